"""The colour of a stroke whose dabs have their own: beside the coverage, the mean of what was laid at each pixel.

A dab of strength k, opacity times flow times its profile, over a coverage that is M once it is laid, brings the mean c
to c + (t - c) k / M, t being the dab's own: a dab that covers in full leaves nothing of what lay there.
"""

from __future__ import annotations

import math

import numpy as np

from engine.brush import discs as kernels
from engine.brush.discs import CX, CY, ROUT
from engine.brush.print_form import Print, TwoInts
from engine.numeric.address import TILE
from engine.numeric.kernel import Array, kernel

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


class Tinted:
    """A print that lays the dabs of another one, round if that is None, with their tints: the last `count` columns of
    discs.  `tiles`: by the corner of a tile, float32 (count, 128, 128)."""

    def __init__(self, laid: Print | None, count: int) -> None:
        self._laid, self._count = laid, count
        self.tiles: dict[TwoInts, np.ndarray] = {}
        self._lent: set[TwoInts] = set()
        self._strength = np.zeros((TILE, TILE), np.float32)

    def lay(self, coverage: Array, discs: Array, which: Array, count: TwoInts, corner: TwoInts) -> None:
        """Lays the discs `which` into a tile's coverage, as `Pattern.lay`, and their tints over those there."""
        tints = self.tiles.get(corner)
        if tints is None or corner in self._lent:
            tints = np.zeros((self._count, TILE, TILE), np.float32) if tints is None else tints.copy()
            self._lent.discard(corner)
        self.tiles[corner] = tints
        for k in range(len(which)):
            for plane in (coverage, self._strength):
                if self._laid is None:
                    kernels.lay(plane, discs, which, k, k + 1, *corner)
                else:
                    self._laid.lay(plane, discs, which[k : k + 1], count, corner)
            _blend(coverage, self._strength, tints, discs[which[k]], *corner)

    def of_copy(self, number: int) -> Print:
        """Returns what the dabs of one copy alone look like."""
        return self if self._laid is None else self._laid.of_copy(number)

    def told(self) -> dict[TwoInts, np.ndarray]:
        """Returns the tints so far, which later dabs do not change."""
        self._lent = set(self.tiles)
        return dict(self.tiles)


@kernel
def _blend(coverage: Array, strength: Array, tints: Array, disc: Array, left: int, top: int) -> None:
    """Mixes a disc's tints, its last columns, into those of a tile, by its `strength`, which is cleared."""
    cx, cy, reach = disc[CX] - left, disc[CY] - top, disc[ROUT] + 2.0
    own = disc.shape[0] - tints.shape[0]
    first, last = max(0, math.floor(cx - reach)), min(TILE, math.ceil(cx + reach))
    for y in range(max(0, math.floor(cy - reach)), min(TILE, math.ceil(cy + reach))):
        m, k = coverage[y], strength[y]
        for c in range(tints.shape[0]):
            t, value = tints[c, y], np.float32(disc[own + c])
            for x in range(first, last):
                if k[x] > _ZERO:
                    t[x] += (value - t[x]) * min(k[x] / max(m[x], k[x]), _ONE)
        for x in range(first, last):
            k[x] = _ZERO
