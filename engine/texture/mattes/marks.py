"""What an artist says of a picture: strokes over what belongs, and over what does not.

Light on purpose: the window knows of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Mark(NamedTuple):
    """A stroke that says what belongs (`keep`) or does not: points (x, y) and a radius, in pixels of the picture."""

    keep: bool
    points: tuple[tuple[float, float], ...]
    radius: float


def where_marked(marks: Sequence[Mark], size: tuple[int, int], small: tuple[int, int]) -> np.ndarray:
    """Returns where marks lie in a small picture of one of a size, later ones over earlier: int8 (h, w)."""
    out = np.zeros(small, np.int8)
    down, across = small[0] / size[0], small[1] / size[1]
    for mark in marks:
        scaled = [(x * across - 0.5, y * down - 0.5) for x, y in mark.points]
        reach = max(0.75, mark.radius * max(down, across))
        for a, b in zip(scaled, scaled[1:] or scaled, strict=False):
            _segment(out, a, b, reach, 1 if mark.keep else -1)
    return out


def _segment(out: np.ndarray, a: tuple[float, float], b: tuple[float, float], reach: float, value: int) -> None:
    """Sets what lies within reach of a line from a to b."""
    height, width = out.shape
    x0, x1 = (int(np.clip(np.floor(min(a[0], b[0]) - reach), 0, width)), min(max(a[0], b[0]) + reach + 1, width))
    y0, y1 = (int(np.clip(np.floor(min(a[1], b[1]) - reach), 0, height)), min(max(a[1], b[1]) + reach + 1, height))
    y, x = np.mgrid[y0 : max(y0, int(y1)), x0 : max(x0, int(x1))]
    dx, dy = b[0] - a[0], b[1] - a[1]
    along = np.clip(((x - a[0]) * dx + (y - a[1]) * dy) / max(dx * dx + dy * dy, 1e-9), 0.0, 1.0)
    near = np.hypot(x - a[0] - along * dx, y - a[1] - along * dy) <= reach
    out[y0 : y0 + near.shape[0], x0 : x0 + near.shape[1]][near] = value
