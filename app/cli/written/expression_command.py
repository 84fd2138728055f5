"""`inkfall texture expression`: a texture that somebody wrote, as a picture (Perlin & Velho 1995, 8.2)."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from app.cli.arguments import Parser, read_place, seed, size
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output
from app.cli.progress import Progress
from app.cli.written.named_files import defined_among, text_of_file, textures_named

if TYPE_CHECKING:
    import numpy as np

    from engine.numeric.address import Rect
    from engine.texture.expression.examined import LineLook
    from engine.texture.expression.written_ink import Expression

_ABOUT = "Draws a texture written as an expression: named lines, the last one is the texture.  Its words: --words"
_SIZE = (512, 512)
_ROWS, _COLUMNS = 128, 2048  # pixels that are made at a time
_LEVELS = 1 << 16


class _Given(NamedTuple):
    """A text, and what it is called where it is wrong."""

    text: str
    where: str


def run(words: list[str]) -> int:
    """Carries the command out; returns the exit status."""
    given = _parser().parse_args(words)
    if given.words:
        return _tell_words()
    text = _text(given)
    if given.out is None and given.debug is None:
        raise Refused("texture expression: found no output, expected --out P.png or --debug SHEET.png")
    for path in (given.out, given.debug):
        if path is not None:
            checked_output(path, (".png",))
    made = _made(text, given)
    whole = _rect(given)
    told: dict[str, object] = {}
    if given.out is not None:
        told = {"written": given.out, "size": [whole.width, whole.height], "level": given.level}
        told |= {"channels": _write(given, made, whole), "bits": given.depth, "seed": given.seed}
    if given.debug is not None:
        told["sheet"] = given.debug
        _sheet(given, made, whole)
    _tell(given, made, whole, told)
    return DONE


def _parser() -> Parser:
    parser = Parser(prog="inkfall texture expression", description=_ABOUT, allow_abbrev=False)
    parser.add_argument("file", metavar="FILE", nargs="?", help="a text file")
    parser.add_argument("--text", metavar="T", help="the text itself; ; ends a line")
    parser.add_argument("--out", metavar="P.png", help="where the picture goes")
    parser.add_argument("--size", type=size, default=_SIZE, metavar="WxH", help="pixels (default 512x512)")
    parser.add_argument("--level", type=_level, default=0, metavar="L", help="each has twice the pixels (default 0)")
    parser.add_argument("--origin", type=read_place, default=(0, 0), metavar="X,Y", help="in pixels of the level")
    parser.add_argument("--period", type=float, default=64.0, metavar="P", help="what x = 1 is, in pixels of level 0")
    parser.add_argument("--seed", type=seed, default=0, metavar="S", help="another seed, another texture (default 0)")
    parser.add_argument("--pressure", type=_felt, default=1.0, metavar="P", help="of the pen, 0 to 1 (default 1)")
    parser.add_argument("--rim", type=_felt, default=1.0, metavar="R", help="distance from the stroke's, 0 to 1")
    parser.add_argument("--direction", type=float, default=0.0, metavar="D", help="of the stroke, degrees clockwise")
    parser.add_argument("--stages", type=int, metavar="N", help="mixed pressures, 2 to 9 (default 5)")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a slider, or a colour")
    parser.add_argument(
        "--texture",
        action="append",
        default=[],
        metavar="NAME=FILE",
        help='a picture or a .txt that the text names, "NAME"(x, y)',
    )
    parser.add_argument("--depth", type=int, choices=(8, 16), default=8, help="bits")
    parser.add_argument("--debug", metavar="SHEET.png", help="each of its lines as a picture, and how far it shimmers")
    parser.add_argument("--words", action="store_true", help="tell all functions of the language")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser


def _level(text: str) -> int:
    try:
        value = int(text)
    except ValueError:
        value = _LEVELS + 1
    if abs(value) > _LEVELS:
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected an integer from -{_LEVELS} to {_LEVELS}")
    return value


def _felt(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected a number from 0 to 1")
    return value


def _text(given: argparse.Namespace) -> _Given:
    if (given.file is None) == (given.text is None):
        found = "both" if given.file is not None else "neither"
        raise Refused(f"texture expression: found {found}, expected FILE or --text T")
    if given.text is not None:
        return _Given(given.text, "--text")
    return _Given(text_of_file(given.file), given.file)


def _made(text: _Given, given: argparse.Namespace) -> Expression:
    """Returns the texture, by the same command as in a recording."""
    from immutables import Map

    from engine.checks.field_error import FieldError
    from engine.painting.commands import DefineTexture
    from engine.texture.expression.defined import expression
    from engine.texture.expression.written_ink import Expression

    values = dict(_setting(word) for word in given.set)
    told = {
        "text": text.text,
        "period": given.period,
        "seed": given.seed,
        "values": Map(values),
    }
    told |= {} if given.stages is None else {"stages": given.stages}
    told |= {"weight": given.pressure, "rim": given.rim, "direction": given.direction}
    others = textures_named(given.texture)
    try:
        if '"' not in text.text:
            return expression(told, min(given.level, 0))
        made = defined_among(others, DefineTexture("", "expression", Map(told))).instance({}, min(given.level, 0), 0)
        assert isinstance(made, Expression)
        return made
    except FieldError as error:
        where = _where(error.place, text.where)
        raise Refused(f"{where}: found {error.found}, expected {error.expected}") from None


def _where(place: str, text: str) -> str:
    """Returns where on the command line something is wrong."""
    if place.startswith("text"):
        return text + place.removeprefix("text")
    return f"--set {place.removeprefix('values').removeprefix('.')}".rstrip() if "values" in place else f"--{place}"


def _setting(word: str) -> tuple[str, float | str]:
    name, sign, value = word.partition("=")
    if not sign or not name.isidentifier():
        raise Refused(f"--set: found {word[:40]!a}, expected NAME=VALUE")
    if value.startswith("#"):
        return name, value
    try:
        return name, float(value)
    except ValueError:
        raise Refused(f"--set {name[:40]}: found {value[:40]!a}, expected a number, or a colour #rrggbb") from None


def _rect(given: argparse.Namespace) -> Rect:
    from engine.numeric.address import Rect

    return Rect.at(*given.origin, *given.size)


def _write(given: argparse.Namespace, made: Expression, whole: Rect) -> int:
    """Writes the picture strip by strip; gives its channels."""
    from engine.files.atomic import replacing
    from engine.files.png_writer import PngWriter

    channels = _channels(made, given.level)
    with Progress("drawing", whole.height) as tell, replacing(given.out) as file:
        writer = PngWriter(file, whole.width, whole.height, channels, given.depth)
        done = 0
        for rows in _strips(made, whole, given):
            writer.rows(rows)
            done += len(rows)
            tell(done)
        writer.close()
    return channels


def _channels(made: Expression, level: int) -> int:
    return 1 if made.at(level).channels == 1 else (3 if made.cover is None else 4)


def _strips(made: Expression, whole: Rect, given: argparse.Namespace) -> Iterator[np.ndarray]:
    """Yields rows of the texture as pixels: uint8 or uint16 (n, w, channels), alpha not premultiplied."""
    import numpy as np

    from engine.numeric.address import Rect

    channels, parts = _channels(made, given.level), made.under(given.pressure, given.rim)
    for y in range(whole.y0, whole.y1, _ROWS):
        pieces = []
        for x in range(whole.x0, whole.x1, _COLUMNS):
            rect = Rect(x, y, min(x + _COLUMNS, whole.x1), min(y + _ROWS, whole.y1))
            mixed = [np.float32(part) * one.means(given.level, rect) for part, one in parts]
            pieces.append(_pixels(np.sum(mixed, axis=0), channels, given.depth))
        yield np.ascontiguousarray(np.concatenate(pieces, axis=1))


def _pixels(seen: np.ndarray, channels: int, depth: int) -> np.ndarray:
    import numpy as np

    full, kind = (255, np.uint8) if depth == 8 else (65535, np.uint16)
    s = seen[:channels].astype(np.float64)
    if channels == 1:
        s = 0.5 + 0.5 * s
    elif channels == 4:
        s[:3] /= np.maximum(s[3:], 1e-6)
    return np.moveaxis(np.floor(np.clip(s, 0.0, 1.0) * full + 0.5).astype(kind), 0, -1)


def _sheet(given: argparse.Namespace, made: Expression, whole: Rect) -> None:
    import numpy as np

    from app.cli.written.lines_sheet import lines_sheet
    from engine.files.atomic import replacing
    from engine.files.png_writer import PngWriter

    page = lines_sheet(made, given.level, whole)
    with replacing(given.debug) as file:
        writer = PngWriter(file, page.shape[1], page.shape[0], 3, 8)
        writer.rows(np.ascontiguousarray(page))
        writer.close()


def _tell(given: argparse.Namespace, made: Expression, whole: Rect, told: dict[str, object]) -> None:
    from engine.texture.expression.examined import line_looks

    looks = line_looks(made, given.level)
    samples, cost = looks[-1].samples, looks[-1].cost
    if given.json:
        lines = [_line(look) for look in looks]
        print(json.dumps(told | {"samples": samples or "1 to 16", "cost": round(cost), "lines": lines}))
        return
    colours = {1: "grey", 3: "colour", 4: "colour and alpha"}
    how = f"{looks[-1].told} and about {cost:.0f} ns a pixel"
    if given.out is not None:
        kind = colours[_channels(made, given.level)]
        print(f"wrote {given.out}: {whole.width} x {whole.height} pixels, {kind}, {given.depth} bits; {how}")
    if given.debug is not None:
        print(f"wrote {given.debug}: {len(looks)} lines; {how}")


def _line(look: LineLook) -> dict[str, object]:
    told = {"name": look.name, "row": look.row, "kind": "colour" if look.coloured else "number"}
    return told | {"samples": look.samples or "1 to 16", "cost": round(look.cost)}


def _tell_words() -> int:
    from engine.texture.expression.language import FUNCTIONS
    from engine.texture.expression.written import PLACE_NAMES

    for name, about in PLACE_NAMES.items():
        print(f"{name}: {about}")
    for row in FUNCTIONS.values():
        print(row[3])
    return DONE
