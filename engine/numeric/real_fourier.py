"""Fourier transforms of real pictures, in float32: the same bits on every processor.

Lines are transformed sixteen beside one another (`butterflies`), rows two as the parts of one complex line.  Lengths
are taken apart as in `fourier`, those with a factor above _DIRECT by a convolution.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from engine.numeric import fourier
from engine.numeric.butterflies import (
    IN_REGISTERS,
    LANES,
    joined,
    of_five,
    of_four,
    of_three,
    of_two,
    paired,
    parted,
    split,
    turn_over,
)
from engine.numeric.in_parts import in_parts
from engine.numeric.kernel import Array, Int, inner, kernel

_DIRECT = 31  # of the factors that are transformed as they stand
_PARTS = 2 * LANES  # floats of a block's row


def rfft2(images: np.ndarray) -> np.ndarray:
    """Returns half of the spectrum of real pictures (..., h, w): complex64 (..., h, w//2 + 1)."""
    given = np.ascontiguousarray(images, np.float32)
    *leading, height, width = given.shape
    half = np.empty((*leading, height, width // 2 + 1), np.complex64)
    floats = half.view(np.float32).reshape(-1, height, 2 * half.shape[-1])
    pictures, across, down = given.reshape(-1, height, width), _plan(width), _plan(height)

    def some(first: int, last: int) -> None:
        _rows(pictures[first:last], floats[first:last], *across)
        _columns(floats[first:last], False, *down)

    in_parts(some, len(pictures), given.size)
    return half


def irfft2(half: np.ndarray, size: tuple[int, int], spent: bool = False) -> np.ndarray:
    """Returns the pictures (..., *size) of half a spectrum: float32.  `spent`: the spectrum may be written over."""
    floats = np.array(half, copy=None if spent else True, order="C").view(np.float32)
    floats = floats.reshape(-1, size[0], floats.shape[-1])
    out = np.empty((*half.shape[:-2], *size), np.float32)
    pictures, down, across = out.reshape(-1, *size), _plan(size[0]), _plan(size[1])

    def some(first: int, last: int) -> None:
        _columns(floats[first:last], True, *down)
        _rows_back(floats[first:last], pictures[first:last], np.float32(1.0 / (size[0] * size[1])), *across)

    in_parts(some, len(pictures), out.size)
    return out


def fast_length(n: int) -> int:
    """Returns the smallest length from `n` on that has no factors but 2, 3 and 5."""
    while any(p > IN_REGISTERS for p in fourier.factors_of(n)):
        n += 1
    return n


@lru_cache(maxsize=32)
def _plan(n: int) -> tuple[np.ndarray, ...]:
    """Returns what lines of a length are transformed with, all but the first as float32, two for a complex number: the
    factors, int64, and the waves of that length.  Or, where a factor is above _DIRECT, those of the convolution that
    does it, the chirp (n), and the transform of its conjugate, scaled."""
    factors, chirp, around = fourier.factors_of(n), np.zeros((0, 2)), np.zeros((0, 2))
    size = n
    if max(factors, default=1) > _DIRECT:
        real, imaginary, *parts = fourier.chirp_of(n)
        chirp, around = np.stack([real, imaginary], axis=-1), np.concatenate(parts, axis=-1)
        size = len(around)
        factors, around = fourier.factors_of(size), around / size
    waves = np.stack(fourier.waves_of(size), axis=-1)
    return factors, *(_flat(pairs) for pairs in (waves, chirp, around))


def _flat(pairs: np.ndarray) -> np.ndarray:
    out = pairs.astype(np.float32).reshape(-1)
    out.flags.writeable = False
    return out


@kernel
def _rows(images: Array, half: Array, factors: Array, waves: Array, chirp: Array, around: Array) -> None:
    """half (n, h, 2c) = the lower half of the spectra of rows (n, h, w), pairs being complex numbers."""
    width, pairs = images.shape[2], (images.shape[1] + 1) // 2
    wide, complete = _rounded(width), _rounded(half.shape[2])
    given, made = np.zeros(_PARTS * wide, np.float32), np.empty(_PARTS * complete, np.float32)
    x, u = _room(wide, waves), _room(wide, waves)
    z = np.empty(_PARTS * complete, np.float32)
    second = LANES * complete
    for first in range(0, images.shape[0] * pairs, LANES):
        count = min(LANES, images.shape[0] * pairs - first)
        _gathered(images, first, count, given, wide)
        for part in range(2):
            for k in range(0, width, LANES):
                turn_over(given, part * wide + k, 2 * wide, x, _PARTS * k + LANES * part, _PARTS)
        found = _transformed(x, u, factors, waves, chirp, around)
        for k in range(width // 2 + 1):
            split(found, _PARTS * k, _PARTS * ((width - k) % width), z, _PARTS * k, second + _PARTS * k)
        for part in range(2):
            for k in range(0, complete, LANES):
                turn_over(z, part * second + LANES * k, LANES, made, part * complete + k, 2 * complete)
        _scattered(made, complete, first, count, half, np.float32(1.0))


@kernel
def _rows_back(
    half: Array, out: Array, scale: np.float32, factors: Array, waves: Array, chirp: Array, around: Array
) -> None:
    """out (n, h, w) = the rows whose half spectra are (n, h, 2c), times `scale`."""
    width, pairs = out.shape[2], (out.shape[1] + 1) // 2
    wide, complete = _rounded(width), _rounded(half.shape[2])
    given, made = np.zeros(_PARTS * complete, np.float32), np.empty(_PARTS * wide, np.float32)
    x, u = _room(wide, waves), _room(wide, waves)
    z = np.empty(_PARTS * complete, np.float32)
    second = LANES * complete
    for first in range(0, out.shape[0] * pairs, LANES):
        count = min(LANES, out.shape[0] * pairs - first)
        _gathered(half, first, count, given, complete)
        for n in range(2 * count):  # of a real line the lowest frequency is real, and so is the highest
            given[n * complete + 1] = np.float32(0.0)
            if width % 2 == 0:
                given[n * complete + width + 1] = np.float32(0.0)
        for part in range(2):
            for k in range(0, complete, LANES):
                turn_over(given, part * complete + k, 2 * complete, z, part * second + LANES * k, LANES)
        for k in range(width // 2 + 1):
            joined(z, _PARTS * k, second + _PARTS * k, x, _PARTS * k, _PARTS * ((width - k) % width))
        found = _transformed(x, u, factors, waves, chirp, around)
        for part in range(2):
            for k in range(0, width, LANES):
                turn_over(found, _PARTS * k + LANES * (1 - part), _PARTS, made, part * wide + k, 2 * wide)
        _scattered(made, wide, first, count, out, scale)


@inner
def _gathered(rows: Array, first: Int, count: Int, given: Array, wide: Int) -> None:
    """Lays pairs of rows (n, h, w) of one picture one below the other, each `wide`; what has no other is paired with
    nothing, so that pictures do not hang on one another."""
    height, width = rows.shape[1:]
    pairs = (height + 1) // 2
    for n in range(2 * count):
        pair, line = first + (n >> 1), given[n * wide : n * wide + width]
        row = 2 * (pair % pairs) + (n & 1)
        if row < height:
            line[:] = rows[pair // pairs, row]
        else:
            line[:] = np.float32(0.0)


@inner
def _scattered(made: Array, wide: Int, first: Int, count: Int, rows: Array, scale: np.float32) -> None:
    """Puts such rows back in their places, times `scale`."""
    height, width = rows.shape[1:]
    pairs = (height + 1) // 2
    for n in range(2 * count):
        pair, line = first + (n >> 1), made[n * wide : n * wide + width]
        row = 2 * (pair % pairs) + (n & 1)
        if row < height:
            out = rows[pair // pairs, row]
            for k in range(width):
                out[k] = line[k] * scale


@inner
def _rounded(n: Int) -> Int:
    """Returns how long rows are laid that are turned over: not by a power of two, which would crowd the cache."""
    return ((n + LANES - 1) // LANES | 1) * LANES


@kernel
def _columns(whole: Array, back: bool, factors: Array, waves: Array, chirp: Array, around: Array) -> None:
    """Transforms whole (n, h, 2c) in place down the columns, pairs being complex numbers."""
    height, width = whole.shape[1:]
    flat = whole.reshape(-1)
    x, u = _room(height, waves), _room(height, waves)
    real = LANES if back else 0  # changed over, the transform is the inverse
    for n in range(whole.shape[0]):
        for first in range(0, width, _PARTS):
            at = n * height * width + first
            if first + _PARTS <= width:
                for y in range(height):
                    parted(flat, at + y * width, x, _PARTS * y + real, _PARTS * y + LANES - real)
                found = _transformed(x, u, factors, waves, chirp, around)
                for y in range(height):
                    paired(found, _PARTS * y + real, _PARTS * y + LANES - real, flat, at + y * width)
                continue
            lanes = (width - first) // 2
            for k in range(height * _PARTS):
                x[k] = np.float32(0.0)
            for y in range(height):
                for i in range(2 * lanes):
                    x[_PARTS * y + (i >> 1) + (real if i & 1 == 0 else LANES - real)] = flat[at + y * width + i]
            found = _transformed(x, u, factors, waves, chirp, around)
            for y in range(height):
                for i in range(2 * lanes):
                    flat[at + y * width + i] = found[_PARTS * y + (i >> 1) + (real if i & 1 == 0 else LANES - real)]


@inner
def _room(count: Int, waves: Array) -> Array:
    return np.empty(_PARTS * max(count, waves.size // 2), np.float32)


@inner
def _transformed(x: Array, u: Array, factors: Array, waves: Array, chirp: Array, around: Array) -> Array:
    """Returns the transform of a block, which is x or u; both are written over.  By convolution (Bluestein 1970), if
    there is a chirp."""
    if chirp.size == 0:
        return _stepped(x, u, factors, waves)
    x[_PARTS * (chirp.size // 2) : _PARTS * (around.size // 2)] = np.float32(0.0)
    _multiply(x, chirp, np.float32(1.0))
    found = _stepped(x, u, factors, waves)
    other = u if factors.size % 2 == 0 else x
    _multiply(found, around, np.float32(-1.0))  # the transform of the conjugate is the conjugate of the inverse
    made = _stepped(found, other, factors, waves)
    for i in range(_PARTS * (chirp.size // 2)):
        made[i] = made[i] if i % _PARTS < LANES else -made[i]
    _multiply(made, chirp, np.float32(1.0))
    return made


@inner
def _multiply(x: Array, by: Array, sign: np.float32) -> None:
    """Multiplies the first numbers of a block by complex ones; their imaginary parts by `sign`, besides."""
    for k in range(by.size // 2):
        c, s = by[2 * k], by[2 * k + 1]
        row = x[_PARTS * k : _PARTS * (k + 1)]
        for i in range(LANES):
            a, b = row[i], row[LANES + i]
            row[i] = a * c - b * s
            row[LANES + i] = sign * (a * s + b * c)


@inner
def _stepped(x: Array, u: Array, factors: Array, waves: Array) -> Array:
    """Returns the transform of a block of as many numbers as there are waves."""
    left, stride = waves.size // 2, np.int64(1)  # a constant would have what takes it compiled for that, too
    for r in factors:
        left //= r
        if r > IN_REGISTERS:
            _of_many(x, u, r, left, stride, waves)
        else:
            _step(x, u, r, left, stride, waves)
        x, u = u, x
        stride *= r
    return x


@inner
def _step(x: Array, u: Array, r: Int, left: Int, stride: Int, waves: Array) -> None:
    apart = left * stride
    for p in range(left):
        turn, first, to = p * stride, p * stride, p * stride * r
        if r == 4:
            for q in range(stride):
                of_four(x, first + q, apart, u, to + q, stride, waves, turn)
        elif r == 2:
            for q in range(stride):
                of_two(x, first + q, apart, u, to + q, stride, waves, turn)
        elif r == 3:
            for q in range(stride):
                of_three(x, first + q, apart, u, to + q, stride, waves, turn)
        else:
            for q in range(stride):
                of_five(x, first + q, apart, u, to + q, stride, waves, turn)


@inner
def _of_many(x: Array, u: Array, r: Int, left: Int, stride: Int, waves: Array) -> None:
    """As the butterflies, of any number of numbers."""
    n = waves.size // 2
    sums = np.empty(_PARTS, np.float32)
    for p in range(left):
        for q in range(stride):
            for j in range(r):
                sums[:] = np.float32(0.0)
                for k in range(r):
                    turn = 2 * (j * k % r * (n // r))
                    c, s = waves[turn], waves[turn + 1]
                    at = _PARTS * (q + stride * (p + left * k))
                    for i in range(LANES):
                        a, b = x[at + i], x[at + LANES + i]
                        sums[i] += a * c - b * s
                        sums[LANES + i] += a * s + b * c
                turn, to = 2 * p * j * stride, _PARTS * (q + stride * (r * p + j))
                c, s = waves[turn], waves[turn + 1]
                for i in range(LANES):
                    a, b = sums[i], sums[LANES + i]
                    u[to + i] = a * c - b * s
                    u[to + LANES + i] = a * s + b * c
