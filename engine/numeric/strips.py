"""Sums of weighted, displaced copies of a small picture, in strips 16 pixels wide.

A copy that is added to a picture row by row is many short runs that begin anywhere.  In strips, the rows of 16 pixels
of a block of the result follow one another, and the small picture is kept as it falls on a strip at each of its
displacements; so a copy is a few long runs at aligned places, several times as fast.  The sums are the same, bit for
bit: what is added besides are zeros.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Array, Int, Real, inlined, inner, kernel

WIDE = 16  # pixels across a strip
_BLOCK = 128  # pixels along a side of a block of the result
_MARGIN = 8  # rows of zeros below a strip: runs are of whole groups of four rows
_MOST = 3 << 19  # bytes that a picture in strips may take: it has to stay near the processor
_ALIGNED = 64

NO_STRIPS = np.empty((0, 0, 0, 0), np.float32)
NO_ROWS = np.empty((0, 2), np.int64)


def in_strips(planes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """`planes` (c, h, w) as they fall on a strip whose first pixel is their column d - 15, for each d.

    (float32 (c, w + 15, h + 8, 16), and the rows [first, last) that are not zero, int64 (w + 15, 2)); empty for
    planes that would take too much.
    """
    channels, height, width = planes.shape
    shape = (channels, width + WIDE - 1, height + _MARGIN, WIDE)
    if 4 * int(np.prod(shape)) > _MOST:
        return NO_STRIPS, NO_ROWS
    laid = np.zeros((channels, height + _MARGIN, width + 2 * (WIDE - 1)), np.float32)
    laid[:, :height, WIDE - 1 : WIDE - 1 + width] = planes
    strips = _empty(shape)
    for d in range(shape[1]):
        strips[:, d] = laid[:, :, d : d + WIDE]
    filled = (strips != 0.0).any((0, 3))
    first, last = filled.argmax(1), filled.shape[1] - filled[:, ::-1].argmax(1)
    return strips, np.stack([first, np.where(filled.any(1), last, first)], 1).astype(np.int64)


def _empty(shape: tuple[int, ...]) -> np.ndarray:
    """float32, at an address that whole vectors are read from."""
    size = 4 * int(np.prod(shape))
    room = np.empty(size + _ALIGNED, np.uint8)
    at = -room.ctypes.data % _ALIGNED
    return room[at : at + size].view(np.float32).reshape(shape)


@inlined
def _add(into: np.ndarray, p: Int, copied: np.ndarray, q: Int, n: Int, weight: Real) -> None:
    """into[p:p + n] += weight * copied[q:q + n]; unsigned places, so that none counts from the end."""
    for i in range(n):
        into[p + i] += weight * copied[q + i]


@inner
def _near(
    places: Array,
    weights: Array,
    first: Int,
    last: Int,
    block: tuple[Int, Int, Int, Int],
    shape: tuple[Int, Int],
    at: Array,
    found: Array,
) -> Int:
    """Lists the copies `first` to `last` that touch a block: (top row, displacement on its first strip) in `at`,
    weights in `found`; how many.  block = (y, x, height, width), shape = (rows of a copy, its displacements)."""
    y0, x0, height, width = block
    high, displacements = shape
    count = 0
    for n in range(first, last):
        top, left = places[n, 0] - y0, places[n, 1] - x0
        if top < height and top + high > 0 and left < width and left + displacements > WIDE - 1:
            at[count, 0], at[count, 1], found[count] = top, WIDE - 1 - left, weights[n]
            count += 1
    return count


@inner
def _lay(
    strip: Array, copied: Array, rows: Array, shape: tuple[Int, Int, Int, Int, Int], at: Array, found: Array
) -> None:
    """Sums the listed copies on a strip, the `s`-th of a block: shape = (s, channel, its rows, a copy's displacements
    and rows)."""
    s, channel, height, displacements, deep = shape
    strip[: (height + _MARGIN) * WIDE] = np.float32(0.0)
    for n in range(found.size):
        d = at[n, 1] + s * WIDE
        if 0 <= d < displacements:
            top = at[n, 0]
            a, b = max(0, top + rows[d, 0]), min(height, top + rows[d, 1])
            if a < b:
                length = np.uintp(((b - a + 3) >> 2) << 6)
                p = np.uintp(a * WIDE)
                q = np.uintp(((channel * displacements + d) * deep + a - top) * WIDE)
                _add(strip, p, copied, q, length, found[n])


@inner
def _unpack(out: np.ndarray, strip: np.ndarray, channel: Int, y0: Int, x0: Int) -> None:
    """Copies a strip to rows and columns from (y0, x0) on of `out`."""
    height, wide = min(_BLOCK, out.shape[1] - y0), np.uintp(min(WIDE, out.shape[2] - x0))
    flat = out.reshape(out.size)
    for y in range(height):
        p = np.uintp((channel * out.shape[1] + y0 + y) * out.shape[2] + x0)
        q = np.uintp(y * WIDE)
        for i in range(wide):
            flat[p + i] = strip[q + i]


@kernel
def lay_strips(
    out: Array, copied: Array, rows: Array, places: Array, weights: Array, bands: tuple[Array, Int, Int]
) -> None:
    """out (c, h, w) = sum over n of weights[n] times the copy, beginning at (row, column) places[n], in that order.

    bands = (starts, top, tall): copies starts[j] to starts[j + 1] begin in the rows [top + j tall, top + (j + 1) tall).
    """
    starts, first, tall = bands
    channels, displacements, copy_height, _ = copied.shape
    high = copy_height - _MARGIN
    room = np.empty((min(_BLOCK, out.shape[1]) + _MARGIN) * WIDE + 16, np.float32)
    strip = room[(np.uintp(-room.ctypes.data) & np.uintp(63)) >> np.uintp(2) :]
    flat = copied.reshape(copied.size)
    at, found = np.empty((weights.size, 2), np.int64), np.empty(weights.size, np.float32)
    for y0 in range(0, out.shape[1], _BLOCK):
        height = min(_BLOCK, out.shape[1] - y0)
        j0 = max(0, (y0 - high - first) // tall)
        j1 = max(j0, min(starts.size - 1, (y0 + height - first) // tall + 1))
        for x0 in range(0, out.shape[2], _BLOCK):
            width = min(_BLOCK, out.shape[2] - x0)
            block = y0, x0, height, width
            count = _near(places, weights, starts[j0], starts[j1], block, (high, displacements), at, found)
            for s in range((width + WIDE - 1) // WIDE):
                for c in range(channels):
                    _lay(strip, flat, rows, (s, c, height, displacements, copy_height), at[:count], found[:count])
                    _unpack(out, strip, c, y0, x0 + s * WIDE)
