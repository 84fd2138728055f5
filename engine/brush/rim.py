"""The rim of a stroke: how far inside it each pixel lies, and what a curve of that does to the coverage and colour.

A pixel is inside where its coverage is above a sixteenth of the brush's opacity: for a hard brush that is all it
covers, for a soft one all that is seen of it.  The distance is Euclidean and exact, to the nearest pixel outside, and
known up to the edge's width; so a tile needs to see only so far beyond itself, and tiles agree.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from engine.brush.parts import Edge
from engine.brush.settings import Brush
from engine.numeric.address import TILE, TileKey
from engine.numeric.kernel import kernel
from engine.numeric.shaping import look_up, table

CAP = 64  # px: wider rims are as wide as this
INSIDE = 1.0 / 16.0  # of the brush's opacity
_LEAST_INSIDE = 2.0**-12

_ZERO = np.float32(0.0)
_ONE = np.float32(1.0)

Tiles = Mapping[TileKey, "np.ndarray | float"]


@dataclass(frozen=True, eq=False)
class Rim:
    """`width`: px, 1..64; `curve`: float32 (1025,); `amount`: 0..1; `least`: M from which a pixel is inside;
    `colour`: float32 (3,), encoded sRGB, or None."""

    curve: np.ndarray
    width: float
    amount: float
    least: float
    colour: np.ndarray | None = None

    @classmethod
    def of(cls, brush: Brush) -> Rim | None:
        """Returns the rim that a brush asks for; None if that is nothing."""
        edge: Edge | None = brush.edge
        if edge is None or edge.amount == 0.0 or edge.width == 0.0:
            return None
        colour = None if edge.colour is None else np.array(edge.rgb, np.float32)
        width = min(max(edge.width * brush.radius, 1.0), float(CAP))
        return cls(table(edge.curve, "edge"), width, edge.amount, max(INSIDE * brush.opacity, _LEAST_INSIDE), colour)

    @property
    def reach(self) -> int:
        """Tells how many pixels beyond a tile its distances depend on."""
        return math.ceil(self.width)

    def around(self, tiles: Tiles, key: TileKey) -> tuple[np.ndarray | float, ...]:
        """Returns the coverage of the nine tiles around and of `key`, row by row; 0 where there is none."""
        return tuple(tiles.get(TileKey(key.level, key.x + i, key.y + j), 0.0) for j in (-1, 0, 1) for i in (-1, 0, 1))

    def depths(self, around: tuple[np.ndarray | float, ...]) -> np.ndarray | None:
        """Returns the distance from the rim in widths, 0..1, of the tile in the middle of nine: float32 (128, 128);
        None where all of it is 1."""
        if not any(isinstance(part, np.ndarray) or part < self.least for part in around):
            return None
        reach = self.reach
        size = TILE + 2 * reach
        inside = np.empty((size, size), np.bool_)
        spans = (slice(0, reach), slice(reach, reach + TILE), slice(reach + TILE, size))
        sources = (slice(TILE - reach, TILE), slice(0, TILE), slice(0, reach))
        for n, part in enumerate(around):
            rows, columns = spans[n // 3], spans[n % 3]
            seen = part[sources[n // 3], sources[n % 3]] if isinstance(part, np.ndarray) else part
            inside[rows, columns] = np.greater_equal(seen, self.least)
        out = np.empty((TILE, TILE), np.float32)
        _distances(inside, reach, np.float32(1.0 / self.width), out)
        return out

    def factors(self, depths: np.ndarray) -> np.ndarray:
        """Returns what coverage is multiplied by: float32 (128, 128)."""
        out = depths.copy()
        look_up(out.reshape(-1), self.curve, _ONE, _ZERO)
        if self.amount < 1.0:
            out *= np.float32(self.amount)
            out += np.float32(1.0 - self.amount)
        return out

    @property
    def within(self) -> float:
        """Returns the factor a width inside the rim and beyond."""
        return 1.0 - self.amount + self.amount * float(self.curve[-1])

    def stain(self, depths: np.ndarray) -> np.ndarray:
        """Tells how far the paint's colour turns to the rim's: float32 (128, 128); `amount` at it, 0 from half a
        width on: pigment that gathers leaves a line, not a shade."""
        t = np.maximum(np.float32(1.0) - np.float32(2.0) * depths, np.float32(0.0))
        out: np.ndarray = np.float32(self.amount) * t * t * (np.float32(3.0) - np.float32(2.0) * t)
        return out


def rim_of_ink(brush: Brush) -> Rim:
    """Returns the rim from which an ink counts how far within its stroke it lies: as wide as the brush's radius."""
    width = min(max(brush.radius, 1.0), float(CAP))
    return Rim(table("identity"), width, 1.0, max(INSIDE * brush.opacity, _LEAST_INSIDE))


@kernel
def _distances(inside: np.ndarray, reach: int, scale: np.float32, out: np.ndarray) -> None:
    """Writes how far each pixel of the middle lies from the nearest pixel that is not inside, less the half pixel to
    the border between them, times `scale` and at most 1.

    `inside`: bool (n + 2 reach, n + 2 reach); `out`: float32 (n, n).  First down each column, then along the rows the
    least of the squares' sums: exact, and both loops vectorise.
    """
    size, n = inside.shape[0], out.shape[0]
    far = np.int32(reach + 1)
    down = np.empty((n, size), np.int32)
    run = np.empty(size, np.int32)
    run[:] = far
    for y in range(reach + n):
        row = inside[y]
        for x in range(size):
            run[x] = min(run[x] + np.int32(1), far) if row[x] else np.int32(0)
        if y >= reach:
            here = down[y - reach]
            for x in range(size):
                here[x] = run[x]
    run[:] = far
    for y in range(size - 1, reach - 1, -1):
        row = inside[y]
        for x in range(size):
            run[x] = min(run[x] + np.int32(1), far) if row[x] else np.int32(0)
        if y < reach + n:
            here = down[y - reach]
            for x in range(size):
                here[x] = min(here[x], run[x])
    least = np.empty(n, np.int32)
    for y in range(n):
        row = down[y]
        for x in range(size):
            row[x] *= row[x]
        least[:] = far * far
        for k in range(2 * reach + 1):
            part = row[k : k + n]
            off = np.int32((k - reach) * (k - reach))
            for x in range(n):
                least[x] = min(least[x], part[x] + off)
        o = out[y]
        for x in range(n):
            o[x] = min(max(np.float32(math.sqrt(np.float32(least[x]))) - np.float32(0.5), _ZERO) * scale, _ONE)
