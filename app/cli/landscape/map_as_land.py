"""Make a painting whose land is a height map: a 16-bit PNG, a TIFF or GeoTIFF, an EXR.  Finer ground, as rough as the
map, lies below its pixels; the file itself is kept with the painting."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from app.cli.arguments import Rectangle, rectangle
from app.cli.landscape.land_view import number
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress
from engine.checks.roles import AS_HEIGHT

if TYPE_CHECKING:
    from engine.session.session import Session

_LAND = "Land"  # the layer, where the painting has none of heights


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("map", metavar="MAP", help=".png .tif .tiff .exr")
    parser.add_argument("out", metavar="OUT.ora")
    parser.add_argument("--in", dest="painting", metavar="PAINTING.ora", help="which gets it (default: a new one)")
    rect = "level, and rectangle in its pixels (default: one for each of the map's, from 0, 0)"
    parser.add_argument("--rect", type=rectangle, metavar="L,X,Y,W,H", help=rect)
    ends = "pixels of the level at which its lowest and highest lie (default: to scale, where a GeoTIFF tells it)"
    parser.add_argument("--range", metavar="LOW,HIGH", help=ends)
    rock = "how much finer ground there is below its pixels (default 1: as rough as the map)"
    parser.add_argument("--rock", type=number, metavar="A", help=rock)
    rim = "pixels of the level over which it grows from nothing"
    parser.add_argument("--rim", type=number, metavar="PX", help=rim)


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    checked_output(options.out, (".ora",))
    if os.path.exists(options.out) and os.path.samefile(options.map, options.out):
        raise Refused(f"{options.out}: found the map itself, expected another file to write to")
    ends = None if options.range is None else _ends(options.range)
    from engine.archive.saving import Snapshot, save
    from engine.painting.commands import parse
    from engine.painting.layering.ground_command import in_full
    from engine.session.landforms.laid_map import map_in

    held, found = map_in(options.map)
    height, width = found.heights.shape
    at = Rectangle(0, 0, 0, width, height) if options.rect is None else options.rect
    told: dict[str, object] = {"do": "ground", "path": os.path.abspath(options.map), "sha": held.sha, "rect": [*at]}
    for name, value in (("range", ends), ("rock", options.rock), ("rim", options.rim)):
        if value is not None:
            told[name] = value
    commands = [parse(one, "") for one in in_full(told)]
    session = _session(options.painting, (width, height))
    for command in commands:
        session.do(command, held)
    with Progress("saving", 100) as tell:
        save(options.out, Snapshot(session.painting, session.recording()), tell.part)
    print(f"wrote {options.out}: {found.told}")
    return DONE


def _ends(text: str) -> list[float]:
    words = text.split(",")
    if len(words) != 2:
        raise Refused(f"--range: found {text[:40]!a}, expected LOW,HIGH in pixels")
    try:
        return [number(word) for word in words]
    except argparse.ArgumentTypeError as error:
        raise Refused(f"--range: {error}") from None


def _session(path: str | None, size: tuple[int, int]) -> Session:
    """Returns what is to have the ground, with a layer of heights: a new painting of a size, or one from a file."""
    from engine.numeric.address import Rect
    from engine.numeric.arithmetic import EVERYWHERE
    from engine.painting.commands import AddLayer, SetLayer
    from engine.painting.recording import Header
    from engine.painting.value import first_painting
    from engine.session.session import Session
    from engine.studio.filing.documents import opened
    from engine.terrain.plane import heights_of

    if path is None:
        session = Session(first_painting(Header(Rect.at(0, 0, *size), arithmetic=EVERYWHERE)))
    else:
        session = opened(Path(path)).session()
    if heights_of(session.painting) is None:
        session.do(AddLayer(_LAND))
        session.do(SetLayer(_LAND, role=AS_HEIGHT))
    return session
