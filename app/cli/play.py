"""Replay a recording without a window, and write what it painted."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from typing import TYPE_CHECKING

from app.cli.arguments import count, rectangle, seed
from app.cli.match_command import MOST, whole
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output, picture_of, salvage_option, salvageable
from app.cli.progress import Progress
from engine.brush.modes import MODES

if TYPE_CHECKING:
    from engine.files.fault import FileError
    from engine.painting.recording import Recording


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("recording", metavar="RECORDING", help="a recording, .jsonl")
    parser.add_argument("--save", metavar="P.ora", help="write the painting")
    parser.add_argument("--png", metavar="P.png", help="write a picture of the frame, or of --rect")
    parser.add_argument("--rect", type=rectangle, metavar="L,X,Y,W,H", help="level, and rectangle in its pixels")
    parser.add_argument("--until", type=count, metavar="N", help="only the first N commands")
    parser.add_argument("--seed", type=seed, metavar="S", help="of the textures, instead of the recording's")
    parser.add_argument("--threads", type=whole(1, MOST), metavar="N", help="default: as many as there are cores")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    salvage_option(parser)
    modes = [f"  {row.name:<8} {row.tooltip}" for row in MODES.values()]
    where = "palettes/recording.md tells all that a recording may hold."
    parser.epilog = "\n".join(["modes of a brush:", *modes, "", where])
    parser.formatter_class = argparse.RawDescriptionHelpFormatter


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    if options.rect is not None and options.png is None:
        raise Refused("--rect: found no --png, expected one to write the rectangle to")
    checked_output(options.save, (".ora",))
    checked_output(options.png, (".png",))
    from engine.archive.export import export
    from engine.archive.saving import Snapshot, save
    from engine.painting.grown import settled
    from engine.session.replay import replay_torn

    recording, torn = _read(options)
    start = time.perf_counter()
    played = 0
    with Progress("playing", len(recording.commands)) as progress:

        def tell(done: int) -> None:
            nonlocal played
            played = done
            progress(done)

        session, fault = replay_torn(recording, seed=options.seed, tell=tell)
        if fault is not None and not options.salvage:
            raise fault
        painting = settled(session.painting, options.threads)
    seconds = time.perf_counter() - start
    if options.save is not None:
        with Progress("saving", 100) as tell:
            save(options.save, Snapshot(painting, session.recording()), tell.part)
    if options.png is not None:
        with Progress("writing", 100) as tell:
            export(options.png, picture_of(painting, options.rect), tell.part)
    _tell(options, played, seconds)
    missing = fault or torn
    if missing is not None:
        print(f"inkfall: {missing}; what comes before was played, the rest is missing", file=sys.stderr)
    return DONE


def _read(options: argparse.Namespace) -> tuple[Recording, FileError | None]:
    """Returns the commands to play, and what is wrong with what follows them if that may be."""
    from engine.painting.recording import COMMANDS_CAP, read_torn

    recording, torn = read_torn(options.recording, COMMANDS_CAP if options.until is None else options.until)
    if torn is not None and not options.salvage:
        raise salvageable(torn)
    return recording, torn


def _tell(options: argparse.Namespace, commands: int, seconds: float) -> None:
    written = [os.fspath(path) for path in (options.save, options.png) if path is not None]
    if options.json:
        print(json.dumps({"commands": commands, "seconds": round(seconds, 3), "written": written}))
    else:
        print(f"{commands} commands in {seconds:.2f} s" + "".join(f", wrote {path}" for path in written))
