"""An octave finer than a picture, by maps: a function of the picture about each pixel, and of noise by its place.

Whatever the maps say, the mean of four finer pixels is the pixel that they lie in.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.hashing import mix64
from engine.numeric.kernel import Array, inner, kernel
from engine.texture.learnt.kinds import LOOKED_ROUND, kinds_of, liveliness
from engine.texture.learnt.maps import NOISY, TAPPED, Maps

_LOW = np.uint64((1 << 21) - 1)
_HALF = np.float32((1 << 20) - 0.5)
_SPREAD = np.float32(3.0**0.5 / (1 << 20))  # evenly spread numbers of 21 bits to variance 1
_NEXT = np.uint64(0x9E3779B97F4A7C15)


def refined(planes: np.ndarray, hashes: np.ndarray, maps: Maps, octave: int) -> np.ndarray:
    """Returns the finer pixels of planes (C, h + 4, w + 4): float32 (C, 2 h, 2 w), kept within 0..1, colours below
    alpha.  `hashes`: of the places, uint64 (h + 2, w + 2); `octave`: 0 or 1, how many were added before."""
    along = along_axes(planes, maps.axes)
    _, height, width = planes.shape
    out = np.empty((len(planes), 2 * (height - 2 * LOOKED_ROUND), 2 * (width - 2 * LOOKED_ROUND)), np.float32)
    if not len(along):
        out[:] = np.repeat(
            np.repeat(planes[:, LOOKED_ROUND:-LOOKED_ROUND, LOOKED_ROUND:-LOOKED_ROUND], 2, axis=1), 2, axis=2
        )
        return out
    kinds, steep = kinds_of(along[0], maps.edges)
    lively = liveliness(steep, maps.edges)
    noise = np.empty((len(along), *hashes.shape, 3), np.float32)
    _refine(planes, along, kinds, lively, hashes, maps.axes, maps.sharp, maps.rough, maps.loud[octave], noise, out)
    return out


def along_axes(planes: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Returns planes (C, h, w) along axes (R, C): float32 (R, h, w)."""
    out = np.zeros((len(axes), *planes.shape[1:]), np.float32)
    for own, axis in zip(out, axes, strict=True):
        for plane, part in zip(planes, axis, strict=True):
            own += plane * part
    return out


@kernel
def _refine(
    planes: Array,
    along: Array,
    kinds: Array,
    lively: Array,
    hashes: Array,
    axes: Array,
    sharp: Array,
    rough: Array,
    loud: np.float32,
    noise: Array,
    out: Array,
) -> None:
    count, channels = axes.shape
    height, width = kinds.shape
    _fill_noise(hashes, loud, noise)
    found, told = np.empty((2, 4), np.float32), np.empty((channels, 4), np.float32)
    for y in range(height):
        for x in range(width):
            kind = kinds[y, x]
            for c in range(channels):
                told[c, 0] = planes[c, y + LOOKED_ROUND, x + LOOKED_ROUND]
                told[c, 1:] = np.float32(0.0)
            for r in range(count):
                _differences(along[r], noise[r], sharp[kind, r], rough[kind, r], lively[y, x], y, x, found)
                for c in range(channels):
                    for n in range(3):
                        seen = found[0, n] if c == 3 else found[0, n] + found[1, n]  # an outline does not fray
                        told[c, n + 1] += axes[r, c] * seen
            _put(told, out, 2 * y, 2 * x)


@inner
def _fill_noise(hashes: Array, loud: np.float32, noise: Array) -> None:
    scale = loud * _SPREAD
    for r in range(noise.shape[0]):
        own = noise[r]
        for y in range(hashes.shape[0]):
            for x in range(hashes.shape[1]):
                h = mix64(hashes[y, x] + _NEXT * np.uint64(r + 1))
                for n in range(3):
                    own[y, x, n] = (np.float32((h >> np.uint64(21 * n)) & _LOW) - _HALF) * scale


@inner
def _differences(
    plane: Array, noise: Array, sharp: Array, rough: Array, lively: np.float32, y: int, x: int, out: Array
) -> None:
    """Writes what the finer pixels of one differ by, along one axis of colour: as is foretold, and by noise."""
    middle = plane[y + LOOKED_ROUND, x + LOOKED_ROUND]
    a = b = c = d = np.float32(0.0)
    for j in range(TAPPED):
        row = plane[y + j, x : x + TAPPED]
        for i in range(TAPPED):
            value, parts = row[i] - middle, sharp[TAPPED * j + i]
            a += value * parts[0]
            b += value * parts[1]
            c += value * parts[2]
            d += value * parts[3]
    out[0, 0], out[0, 1], out[0, 2], out[0, 3] = a, b, c, d
    a = b = c = d = np.float32(0.0)
    for j in range(3):
        random = noise[y + j, x : x + 3].reshape(-1)
        for i in range(NOISY):
            value, parts = random[i] * lively, rough[NOISY * j + i]
            a += value * parts[0]
            b += value * parts[1]
            c += value * parts[2]
            d += value * parts[3]
    out[1, 0], out[1, 1], out[1, 2], out[1, 3] = a, b, c, d


@inner
def _put(told: Array, out: Array, y: int, x: int) -> None:
    """Writes four pixels, alpha before the colours that it limits."""
    channels = told.shape[0]
    for j in range(2):
        for i in range(2):
            down, across = np.float32(1 - 2 * j), np.float32(1 - 2 * i)
            most = np.float32(1.0)
            for n in range(channels):
                c = channels - 1 - n
                s, p, q, r = told[c, 0], told[c, 1], told[c, 2], told[c, 3]
                value = min(max(((s + across * p) + down * q) + (across * down) * r, np.float32(0.0)), most)
                out[c, y + j, x + i] = value
                if channels == 4 and c == 3:
                    most = value
