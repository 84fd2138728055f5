"""Play the bundled demo recording: live in the window, or without a display into a painting and pictures."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

from app.cli.arguments import Rectangle
from app.cli.outcome import DONE, Failed
from app.cli.output import picture_of
from app.cli.progress import Progress

PALETTES = Path(__file__).resolve().parent.parent.parent / "palettes"
RECORDING = PALETTES / "demo" / "demo.jsonl"
PLACES = PALETTES / "demo" / "demo.json"  # {"zoom": [[L, X, Y, W, H], ...]}
FOLDER = "inkfall-demo"


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument(
        "--out", metavar="DIR", help=f"write pictures into DIR (without a display: {FOLDER}), no window"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object; no window")


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    if options.out is None and not options.json and _in_window():
        return DONE
    return _in_pictures(Path(options.out or FOLDER), options.json)


def _in_window() -> bool:
    """Plays in the window until it is closed; False if there is none to be had."""
    from app.cli.doctor import display

    if display() is None:
        print("No display here, so the demo goes into files.")
        return False
    try:
        from app.loop import WindowError, run
    except ImportError as error:
        print(f"The window's libraries cannot be loaded ({error}), so the demo goes into files.")
        return False
    try:
        return run(play=str(RECORDING)) == 0
    except WindowError as error:
        print(f"The window cannot be opened ({error}), so the demo goes into files.")
        return False


def _in_pictures(folder: Path, as_json: bool) -> int:
    from engine.archive.export import export
    from engine.archive.saving import Snapshot, save
    from engine.painting.grown import settled
    from engine.painting.recording import read
    from engine.session.replay import replay

    places = [Rectangle(*place) for place in json.loads(PLACES.read_text())["zoom"]]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Failed(f"{folder}: the folder cannot be made: {error.strerror}") from None
    recording = read(RECORDING)
    with Progress("painting", len(recording.commands)) as tell:
        session = replay(recording, tell=tell)
        painting = settled(session.painting)
    written = [folder / "demo.ora", folder / "demo.png"]
    with Progress("writing", len(places) + 2) as tell:
        save(written[0], Snapshot(painting, session.recording()))
        tell(1)
        export(written[1], picture_of(painting, None))
        for number, place in enumerate(places):
            tell(number + 2)
            written.append(folder / f"demo-zoom-{number:02}.png")
            export(written[-1], picture_of(painting, place))
    if as_json:
        print(json.dumps({"written": [os.fspath(path) for path in written]}))
    else:
        print(f"Painted {len(recording.commands)} commands; wrote into {folder}/:")
        print("  " + ", ".join(path.name for path in written[:2]))
        if places:
            print(f"  {written[2].name} to {written[-1].name}, at levels {places[0].level} to {places[-1].level}")
    return DONE
