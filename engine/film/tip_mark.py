"""The brush in a film: a ring as large as its tip."""

from __future__ import annotations

import math

import numpy as np

from engine.film.aim import SUBPIXEL, Aim, shifted
from engine.film.replaying import Tip

_SMALLEST = 3.0  # pixels of the picture: a tip that is smaller is still seen
_LINE = 1.3  # pixels across each of the two lines
_FAR = 40  # bits of a distance in pixels, beyond which it is nowhere near


def with_tip(frame: np.ndarray, aim: Aim, tip: Tip) -> np.ndarray:
    """Returns a frame, uint8 (h, w, 3), with a light ring in a dark one where the brush is; as it is if that is
    outside."""
    height, width = frame.shape[:2]
    x = _offset(aim, aim.x, tip.level, tip.origin[0], tip.x)
    y = _offset(aim, aim.y, tip.level, tip.origin[1], tip.y)
    zoom = aim.level + aim.fraction - tip.level
    if x is None or y is None or zoom > _FAR:
        return frame
    x = -x if aim.mirrored > 0.5 else x
    cos, sin = math.cos(aim.turn), math.sin(aim.turn)
    x, y = cos * x - sin * y, sin * x + cos * y
    radius = max(tip.radius * 2.0 ** max(zoom, -float(_FAR)), _SMALLEST)
    x, y, reach = x + width / 2, y + height / 2, radius + 2 * _LINE + 1
    top, bottom = max(math.floor(y - reach), 0), min(math.ceil(y + reach), height)
    left, right = max(math.floor(x - reach), 0), min(math.ceil(x + reach), width)
    if top >= bottom or left >= right:
        return frame
    rows, columns = np.ogrid[top:bottom, left:right]
    far = np.hypot(columns + 0.5 - x, rows + 0.5 - y)[..., None]
    out = frame.copy()
    part = out[top:bottom, left:right].astype(np.float64)
    for middle, grey in ((radius + _LINE / 2, 255.0), (radius + 1.5 * _LINE, 0.0)):
        cover = np.clip(0.5 + _LINE / 2 - np.abs(far - middle), 0.0, 1.0)
        part += cover * (grey - part)
    out[top:bottom, left:right] = np.rint(part)
    out.flags.writeable = False
    return out


def _offset(aim: Aim, middle: int, level: int, origin: int, offset: float) -> float | None:
    """Returns how far from the middle of the picture a place is, in its pixels; None if that is too far to tell."""
    place = (origin << SUBPIXEL) + round(offset * (1 << SUBPIXEL))
    units = shifted(place, aim.level - level) - middle
    return None if units.bit_length() > _FAR + SUBPIXEL else units / (1 << SUBPIXEL) * 2.0**aim.fraction
