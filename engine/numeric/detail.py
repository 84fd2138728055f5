"""What a finer level adds to a coarser one: fine - E coarse, in plain float32 (no rounding to the grid).

E is the quadratic B-spline expand, (9, 3, 3, 1)/16 of the four nearest parents.  Rows and columns are weighed one
after the other, always in the same order, so a pixel's value does not depend on the rectangle it was computed in.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.kernel import inner, kernel

# Below a sixteenth of the grid's step a difference is the rounding of float32, not detail.
FLOOR = np.float32(2.0**-20)

_ZERO = np.float32(0.0)
_THREE = np.float32(3.0)
_SIXTEENTH = np.float32(1.0 / 16.0)


def parents(rect: Rect) -> Rect:
    """Returns the pixels of the next coarser level that E needs for the (even) rectangle `rect`."""
    return rect.zoomed(-1).grown(1)


@inner
def blend_rows(near: np.ndarray, far: np.ndarray, out: np.ndarray) -> None:
    """Writes the vertical half of E: 3 near + far, to be divided by 4."""
    for i in range(out.size):
        out[i] = _THREE * near[i] + far[i]


@inner
def _subtract_row(t: np.ndarray, out: np.ndarray) -> int:
    """out (2n,) -= E of `t` (n + 2,), differences below FLOOR to zero; how many are left."""
    n = out.size // 2
    left, mid, right = t[0:n], t[1 : n + 1], t[2 : n + 2]
    count = np.int32(0)
    for i in range(n):
        a = out[2 * i] - (_THREE * mid[i] + left[i]) * _SIXTEENTH
        b = out[2 * i + 1] - (_THREE * mid[i] + right[i]) * _SIXTEENTH
        a = a if abs(a) > FLOOR else _ZERO
        b = b if abs(b) > FLOOR else _ZERO
        out[2 * i] = a
        out[2 * i + 1] = b
        count += np.int32(a != _ZERO) + np.int32(b != _ZERO)
    return count  # type: ignore[return-value]


@kernel
def subtract_expanded(fine: np.ndarray, coarse: np.ndarray) -> bool:
    """fine -= E coarse, in place; whether anything but zeros is left.

    `fine` float32 (C, 2h, 2w) begins at an even row and column; `coarse` (C, h + 2, w + 2) are its `parents`.
    """
    t = np.empty(coarse.shape[2], np.float32)
    some = False
    for c in range(fine.shape[0]):
        for y in range(fine.shape[1]):
            row = 1 + y // 2
            blend_rows(coarse[c, row], coarse[c, row + 2 * (y & 1) - 1], t)
            if _subtract_row(t, fine[c, y]) > 0:
                some = True
    return some


@kernel
def expand_row(t: np.ndarray, out: np.ndarray) -> None:
    """Writes the horizontal half of E and the division by 16: `t` (n + 2,) to `out` (2n,)."""
    n = out.size // 2
    left, mid, right = t[0:n], t[1 : n + 1], t[2 : n + 2]
    for i in range(n):
        out[2 * i] = (_THREE * mid[i] + left[i]) * _SIXTEENTH
        out[2 * i + 1] = (_THREE * mid[i] + right[i]) * _SIXTEENTH


def cut(planes: np.ndarray, rect: Rect, inside: Rect) -> np.ndarray:
    """`planes` (C, h, w), which cover `inside`, cropped to `rect`; contiguous."""
    if rect == inside:
        return planes
    rows, columns = rect.slices(inside)
    return np.ascontiguousarray(planes[:, rows, columns])


@kernel
def add_expanded(fine: np.ndarray, coarse: np.ndarray) -> None:
    """fine += E coarse, in place; shapes as for `subtract_expanded`."""
    t, finer = np.empty(coarse.shape[2], np.float32), np.empty(fine.shape[2], np.float32)
    for c in range(fine.shape[0]):
        for y in range(fine.shape[1]):
            row, out = 1 + y // 2, fine[c, y]
            blend_rows(coarse[c, row], coarse[c, row + 2 * (y & 1) - 1], t)
            expand_row(t, finer)
            for i in range(out.size):
                out[i] += finer[i]
