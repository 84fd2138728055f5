"""Sparse convolution: an endless field of weighted, displaced copies of one impulse response (Lewis 1984, section 5.2).

The points form a sparse white noise: square by square, a hash of (key, place) says how many there are, where they lie
and what they weigh.  With weights of zero mean, independent of one another, the field has the expected spectrum of
the impulse response.  Each pixel sums its points in the order of (row of cells, column of cells, number), so that any
rectangle, made alone, holds the same bits as the whole.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.hashing import MASK32, fold_key, mix64, place64
from engine.numeric.kernel import Array, Int, Real, inlined, inner, kernel
from engine.numeric.strips import NO_ROWS, NO_STRIPS, in_strips, lay_strips

ALIKE = -1  # for `levels`: all points weigh 1
_SMALLEST = 8  # pixels along a cell, which else is half as large as the sample: so it covers the plane evenly
_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_BITS20 = np.uint64(0xFFFFF)
_1, _20, _40 = np.uint64(1), np.uint64(20), np.uint64(40)
_HEAVIEST = math.sqrt(3.0)  # of a point, its weights being of variance 1
# Weights of either sign, evenly spread from half the standard deviation up: none of the points is lost.
_LEAST = np.float32(0.5)
_RANGE = np.float32((math.sqrt(11.25) - 1.5) / 2.0 / (1 << 23))


@dataclass(frozen=True, eq=False, slots=True)
class Impulse:
    """An impulse response, seen `coarser` levels above the one on which its points lie.

    `phases`: float32 (p, p, c, h, w), C-contiguous, p = 2^s: the response as it falls on the pixels when its corner
    lies at the fraction (row, column)/p of one.  Plain: (1, 1, c, h, w).  `size`: (h, w) at the level of the points.
    `strips`, `rows`: a small plain one once more, as `engine.numeric.strips` lays it; else empty.
    """

    phases: np.ndarray
    size: tuple[int, int]
    coarser: int
    strips: np.ndarray
    rows: np.ndarray

    @classmethod
    def of(cls, response: np.ndarray) -> Impulse:
        """`response`: float32 (c, h, w)."""
        plain = np.ascontiguousarray(response[None, None], np.float32)
        return cls(plain, response.shape[1:], 0, *in_strips(plain[0, 0]))

    def seen(self, coarser: int, phases: int = 16) -> Impulse:
        """The means over 2^coarser pixels squared; positions in steps of a pixel of the finer level, at least 1/16."""
        assert self.phases.shape[:2] == (1, 1)
        steps = min(coarser, phases.bit_length() - 1)
        response = _pooled(self.phases[0, 0], 1 << (coarser - steps), (0, 0))
        p = 1 << steps
        rows = [[_pooled(response, p, (y, x)) for x in range(p)] for y in range(p)]
        return Impulse(np.ascontiguousarray(rows, np.float32), self.size, coarser, NO_STRIPS, NO_ROWS)


def _pooled(planes: np.ndarray, p: int, at: tuple[int, int]) -> np.ndarray:
    """Means over p x p pixels of `planes` (c, h, w) laid at `at` (< p) on zeros: (c, ceil(h + p - 1 / p), ...)."""
    channels, height, width = planes.shape
    rows, columns = (-(-(size + p - 1) // p) for size in (height, width))
    laid = np.zeros((channels, rows * p, columns * p))
    laid[:, at[0] : at[0] + height, at[1] : at[1] + width] = planes
    out: np.ndarray = laid.reshape(channels, rows, p, columns, p).mean((2, 4)).astype(np.float32)
    return out


@dataclass(frozen=True, slots=True)
class Noise:
    """The sparse noise: `density` points per area of the sample; `levels`: weights are one of so many evenly spaced
    values, 0 for any; `key`: 64 bits.  The weights have mean 0 and standard deviation 1."""

    key: int
    density: float
    levels: int = 0


def spread(response: np.ndarray, density: float) -> float:
    """Returns the standard deviation of the field of a response (c, h, w), over all channels, known before it is
    made."""
    channels, height, width = response.shape
    energy = float(np.square(response, dtype=np.float64).sum()) / channels
    return math.sqrt(density * energy / (height * width))


def loudness(impulse: Impulse, noise: Noise) -> tuple[float, float]:
    """Returns how far a field is from 0 at most, wherever its points lie, and its standard deviation; of its loudest
    channel."""
    most, count, size = float(np.abs(impulse.phases).max(initial=0.0)), 1, impulse.size
    cells = [max(_SMALLEST, side // 2) for side in size]
    for side, cell in zip(impulse.phases.shape[3:], cells, strict=True):
        count *= -(-(side << impulse.coarser) // cell) + 1
    in_cell = int(noise.density * (cells[0] * cells[1] / (size[0] * size[1]))) + 1
    energy = np.square(impulse.phases, dtype=np.float64).mean(axis=(0, 1)).sum(axis=(1, 2)).max(initial=0.0)
    per_pixel = noise.density * 4.0**impulse.coarser / (size[0] * size[1])
    return _HEAVIEST * count * in_cell * most, math.sqrt(per_pixel * float(energy))


def reach(impulse: Impulse, rect: Rect) -> Rect:
    """Tells where the points lie that can touch `rect`, in pixels of the rectangle's own level."""
    m, (left, top, right, bottom) = impulse.coarser, _points(impulse, rect)
    return Rect(left >> m, top >> m, (right - 1 >> m) + 1, (bottom - 1 >> m) + 1)


def _points(impulse: Impulse, rect: Rect) -> tuple[int, int, int, int]:
    """Returns the same as (left, top, right, bottom) in pixels of the points' level."""
    m, (height, width) = impulse.coarser, impulse.phases.shape[3:]
    down, right = impulse.size[0] // 2, impulse.size[1] // 2
    left, top = (rect.x0 - width + 1 << m) + right, (rect.y0 - height + 1 << m) + down
    return left, top, (rect.x1 << m) + right, (rect.y1 << m) + down


def field(impulse: Impulse, noise: Noise, rect: Rect, within: np.ndarray | None = None) -> np.ndarray:
    """Returns the field over `rect`: float32 (c, h, w), of mean 0.

    A copy of the response begins at pixel (x, y) - size // 2, where (x, y) is its point.  `within`: uint8 (h, w) over
    `reach(impulse, rect)`; points where it is 0 are left out (the extent of section 5.2).
    """
    out = np.empty((impulse.phases.shape[2], rect.height, rect.width), np.float32)
    if rect.empty:
        return out
    m, (height, width) = impulse.coarser, impulse.size
    cell_h, cell_w = max(_SMALLEST, height // 2), max(_SMALLEST, width // 2)
    left, top, right, bottom = _points(impulse, rect)
    x, y = left // cell_w, top // cell_h
    columns, rows = (right - 1) // cell_w + 1 - x, (bottom - 1) // cell_h + 1 - y
    around = rect if within is None else reach(impulse, rect)
    # From the rectangle's corner on, its place is known to the keys alone.
    corner = x * cell_w - (rect.x0 << m), y * cell_h - (rect.y0 << m)
    offsets = width // 2, height // 2, around.x0 - rect.x0, around.y0 - rect.y0
    numbers = np.array((x & MASK32, y & MASK32, columns, rows, cell_w, cell_h, *corner, *offsets, m), np.int64)
    mean = noise.density * (cell_w * cell_h / (width * height))
    inside = _EVERYWHERE if within is None else within
    keys = _keys(noise.key, x >> 32, y >> 32)
    _fill(out, impulse.phases, impulse.strips, impulse.rows, keys, numbers, mean, noise.levels, inside)
    return out


class _Layout(NamedTuple):
    """Where a rectangle's cells lie; it is handed over as an array, since tuples take the kernel long to take apart."""

    x: int  # the first cell's column and row, their low halves
    y: int
    columns: int
    rows: int
    width: int  # of a cell, in pixels of the points' level
    height: int
    left: int  # of the first cell, from the rectangle's corner
    top: int
    half_x: int  # how far to the left of and above its point a response begins
    half_y: int
    reach_x: int  # the corner of the points' reach, in pixels of the rectangle's level
    reach_y: int
    coarser: int  # levels from the rectangle's up to the points'


_EVERYWHERE = np.zeros((0, 0), np.uint8)


@lru_cache(maxsize=1024)
def _keys(key: int, high_x: int, high_y: int) -> np.ndarray:
    """Keys of four squares of 2^32 cells: uint64 (2 rows, 2 columns)."""
    squares = [[fold_key(key, high_x + i, high_y + j) for i in range(2)] for j in range(2)]
    return np.array(squares, np.uint64)


@inlined
def _weight(h: Int, levels: Int) -> Real:
    """Returns a number of mean 0 and variance 1 from the upper 24 bits of a hash: any, or one of `levels` values."""
    bits = h >> _40
    if levels == ALIKE:
        return np.float32(1.0)
    if levels < 2:
        size = _LEAST + np.float32(np.int32(bits >> _1)) * _RANGE
        return size if bits & _1 else -size
    step = np.float32(math.sqrt(12.0 / (levels * levels - 1.0)))
    k = np.int32((bits * np.uint64(levels)) >> np.uint64(24))
    return (np.float32(k) - np.float32(0.5) * np.float32(levels - 1)) * step


@inner
def _stamp(out: np.ndarray, response: np.ndarray, top: Int, left: Int, weight: Real) -> None:
    """out += weight * response (c, h, w), whose first pixel lies at (top, left) of `out`, inside or not."""
    y0, y1 = max(0, top), min(out.shape[1], top + response.shape[1])
    x0, x1 = max(0, left), min(out.shape[2], left + response.shape[2])
    if x0 >= x1:
        return
    for c in range(out.shape[0]):
        for y in range(y0, y1):
            row, copied = out[c, y, x0:x1], response[c, y - top, x0 - left : x1 - left]
            for i in range(row.size):
                row[i] += weight * copied[i]


@inlined
def _counts(within: np.ndarray, x: Int, y: Int) -> bool:
    return 0 <= y < within.shape[0] and 0 <= x < within.shape[1] and within[y, x] != 0  # type: ignore[no-any-return]


@inner
def _cell(
    h: Int,
    corner: tuple[Int, Int],
    layout: _Layout,
    noise: tuple[Real, Int],
    within: Array,
    places: Array,
    weights: Array,
    count: Int,
) -> Int:
    """Lists the points of one cell, whose hash is `h` and whose corner lies at (x, y), from `count` on; the new count.

    `places`: int64 (n, 2), where the response begins, (row, column) in pixels of the points' level.
    """
    cell_w, cell_h = np.uint64(layout.width), np.uint64(layout.height)
    mean, levels = noise
    rest = np.float64(mix64(h) >> _40) * 2.0**-24  # type: ignore[arg-type]
    for i in range(int(mean) + (1 if rest < mean - int(mean) else 0)):
        g = mix64(h + np.uint64(i + 1) * _GOLDEN)
        x = corner[0] + np.int64((g & _BITS20) * cell_w >> _20)
        y = corner[1] + np.int64((g >> _20 & _BITS20) * cell_h >> _20)
        m = layout.coarser
        if within.size and not _counts(within, (x >> m) - layout.reach_x, (y >> m) - layout.reach_y):
            continue
        places[count, 0], places[count, 1] = y - layout.half_y, x - layout.half_x
        weights[count] = _weight(g, levels)
        count += 1
    return count


@kernel
def _fill(
    out: Array,
    phases: Array,
    strips: Array,
    filled: Array,
    keys: Array,
    numbers: Array,
    mean: Real,
    levels: Int,
    within: Array,
) -> None:
    """Lists the points, cell by cell, then lays them.  `numbers`: int64, those of a _Layout in order."""
    n = numbers
    layout = _Layout(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12])
    noise = mean, levels
    x, y, columns, rows = layout.x, layout.y, layout.columns, layout.rows
    most = columns * rows * (int(noise[0]) + 1)
    places, weights, starts = np.empty((most, 2), np.int64), np.empty(most, np.float32), np.empty(rows + 1, np.int64)
    count = np.int64(0)  # no plain 0: numba would compile `_cell` for that number alone, too
    for j in range(rows):
        starts[j] = count
        for i in range(columns):
            key = keys[(y + j) >> 32, (x + i) >> 32]
            h = place64(key, np.uint64((x + i) & MASK32), np.uint64((y + j) & MASK32))
            corner = layout.left + i * layout.width, layout.top + j * layout.height
            count = _cell(h, corner, layout, noise, within, places, weights, count)  # type: ignore[assignment]
    starts[rows] = count
    if strips.size:
        top = layout.top - layout.half_y
        lay_strips(out, strips, filled, places, weights, (starts, top, layout.height))
        return
    out[:] = np.float32(0.0)
    for n in range(count):  # type: ignore[assignment]
        top, left = places[n, 0] >> layout.coarser, places[n, 1] >> layout.coarser
        if top < out.shape[1] and top + phases.shape[3] > 0:
            a, b = places[n, 0] - (top << layout.coarser), places[n, 1] - (left << layout.coarser)
            p = phases.shape[0]
            _stamp(out, phases[a * p >> layout.coarser, b * p >> layout.coarser], top, left, weights[n])
