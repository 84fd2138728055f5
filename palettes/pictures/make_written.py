"""Draws written.webp: every written texture that comes along as a brush lays it, and 8, 64 and 1024 times as near.

python palettes/pictures/make_written.py
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from scipy.ndimage import uniform_filter

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1]))

from engine.numeric.address import Rect  # noqa: E402
from engine.texture.expression.defined import expression  # noqa: E402
from engine.texture.expression.library.bundled_texts import LibraryText, written_library  # noqa: E402
from engine.texture.expression.written_ink import Expression  # noqa: E402

COLUMNS, MARGIN, GAP, HEAD = 4, 22, 12, 19
WIDE, NEAR, TALL = 190, 62, 124  # of 1:1, of each view from near, and of all
NEARER = (3, 6, 10)  # levels: 8, 64 and 1024 times as near
START = (1.4, 1.0)  # periods: the middle of 1:1
BUSY = 0.9  # of the places, by how much there is to see, which one is looked at from near
_PAPER, _INK, _FAINT = (250, 244, 234), "#3a2e26", "#9a8878"


def seen(made: Expression, level: int, middle: tuple[float, float], size: tuple[int, int]) -> np.ndarray:
    """What lies about a place, in periods, over paper: float32 (3, h, w), 0..1."""
    x, y = (round(v * made.period * 2.0**level) - s // 2 for v, s in zip(middle, size, strict=True))
    planes = made.means(level, Rect.at(x, y, *size))
    if len(planes) == 1:
        return np.repeat(0.5 + 0.5 * planes, 3, axis=0)
    ground = np.array(_PAPER, np.float32).reshape(3, 1, 1) / 255
    return planes[:3] + (1.0 - planes[3:]) * ground


def busy(picture: np.ndarray, window: tuple[int, int]) -> tuple[int, int]:
    """The middle, across and down, of a window of a picture that shows more than most."""
    grey = picture.mean(axis=0)
    across, down = window
    spread = uniform_filter(grey * grey, (down, across)) - uniform_filter(grey, (down, across)) ** 2
    inner = spread[down:-down, across:-across]
    at = np.argsort(inner, axis=None)[int(BUSY * inner.size)]
    row, column = np.unravel_index(at, inner.shape)
    return int(column) + across, int(row) + down


def views(made: Expression) -> list[Image.Image]:
    """1:1, and each nearer view within the one before."""
    middle, size, level = START, (WIDE, TALL), 0
    found = [seen(made, level, middle, size)]
    for nearer in NEARER:
        window = (max(3, NEAR >> (nearer - level)), max(3, TALL >> (nearer - level)))
        place, pixel = busy(found[-1], window), made.period * 2.0**level
        middle = tuple(m + (p - s / 2) / pixel for m, p, s in zip(middle, place, size, strict=True))
        level, size = nearer, (NEAR, TALL)
        found.append(seen(made, level, middle, size))
    return [Image.fromarray((np.clip(one, 0, 1) * 255 + 0.5).astype(np.uint8).transpose(1, 2, 0)) for one in found]


def drawn(texts: list[LibraryText]) -> Image.Image:
    """The sheet of some texts."""
    wide, tall = WIDE + len(NEARER) * (NEAR + 2), HEAD + TALL
    rows = -(-len(texts) // COLUMNS)
    size = (2 * MARGIN + COLUMNS * (wide + GAP) - GAP, 2 * MARGIN + rows * (tall + GAP) - GAP)
    page = Image.new("RGB", size, _PAPER)
    pen, font, small = ImageDraw.Draw(page), ImageFont.load_default(14), ImageFont.load_default(10)
    for n, told in enumerate(texts):
        x, y = MARGIN + n % COLUMNS * (wide + GAP), MARGIN + n // COLUMNS * (tall + GAP)
        pen.text((x, y + HEAD // 2), told.title, _INK, font, "lm")
        for picture, nearer in zip(views(expression({"text": told.text}, 0)), (0, *NEARER), strict=True):
            page.paste(picture, (x, y + HEAD))
            if nearer:
                pen.text((x + NEAR, y + HEAD // 2), f"{1 << nearer} x", _FAINT, small, "rm")
            x += picture.width + 2
    return page


def main() -> None:
    texts = sorted(written_library().values(), key=lambda told: told.title)
    drawn(texts).save(FOLDER / "written.webp", quality=82, method=6)


if __name__ == "__main__":
    main()
