"""An example turned all round: copies beside one another in one picture, of which a region that has an orientation
everywhere takes what runs that way.

A pixel between four of the example is what a cubic through 4 x 4 of them is there (Catmull & Rom 1974).  An example
without a rim goes on beyond its edges as its mirror image.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.numeric.kernel import Array, Int, inner, kernel
from engine.texture.example.control import unit_table
from engine.texture.example.exemplar import PAD

LEAST_COPIES = 8  # copies
_MOST = 1_400_000  # pixels of all copies, with more than the fewest
_APART = 2  # pixels of the coarsest level between what is in a square and its edges


class Copies(NamedTuple):
    """`side`: of a copy's square; `across`, `down`: how many lie in a row, and rows; `number`: of copies."""

    side: int
    across: int
    down: int
    number: int

    def table(self, n: int) -> np.ndarray:
        """Returns `Control.turns` of level `n`."""
        units = unit_table(self.number)
        held = [self.side >> n, self.across, self.down, PAD, self.number, *(part for unit in units for part in unit)]
        out = np.array(held, np.int32)
        out.flags.writeable = False
        return out

    def ways(self, told: np.ndarray, n: int) -> np.ndarray:
        """Returns which of as many ways as there are copies pixels of level `n` run: told is their orientation,
        uint8 (h, w)."""
        rows, columns = (np.arange(size) // (self.side >> n) for size in told.shape)
        copy: np.ndarray = rows[:, None] * self.across + columns
        own = (told.astype(np.int64) - np.array([*map(self.added, range(self.down * self.across))])[copy]) & 255
        out: np.ndarray = (((own * self.number + 128) >> 8) + copy) % self.number
        return out

    def added(self, copy: int) -> int:
        """Returns by how much, 256 a turn, a copy is turned."""
        return (copy * 256 + self.number // 2) // self.number


def copies_of(size: tuple[int, int], turns: int, levels: int) -> Copies:
    """Returns how an example of (height, width) is laid out, turned in so many ways or, where it is large, in fewer.
    FieldError where it is too large for the fewest."""
    reach = math.isqrt((-(-size[0] // 2)) ** 2 + (-(-size[1] // 2)) ** 2) + 1 + (_APART << levels - 1)
    side = 2 * (-(-reach // (1 << levels)) << levels)
    count = turns
    while count > LEAST_COPIES and count * side * side > _MOST:
        count -= 4
    count = max(count, min(turns, LEAST_COPIES))
    across = math.isqrt(count - 1) + 1
    if count * side * side > 2 * _MOST:
        raise FieldError(
            "maps.orientation", f"an example of {size[1]} x {size[0]} pixels", "at most some 360 x 360, to be turned"
        )
    return Copies(side, across, -(-count // across), count)


def mask_rect(mask: np.ndarray) -> Rect:
    """Returns the rectangle around a mask."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return Rect(int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1)


def turned_copies(
    colours: np.ndarray, mask: np.ndarray, planes: np.ndarray, copies: Copies, mirrored: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns colours, premultiplied float32 (h, w, 4), mask, bool, and planes, uint8 (C, h, w), of all copies."""
    size = copies.down * copies.side, copies.across * copies.side
    out = np.zeros((*size, 4), np.float32)
    region, told = np.zeros(size, np.uint8), np.zeros((len(planes), *size), np.uint8)
    given = (
        np.ascontiguousarray(colours, np.float32),
        np.ascontiguousarray(mask, np.uint8),
        np.ascontiguousarray(planes),
    )
    for k, unit in enumerate(unit_table(copies.number)):
        part = Rect.at(k % copies.across * copies.side, k // copies.across * copies.side, copies.side, copies.side)
        place = part.slices(Rect(0, 0, size[1], size[0]))
        added = copies.added(k)
        _turn(*given, unit[0] / 16384.0, unit[1] / 16384.0, added, mirrored, out[place], region[place], told[:, *place])
    return out, region.astype(np.bool_), told


@kernel
def _turn(
    colours: Array,
    mask: Array,
    planes: Array,
    cosine: float,
    sine: float,
    added: Int,
    mirrored: bool,
    out: Array,
    region: Array,
    told: Array,
) -> None:
    """Writes one copy; `added` to the first of its planes."""
    height, width = mask.shape
    middle, half = (height // 2, width // 2), out.shape[0] // 2
    down, across = np.empty(4, np.float64), np.empty(4, np.float64)
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            v, u = y + 0.5 - half, x + 0.5 - half
            row, column = cosine * v - sine * u + middle[0] - 0.5, sine * v + cosine * u + middle[1] - 0.5
            i, j = int(np.floor(row + 0.5)), int(np.floor(column + 0.5))
            if 0 <= i < height and 0 <= j < width:
                region[y, x] = mask[i, j]
                for c in range(told.shape[0]):
                    told[c, y, x] = (planes[c, i, j] + added) & 255 if c == 0 else planes[c, i, j]
            elif not mirrored:
                continue
            _cubic(row - np.floor(row), down)
            _cubic(column - np.floor(column), across)
            top, left = int(np.floor(row)) - 1, int(np.floor(column)) - 1
            for c in range(4):
                total = 0.0
                for a in range(4):
                    above = _reflected(top + a, height)
                    if not mirrored and above != top + a:
                        continue
                    for b in range(4):
                        beside = _reflected(left + b, width)
                        if mirrored or beside == left + b:
                            total += down[a] * across[b] * colours[above, beside, c]
                out[y, x, c] = min(1.0, max(0.0, total))
            for c in range(3):
                out[y, x, c] = min(out[y, x, c], out[y, x, 3])


@inner
def _cubic(t: float, out: np.ndarray) -> None:
    """Writes the weights of four pixels around a place, `t` from the second on."""
    out[0] = t * (-0.5 + t * (1.0 - 0.5 * t))
    out[1] = 1.0 + t * t * (-2.5 + 1.5 * t)
    out[2] = t * (0.5 + t * (2.0 - 1.5 * t))
    out[3] = t * t * (-0.5 + 0.5 * t)


@inner
def _reflected(n: Int, size: Int) -> Int:
    """Returns which pixel of a row that goes on as its mirror image lies at `n`."""
    n %= 2 * size
    return min(n, 2 * size - 1 - n)
