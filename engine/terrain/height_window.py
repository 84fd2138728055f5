"""The heights of a rectangle of land, in pixels of its level, with what lies around them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from engine.numeric.address import Rect
from engine.terrain.layer_heights import Pixel
from engine.terrain.plane import DEEP, Land

MOST_HEIGHTS = 8193  # samples each way
_ROWS = 256
FINEST_TOLD = 1000  # level beyond which float64 has no number for a pixel


@dataclass(frozen=True)
class Relief:
    """`heights` float32 (h, w) of the pixels of `rect`, in pixels of `level`, above the sea, or above the pixel `about`
    if that is told."""

    level: int
    rect: Rect
    heights: np.ndarray
    about: Pixel | None = None

    @property
    def place(self) -> dict[str, object]:
        """Gives what is told of where it lies."""
        out: dict[str, object] = {"level": self.level, "corner": [self.rect.x0, self.rect.y0]}
        return out if self.about is None else out | {"heights_above_pixel": list(self.about)}


def in_pixels(heights: np.ndarray | float, level: int) -> np.ndarray:
    """Returns heights of pixels of level 0 in pixels of a level."""
    out: np.ndarray = np.ldexp(heights, level)
    return out


def between(heights: np.ndarray) -> float:
    """Returns how far triangles between samples (h, w) are at most from the surface that E makes of the samples, in the
    samples' unit: by an eighth of the second differences each way, by what both come to, and by a quarter of the twist
    of a cell.  Not where those at the rim come to lie: what is around them is not told."""
    h = heights.astype(np.float64)
    bent = [float(np.abs(np.diff(h, 2, axis)).max(initial=0.0)) for axis in (0, 1)]
    twist = float(np.abs(np.diff(np.diff(h, axis=0), axis=1)).max(initial=0.0))
    return sum(bent) / 8.0 + min(bent) / 16.0 + twist / 4.0


def relief(land: Land, level: int, rect: Rect, tell: Callable[[float], None] | None = None) -> Relief:
    """Returns the relief of a rectangle; `tell` hears of the part that is done.  ValueError where it is too large, or
    is told in numbers that are none."""
    if level > FINEST_TOLD:
        raise ValueError(f"found level {level}, expected at most {FINEST_TOLD} for heights")
    if max(rect.width, rect.height) > MOST_HEIGHTS:
        raise ValueError(f"found {rect.width} x {rect.height} heights, expected at most {MOST_HEIGHTS} each way")
    about = land.about(level, rect) if level > DEEP else None
    out = np.empty((rect.height, rect.width), np.float32)
    for y in range(0, rect.height, _ROWS):
        part = Rect(rect.x0, rect.y0 + y, rect.x1, min(rect.y0 + y + _ROWS, rect.y1))
        out[y : y + part.height] = in_pixels(land.height(level, part, about), level)
        if tell is not None:
            tell(min(1.0, (y + part.height) / rect.height))
    if not np.isfinite(out).all():
        raise ValueError("heights beyond all numbers; expected a smaller scale")
    return Relief(level, rect, out, about)


def number_of(value: int) -> float:
    """Returns a whole number as a float; infinity where there is none so large."""
    try:
        return float(value)
    except OverflowError:
        return math.inf
