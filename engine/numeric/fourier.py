"""Fourier transforms of our own, of any size: the same bits on every processor.

Those of NumPy and SciPy begin with the C library's sines and cosines, and multiply complex numbers as the processor
likes best.  Here lengths are taken apart into their prime factors, 4 before 2 (Stockham's self-sorting transform),
those above 61 by Bluestein's convolution.  All in float64; lines run beside one another where there are several.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from engine.numeric.elementary import cos, mapped, sin
from engine.numeric.kernel import Array, kernel

_LARGEST = 61  # of the factors that are transformed as they stand
_AXES = (-2, -1)


def fft2(values: np.ndarray) -> np.ndarray:
    """Returns the transform along the last two axes: complex128."""
    return _along(_along(np.array(values, np.complex128), -1), -2)


def ifft2(values: np.ndarray) -> np.ndarray:
    """Returns the inverse of `fft2`: complex128."""
    found: np.ndarray = np.conj(fft2(np.conj(values)))
    height, width = found.shape[-2:]
    found.real /= height * width
    found.imag /= height * width
    return found


def _along(values: np.ndarray, axis: int) -> np.ndarray:
    """Returns complex128 `values` transformed along one axis."""
    moved = np.moveaxis(values, axis, 0)
    n, shape = len(moved), moved.shape
    real, imaginary = (np.ascontiguousarray(part.reshape(n, -1)) for part in (moved.real, moved.imag))
    out = np.empty(shape, np.complex128)
    real, imaginary = _transformed(real, imaginary)
    out.real, out.imag = real.reshape(shape), imaginary.reshape(shape)
    return np.moveaxis(out, 0, axis)


def _transformed(real: np.ndarray, imaginary: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the transforms along the first axis of float64 (n, lines), in two parts; they may be written over."""
    n = len(real)
    factors = factors_of(n)
    if factors.size and factors.max() > _LARGEST:
        return _by_convolution(real, imaginary)
    other = np.empty_like(real), np.empty_like(imaginary)
    _steps(real, imaginary, *other, factors, *waves_of(n))
    return other if factors.size % 2 else (real, imaginary)


@lru_cache(maxsize=64)
def factors_of(n: int) -> np.ndarray:
    """Returns the factors of n, 4 before 2: int64."""
    found, p = [], 4
    while n > 1:
        while n % p == 0:
            found.append(p)
            n //= p
        p = {4: 2, 2: 3}.get(p, p + 2)
        if p * p > n > p:
            p = n
    return np.array(found, np.int64)


@lru_cache(maxsize=16)
def waves_of(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns cos and -sin of 2 pi k / n for k = 0, ..., n - 1: exact where they are 0, 1/2 or 1."""
    k = np.arange(n)
    eighth = (8 * k + n) // (2 * n)  # the nearest quarter turn
    angle = (4 * k - n * eighth) * (math.pi / (2 * n))
    c, s = mapped(cos, angle), mapped(sin, angle)
    turned = [(c, s), (-s, c), (-c, -s), (s, -c)]
    real, imaginary = (np.choose(eighth % 4, [pair[i] for pair in turned]) for i in (0, 1))
    imaginary = -imaginary
    real.flags.writeable = imaginary.flags.writeable = False
    return real, imaginary


@lru_cache(maxsize=16)
def chirp_of(n: int) -> tuple[np.ndarray, ...]:
    """Returns e^(-i pi k^2 / n), as two parts (n,), and the transform of its conjugate, laid around a circle of a power
    of two."""
    k = np.arange(n)
    real, imaginary = (wave[k * k % (2 * n)] for wave in waves_of(2 * n))
    size = 1 << (2 * n - 1).bit_length()
    around = np.zeros((2, size, 1))
    around[0, :n, 0], around[1, :n, 0] = real, -imaginary
    around[:, size - n + 1 :] = around[:, n - 1 : 0 : -1]
    return real, imaginary, *_transformed(around[0], around[1])


def _by_convolution(real: np.ndarray, imaginary: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """As `_transformed`, for lengths with large prime factors (Bluestein 1970)."""
    n = len(real)
    c, s, around, across = (part.reshape(-1, 1) for part in chirp_of(n))
    given = np.zeros((2, len(around), real.shape[1]))
    given[0, :n], given[1, :n] = real * c - imaginary * s, real * s + imaginary * c
    a, b = _transformed(given[0], given[1])
    # The inverse transform is the conjugate of the transform of the conjugate.
    a, b = _transformed(a * around - b * across, -(a * across + b * around))
    a, b = a[:n] / len(around), -b[:n] / len(around)
    return a * c - b * s, a * s + b * c


@kernel
def _steps(x: Array, y: Array, u: Array, v: Array, factors: Array, cosines: Array, sines: Array) -> None:
    """Transforms x + iy, float64 (n, lines), with u + iv for room: what comes out is in that, or in x + iy, by the
    number of factors."""
    n, lines = x.shape
    left, stride = n, 1
    sums = np.empty((2, _LARGEST, lines))
    for r in factors:
        left //= r
        for p in range(left):
            for q in range(stride):
                for j in range(r):
                    _part(x, y, sums, (q + stride * p, stride * left, j, r), cosines, sines)
                for j in range(r):
                    turn = p * j * stride
                    c, s = cosines[turn], sines[turn]
                    a, b = sums[0, j], sums[1, j]
                    to = q + stride * (r * p + j)
                    at, bt = u[to], v[to]
                    for i in range(lines):
                        at[i] = a[i] * c - b[i] * s
                        bt[i] = a[i] * s + b[i] * c
        x, y, u, v = u, v, x, y
        stride *= r


@kernel
def _part(x: Array, y: Array, sums: Array, where: tuple[int, int, int, int], cosines: Array, sines: Array) -> None:
    """Writes number j of the transform of r lines, the first at `start` and `apart` from one another."""
    start, apart, j, r = where
    n = len(cosines)
    a, b = sums[0, j], sums[1, j]
    a[:], b[:] = x[start], y[start]
    for k in range(1, r):
        turn = j * k % r * (n // r)
        c, s = cosines[turn], sines[turn]
        f, g = x[start + k * apart], y[start + k * apart]
        if s == 0.0:
            for i in range(a.size):
                a[i] += f[i] * c
                b[i] += g[i] * c
        elif c == 0.0:
            for i in range(a.size):
                a[i] -= g[i] * s
                b[i] += f[i] * s
        else:
            for i in range(a.size):
                a[i] += f[i] * c - g[i] * s
                b[i] += f[i] * s + g[i] * c
