"""Kernels over complex bands, kept as their real and imaginary parts, float32 (n, pixels): how large they are and which
way they turn, beside those of their parents.

A parent is the band of the next coarser scale, brought to the finer grid; at twice its phase it turns as fast as its
child does (Portilla & Simoncelli 2000).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from engine.numeric.in_parts import in_parts
from engine.numeric.kernel import Array, dividing
from engine.numeric.sums import mean

_NEAR = 4  # coarse places that a fine one is told from, along each axis
_TINY = np.float32(1e-12)


def flat(parts: np.ndarray) -> np.ndarray:
    """Returns bands (orientations, n, h, w) one after the other: (orientations n, h, w)."""
    return parts.reshape(-1, *parts.shape[2:])


def magnitudes(real: np.ndarray, imaginary: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the magnitudes of bands, less their means, and these: float32 (n, pixels), float64 (n,)."""
    out = np.empty(real.shape, np.float32)
    _magnitudes(real, imaginary, out)
    means = mean(out, axis=1, dtype=np.float64)
    out -= means.astype(np.float32)[:, None]
    return out, means


def impose(real: np.ndarray, imaginary: np.ndarray, wanted: np.ndarray, means: np.ndarray) -> None:
    """Gives bands the magnitudes `wanted` more than `means`, none below 0; only their real parts are written."""
    _impose(real, imaginary, wanted, means.astype(np.float32))


def parents_of(real: np.ndarray, imaginary: np.ndarray, size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Returns what bands (n, h, w) are as parents on a grid of `size`: their magnitudes less the means (n, pixels), and
    real and imaginary parts at twice the phase (2 n, pixels)."""
    count = len(real)
    sizes = np.empty((count, *size), np.float32)
    turned = np.empty((2 * count, *size), np.float32)
    rows, down = _spread(real.shape[1], size[0])
    columns, across = _spread(real.shape[2], size[1])

    def some(first: int, last: int) -> None:
        part, other = slice(first, last), slice(count + first, count + last)
        given = real[part], imaginary[part], rows, down, columns, across
        _parents(*given, sizes[part], turned[part], turned[other])

    in_parts(some, count, sizes.size)
    found = sizes.reshape(count, -1)
    found -= mean(found, axis=1, dtype=np.float64).astype(np.float32)[:, None]
    return found, turned.reshape(2 * count, -1)


@lru_cache(maxsize=64)
def _spread(coarse: int, fine: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the coarse places that each fine one is told from, int32 (4, fine), and how much each counts: a cubic
    through them."""
    places = np.arange(fine) * (coarse / fine)
    first = np.floor(places).astype(np.int64)
    t = places - first
    weights = np.stack(
        [
            ((-0.5 * t + 1.0) * t - 0.5) * t,
            (1.5 * t - 2.5) * t * t + 1.0,
            ((-1.5 * t + 2.0) * t + 0.5) * t,
            (0.5 * t - 0.5) * t * t,
        ]
    )
    which = (first + np.arange(-1, _NEAR - 1)[:, None]) % coarse
    return which.astype(np.int32), weights.astype(np.float32)


@dividing
def _magnitudes(real: Array, imaginary: Array, out: Array) -> None:
    for n in range(real.shape[0]):
        a, b, into = real[n], imaginary[n], out[n]
        for i in range(into.size):
            into[i] = np.sqrt(a[i] * a[i] + b[i] * b[i])


@dividing
def _impose(real: Array, imaginary: Array, wanted: Array, means: Array) -> None:
    for n in range(real.shape[0]):
        a, b, more, middle = real[n], imaginary[n], wanted[n], means[n]
        for i in range(a.size):
            size = max(more[i] + middle, np.float32(0.0))
            a[i] *= size / (np.sqrt(a[i] * a[i] + b[i] * b[i]) + _TINY)


@dividing
def _parents(
    real: Array,
    imaginary: Array,
    rows: Array,
    down: Array,
    columns: Array,
    across: Array,
    sizes: Array,
    cosines: Array,
    sines: Array,
) -> None:
    count, height, width = sizes.shape
    a, b = np.empty(real.shape[2], np.float32), np.empty(real.shape[2], np.float32)
    c, d = np.empty(width, np.float32), np.empty(width, np.float32)
    for n in range(count):
        for y in range(height):
            _across_rows(real[n], rows[:, y], down[:, y], a)
            _across_rows(imaginary[n], rows[:, y], down[:, y], b)
            _along(a, columns, across, c)
            _along(b, columns, across, d)
            size, one, other = sizes[n, y], cosines[n, y], sines[n, y]
            for x in range(width):
                far = np.sqrt(c[x] * c[x] + d[x] * d[x]) + _TINY
                size[x] = far
                one[x] = (c[x] * c[x] - d[x] * d[x]) / far
                other[x] = np.float32(2.0) * c[x] * d[x] / far


@dividing
def _across_rows(plane: Array, rows: Array, weights: Array, out: Array) -> None:
    p, q, r, s = plane[rows[0]], plane[rows[1]], plane[rows[2]], plane[rows[3]]
    f, g, h, k = weights[0], weights[1], weights[2], weights[3]
    for x in range(out.size):
        out[x] = (p[x] * f + q[x] * g) + (r[x] * h + s[x] * k)


@dividing
def _along(line: Array, columns: Array, weights: Array, out: Array) -> None:
    f, g, h, k = weights[0], weights[1], weights[2], weights[3]
    p, q, r, s = columns[0], columns[1], columns[2], columns[3]
    for x in range(out.size):
        near = line[np.uint32(p[x])] * f[x] + line[np.uint32(q[x])] * g[x]
        out[x] = near + (line[np.uint32(r[x])] * h[x] + line[np.uint32(s[x])] * k[x])
