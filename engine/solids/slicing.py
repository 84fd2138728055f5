"""Flat slices through a solid, which tile without a seam.

A solid repeats after one unit along each axis; so does each plane through whole-numbered directions, along any two
of these.  A slice is cut at right angles to `normal`, a direction of small whole numbers, along two others that stand
on it and on one another, each as long as it takes to repeat.
"""

from __future__ import annotations

from math import gcd
from typing import NamedTuple

import numpy as np

from engine.solids.solid_lookup import Lookup

STEEPEST = 2  # of a normal's numbers at most
SLICE_SIDE = 1024  # pixels along a side
_AXIS = tuple[int, int, int]


class Slice(NamedTuple):
    """Of which solid; the plane's `normal`; how far along it, `depth`, in units; pixels of a unit."""

    solid: Lookup
    normal: tuple[int, int, int]
    depth: float
    unit: int


def sides(normal: tuple[int, int, int]) -> tuple[_AXIS, _AXIS]:
    """Returns the whole-numbered directions of a slice's rows and columns."""
    a, b, c = normal
    across = _least((-b, a, 0)) if a or b else (1, 0, 0)
    x, y, z = across
    return across, _least((b * z - c * y, c * x - a * z, a * y - b * x))


def _least(direction: tuple[int, int, int]) -> _AXIS:
    """The same way, in the smallest whole numbers."""
    common = gcd(*direction)
    x, y, z = direction
    return x // common, y // common, z // common


def slice_size(cut: Slice) -> tuple[int, int]:
    """Returns the width and height of a slice: whole pixels, so near to a unit's as they fit."""
    across, down = (sum(value * value for value in side) ** 0.5 for side in sides(cut.normal))
    fits = min(1.0, SLICE_SIDE / (cut.unit * max(across, down)))
    return max(4, round(cut.unit * across * fits)), max(4, round(cut.unit * down * fits))


def sliced(cut: Slice) -> np.ndarray:
    """Returns the slice's colours, float32 (3, height, width): each pixel the mean of four places in it."""
    width, height = slice_size(cut)
    across, down = (np.array(side, np.float64) for side in sides(cut.normal))
    size = float(sum(value * value for value in cut.normal))
    middle = np.array(cut.normal, np.float64) * (cut.depth / size)
    finest = 0.5 / cut.unit
    total = np.zeros((height * width, 3))
    for dy in (0.25, 0.75):
        for dx in (0.25, 0.75):
            x = ((np.arange(width) + dx) / width)[None, :, None]
            y = ((np.arange(height) + dy) / height)[:, None, None]
            points = (middle + x * across + y * down).reshape(-1, 3)
            total += cut.solid.colours(points, finest)
    out: np.ndarray = (total * 0.25).T.reshape(3, height, width).astype(np.float32)
    return out
