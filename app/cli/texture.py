"""Make a texture and write a piece of it as a picture."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from app.cli.arguments import Parser, read_place, seed, size
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress

if TYPE_CHECKING:
    import numpy as np

    from engine.numeric.address import Rect
    from engine.painting.textures import Texture
    from engine.texture.record import Instance

ROWS, TOGETHER = 256, 1 << 25  # of a strip: rows, and pixels at most
_COLUMNS = 2048  # of the pieces in which a strip is made


class Maker(NamedTuple):
    """A row: what its picture is called, what it does, and the options that go to the maker by their names."""

    picture: str
    about: str
    options: tuple[str, ...]


MAKERS = {
    "spectrum": Maker(
        "AMPLITUDE",
        "The inverse transform of an amplitude spectrum: a texture that tiles.  Brightness times alpha is the "
        "logarithm of the amplitude, zero frequency in the middle; two quadrants are enough",
        ("phase", "forward", "part"),
    ),
    "sparse": Maker(
        "SAMPLE",
        "Endless texture: copies of a sample, under a radial window, scattered at random places",
        ("density", "mean", "spread", "quantise", "turn"),
    ),
    "impulse": Maker(
        "PHOTO",
        "Endless texture like a photograph: windows of it, averaged as spectra, are scattered at random places",
        ("window", "average", "phase", "density", "mean", "spread", "quantise", "turn"),
    ),
}
# Makers that match histograms: they make a texture of one size, whole.
MATCHED = ("match", "mix", "solid")


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("maker", metavar="MAKER", help=f"{_known()}; MAKER --help tells its options")
    parser.add_argument("words", nargs=argparse.REMAINDER, metavar="...", help="the maker's picture and options")


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    name = options.maker
    if name == "example":
        from app.cli.of_examples import example_command

        return example_command.run(options.words)
    if name == "doctor":
        from app.cli.texture_doctor import advice

        return advice.run(options.words)
    if name == "mask":
        from app.cli.of_examples import mask_command

        return mask_command.run(options.words)
    if name == "learn":
        from app.cli.refining import learn_command

        return learn_command.run(options.words)
    if name == "expression":
        from app.cli.written import expression_command

        return expression_command.run(options.words)
    if name in MATCHED:
        from app.cli import match_command, solid_command

        return solid_command.run(options.words) if name == "solid" else match_command.run(name, options.words)
    if name not in MAKERS:
        raise Refused(f"texture: found the maker {name[:40]!a}, expected one of {_known()}")
    given = _parser(name).parse_args(options.words)
    checked_output(given.out, (".png",))
    if os.path.exists(given.out) and os.path.exists(given.picture) and os.path.samefile(given.out, given.picture):
        raise Refused(f"{given.out}: found the {MAKERS[name].picture.lower()} itself, expected another file")
    texture = _defined(name, given)
    size = given.size or _own_size(name, given.picture, texture)
    instance = texture.instance({}, 0, 0)
    channels = _write(given, instance, size)
    _tell(given, texture, size, channels)
    return DONE


def _known() -> str:
    return ", ".join((*MAKERS, *MATCHED, "learn", "expression", "example", "doctor", "mask"))


def _parser(name: str) -> Parser:
    row = MAKERS[name]
    parser = Parser(prog=f"inkfall texture {name}", description=row.about, allow_abbrev=False)
    parser.add_argument("picture", metavar=row.picture, help="a PNG, JPEG or TIFF; grey, RGB or RGBA, 8 or 16 bit")
    parser.add_argument("--out", metavar="P.png", required=True, help="where the texture goes")
    parser.add_argument("--size", type=size, metavar="WxH", help="pixels (default: those of the sample)")
    parser.add_argument("--seed", type=seed, default=0, metavar="S", help="another seed, another texture (default 0)")
    parser.add_argument("--depth", type=int, choices=(8, 16), default=8, help="bits; 16 for height fields")
    if name != "spectrum":
        parser.add_argument(
            "--origin", type=read_place, default=(0, 0), metavar="X,Y", help="place of the window on the endless field"
        )
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    declared: dict[str, dict[str, Any]] = {
        "phase": {"metavar": "P", "help": _PHASES[name]},
        "forward": {"action": "store_true", "help": "the picture is a pattern, the texture its spectrum"},
        "part": {"choices": ("real", "imag", "magnitude", "log", "phase"), "help": "of the transform (default real)"},
        "density": {"type": float, "metavar": "D", "help": "copies per area of the sample (default 10)"},
        "mean": {"type": float, "metavar": "M", "help": "brightness around which it varies, -1 to 1 (default 0)"},
        "spread": {"type": float, "metavar": "S", "help": "contrast, 0 to 4 (default 1; a coloured photo's own)"},
        "quantise": {"type": int, "metavar": "N", "help": "how many different weights copies have (default: any)"},
        "turn": {"type": float, "metavar": "T", "help": "how far copies are turned at random, 0 to 1 (default 0)"},
        "window": {"type": int, "metavar": "N", "help": "pixels along a window (default: chosen from the picture)"},
        "average": {"type": int, "metavar": "N", "help": "how many windows are averaged (default 4)"},
    }
    for option in row.options:
        parser.add_argument(f"--{option}", **declared[option])
    return parser


_PHASES = {
    "spectrum": "random, zero, or a picture of phases, black to white for -180 to 180 degrees (default random; "
    "of a pattern zero)",
    "sparse": "",
    "impulse": "window: of the window in the middle; zero; random (default window)",
}


def _defined(name: str, given: argparse.Namespace) -> Texture:
    """Returns the texture, by the same command as in a recording."""
    from immutables import Map

    from engine.canvas import layers
    from engine.checks.field_error import FieldError
    from engine.makers.makers import define
    from engine.painting.commands import DefineTexture
    from engine.painting.textures import Around

    told = {option: getattr(given, option) for option in MAKERS[name].options}
    arguments = {option: value for option, value in told.items() if value is not None and value is not False}
    command = DefineTexture(name, name, Map({"path": given.picture, "seed": given.seed, **arguments}))
    try:
        return define(command, layers.EMPTY, Around())
    except FieldError as error:
        where = f"--{error.place}" if error.place in told or error.place == "seed" else given.picture or "the picture"
        raise Refused(f"{where}: found {error.found}, expected {error.expected}") from None


def _own_size(name: str, picture: str, texture: Texture) -> tuple[int, int]:
    """Of the sample: that of a narrow spectrum holds several side by side, and only the first is asked for."""
    from engine.files.images import read_image
    from engine.makers.makers import NARROWEST

    assert texture.source is not None
    width, height = texture.source.width, texture.source.height
    if name == "spectrum" and width < 2 * NARROWEST:
        width = read_image(picture)[0].shape[1]
    return width, height


def _write(given: argparse.Namespace, instance: Instance, size: tuple[int, int]) -> int:
    """Writes the texture strip by strip; gives its channels."""
    from engine.files.atomic import replacing
    from engine.files.png_writer import PngWriter
    from engine.numeric.address import Rect

    width, height = size
    x, y = getattr(given, "origin", (0, 0))
    channels = len(instance.appearance(0, Rect.at(x, y, 1, 1)))
    with Progress("making", height) as tell, replacing(given.out) as file:
        writer = PngWriter(file, width, height, channels, given.depth)
        done = 0
        for pixels in _strips(instance, Rect.at(x, y, width, height), given.depth):
            writer.rows(pixels)
            done += len(pixels)
            tell(done)
        writer.close()
    return channels


def _strips(instance: Instance, whole: Rect, depth: int) -> Iterator[np.ndarray]:
    """Yields rows of the texture as pixels: uint8 or uint16 (n, w, channels)."""
    import numpy as np

    from engine.numeric.address import Rect

    full, kind = (255, np.uint8) if depth == 8 else (65535, np.uint16)
    rows = max(16, min(ROWS, TOGETHER // whole.width))
    for y in range(whole.y0, whole.y1, rows):
        pieces = []
        for x in range(whole.x0, whole.x1, _COLUMNS):
            rect = Rect(x, y, min(x + _COLUMNS, whole.x1), min(y + rows, whole.y1))
            s = np.clip(0.5 + 0.5 * instance.appearance(0, rect).astype(np.float64), 0.0, 1.0)
            pieces.append(np.moveaxis(np.floor(s * full + 0.5).astype(kind), 0, -1))
        yield np.ascontiguousarray(np.concatenate(pieces, axis=1))


def _tell(given: argparse.Namespace, texture: Texture, size: tuple[int, int], channels: int) -> None:
    assert texture.source is not None
    told: dict[str, Any] = {
        "written": given.out,
        "size": list(size),
        "channels": channels,
        "bits": given.depth,
        "sample": [texture.source.width, texture.source.height],
        "seed": given.seed,
    }
    told |= {name: texture.parameters[name] for name in ("window", "average") if name in texture.parameters}
    if given.json:
        print(json.dumps(told))
        return
    colours = "grey" if channels == 1 else "colour"
    width, height = told["sample"]
    if "window" in told:
        chosen = "" if given.window else ", chosen from the picture"
        print(f"window of {width} x {height} pixels{chosen}; {told['average']} averaged")
    elif "origin" in given:
        print(f"window of {width} x {height} pixels, the sample's")
    print(f"wrote {given.out}: {size[0]} x {size[1]} pixels, {colours}, {given.depth} bits")
