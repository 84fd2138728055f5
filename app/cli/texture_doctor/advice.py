"""`inkfall texture doctor`: what kind of texture a picture is, and which maker suits it, with all of them side by
side."""

from __future__ import annotations

import argparse
import json
from typing import TYPE_CHECKING, Any

from app.cli.arguments import Parser, seed
from app.cli.match_command import PICTURE, read, write
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress

if TYPE_CHECKING:
    from engine.makers.doctor.examining import Report, Trial

_ABOUT = "Tells which maker of textures suits an example, and shows what all of them make of it, side by side"


def run(words: list[str]) -> int:
    """Carries the command out; returns the exit status."""
    given = _parser().parse_args(words)
    checked_output(given.png, (".png",))
    report = _examined(given)
    told = facts(report)
    if given.png:
        from app.cli.texture_doctor.doctor_sheet import doctor_sheet

        write(given.png, doctor_sheet(report))
        told["written"] = given.png
    if given.json:
        print(json.dumps({"file": given.example, **told}))
    else:
        _print(given.example, told)
    return DONE


def _parser() -> Parser:
    parser = Parser(prog="inkfall texture doctor", description=_ABOUT, allow_abbrev=False)
    parser.add_argument("example", metavar="EXAMPLE", help=f"{PICTURE}; the middle 256 x 256 are looked at")
    parser.add_argument("--flat", action="store_true", help="take out falling light and a slanted view first")
    parser.add_argument("--png", metavar="SHEET", help="write a sheet of what all makers make of it")
    parser.add_argument("--seed", type=seed, default=0, metavar="S", help="another seed, other textures (default 0)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser


def _examined(given: argparse.Namespace) -> Report:
    from engine.checks.field_error import FieldError
    from engine.makers.doctor.examining import examined
    from engine.makers.doctor.trying import TRIED

    planes, report = read(given.example, given.png or "").planes, None
    try:
        with Progress("examining", len(TRIED)) as bar:
            for found in examined(planes, given.seed, given.flat):
                if found is not None:
                    report = found
                    bar(len(found.trials))
    except FieldError as error:
        raise Refused(f"{given.example}: found {error.found}, expected {error.expected}") from None
    assert report is not None
    return report


def facts(report: Report) -> dict[str, Any]:
    """Returns what there is to tell of a report, ready for JSON."""
    grain, gradients = report.grain, report.gradients
    height, width = report.example.shape[1:]
    return {
        "looked_at": [width, height],
        "kinds": list(report.kinds),
        "periods": [{"length": round(one.length, 1), "angle": round(one.angle, 1)} for one in grain.periods],
        "angle": None if grain.angle is None else round(grain.angle, 1),
        "structure": round(grain.structure, 3),
        "light": round(gradients.light, 3),
        "slant": gradients.slant or None,
        "trials": {trial.way: _of_trial(trial) for trial in report.trials},
        "advice": report.advice,
        "why": report.why,
    }


def _of_trial(trial: Trial) -> dict[str, Any]:
    if trial.likeness is None:
        return {"fault": trial.fault}
    return {
        "seconds": round(trial.seconds, 3),
        "apart": round(trial.likeness.apart, 3),
        "statistics": round(trial.likeness.statistics, 3),
        "patches": round(trial.likeness.patches, 3),
        "copied": round(trial.likeness.copied, 3),
    }


def _print(path: str, told: dict[str, Any]) -> None:
    kinds = ", ".join(told["kinds"]) or "of one colour"
    print(f"{path}: {kinds}")
    for period in told["periods"]:
        print(f"  repeats every {period['length']:g} px, at {period['angle']:g} degrees")
    if told["angle"] is not None:
        print(f"  lies along {told['angle']:g} degrees")
    if told["light"]:
        print(f"  light falls off over it: {told['light']:.0%} of its brightness' variance (--flat takes it out)")
    if told["slant"]:
        print(f"  seen at a slant: it goes away {told['slant']} (--flat takes it out)")
    for way, trial in told["trials"].items():
        if "fault" in trial:
            print(f"  {way:12} {trial['fault']}")
        else:
            print(f"  {way:12} {trial['apart']:5.2f} apart, {trial['copied']:4.0%} copied, {trial['seconds']:.2f} s")
    print(f"advice: {told['advice']}. {told['why']}")
    if "written" in told:
        print(f"wrote {told['written']}")
