"""Replay a recording without a window, and write what it painted."""

from __future__ import annotations

import argparse
import json
import os
import time

from app.cli.arguments import count, rectangle, seed
from app.cli.match_command import MOST, whole
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output, picture_of
from app.cli.progress import Progress
from engine.brush.modes import MODES


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
    from engine.painting.recording import read
    from engine.session.replay import replay

    recording = read(options.recording)
    if options.until is not None:
        recording = recording.until(options.until)
    start = time.perf_counter()
    with Progress("playing", len(recording.commands)) as tell:
        session = replay(recording, seed=options.seed, tell=tell)
        painting = settled(session.painting, options.threads)
    seconds = time.perf_counter() - start
    if options.save is not None:
        with Progress("saving", 100) as tell:
            save(options.save, Snapshot(painting, session.recording()), tell.part)
    if options.png is not None:
        with Progress("writing", 100) as tell:
            export(options.png, picture_of(painting, options.rect), tell.part)
    _tell(options, len(recording.commands), seconds)
    return DONE


def _tell(options: argparse.Namespace, commands: int, seconds: float) -> None:
    written = [os.fspath(path) for path in (options.save, options.png) if path is not None]
    if options.json:
        print(json.dumps({"commands": commands, "seconds": round(seconds, 3), "written": written}))
    else:
        print(f"{commands} commands in {seconds:.2f} s" + "".join(f", wrote {path}" for path in written))
