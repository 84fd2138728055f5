"""Paints media.png: every bundled brush with textures, and every paper, each in a stroke and 8 times as near; brushes
that grow examples at half their size, and beside it at the examples' own.

python palettes/pictures/make_sheet.py
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1]))

from app.desk import presets  # noqa: E402
from engine.brush.settings import Brush  # noqa: E402
from engine.canvas.composite import composite  # noqa: E402
from engine.canvas.layers import Layer  # noqa: E402
from engine.canvas.reading import layer_planes  # noqa: E402
from engine.numeric.address import Rect  # noqa: E402
from engine.painting.commands import DefineTexture, Stroke  # noqa: E402
from engine.painting.grown import settled  # noqa: E402
from engine.painting.value import Painting  # noqa: E402
from engine.session.apply import apply  # noqa: E402

COLUMNS, MARGIN, GAP, CAPTION = 4, 26, 14, 20
WIDE, NEAR, TALL = 208, 78, 96  # of a stroke, of what is seen of it from near, and of both
CLOSER = 3  # levels
GROWN = 1  # the level at which examples are grown: so much of them fits into a cell, and no pixel of theirs is coarser
GROUND = (250, 240, 230)  # of the sheet
SHEET = (255, 250, 240)  # of what is painted on
INK, FAINT = (58, 46, 38), (158, 140, 120)
BANDS = ("#23303e", "#7c3a34", "#cf9a45", "#5f7f58", "#4f86a6", "#e6d6ba")
LARGEST = 26.0  # px, of a brush on the sheet


def strokes(brush: Brush, light: bool) -> list[Stroke]:
    """A wave whose pressure rises and falls; over bands of colour if the brush changes what is there."""
    found = []
    level = GROWN if brush.mode == "example" else 0
    if brush.mode == "raster":
        for k, colour in enumerate(BANDS):
            x = WIDE * (k + 0.5) / len(BANDS)
            band = Brush(radius=WIDE / 9.5, hardness=0.5, colour=colour, grain=None)
            found.append(_stroke([(x, -10.0, 1.0), (x, TALL + 10.0, 1.0)], band))
    t = np.linspace(0.0, 1.0, 48)
    x, y = WIDE * (0.12 + 0.76 * t), TALL * (0.5 + 0.17 * np.sin(t * 2 * np.pi))
    pressure = (0.12 + 0.6 * t) if light else np.sin(np.pi * (0.08 + 0.88 * t)) ** 0.7
    size = 2.0**level
    rows = np.stack([x * size, y * size, pressure], axis=1)
    found.append(_stroke(rows.tolist(), replace(brush, radius=min(brush.radius, LARGEST * size)), level))
    return found


def _stroke(rows: Sequence[Sequence[float]], brush: Brush, level: int = 0) -> Stroke:
    points = np.zeros((len(rows), 6))
    points[:, :3] = rows
    points.flags.writeable = False
    return Stroke(level, (0, 0), points, brush)


def painted(brush: Brush, textures: Iterable[DefineTexture], light: bool = False) -> Painting:
    painting = Painting(seed=7)
    for definition in textures:
        painting = apply(painting, definition)
    for stroke in strokes(brush, light):
        painting = apply(painting, stroke)
    return settled(painting)


def seen(painting: Painting, level: int, middle: tuple[float, float], size: tuple[int, int]) -> Image.Image:
    """A painting over the sheet's white."""

    def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
        return layer_planes(layer, level, rect)

    x, y = (round(v * 2**level) - s // 2 for v, s in zip(middle, size, strict=True))
    rgba = composite(painting.root, level, Rect.at(x, y, *size), read)
    rgb = rgba[:3] + (1.0 - rgba[3:]) * (np.array(SHEET, np.float32).reshape(3, 1, 1) / 255)
    return Image.fromarray((np.clip(rgb, 0.0, 1.0) * 255 + 0.5).astype(np.uint8).transpose(1, 2, 0))


def near(painting: Painting, level: int, middle: tuple[float, float]) -> Image.Image:
    """What lies about a place, or as far to its right as there is anything."""
    x, y = middle
    while True:
        picture = seen(painting, level, (x, y), (NEAR, TALL))
        if x >= WIDE or any(low < high for low, high in picture.getextrema()):
            return picture
        x += NEAR / 2**level


class Sheet:
    """Cells in columns, a heading over each group of them."""

    def __init__(self) -> None:
        self.image = Image.new("RGB", (2 * MARGIN + COLUMNS * (WIDE + NEAR + 4) + (COLUMNS - 1) * GAP, 4000), GROUND)
        self.draw = ImageDraw.Draw(self.image)
        self.y, self.column = MARGIN - 8, 0

    def heading(self, text: str) -> None:
        if self.column:
            self.y, self.column = self.y + TALL + CAPTION + GAP, 0
        self.draw.text((MARGIN, self.y), text, INK, ImageFont.load_default(19))
        across = (MARGIN + 170, self.y + 14, self.image.width - MARGIN, self.y + 14)
        self.draw.line(across, (222, 208, 188))
        self.y += 32

    def cell(self, name: str, note: str, painting: Painting, middle: tuple[float, float], closer: int = CLOSER) -> None:
        if self.column == COLUMNS:
            self.y, self.column = self.y + TALL + CAPTION + GAP, 0
        x = MARGIN + self.column * (WIDE + NEAR + 4 + GAP)
        self.draw.text((x + 1, self.y), name, INK, ImageFont.load_default(13))
        self.draw.text((x + WIDE, self.y + 2), note, FAINT, ImageFont.load_default(11), anchor="ra")
        self.image.paste(seen(painting, 0, (WIDE / 2, TALL / 2), (WIDE, TALL)), (x, self.y + CAPTION))
        self.image.paste(near(painting, closer, middle), (x + WIDE + 4, self.y + CAPTION))
        self.column += 1

    def save(self, path: Path) -> None:
        """In steps of 8 of each channel, to be a small file."""
        whole = self.image.crop((0, 0, self.image.width, self.y + TALL + CAPTION + MARGIN))
        coarse = np.minimum((np.asarray(whole, np.uint16) + 4) // 8 * 8, 255).astype(np.uint8)
        Image.fromarray(coarse).save(path, optimize=True)


def main() -> None:
    sheet = Sheet()
    found, faults = presets.load_brushes(presets.bundled_folder())
    papers, more = presets.load_papers(presets.papers_folder())
    if faults or more:
        raise SystemExit("\n".join(faults + more))
    group = ""
    for preset in (p for p in found if p.textures):
        if preset.group != group:
            group = preset.group
            sheet.heading(group)
        made = preset.brush.op if preset.brush.mode == "raster" else ""
        note = made if isinstance(made, str) else made.get("name", "formula")
        closer = GROWN if preset.brush.mode == "example" else CLOSER
        sheet.cell(preset.name, note, painted(preset.brush, preset.textures), (WIDE * 0.34, TALL * 0.6), closer)
    sheet.heading("Papers")
    for paper in papers:
        crayon = Brush(radius=24.0, hardness=0.3, spacing=0.12, colour="#3a2c2a", grain=paper.grain)
        sheet.cell(paper.name, "", painted(crayon, paper.textures, light=True), (WIDE * 0.5, TALL * 0.5))
    sheet.save(FOLDER / "media.png")


if __name__ == "__main__":
    main()
