"""Pictures at other scales and between their pixels, by cubic convolution (Keys 1981, a = -1/2).

Where a picture shrinks the filter is as wide as it shrinks.  Rows come first, whole vectors of them; then columns, of
16 rows at once, which lie beside one another for that.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from engine.numeric.kernel import Array, Int, inner_uncounted, uncounted
from engine.numeric.resample import cubic

BESIDE = 16  # worked on at once
THREE = 3
_BYTE = np.float32(255.0)
_ROUND = np.float32(0.5)
_LEAST = np.float32(0.0)


class Taps(NamedTuple):
    """Which pixels along an axis make each of the result: the first of them, int64 (n,), and what each counts, float32
    (n, taps), 1 in all.  The number of taps is a multiple of four."""

    first: np.ndarray
    weights: np.ndarray


class Part(NamedTuple):
    """A picture, float32 (3, h, w), and the taps by which it is seen."""

    planes: np.ndarray
    rows: Taps
    columns: Taps


def margin(step: float) -> int:
    """Returns how far around it a picture is looked at, in its pixels, where one of the result is `step` of them."""
    return _count(max(1.0, step))


def taps(start: float, step: float, count: int) -> Taps:
    """Returns the taps of `count` pixels, each `step` wide, from `start` pixels into a picture on."""
    wide = max(1.0, step)
    centre = start + (np.arange(count) + 0.5) * step - 0.5
    first = np.ceil(centre - 2.0 * wide).astype(np.int64)
    weights = cubic(np.abs(first[:, None] + np.arange(_count(wide)) - centre[:, None]) / wide)
    weights /= weights.sum(axis=1, keepdims=True)
    return Taps(first, weights.astype(np.float32))


def _count(wide: float) -> int:
    return 4 * math.ceil(wide)


def faded(part: Part, share: float) -> Part:
    """Returns a picture that counts only so much."""
    return part._replace(columns=Taps(part.columns.first, part.columns.weights * np.float32(share)))


def write_scaled(parts: tuple[Part, ...], first: int, out: np.ndarray) -> None:
    """Writes the sum of one picture or two, as their rows from `first` on have it, into `out`, uint8 (n, w, 3)."""
    sums = np.empty((THREE, out.shape[1], BESIDE), np.float32)
    for top in range(0, len(out), BESIDE):
        rows = out[top : top + BESIDE]
        sums[:] = 0.0
        for part in parts:
            columns = part.columns
            wide = int(columns.first[-1] - columns.first[0]) + columns.weights.shape[1]
            line, beside = np.empty(wide, np.float32), np.zeros((wide, BESIDE), np.float32)
            _add(part.planes, *part.rows, *columns, first + top, len(rows), line, beside, sums)
        _write(sums, rows)


@inner_uncounted
def _add_rows(planes: Array, channel: int, top: int, weights: Array, left: int, line: Array) -> None:
    """Writes the weighted sum of rows of a channel into `line`, from column `left` on."""
    wide = np.uintp(line.size)
    at = np.uintp(left)
    for k in range(0, weights.size, 4):
        a, b = planes[channel, top + k], planes[channel, top + k + 1]
        c, d = planes[channel, top + k + 2], planes[channel, top + k + 3]
        p, q, r, s = weights[k], weights[k + 1], weights[k + 2], weights[k + 3]
        if k == 0:
            for x in range(wide):
                line[x] = (p * a[at + x] + q * b[at + x]) + (r * c[at + x] + s * d[at + x])
        else:
            for x in range(wide):
                line[x] += (p * a[at + x] + q * b[at + x]) + (r * c[at + x] + s * d[at + x])


@inner_uncounted
def _add_columns(beside: Array, left: Int, first: Array, weights: Array, sums: Array) -> None:
    """Adds the weighted sums of columns, whose 16 rows lie beside one another, to `sums`, (w, 16)."""
    for i in range(first.size):
        p = np.uintp(first[i] - left)
        row = sums[i]
        for k in range(0, weights.shape[1], 4):
            w0, w1, w2, w3 = weights[i, k], weights[i, k + 1], weights[i, k + 2], weights[i, k + 3]
            a, b, c, d = beside[p + k], beside[p + k + 1], beside[p + k + 2], beside[p + k + 3]
            for r in range(BESIDE):
                row[r] += (w0 * a[r] + w1 * b[r]) + (w2 * c[r] + w3 * d[r])


@uncounted
def _add(
    planes: Array,
    rows: Array,
    down: Array,
    columns: Array,
    across: Array,
    top: Int,
    count: Int,
    line: Array,
    beside: Array,
    sums: Array,
) -> None:
    """Adds rows `top` to `top + count` of a picture to `sums`, float32 (3, w, 16)."""
    for channel in range(THREE):
        for r in range(count):
            _add_rows(planes, channel, int(rows[top + r]), down[top + r], columns[0], line)
            for x in range(line.size):
                beside[x, r] = line[x]
        _add_columns(beside, columns[0], columns, across, sums[channel])


@uncounted
def _write(sums: Array, out: Array) -> None:
    """Writes sums, float32 (3, w, 16), as rows of bytes, uint8 (n, w, 3)."""
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            for channel in range(THREE):
                out[y, x, channel] = np.uint8(min(max(sums[channel, x, y] * _BYTE + _ROUND, _LEAST), _BYTE))
