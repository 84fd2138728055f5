"""Kernels that lay the tints of dabs: those of each into the mean of what was laid at a pixel (module `tinting`)."""

from __future__ import annotations

import math

import numpy as np

from engine.brush.discs import CEILING, CX, CY, RATE, RIN2, ROUT, SCALE
from engine.numeric.address import TILE
from engine.numeric.kernel import Array, inner, kernel

_ZERO, _ONE, _TWO, _THREE = np.float32(0.0), np.float32(1.0), np.float32(2.0), np.float32(3.0)


@inner
def blend(coverage: Array, strength: Array, tints: Array, disc: Array, left: int, top: int) -> None:
    """Mixes a disc's tints, its last columns, into those of a tile, by its `strength`, which is cleared."""
    cx, cy, reach = disc[CX] - left, disc[CY] - top, disc[ROUT] + 2.0
    own = disc.shape[0] - tints.shape[0]
    first, last = max(0, math.floor(cx - reach)), min(TILE, math.ceil(cx + reach))
    for y in range(max(0, math.floor(cy - reach)), min(TILE, math.ceil(cy + reach))):
        m, k = coverage[y], strength[y]
        for x in range(first, last):  # how much of the dab is in the mean
            k[x] = min(k[x] / max(m[x], k[x]), _ONE) if k[x] > _ZERO else _ZERO
        for c in range(tints.shape[0]):
            t, value = tints[c, y], np.float32(disc[own + c])
            for x in range(first, last):
                t[x] += (value - t[x]) * k[x]
        for x in range(first, last):
            k[x] = _ZERO


@kernel
def blend_one(coverage: Array, strength: Array, tints: Array, disc: Array, left: int, top: int) -> None:
    """As `blend`, for Python."""
    blend(coverage, strength, tints, disc, left, top)


@kernel
def lay_round(coverage: Array, tints: Array, discs: Array, which: Array, corner: tuple[int, int]) -> None:
    """Lays round discs, as `discs.lay` does, and their tints, one after the other."""
    across, share = np.empty(TILE, np.float32), np.empty(TILE, np.float32)
    for index in which:
        disc = discs[index]
        cx, cy, outer, scale = disc[CX] - corner[0], disc[CY] - corner[1], disc[ROUT], disc[SCALE]
        ceiling, rate, own = np.float32(disc[CEILING]), np.float32(disc[RATE]), disc.shape[0] - tints.shape[0]
        for x in range(max(0, math.floor(cx - outer)), min(TILE, math.ceil(cx + outer) + 1)):
            across[x] = np.float32((x + 0.5 - cx) * (x + 0.5 - cx) * scale)
        for y in range(max(0, math.ceil(cy - outer - 0.5)), min(TILE, math.floor(cy + outer - 0.5) + 1)):
            square = (y + 0.5 - cy) * (y + 0.5 - cy)
            half = math.sqrt(max(0.0, outer * outer - square))
            first, last = max(0, math.ceil(cx - half - 0.5)), min(TILE, math.floor(cx + half - 0.5) + 1)
            down, m = np.float32((square - disc[RIN2]) * scale), coverage[y]
            for x in range(first, last):
                v = _ONE - max(_ZERO, min(_ONE, across[x] + down))
                part = rate * (v * v * (_THREE - _TWO * v))
                m[x] += max(_ZERO, ceiling - m[x]) * part
                k = ceiling * part
                share[x] = min(k / max(m[x], k), _ONE) if k > _ZERO else _ZERO
            for c in range(tints.shape[0]):
                t, value = tints[c, y], np.float32(disc[own + c])
                for x in range(first, last):
                    t[x] += (value - t[x]) * share[x]
