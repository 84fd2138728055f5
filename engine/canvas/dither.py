"""Dither: what is added before values are rounded to the coarse grid, so that weak strokes are neither lost nor banded.

On the grid of 2^-12 a stroke that covers little moves a pixel by less than half a step: rounded to the nearest, it
would stay where it is, however often one goes over it, and a gradient would become terraces.  So where A lies within
1/16 of 1, noise from -1/2 to 1/2 of a step is added first, v' = round(A v + B + noise): on the average a pixel then
moves by what it should, and a thousand strokes come to where they would without rounding, within a few steps.
Elsewhere there is none: what covers more leaves half of a level of 8 bits behind at most, and flat paint stays flat.

The noise of a pixel is a hash of its place, its level and the number of the commit in its layer: preview and commit
have the same, in any order and on any thread.  All planes of a pixel share it, so that colour stays within alpha, and
grey grey.  It is less than half a step, so that nothing moves where A v + B is v.  The same noise goes with what a
stroke leaves of coarser levels (rule U), and of finer detail (`attenuate`).

On the grid of 2^-16 there is none, and B, which lies on it, is added after A v is rounded.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect, TileKey
from engine.numeric.grid import FINE_STEP
from engine.numeric.hashing import fold_key, place64
from engine.numeric.kernel import kernel
from engine.numeric.stand_in import interpreted, or_plain

_LEAST, _MOST = np.float32(15 / 16), np.float32(17 / 16)  # A of what is weak lies between
_SHIFT = np.uint64(54)  # leaves 10 bits
_PART, _HALF = np.float32(1 / 1024), np.float32(1023 / 2048)
_place = interpreted(place64, {})
NO_DITHER = np.zeros((0, 0), np.float32)
NO_DITHER.flags.writeable = False


def dithering(step: np.float32, number: int, key: TileKey, inner: Rect, keep: np.ndarray) -> np.ndarray:
    """Returns what the commit of a number adds in a tile before it rounds, over `inner`, which is given from the tile's
    corner, and where A is `keep`: float32 (h, w), within half a `step`, 0 where A is not weak; empty on the fine grid.
    """
    if step == FINE_STEP:
        return NO_DITHER
    out = np.empty((inner.height, inner.width), np.float32)
    _sow(np.uint64(fold_key(number, key.level, key.x, key.y)), inner.y0, inner.x0, keep, step, out)
    return out


def _sown(key: np.uint64, top: int, left: int, keep: np.ndarray, step: np.float32, out: np.ndarray) -> None:
    """As `_sow`, plainly."""
    y, x = np.indices(out.shape, np.uint64)
    parts = (_place(key, x + np.uint64(left), y + np.uint64(top)) >> _SHIFT).astype(np.float32)
    out[...] = np.where((keep > _LEAST) & (keep < _MOST), (parts * _PART - _HALF) * step, np.float32(0.0))


@or_plain(_sown)
@kernel
def _sow(key: np.uint64, top: int, left: int, keep: np.ndarray, step: np.float32, out: np.ndarray) -> None:
    for j in range(out.shape[0]):
        row, a = out[j], keep[j]
        for i in range(row.size):
            row[i] = np.float32(0.0)
            if _LEAST < a[i] < _MOST:
                bits = place64(key, np.uint64(left + i), np.uint64(top + j)) >> _SHIFT
                row[i] = (np.float32(bits) * _PART - _HALF) * step
