"""Pictures at other scales and between their pixels, by cubic convolution (Keys 1981, a = -1/2).

Where a picture shrinks the filter is as wide as it shrinks.  Rows come first, whole vectors of them; then columns, of
16 rows at once, which lie beside one another for that.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from engine.numeric.kernel import Array, Int, inlined, inner_uncounted, uncounted
from engine.numeric.resample import cubic

BESIDE = 16  # rows worked on at once
THREE = 3
_STRETCH = 128  # columns
_BYTE = np.float32(255.0)
_ROUND = np.float32(0.5)
_LEAST = np.float32(0.0)


class Taps(NamedTuple):
    """Which pixels along an axis make each of the result: the first of them, int64 (n,), and what each counts, float32
    (n, taps), 1 in all.  There are four taps or eight."""

    first: np.ndarray
    weights: np.ndarray


class Part(NamedTuple):
    """A picture, uint8 (3, h, w), and the taps by which it is seen."""

    planes: np.ndarray
    rows: Taps
    columns: Taps


def margin(step: float) -> int:
    """Returns how far around it a picture is looked at, in its pixels, where one of the result is `step` of them."""
    return _count(max(1.0, step))


def taps(start: float, step: float, count: int) -> Taps:
    """Returns the taps of `count` pixels, each `step` wide, at most 2, from `start` pixels into a picture on."""
    if step > 2.0:
        raise ValueError(f"taps: found pixels of {step}, expected at most 2")
    wide = max(1.0, step)
    centre = start + (np.arange(count) + 0.5) * step - 0.5
    first = np.ceil(centre - 2.0 * wide).astype(np.int64)
    weights = cubic(np.abs(first[:, None] + np.arange(_count(wide)) - centre[:, None]) / wide)
    weights /= weights.sum(axis=1, keepdims=True)
    return Taps(first, weights.astype(np.float32))


def _count(wide: float) -> int:
    return 4 * math.ceil(wide)


@inlined
def _of(byte: np.uint8) -> np.float32:
    return np.float32(byte)


def faded(part: Part, share: float) -> Part:
    """Returns a picture that counts only so much."""
    return part._replace(columns=Taps(part.columns.first, part.columns.weights * np.float32(share)))


def write_scaled(parts: tuple[Part, ...], first: int, out: np.ndarray) -> None:
    """Writes the sum of one picture or two, as their rows from `first` on have it, into `out`, uint8 (n, w, 3)."""
    sums = np.empty((THREE, out.shape[1], BESIDE), np.float32)
    rooms = [np.zeros((_STRETCH // BESIDE + _width(part.columns), BESIDE), np.float32) for part in parts]
    for top in range(0, len(out), BESIDE):
        rows = out[top : top + BESIDE]
        sums[:] = 0.0
        for part, room in zip(parts, rooms, strict=True):
            _add(part.planes, *part.rows, *part.columns, first + top, len(rows), room, sums)
        _write(sums, rows)


def _width(columns: Taps) -> int:
    """Returns how many columns of a picture are seen."""
    return int(columns.first[-1] - columns.first[0] + columns.weights.shape[1])


@inner_uncounted
def _add_rows(planes: Array, channel: int, top: int, weights: Array, left: int, line: Array, wide: int) -> None:
    """Writes the weighted sum of rows of a channel into `line`, `wide` columns from `left` on."""
    at, count = np.uintp(left), np.uintp(wide)
    a, b, c, d = planes[channel, top], planes[channel, top + 1], planes[channel, top + 2], planes[channel, top + 3]
    p, q, r, s = weights[0], weights[1], weights[2], weights[3]
    if weights.size == 4:
        for x in range(count):
            line[x] = (p * _of(a[at + x]) + q * _of(b[at + x])) + (r * _of(c[at + x]) + s * _of(d[at + x]))
    else:
        e, f, g, h = (
            planes[channel, top + 4],
            planes[channel, top + 5],
            planes[channel, top + 6],
            planes[channel, top + 7],
        )
        t, u, v, w = weights[4], weights[5], weights[6], weights[7]
        for x in range(count):
            line[x] = ((p * _of(a[at + x]) + q * _of(b[at + x])) + (r * _of(c[at + x]) + s * _of(d[at + x]))) + (
                (t * _of(e[at + x]) + u * _of(f[at + x])) + (v * _of(g[at + x]) + w * _of(h[at + x]))
            )


@inner_uncounted
def _add_columns(beside: Array, left: Int, first: Array, weights: Array, sums: Array) -> None:
    """Adds the weighted sums of columns, whose 16 rows lie beside one another, to `sums`, (w, 16)."""
    for i in range(first.size):
        p = np.uintp(first[i] - left)
        row = sums[i]
        w0, w1, w2, w3 = weights[i, 0], weights[i, 1], weights[i, 2], weights[i, 3]
        a, b, c, d = beside[p], beside[p + 1], beside[p + 2], beside[p + 3]
        if weights.shape[1] == 4:
            for r in range(BESIDE):
                row[r] += (w0 * a[r] + w1 * b[r]) + (w2 * c[r] + w3 * d[r])
        else:
            w4, w5, w6, w7 = weights[i, 4], weights[i, 5], weights[i, 6], weights[i, 7]
            e, f, g, h = beside[p + 4], beside[p + 5], beside[p + 6], beside[p + 7]
            for r in range(BESIDE):
                row[r] += ((w0 * a[r] + w1 * b[r]) + (w2 * c[r] + w3 * d[r])) + (
                    (w4 * e[r] + w5 * f[r]) + (w6 * g[r] + w7 * h[r])
                )


@uncounted
def _add(
    planes: Array,
    rows: Array,
    down: Array,
    columns: Array,
    across: Array,
    top: Int,
    count: Int,
    room: Array,
    sums: Array,
) -> None:
    """Adds rows `top` to `top + count` of a picture to `sums`, float32 (3, w, 16).  `room`: float32 (8 + n, 16), for a
    stretch of columns, so short that what its rows are made of stays at hand, and for the n columns that are seen."""
    beside, line = room[_STRETCH // BESIDE :], room[: _STRETCH // BESIDE].reshape(_STRETCH)
    left = int(columns[0])
    for channel in range(THREE):
        for start in range(0, beside.shape[0], _STRETCH):
            wide = min(_STRETCH, beside.shape[0] - start)
            for r in range(count):
                _add_rows(planes, channel, int(rows[top + r]), down[top + r], left + start, line, wide)
                for x in range(wide):
                    beside[start + x, r] = line[x]
        _add_columns(beside, left, columns, across, sums[channel])


@uncounted
def _write(sums: Array, out: Array) -> None:
    """Writes sums, float32 (3, w, 16), as rows of bytes, uint8 (n, w, 3)."""
    for x in range(out.shape[1]):
        for channel in range(THREE):
            for y in range(out.shape[0]):
                out[y, x, channel] = np.uint8(min(max(sums[channel, x, y] + _ROUND, _LEAST), _BYTE))
