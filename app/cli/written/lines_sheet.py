"""The sheet of a written texture: each of its lines as a picture, and how far it is from its next finer level."""

from __future__ import annotations

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from engine.numeric.address import Rect
from engine.texture.expression.examined import LineLook, line_looks, line_planes, shimmer
from engine.texture.expression.written_ink import Expression

_SIDE, _GAP, _HEAD, _COLUMNS = 192, 16, 42, 4  # pixels; pictures side by side
_PAPER, _INK, _SOFT = (24, 25, 28), (226, 227, 230), (140, 143, 150)
_CHECKER = (0.45, 0.55)
_LOUDER = 32.0  # times which differences are shown


def lines_sheet(made: Expression, level: int, whole: Rect) -> np.ndarray:
    """Returns the sheet of the first 192 x 192 pixels of a rectangle of a level: uint8 RGB (h, w, 3)."""
    rect = Rect.at(whole.x0, whole.y0, min(_SIDE, whole.width), min(_SIDE, whole.height))
    looks = line_looks(made, level)
    panels = [(*_titles(n, look), _seen(made, n, level, rect)) for n, look in enumerate(looks)]
    found = shimmer(made, level, rect)
    title = f"shimmer: {found.rms * 255:.2f} / 255 rms"
    panels.append((title, f"against level {level + 1}, {_LOUDER:.0f} x", _grey(found.difference * _LOUDER)))
    rows = -(-len(panels) // _COLUMNS)
    size = _GAP + _COLUMNS * (_SIDE + _GAP), _GAP + rows * (_HEAD + _SIDE + _GAP)
    page = Image.new("RGB", size, _PAPER)
    draw, font = ImageDraw.Draw(page), ImageFont.load_default(13)
    for i, (above, below, picture) in enumerate(panels):
        x, y = _GAP + i % _COLUMNS * (_SIDE + _GAP), _GAP + i // _COLUMNS * (_HEAD + _SIDE + _GAP)
        draw.text((x, y + 14), above, _INK, font, anchor="ls")
        draw.text((x, y + 32), below, _SOFT, font, anchor="ls")
        page.paste(Image.fromarray(picture), (x, y + _HEAD))
    return np.asarray(page)


def _titles(number: int, look: LineLook) -> tuple[str, str]:
    name = look.name or "the texture"
    return f"{number + 1}  {name}"[:26], f"{look.cost:.0f} ns, {look.told}"


def _grey(values: np.ndarray) -> np.ndarray:
    seen = np.floor(np.clip(values, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)
    return np.repeat(seen[..., None], 3, axis=-1)


def _seen(made: Expression, number: int, level: int, rect: Rect) -> np.ndarray:
    planes = line_planes(made, number, level, rect)
    if len(planes) == 1:
        return _grey(planes[0])
    squares = (np.add.outer(np.arange(rect.height) // 8, np.arange(rect.width) // 8) & 1).astype(bool)
    ground = np.where(squares, *_CHECKER)
    colours = planes[:3] + ground * (1.0 - np.clip(planes[3], 0.0, 1.0))
    return np.moveaxis(np.floor(np.clip(colours, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8), 0, -1)
