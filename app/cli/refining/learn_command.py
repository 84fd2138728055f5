"""`inkfall texture learn`: a picture refined past its own resolution by what is learnt of it (Perlin & Velho 1995)."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from app.cli import match_command
from app.cli.arguments import Parser, seed
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress

if TYPE_CHECKING:
    from engine.makers.learning import Finer

_ABOUT = "Refines a picture past its own resolution: its finest pixels tell how they follow from coarser ones"
_ROWS, _COLUMNS = 256, 2048  # pixels that are made at a time
_MOST = 1 << 30  # pixels of what is made


def run(words: list[str]) -> int:
    """Carries the command out; returns the exit status."""
    given = _parser().parse_args(words)
    checked_output(given.out, (".png",))
    example = match_command.read(given.example, given.out)
    if example.planes[0].size << 2 * given.octaves > _MOST:
        raise Refused(f"--octaves: found {given.octaves}, expected fewer for {given.example}: 2^30 pixels at most")
    from engine.makers.heeger_bergen import rgba
    from engine.makers.learning import Finer, maps_for
    from engine.texture.image import ImageSource
    from engine.texture.learnt.refinement import Learning

    source = ImageSource.of("", rgba(example.planes))
    learning = Learning(maps_for("", source), given.strength, given.octaves)
    finer = Finer(source, learning, given.tile, given.seed)
    depth = given.depth or example.bits
    channels = _write(given.out, finer, depth)
    width, height = finer.size
    if given.json:
        told = {"written": given.out, "size": [width, height], "channels": channels, "bits": depth}
        print(json.dumps(told | {"octaves": given.octaves, "strength": given.strength, "seed": given.seed}))
        return DONE
    colours = {1: "grey", 3: "colour", 4: "colour and alpha"}[channels]
    print(f"wrote {given.out}: {width} x {height} pixels, {colours}, {depth} bits")
    return DONE


def _parser() -> Parser:
    parser = Parser(prog="inkfall texture learn", description=_ABOUT, allow_abbrev=False)
    parser.add_argument("example", metavar="EXAMPLE", help=match_command.PICTURE)
    parser.add_argument("--out", metavar="P.png", required=True, help="where the finer picture goes")
    parser.add_argument(
        "--octaves",
        type=match_command.whole(1, 2),
        default=1,
        metavar="N",
        help="1: twice as large, 2: 4 x (default 1)",
    )
    parser.add_argument(
        "--strength", type=match_command.part, default=1.0, metavar="S", help="of what is added, 0..1 (default 1)"
    )
    parser.add_argument("--tile", action="store_true", help="the picture tiles, and so does what is made")
    parser.add_argument("--seed", type=seed, default=0, metavar="S", help="another seed, other grain (default 0)")
    parser.add_argument("--depth", type=int, choices=(8, 16), help="bits (default: the example's)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser


def _write(path: str, finer: Finer, depth: int) -> int:
    """Writes the picture strip by strip; gives its channels."""
    import numpy as np

    from engine.files.atomic import replacing
    from engine.files.png_writer import PngWriter
    from engine.numeric.address import Rect

    width, height = finer.size
    channels = len(finer.planes(Rect(0, 0, 1, 1)))
    with Progress("refining", height) as tell, replacing(path) as file:
        writer = PngWriter(file, width, height, channels, depth)
        for top in range(0, height, _ROWS):
            bottom = min(top + _ROWS, height)
            places = (Rect(x, top, min(x + _COLUMNS, width), bottom) for x in range(0, width, _COLUMNS))
            pieces = [match_command.pixels_of(finer.planes(place), depth) for place in places]
            writer.rows(np.ascontiguousarray(np.concatenate(pieces, axis=1)))
            tell(bottom)
        writer.close()
    return channels
