"""Writes palettes/pictures/examples.png: every bundled example texture with its name.

python palettes/examples/make/contact_sheet.py
"""

from __future__ import annotations

import tomllib
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

FOLDER = Path(__file__).resolve().parents[1]
PICTURE = FOLDER.parent / "pictures" / "examples.png"
CELL, LABEL, COLUMNS = 160, 20, 8
PAPER, INK = "#ddd8cf", "#33312e"


def entries() -> list[tuple[str, str]]:
    """Groups and names, group by group."""
    found = [(tomllib.loads(file.read_text("utf-8"))["group"], file.stem) for file in FOLDER.glob("*.toml")]
    return sorted(found)


def sheet() -> Image.Image:
    """The pictures, reduced, in rows."""
    listed = entries()
    rows = -(-len(listed) // COLUMNS)
    page = Image.new("RGB", (COLUMNS * CELL, rows * (CELL + LABEL)), PAPER)
    pen, font = ImageDraw.Draw(page), ImageFont.load_default(12)
    for k, (_, name) in enumerate(listed):
        x, y = k % COLUMNS * CELL, k // COLUMNS * (CELL + LABEL)
        picture = Image.open(FOLDER / f"{name}.png")
        # Reduced with premultiplied alpha, so that what is transparent lends no colour.
        small = picture.convert("RGBa").resize((CELL - 8, CELL - 8), Image.Resampling.LANCZOS).convert("RGBA")
        page.paste(small, (x + 4, y + 4), small)
        middle = x + CELL // 2
        pen.text((middle, y + CELL + 1), name, INK, font, anchor="mt")
    return page


def main() -> None:
    sheet().quantize(256, dither=Image.Dither.FLOYDSTEINBERG).save(PICTURE, optimize=True)


if __name__ == "__main__":
    main()
