"""What lies above a rectangle, level by level, and going down through many levels between which nothing lies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect


class Clip(NamedTuple):
    """A rectangle of a level, for what is kept of it."""

    level: int
    rect: Rect


@dataclass(frozen=True, slots=True)
class Column:
    """An even rectangle of a level, not empty, and above it the pixels that its values follow from by expand: those of
    each level hold the `parents` of those of the level below.  Far up they are six to eight pixels wide."""

    rect: Rect

    def at(self, up: int) -> Rect:
        """Returns the pixels `up` levels above."""
        if up == 0:
            return self.rect
        x0, y0, x1, y1 = self.rect
        n = up + 1
        return Rect(2 * (x0 >> n) - 2, 2 * (y0 >> n) - 2, 2 * ((x1 - 1) >> n) + 4, 2 * ((y1 - 1) >> n) + 4)

    def lies_alike(self, first: int, last: int) -> bool:
        """Tells whether the pixels of each level from `first` levels above to `last` (1 at least) lie alike upon those
        of the next coarser one."""
        ends, count = (self.rect.x0, self.rect.x1 - 1), first - last
        rows = self.rect.y0, self.rect.y1 - 1
        for low, high in (ends, rows):
            bits = (low >> last + 1) & ((1 << count) - 1)
            if bits not in (0, (1 << count) - 1):
                return False
            if (high >> first + 1) - (low >> first + 1) != (high >> last + 1) - (low >> last + 1):
                return False
        return True

    def still(self, before: np.ndarray, after: np.ndarray, up: int, last: int) -> np.ndarray | None:
        """Returns what arrays (C, h, w) come to `last` levels above (1 at least), if all steps down to there do the
        same as the one from `before`, `up` + 1 levels above, to `after`; None where they may do anything else."""
        one = after[:, :1, :1]
        if (after == one).all() and (before == one).all():
            at = self.at(last)
            return np.ascontiguousarray(np.broadcast_to(one, (len(after), at.height, at.width)))
        alike = np.array_equal(before, after) and self.lies_alike(up + 1, last)
        return after if alike else None
