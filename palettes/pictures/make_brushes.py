"""Draws brushes.webp: a stroke of every bundled brush at 1:1, as a quarter as large, and 16 times as near.

python palettes/pictures/make_brushes.py [PART OF A NAME]
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

FOLDER = Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER.parents[1]), str(FOLDER)]

from make_sheet import BANDS, seen  # noqa: E402

from app.desk import presets  # noqa: E402
from app.desk.holding.generator_brushes import generator_brushes  # noqa: E402
from app.desk.holding.written_brushes import written_brushes  # noqa: E402
from engine.brush.settings import Brush  # noqa: E402
from engine.painting.commands import Stroke  # noqa: E402
from engine.painting.grown import settled  # noqa: E402
from engine.painting.value import Painting  # noqa: E402
from engine.session.apply import apply  # noqa: E402

COLUMNS, MARGIN, GAP, HEAD = 5, 22, 12, 18
WIDE, TALL, FAR, NEAR = 212, 104, 2, 4  # px of a stroke; levels of the views from afar and from near
SIDE = 78  # px of the view from near
LARGEST = 34.0  # px, of a brush on the sheet
PAPER, INK, FAINT = (250, 240, 230), (58, 46, 38), (158, 140, 120)
SKY = "#4a6f96"  # below what is white


def line(rows: np.ndarray, brush: Brush) -> Stroke:
    """A stroke of level 0."""
    rows = np.ascontiguousarray(rows)
    rows.flags.writeable = False
    return Stroke(0, (0, 0), rows, brush)


def grounds(brush: Brush) -> list[Stroke]:
    """What lies below it: bands of colour, where it changes or takes up what is there; sky, where it is white."""
    wet = brush.wet is not None
    light = min(int(brush.colour[k : k + 2], 16) for k in (1, 3, 5)) > 185
    colours = BANDS if brush.mode in ("raster", "erase", "smooth") or wet else (SKY,) if light else ()
    found = []
    for k, colour in enumerate(colours):
        wide = WIDE / len(colours)
        rows = np.zeros((2, 6))
        rows[:, 0], rows[:, 1], rows[:, 2] = wide * (k + 0.5), (-wide, TALL + wide), 1.0
        found.append(line(rows, Brush(radius=wide * 0.55, hardness=0.9, colour=colour, grain=None)))
    return found


def wave(brush: Brush) -> Stroke:
    """A wave whose pressure rises and falls, as a hand draws it."""
    t = np.linspace(0.0, 1.0, 64)
    rows = np.zeros((len(t), 6))
    rows[:, 0], rows[:, 1] = WIDE * (0.13 + 0.74 * t), TALL * (0.5 + 0.2 * np.sin(t * 2 * np.pi))
    rows[:, 2], rows[:, 5] = np.sin(np.pi * (0.06 + 0.88 * t)) ** 0.7, 0.8 * t
    return line(rows, replace(brush, radius=min(brush.radius, LARGEST)))


def painted(preset: presets.Preset) -> Painting:
    """A stroke of a brush, and what it is laid on."""
    painting = Painting(seed=7)
    for definition in preset.textures:
        painting = apply(painting, definition)
    for stroke in (*grounds(preset.brush), wave(preset.brush)):
        painting = apply(painting, stroke)
    return settled(painting)


def drawn(found: list[presets.Preset]) -> Image.Image:
    """The sheet of some brushes."""
    wide, tall = WIDE + SIDE + 2, HEAD + TALL
    rows = -(-len(found) // COLUMNS)
    size = (2 * MARGIN + COLUMNS * (wide + GAP) - GAP, 2 * MARGIN + rows * (tall + GAP) - GAP)
    page = Image.new("RGB", size, PAPER)
    pen, font, small = ImageDraw.Draw(page), ImageFont.load_default(13), ImageFont.load_default(10)
    for n, preset in enumerate(found):
        x, y = MARGIN + n % COLUMNS * (wide + GAP), MARGIN + n // COLUMNS * (tall + GAP)
        pen.text((x, y + HEAD // 2), preset.name, INK, font, "lm")
        pen.text((x + wide, y + HEAD // 2), preset.group, FAINT, small, "rm")
        painting, middle = painted(preset), (WIDE / 2, TALL / 2)
        page.paste(seen(painting, 0, middle, (WIDE, TALL)), (x, y + HEAD))
        right, far = x + WIDE + 2, (SIDE, TALL >> FAR)
        page.paste(seen(painting, -FAR, middle, far), (right, y + HEAD))
        near = (SIDE, TALL - far[1] - 2)
        page.paste(seen(painting, NEAR, (WIDE * 0.38, TALL * 0.64), near), (right, y + HEAD + far[1] + 2))
    return page


def main() -> None:
    bundled, faults = presets.load_brushes(presets.bundled_folder())
    if faults:
        raise SystemExit("\n".join(faults))
    every = (*bundled, *generator_brushes(), *written_brushes())
    found = [one for one in every if all(part in one.name for part in sys.argv[1:2])]
    drawn(found).save(FOLDER / "brushes.webp", quality=80, method=6)


if __name__ == "__main__":
    main()
