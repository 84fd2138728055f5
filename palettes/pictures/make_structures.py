"""Draws structures.webp: a dozen kinds of examples, and what is made of each by histograms, by statistics, with
objects, in full layout and of large pieces; beside each what is learnt of its detail, 8 times as near.

python palettes/pictures/make_structures.py
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.ndimage import uniform_filter

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
sys.path[:0] = [str(ROOT), str(FOLDER), str(FOLDER.parent / "brushes" / "examples")]

import make_examples  # noqa: E402
import make_sheet  # noqa: E402

from engine.numeric.address import Rect  # noqa: E402
from engine.painting.commands import parse  # noqa: E402
from engine.painting.grown import settled  # noqa: E402
from engine.painting.value import Painting  # noqa: E402
from engine.session.apply import apply  # noqa: E402
from engine.texture.record import Instance  # noqa: E402
from engine.texture.table import instance  # noqa: E402

TEXTURE, SEEN, NEARBY = 128, 112, 72  # px, of a texture, of what is shown of it, and across what is shown from near
CLOSER = 3  # levels
SPACE, LABELS, HEADS = 4, 84, 26  # px, between cells, of the names on the left and of the titles above
# From even grain to things, with the names of the examples that they are cut from; wood is grown here.
KINDS = {
    "felt": "felt",
    "rust": "rust-and-paint",
    "turf": "turf",
    "bread": "bread",
    "embroidery": "embroidery",
    "wood": "",
    "orange": "orange-segment",
    "lava": "lava",
    "leaves": "leaves",
    "gravel": "mossy-gravel",
    "bricks": "brick-in-plaster",
    "print": "torn-headlines",
}
_MATCHED = {"maker": "match", "size": [TEXTURE, TEXTURE], "seed": 1}
COLUMNS = {
    "example": {"maker": "image"},
    "histograms": _MATCHED,
    "statistics": _MATCHED | {"structure": "statistics"},
    "objects": _MATCHED | {"structure": "objects"},
    "full layout": _MATCHED | {"structure": "full"},
    "pieces": _MATCHED | {"structure": "pieces"},
}
_SHEET, _INK = "#faf0e6", "#3a2e26"


def example(name: str) -> Image.Image:
    """A square from inside a bundled example, or wood."""
    if not name:
        return wood()
    return make_examples.inside(Image.open(FOLDER.parent / "examples" / f"{name}.png"), TEXTURE)


def wood(side: int = TEXTURE) -> Image.Image:
    """Long grain that bends, between pores."""
    bent, pores = (
        _along(instance("rock", {"period": period, "roughness": 0.5, "seed": 5}, 0, 0), side, tall)
        for period, tall in ((60, 3), (4, 8))
    )
    rings = 0.5 + 0.5 * np.sin(np.pi * (np.arange(side) / 6.0 + 2.5 * bent))
    light = np.clip(0.8 * rings**1.5 + 0.3 * pores, 0.0, 1.0)[..., None]
    colours = (1.0 - light) * np.array([104, 62, 32]) + light * np.array([204, 158, 100])
    return Image.fromarray(np.rint(colours).astype(np.uint8))


def _along(rock: Instance, side: int, tall: int) -> np.ndarray:
    """Rock whose features are so many times as tall."""
    seen = rock.appearance(0, Rect.at(0, 0, side, -(-side // tall)))[0]
    return np.asarray(Image.fromarray(seen).resize((side, side), Image.Resampling.BICUBIC))


def filled(path: Path, members: dict[str, object]) -> Painting:
    """A painting all over with the texture of an example."""
    painting = apply(
        Painting(seed=7), parse({"do": "texture", "name": "t", "path": str(path), "detail": "learnt"} | members)
    )
    ink = {"texture": "t", "amount": 1, "colour": "#ffffff"}
    brush = {"radius": TEXTURE, "hardness": 1, "dynamics": {}, "ink": [ink]}
    points = [[0, TEXTURE / 2], [TEXTURE, TEXTURE / 2]]
    return settled(apply(painting, parse({"do": "stroke", "points": points, "brush": brush})))


def busiest(picture: Image.Image) -> tuple[float, float]:
    """The place where most is to be seen from near: an edge rather than the face of a stone."""
    tall, wide = SEEN >> CLOSER, NEARBY >> CLOSER
    grey = np.asarray(picture.convert("L"), np.float32)
    spread = uniform_filter(grey * grey, (tall, wide)) - uniform_filter(grey, (tall, wide)) ** 2
    inner = spread[tall:-tall, wide:-wide]
    row, column = np.unravel_index(np.argmax(inner), inner.shape)
    return float(column + wide), float(row + tall)


def pair(painting: Painting) -> Image.Image:
    """What a painting shows, and beside it a part of that from near."""
    out = Image.new("RGB", (SEEN + 1 + NEARBY, SEEN), _SHEET)
    whole = make_sheet.seen(painting, 0, (SEEN / 2, SEEN / 2), (SEEN, SEEN))
    out.paste(whole)
    out.paste(make_sheet.seen(painting, CLOSER, busiest(whole), (NEARBY, SEEN)), (SEEN + 1, 0))
    return out


def drawn(kinds: dict[str, str]) -> Image.Image:
    """The sheet of some kinds."""
    wide, tall = SEEN + 1 + NEARBY + 2 * SPACE, SEEN + SPACE
    page = Image.new("RGB", (LABELS + len(COLUMNS) * wide, HEADS + len(kinds) * tall), _SHEET)
    pen, font = ImageDraw.Draw(page), ImageFont.load_default(14)
    for column, title in enumerate(COLUMNS):
        pen.text((LABELS + column * wide, HEADS // 2), title, _INK, font, "lm")
    with tempfile.TemporaryDirectory() as folder:
        for row, (kind, name) in enumerate(kinds.items()):
            path, y = Path(folder) / f"{kind}.png", HEADS + row * tall
            example(name).save(path)
            pen.text((SPACE, y + SEEN // 2), kind, _INK, font, "lm")
            for column, members in enumerate(COLUMNS.values()):
                page.paste(pair(filled(path, members)), (LABELS + column * wide, y))
    return page


def main() -> None:
    drawn(KINDS).save(FOLDER / "structures.webp", quality=80, method=6)


if __name__ == "__main__":
    main()
