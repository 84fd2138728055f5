"""Pictures turned and mirrored at any scale, by the cubic convolution of `convolution.py`, whose filter lies along the
axes of the picture that is looked at."""

from __future__ import annotations

import functools
import math
from typing import NamedTuple

import numpy as np

from engine.numeric.kernel import Array, Int, Real, inlined, inner_uncounted, uncounted
from engine.numeric.resample import cubic

_BETWEEN = 512  # places between two pixels for which the filter is known

Axes = tuple[float, float, float, float]


class Askew(NamedTuple):
    """A picture, uint8 (3, h, w), that is seen askew: the middle of the result lies (x, y) pixels from its corner, a
    pixel of the result to the right is `axes[:2]` pixels of it farther, one down `axes[2:]`; it counts `share`."""

    planes: np.ndarray
    x: float
    y: float
    axes: Axes
    share: float


def write_askew(parts: tuple[Askew, ...], top: int, height: int, out: np.ndarray) -> None:
    """Writes rows from `top` on of the sum of pictures, `height` rows high in all, into `out`, uint8 (n, w, 3)."""
    sums = np.zeros((*out.shape[:2], 3), np.float32)
    right, down = 0.5 - out.shape[1] / 2, top + 0.5 - height / 2
    for part in parts:
        a, b, c, d = part.axes
        table = _filters(math.hypot(a, b)) * np.float32(part.share)
        reach = 2.0 * max(1.0, math.hypot(a, b))
        start = part.x + right * a + down * c - 0.5 - reach, part.y + right * b + down * d - 0.5 - reach
        _add(part.planes, table, start, part.axes, _filters(math.hypot(a, b)), sums)
    _write(sums, out)


@functools.lru_cache(maxsize=16)
def _filters(step: float) -> np.ndarray:
    """Returns what each tap counts, float32 (phases, taps), by how far behind the filter's beginning the first one
    lies: 1 in all.  There are four taps or eight."""
    wide = max(1.0, step)
    phases = np.arange(_BETWEEN + 1) / _BETWEEN
    weights = cubic(np.abs(phases[:, None] + np.arange(4 * math.ceil(wide)) - 2.0 * wide) / wide)
    weights /= weights.sum(axis=1, keepdims=True)
    return weights.astype(np.float32)


@inlined
def _across(a: Array, w: Array, x: Int) -> Real:
    """Returns what four pixels of a row from x on are together."""
    i = np.uintp(x)
    total: Real = (w[0] * np.float32(a[i]) + w[1] * np.float32(a[i + 1])) + (
        w[2] * np.float32(a[i + 2]) + w[3] * np.float32(a[i + 3])
    )
    return total


@inner_uncounted
def _add_pixel(planes: Array, rows: Array, columns: Array, top: Int, left: Int, pixel: Array) -> None:
    """Adds what the filters see from (left, top) on to the three channels of a pixel."""
    for channel in range(3):
        total = np.float32(0.0)
        for j in range(rows.size):
            line = planes[channel, np.uintp(top + j)]
            for i in range(0, columns.size, 4):
                total += rows[j] * _across(line, columns[i : i + 4], left + i)
        pixel[channel] += total


@uncounted
def _add(planes: Array, down: Array, start: tuple[Real, Real], axes: Axes, across: Array, sums: Array) -> None:
    """Adds a picture to `sums`, float32 (n, w, 3).  `start`: where the filter of the first pixel begins; `down`,
    `across`: what rows and columns count."""
    height, width, taps = planes.shape[1], planes.shape[2], across.shape[1]
    for y in range(sums.shape[0]):
        for x in range(sums.shape[1]):
            along = start[0] + x * axes[0] + y * axes[2]
            below = start[1] + x * axes[1] + y * axes[3]
            left, top = math.ceil(along), math.ceil(below)
            columns = across[int((left - along) * _BETWEEN + 0.5)]
            rows = down[int((top - below) * _BETWEEN + 0.5)]
            left, top = min(max(left, 0), width - taps), min(max(top, 0), height - taps)
            _add_pixel(planes, rows, columns, top, left, sums[y, x])


@uncounted
def _write(sums: Array, out: Array) -> None:
    """Writes sums, float32 (n, w, 3), as bytes."""
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            for channel in range(3):
                out[y, x, channel] = np.uint8(
                    min(max(sums[y, x, channel] + np.float32(0.5), np.float32(0.0)), np.float32(255.0))
                )
