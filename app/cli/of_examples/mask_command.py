"""`inkfall texture mask`: what lies on a picture's ground, as a mask and as colours without the ground."""

from __future__ import annotations

import argparse
import json
import os
import re
from typing import TYPE_CHECKING

from app.cli.arguments import Parser
from app.cli.match_command import PICTURE, write
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress

if TYPE_CHECKING:
    import numpy as np

    from engine.texture.mattes.marks import Mark

Points = tuple[tuple[float, float], ...]
_ABOUT = "Finds what lies on the ground of a picture: a mask of it, and its colours without the ground"
_PIXELS = 1 << 26  # of a picture
_COORDINATES = 2000  # of a stroke, at most


def run(words: list[str]) -> int:
    """Carries the command out; returns the exit status."""
    given = _parser().parse_args(words)
    checked_output(given.out, (".png",))
    colours = f"{given.out[:-4]}.colours.png"
    for path in (given.out, colours):
        if os.path.exists(path) and os.path.exists(given.picture) and os.path.samefile(path, given.picture):
            raise Refused(f"{path}: found the picture itself, expected another file")
    from engine.files.images import read_image

    pixels, _ = read_image(given.picture)
    height, width = pixels.shape[:2]
    if height * width > _PIXELS:
        raise Refused(f"{given.picture}: found {width} x {height} pixels, expected at most {_PIXELS} in all")
    cut, whole = _cut_out(pixels, _marks(given, width, height))
    write(given.out, cut[..., 3:].copy())
    write(colours, cut)
    _tell(given, cut, whole, colours)
    return DONE


def _parser() -> Parser:
    parser = Parser(prog="inkfall texture mask", description=_ABOUT, allow_abbrev=False)
    parser.add_argument("picture", metavar="PICTURE", help=PICTURE)
    help_ = "where the mask goes: white inside, grey at a soft rim; M.colours.png beside it has the colours"
    parser.add_argument("--out", metavar="M.png", required=True, help=help_)
    for name, what in (("keep", "belongs to it"), ("drop", "is ground")):
        help_ = f"what lies there {what}: a pixel, or a stroke X,Y,X,Y,...; may be given several times"
        parser.add_argument(f"--{name}", metavar="X,Y", type=read_points, action="append", default=[], help=help_)
    help_ = "of what --keep and --drop cover, pixels (default: a hundredth of the longer side)"
    parser.add_argument("--radius", metavar="R", type=_radius, help=help_)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser


def read_points(text: str) -> Points:
    """`X,Y` or `X,Y,X,Y,...`: whole numbers."""
    if re.fullmatch(r"-?[0-9]{1,9}(,-?[0-9]{1,9})+", text):
        numbers = [float(part) for part in text.split(",")]
        if len(numbers) % 2 == 0 and len(numbers) <= _COORDINATES:
            return tuple(zip(numbers[::2], numbers[1::2], strict=True))
    raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected X,Y: a pixel, or several in a row")


def _radius(text: str) -> float:
    if not re.fullmatch(r"[0-9]{1,5}(\.[0-9]{1,9})?", text) or not float(text) > 0.0:
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected pixels above 0")
    return float(text)


def _marks(given: argparse.Namespace, width: int, height: int) -> list[Mark]:
    """Returns what was said, in pixels of the picture; what is dropped lies over what is kept."""
    from engine.texture.mattes.marks import Mark

    radius = given.radius or max(1.0, max(width, height) / 100)
    found = []
    for name, strokes in (("keep", given.keep), ("drop", given.drop)):
        for points in strokes:
            for x, y in points:
                if not (0 <= x < width and 0 <= y < height):
                    raise Refused(
                        f"--{name}: found {x:.0f},{y:.0f}, expected a pixel of the picture, {width} x {height}"
                    )
            found.append(Mark(name == "keep", tuple((x + 0.5, y + 0.5) for x, y in points), radius))
    return found


def _cut_out(pixels: np.ndarray, marks: list[Mark]) -> tuple[np.ndarray, bool]:
    """Returns what is cut out, RGBA (h, w, 4), and whether that is all."""
    from engine.texture.mattes.finding import Cut, outlined, sought

    with Progress("finding", 100) as bar:
        looked = sought(pixels)
        outline = outlined(looked, marks)
        cut = Cut(looked, outline)
        for done, _ in cut.steps():
            bar.part(done)
    return cut.pixels, outline.whole


def _tell(given: argparse.Namespace, cut: np.ndarray, whole: bool, colours: str) -> None:
    from engine.texture.mattes.things import things

    height, width = cut.shape[:2]
    inside = float((cut[..., 3] > 0).mean())
    places = [[r.x0, r.y0, r.width, r.height] for r in things(cut)]
    facts: dict[str, object] = {
        "written": given.out,
        "colours": colours,
        "size": [width, height],
        "bits": 8 * cut.dtype.itemsize,
        "inside": round(inside, 4),
        "whole": whole,
        "regions": places,
    }
    if given.json:
        print(json.dumps(facts))
        return
    if whole:
        print("no ground was found: all that is not transparent is inside")
    several = f", {len(places)} regions" if len(places) > 1 else ""
    print(f"wrote {given.out} and {colours}: {width} x {height} pixels, {inside:.0%} inside{several}")
