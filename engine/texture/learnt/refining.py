"""An octave finer than a picture, by maps: a function of the picture about each pixel, and of noise by its place.

Whatever the maps say, the mean of four finer pixels is the pixel that they lie in.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.hashing import mix64
from engine.numeric.kernel import Array, Int, inner, kernel
from engine.texture.learnt.four_finer import NOISES, REGISTER, four_finer, in_registers
from engine.texture.learnt.kinds import LOOKED_ROUND, kinds_of, liveliness
from engine.texture.learnt.maps import LANES, NOISY, TAPS, Maps

_LOW = np.uint64((1 << 21) - 1)
_HALF = np.float32((1 << 20) - 0.5)
_SPREAD = np.float32(3.0**0.5 / (1 << 20))  # evenly spread numbers of 21 bits to variance 1
_NEXT = np.uint64(0x9E3779B97F4A7C15)


def refined(planes: np.ndarray, hashes: np.ndarray, maps: Maps, octave: int) -> np.ndarray:
    """Returns the finer pixels of planes (C, h + 4, w + 4): float32 (C, 2 h, 2 w), kept within 0..1, colours below
    alpha.  `hashes`: of the places, uint64 (h + 2, w + 2); `octave`: 0 or 1, how many were added before."""
    channels, height, width = planes.shape
    out = np.empty((channels, 2 * (height - 2 * LOOKED_ROUND), 2 * (width - 2 * LOOKED_ROUND)), np.float32)
    count = len(maps.axes)
    if not count:
        out[:] = np.repeat(
            np.repeat(planes[:, LOOKED_ROUND:-LOOKED_ROUND, LOOKED_ROUND:-LOOKED_ROUND], 2, axis=1), 2, axis=2
        )
        return out
    first, along = np.empty((height, width), np.float32), np.empty((height, width, LANES), np.float32)
    axes, sharp, rough = in_registers(maps)
    _fill_along(planes, axes, along, first)
    kinds, steep = kinds_of(first, maps.edges)
    lively = liveliness(steep, maps.edges)
    noise = np.empty((*hashes.shape, NOISES), np.float32)
    _refine(planes, along, kinds, lively, hashes, axes, count, sharp, rough, maps.loud[octave], noise, out)
    return out


def along_axes(planes: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Returns planes (C, h, w) along axes (R, C): float32 (R, h, w)."""
    out = np.zeros((len(axes), *planes.shape[1:]), np.float32)
    for own, axis in zip(out, axes, strict=True):
        for plane, part in zip(planes, axis, strict=True):
            own += plane * part
    return out


@kernel
def _fill_along(planes: Array, axes: Array, out: Array, first: Array) -> None:
    """As `along_axes`, pixel by pixel (h, w, LANES), by axes in registers; the first axis, too: (h, w)."""
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            a = b = c = d = np.float32(0.0)
            for n in range(planes.shape[0]):
                value = planes[n, y, x]
                a += value * axes[n]
                b += value * axes[REGISTER + n]
                c += value * axes[2 * REGISTER + n]
                d += value * axes[3 * REGISTER + n]
            out[y, x, 0], out[y, x, 1], out[y, x, 2], out[y, x, 3] = a, b, c, d
            first[y, x] = a


@kernel
def _refine(
    planes: Array,
    along: Array,
    kinds: Array,
    lively: Array,
    hashes: Array,
    axes: Array,
    count: Int,
    sharp: Array,
    rough: Array,
    loud: np.float32,
    noise: Array,
    out: Array,
) -> None:
    height, width = kinds.shape
    _fill_noise(hashes, count, loud, noise)
    i_row, n_row = LANES * along.shape[1], NOISES * noise.shape[1]
    near, random = along.reshape(-1), noise.reshape(-1)
    own, four = np.ones(LANES, np.float32), np.empty(REGISTER, np.float32)  # opaque where there is no alpha
    for y in range(height):
        for x in range(width):
            kind = np.int64(kinds[y, x])
            s, r = kind * (REGISTER * TAPS), kind * (REGISTER * 3 * NOISY)
            i, n = y * i_row + LANES * x, y * n_row + NOISES * x
            for c in range(planes.shape[0]):
                own[c] = planes[c, y + LOOKED_ROUND, x + LOOKED_ROUND]
            four_finer(near, i, i_row, random, n, n_row, sharp, s, rough, r, axes, lively[y, x], own, four)
            for c in range(planes.shape[0]):
                out[c, 2 * y, 2 * x], out[c, 2 * y, 2 * x + 1] = four[c], four[LANES + c]
                out[c, 2 * y + 1, 2 * x], out[c, 2 * y + 1, 2 * x + 1] = four[2 * LANES + c], four[3 * LANES + c]


@inner
def _fill_noise(hashes: Array, count: Int, loud: np.float32, noise: Array) -> None:
    """Three numbers a pixel along each axis, those of one after the other; nothing along axes that there are not."""
    scale = loud * _SPREAD
    for y in range(hashes.shape[0]):
        for x in range(hashes.shape[1]):
            own = noise[y, x]
            for r in range(count):
                h = mix64(hashes[y, x] + _NEXT * np.uint64(r + 1))
                for n in range(3):
                    own[LANES * n + r] = (np.float32((h >> np.uint64(21 * n)) & _LOW) - _HALF) * scale
            for r in range(count, LANES):
                for n in range(3):
                    own[LANES * n + r] = np.float32(0.0)
