"""Expand and reduce: the two filters of the pyramid, exact on the grid.

Expand is the quadratic B-spline (Chaikin's (1, 3, 3, 1)/4 along each axis); reduce is the mean of 2 x 2 pixels.
With values on the grid and |v| <= 16 every partial sum is exact in float32, so the one rounding at the end is the
only one, whatever the order of the sums; on a coarser grid all the more.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.grid import FINE_STEP, snap, snap_to, snapped_to
from engine.numeric.kernel import inner, kernel
from engine.numeric.stand_in import or_plain

_THREE = np.float32(3.0)
_SIXTEENTH = np.float32(1.0 / 16.0)
_QUARTER = np.float32(0.25)


@inner
def blend_rows(near: np.ndarray, far: np.ndarray, out: np.ndarray) -> None:
    """3 near + far: a row halfway between two coarse rows, times 4."""
    for i in range(out.size):
        out[i] = _THREE * near[i] + far[i]


@kernel
def expand_row(t: np.ndarray, out: np.ndarray, step: np.float32) -> None:
    """`t` (n + 2,) to `out` (2n,): along a row, and the division by 16 of both axes, rounded to the grid of `step`."""
    n = out.size // 2
    left, mid, right = t[0:n], t[1 : n + 1], t[2 : n + 2]
    for i in range(n):
        out[2 * i] = snap_to((_THREE * mid[i] + left[i]) * _SIXTEENTH, step)
        out[2 * i + 1] = snap_to((_THREE * mid[i] + right[i]) * _SIXTEENTH, step)


def expanded_rows(
    coarse: np.ndarray, top: int, left: int, source: int, first: int, last: int, width: int, step: np.float32
) -> np.ndarray:
    """Returns rows [first, last) of one plane of `expand_into`, plainly: float32 (last - first, width)."""
    columns = slice(left, left + width // 2 + 2)
    y = np.arange(first, last)
    near = coarse[source, top + 1 + y // 2, columns]
    far = coarse[source, top + 1 + y // 2 + 2 * (y & 1) - 1, columns]
    t = _THREE * near + far
    out = np.empty((last - first, width), np.float32)
    out[:, ::2], out[:, 1::2] = _THREE * t[:, 1:-1] + t[:, :-2], _THREE * t[:, 1:-1] + t[:, 2:]
    return snapped_to(out * _SIXTEENTH, step)


def _expand_into(
    coarse: np.ndarray,
    top: int,
    left: int,
    planes: np.ndarray,
    out: np.ndarray,
    first: int,
    last: int,
    step: np.float32,
) -> None:
    """As `expand_into`, plainly."""
    for c, source in enumerate(planes.tolist()):
        rows = 0.0 if source < 0 else expanded_rows(coarse, top, left, source, first, last, out.shape[2], step)
        out[c, first:last] = rows


@or_plain(_expand_into)
@kernel
def expand_into(
    coarse: np.ndarray,
    top: int,
    left: int,
    planes: np.ndarray,
    out: np.ndarray,
    first: int,
    last: int,
    step: np.float32,
) -> None:
    """Makes rows [first, last) of `out` (C, 2h, 2w) from `coarse` (D, H, W), both C-contiguous.

    `out[0, 0]` is the first child of `coarse[top + 1, left + 1]`; `planes[c]` says which plane of `coarse` feeds
    plane c, -1 for none (zeros).  `first` and `last` are even; `step`: of the values' grid.
    """
    n = out.shape[2] // 2
    t = np.empty(n + 2, np.float32)
    for c in range(out.shape[0]):
        source = planes[c]
        if source < 0:
            for y in range(first, last):
                out[c, y][:] = np.float32(0.0)
            continue
        for y in range(first, last):
            row = top + 1 + y // 2
            near = coarse[source, row][left : left + n + 2]
            far = coarse[source, row + 2 * (y & 1) - 1][left : left + n + 2]
            blend_rows(near, far, t)
            expand_row(t, out[c, y], step)


def expand(coarse: np.ndarray) -> np.ndarray:
    """E: float32 (C, h + 2, w + 2) to the children of its inner h x w pixels, (C, 2h, 2w)."""
    coarse = np.ascontiguousarray(coarse, np.float32)
    channels, height, width = coarse.shape
    out = np.empty((channels, 2 * height - 4, 2 * width - 4), np.float32)
    expand_into(coarse, 0, 0, np.arange(channels), out, 0, out.shape[1], FINE_STEP)
    return out


@inner
def _reduce_row(upper: np.ndarray, lower: np.ndarray, out: np.ndarray) -> None:
    for i in range(out.size):
        out[i] = snap(((upper[2 * i] + upper[2 * i + 1]) + (lower[2 * i] + lower[2 * i + 1])) * _QUARTER)


@kernel
def _reduce_into(fine: np.ndarray, out: np.ndarray) -> None:
    for c in range(out.shape[0]):
        for y in range(out.shape[1]):
            _reduce_row(fine[c, 2 * y], fine[c, 2 * y + 1], out[c, y])


def reduce(fine: np.ndarray) -> np.ndarray:
    """R: float32 (C, 2h, 2w) to the means of 2 x 2 pixels, (C, h, w)."""
    fine = np.ascontiguousarray(fine, np.float32).view()
    fine.flags.writeable = False  # whatever is given: so the kernel is compiled once
    channels, height, width = fine.shape
    out = np.empty((channels, height // 2, width // 2), np.float32)
    _reduce_into(fine, out)
    return out
