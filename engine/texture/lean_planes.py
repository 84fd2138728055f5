"""Planes on the grid, held in 16 bits a value: those of pictures that textures are made into.

Their values are the grid's, from 0 to 1: one more than 16 bits of a file tell.  Most use fewer, many are grey, nearly
all are opaque: so a plane is held above its lowest value, equal ones once, and one of a single value as that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.grid import FINE_STEP

_MOST = 0xFFFF  # steps of the grid between the lowest and the highest value
_FAR = 1 << 22  # steps from 0 beyond which a value is not held so


@dataclass(frozen=True, eq=False, slots=True, weakref_slot=True)
class LeanPlanes:
    """`shape`: (h, w, planes), as rasters have it; `lowest`: of each plane, in steps of the grid; `above`: the steps
    from there to each value, uint16 (h, w), None where there are none."""

    shape: tuple[int, int, int]
    lowest: tuple[int, ...]
    above: tuple[np.ndarray | None, ...]

    @property
    def nbytes(self) -> int:
        """Counts the bytes of its values."""
        return sum(held.nbytes for held in {id(held): held for held in self.above if held is not None}.values())

    def planes(self, rect: Rect) -> np.ndarray:
        """Returns the planes of a part: float32 (planes, h, w)."""
        rows, columns = slice(rect.y0, rect.y1), slice(rect.x0, rect.x1)
        out = np.empty((len(self.above), rect.height, rect.width), np.float32)
        for plane, lowest, above in zip(out, self.lowest, self.above, strict=True):
            _put(plane, lowest, None if above is None else above[rows, columns])
        return out


def lean_of(planes: np.ndarray) -> LeanPlanes | None:
    """Returns planes, float32 (planes, h, w), as what tells them bit for bit; None where that cannot be."""
    lowest: list[int] = []
    above: list[np.ndarray | None] = []
    for plane in planes:
        steps = plane / FINE_STEP
        low, high = float(steps.min()), float(steps.max())
        if not (abs(low) <= _FAR and high - low <= _MOST):  # nor with a NaN among them
            return None
        found = None if low == high else (steps - np.float32(low)).astype(np.uint16)
        _put(steps, int(low), found)
        if not np.array_equal(steps.view(np.uint32), plane.view(np.uint32)):
            return None
        same = (k for k, other in enumerate(lowest) if other == low and _equal(above[k], found))
        at = next(same, None)
        lowest.append(int(low))
        above.append(found if at is None else above[at])
    count, height, width = planes.shape
    return LeanPlanes((height, width, count), tuple(lowest), tuple(above))


def _put(plane: np.ndarray, lowest: int, above: np.ndarray | None) -> None:
    """Puts the values of a plane in their place."""
    plane[...] = 0.0 if above is None else above
    plane += np.float32(lowest)
    plane *= FINE_STEP


def _equal(one: np.ndarray | None, other: np.ndarray | None) -> bool:
    return one is other if one is None or other is None else np.array_equal(one, other)
