"""The Laplacian pyramid in any number of dimensions (Burt & Adelson 1983; Heeger & Bergen 1995, section 3.1).

Reduce smooths by (1, 4, 6, 4, 1)/16 along each axis and keeps every second sample, the first among them; expand puts
zeros between samples and smooths again.  An axis of n samples becomes (n + 1) // 2; n may be anything from 1.  Both
round to the grid of 2^-16, so that what is taken apart there goes together again exactly.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from engine.numeric.grid import Q
from engine.numeric.kernel import kernel

Edges = Literal["circular", "reflected"]  # what lies beyond: the other end, or the mirror image about the last sample

_STEPS = np.float32(1.0 / Q)
_STEP = np.float32(Q)


def most_levels(size: Sequence[int]) -> int:
    """Tells how many levels pictures of `size` have room for: the rest is 4 samples or more along its shortest axis."""
    return max(0, int(max(min(size), 1)).bit_length() - 3)


def reduce(images: np.ndarray, dimensions: int = 2, edges: Edges = "circular") -> np.ndarray:
    """Half as many samples along each of the last `dimensions` axes: float32, on the 2^-16 grid."""
    out = np.ascontiguousarray(images, np.float32)
    for axis in range(out.ndim - dimensions, out.ndim):
        n = out.shape[axis]
        shape = (*out.shape[:axis], (n + 1) // 2, *out.shape[axis + 1 :])
        smaller = np.empty(shape, np.float32)
        taps = _beyond(2 * np.arange(shape[axis])[:, None] + np.arange(-2, 3), n, edges)
        if axis == out.ndim - 1:
            _reduce_last(out.reshape(-1, n), taps, smaller.reshape(-1, shape[axis]))
        else:
            _reduce(_about(out, axis), taps, _about(smaller, axis))
        out = smaller
    return out


def expand(images: np.ndarray, size: Sequence[int], edges: Edges = "circular") -> np.ndarray:
    """Twice as many samples along each of the last axes, to the `size` that was reduced: float32, on the 2^-16 grid."""
    out = np.zeros((*images.shape[: images.ndim - len(size)], *size), np.float32)
    _add_expanded(out, images, len(size), edges, np.float32(1.0))
    return out


def build(images: np.ndarray, levels: int, dimensions: int = 2, edges: Edges = "circular") -> list[np.ndarray]:
    """Returns the bands of pictures (..., *size), from the finest, and the low-pass rest: `levels` + 1 arrays,
    float32."""
    size = images.shape[images.ndim - dimensions :]
    if not 0 <= levels <= most_levels(size):
        raise ValueError(f"laplacian pyramid: found {levels} levels for {' x '.join(map(str, size))}")
    bands = []
    rest = np.ascontiguousarray(images, np.float32)
    for _ in range(levels):
        low = reduce(rest, dimensions, edges)
        band = rest.copy()
        _add_expanded(band, low, dimensions, edges, np.float32(-1.0))
        bands.append(band)
        rest = low
    return [*bands, rest if levels else rest.copy()]


def collapse(pyramid: Sequence[np.ndarray], dimensions: int = 2, edges: Edges = "circular") -> np.ndarray:
    """Returns the pictures again.  Of an untouched pyramid, bit for bit, where they lay on the grid of 2^-16, |v| <=
    16."""
    out = pyramid[-1]
    for band in pyramid[-2::-1]:
        finer = band.copy()
        _add_expanded(finer, out, dimensions, edges, np.float32(1.0))
        out = finer
    return out


def _beyond(places: np.ndarray, n: int, edges: Edges) -> np.ndarray:
    """Tells where the samples at `places` of an axis of n are found."""
    if edges == "circular":
        return places % n
    turned = places % max(2 * n - 2, 1)
    out: np.ndarray = np.minimum(turned, np.maximum(2 * n - 2 - turned, 0))
    return out


def _about(values: np.ndarray, axis: int) -> np.ndarray:
    """Returns a view (before, n, after) of an array, n being the length of `axis`."""
    return values.reshape(math.prod(values.shape[:axis]), values.shape[axis], -1)


def _add_expanded(out: np.ndarray, low: np.ndarray, dimensions: int, edges: Edges, sign: np.float32) -> None:
    """out (..., *size) += sign times `low` expanded, which is rounded to the grid: what is taken from values on the
    grid and given back leaves no trace."""
    grown = np.ascontiguousarray(low, np.float32)
    for axis in range(out.ndim - dimensions, out.ndim):
        n, m = out.shape[axis], grown.shape[axis]
        # A sample of the smaller axis lies at every second place of the larger one, which ends go round at even n.
        length = n + n % 2 if edges == "circular" else n
        around = _beyond(2 * np.arange(m)[:, None] + np.array([-2, 0, 2]), length, edges) // 2
        if axis == out.ndim - 1:
            _expand_last(grown.reshape(-1, m), around, out.reshape(-1, n), sign)
        else:
            larger = np.empty((*grown.shape[:axis], n, *grown.shape[axis + 1 :]), np.float32)
            _expand(_about(grown, axis), around, _about(larger, axis))
            grown = larger


@kernel
def _reduce(x: np.ndarray, taps: np.ndarray, out: np.ndarray) -> None:
    """out (b, m, c) from x (b, n, c) along the middle axis; taps (m, 5) places in it."""
    outer, middle, inner = np.float32(1.0 / 16.0), np.float32(6.0 / 16.0), np.float32(4.0 / 16.0)
    for b in range(out.shape[0]):
        for j in range(out.shape[1]):
            first, second, third = x[b, taps[j, 0]], x[b, taps[j, 1]], x[b, taps[j, 2]]
            fourth, fifth, row = x[b, taps[j, 3]], x[b, taps[j, 4]], out[b, j]
            for i in range(row.size):
                sides = (first[i] + fifth[i]) * outer + (second[i] + fourth[i]) * inner
                row[i] = sides + third[i] * middle


@kernel
def _reduce_last(x: np.ndarray, taps: np.ndarray, out: np.ndarray) -> None:
    """out (b, m) from x (b, n), as `_reduce`, rounded to the grid."""
    outer, middle, inner = np.float32(1.0 / 16.0), np.float32(6.0 / 16.0), np.float32(4.0 / 16.0)
    m, n = out.shape[1], x.shape[1]
    within = max(1, (n - 1) // 2)  # from here on taps reach beyond the end
    for b in range(out.shape[0]):
        line, row = x[b], out[b]
        for j in range(1, within):
            i = np.uint64(2 * j)
            sides = (line[i - np.uint64(2)] + line[i + np.uint64(2)]) * outer
            value = sides + (line[i - np.uint64(1)] + line[i + np.uint64(1)]) * inner + line[i] * middle
            row[np.uint64(j)] = np.rint(value * _STEPS) * _STEP
        for j in range(m):
            if j == 0 or j >= within:
                sides = (line[taps[j, 0]] + line[taps[j, 4]]) * outer
                value = sides + (line[taps[j, 1]] + line[taps[j, 3]]) * inner + line[taps[j, 2]] * middle
                row[j] = np.rint(value * _STEPS) * _STEP


@kernel
def _expand(x: np.ndarray, around: np.ndarray, out: np.ndarray) -> None:
    """out (b, n, c) from x (b, m, c) along the middle axis; around (m, 3): the samples before, at and after."""
    side, middle, half = np.float32(1.0 / 8.0), np.float32(6.0 / 8.0), np.float32(0.5)
    for b in range(out.shape[0]):
        for j in range(x.shape[1]):
            before, here, after = x[b, around[j, 0]], x[b, j], x[b, around[j, 2]]
            even = out[b, 2 * j]
            for i in range(even.size):
                even[i] = (before[i] + after[i]) * side + here[i] * middle
            if 2 * j + 1 < out.shape[1]:
                odd = out[b, 2 * j + 1]
                for i in range(odd.size):
                    odd[i] = (here[i] + after[i]) * half


@kernel
def _expand_last(x: np.ndarray, around: np.ndarray, out: np.ndarray, sign: np.float32) -> None:
    """out (b, n) += sign times x (b, m) expanded and rounded to the grid."""
    side, middle, half = np.float32(1.0 / 8.0), np.float32(6.0 / 8.0), np.float32(0.5)
    m, n = x.shape[1], out.shape[1]
    for b in range(out.shape[0]):
        line, row = x[b], out[b]
        for j in range(m):
            inside = 0 < j < m - 1
            before = line[j - 1] if inside else line[around[j, 0]]
            after = line[j + 1] if inside else line[around[j, 2]]
            even = (before + after) * side + line[j] * middle
            row[2 * j] += sign * (np.rint(even * _STEPS) * _STEP)
            if 2 * j + 1 < n:
                odd = (line[j] + after) * half
                row[2 * j + 1] += sign * (np.rint(odd * _STEPS) * _STEP)
