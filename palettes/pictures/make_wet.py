"""Paints wet.webp: each bundled wet brush over stripes of other paint, and beside them what it does on bare paper.

python palettes/pictures/make_wet.py
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from immutables import Map
from PIL import Image, ImageDraw, ImageFont

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1]))

from app.desk import presets  # noqa: E402
from engine.brush.settings import Brush  # noqa: E402
from engine.canvas.composite import composite  # noqa: E402
from engine.canvas.reading import layer_planes  # noqa: E402
from engine.numeric.address import Rect  # noqa: E402
from engine.session.session import Session  # noqa: E402

SIZE = (470, 230)
STRIPES = ("#f2c81c", "#2348a6", "#c02634", "#f4f1ea", "#2e7a3c", "#1d1c22")
PAPER = np.array([0.965, 0.955, 0.93])


def curve(start: tuple[float, float], end: tuple[float, float], bend: float, light: float = 0.5) -> np.ndarray:
    """Points from one place to another, firmest in the middle."""
    t = np.linspace(0.0, 1.0, 40)
    points = np.zeros((len(t), 6))
    points[:, 0] = start[0] + (end[0] - start[0]) * t
    points[:, 1] = start[1] + (end[1] - start[1]) * t + bend * np.sin(np.pi * 2 * t)
    points[:, 2] = light + (1 - light) * np.sin(np.pi * t)
    points[:, 5] = t
    return points


def draw(session: Session, brush: Brush, points: np.ndarray) -> None:
    """A stroke."""
    live = session.begin(0, (0, 0), brush)
    live.add(points)
    session.finish(live)


def panel(preset: presets.Preset) -> Image.Image:
    """What one brush does."""
    session = Session()
    for definition in preset.textures:
        session.do(definition)
    for k, colour in enumerate(STRIPES):
        x = 30 + 48 * k
        ground = Brush(radius=24, hardness=0.95, colour=colour, dynamics=Map())
        draw(session, ground, curve((x, 20), (x, 200), 0))
    for x, colour in ((350, "#f2c81c"), (430, "#2348a6")):
        draw(session, Brush(radius=22, hardness=0.95, colour=colour, dynamics=Map()), curve((x, 38), (x, 42), 0, 1.0))
    brush = preset.brush
    draw(session, brush, curve((6, 70), (300, 70), 12))
    draw(session, brush, curve((300, 150), (6, 150), -14))
    for y in (40, 75, 110):
        draw(session, brush, curve((340, y), (445, y + 6), 4, 0.8))
    draw(session, brush, curve((340, 190), (450, 175), 10))
    seen = composite(session.painting.root, 0, Rect(0, 0, *SIZE), layer_planes)
    rgb = seen[:3] + (1 - seen[3]) * PAPER[:, None, None]
    picture = Image.fromarray((np.clip(rgb, 0, 1).transpose(1, 2, 0) * 255 + 0.5).astype(np.uint8))
    ImageDraw.Draw(picture).text((8, SIZE[1] - 20), preset.name, fill=(40, 40, 40), font=ImageFont.load_default(14))
    return picture


def main() -> None:
    panels = [panel(one) for one in presets.load_brushes(presets.bundled_folder())[0] if one.brush.wet is not None]
    sheet = Image.new("RGB", (2 * SIZE[0], -(-len(panels) // 2) * SIZE[1]), (255, 255, 255))
    for i, one in enumerate(panels):
        sheet.paste(one, (i % 2 * SIZE[0], i // 2 * SIZE[1]))
    sheet.save(FOLDER / "wet.webp", quality=90, method=6)


if __name__ == "__main__":
    main()
