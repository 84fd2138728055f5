"""Where a recording that plays looks: the view flies there."""

from __future__ import annotations

import math

from app.canvas.view import SUBPIXEL, Place
from app.desk.desk import Desk
from engine.numeric.scaling import scaled
from engine.studio.results import Looked


def fly(desk: Desk, looked: Looked, _now: float) -> None:
    """Shows what the artist of a recording looked at, as large as the free area allows."""
    x, y = (middle(o, s, looked.level % 1) for o, s in zip(looked.origin, looked.size, strict=True))
    x0, y0, x1, y1 = desk.free_area()
    zoom, (wide, tall) = looked.level, looked.size
    if wide > 0 and tall > 0:
        zoom += math.log2(min((x1 - x0) / wide, (y1 - y0) / tall))
    desk.look_at(Place(x, y, int(looked.level // 1) + SUBPIXEL), zoom, looked.seconds)


def middle(origin: float, size: float, fraction: float) -> int:
    """Returns the middle of a span of pixels of a level and a fraction, in 2^-16 pixels of the whole level; exact
    for integers of any size."""
    whole = int(origin // 1)
    rest: int = round((origin - whole + size / 2) * 2.0 ** (SUBPIXEL - fraction))
    return scaled(whole, SUBPIXEL - fraction) + rest  # pixels of the finer level are smaller
