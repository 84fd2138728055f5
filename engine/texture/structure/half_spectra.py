"""Half spectra of periodic pictures taken from one grid to another, and what is masked in them.

A half spectrum is complex64 (n, h, w//2 + 1), as of `engine.numeric.real_fourier`.  Grids halve, rounded up, so that
any size will do.
"""

from __future__ import annotations

import numpy as np

from engine.numeric import steerable
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.kernel import kernel
from engine.numeric.memo import remembered
from engine.numeric.real_fourier import irfft2, rfft2
from engine.numeric.steerable import Filters, Place

_ORIENTATIONS = 4
Size = tuple[int, int]


def halved_size(size: Size, times: int) -> Size:
    """Returns the size of a grid that is so many times halved_size."""
    for _ in range(times):
        size = -(-size[0] // 2), -(-size[1] // 2)
    return size


def filters_of(size: Size, levels: int) -> Filters:
    """Gives the masks for pictures of a size."""
    return steerable.filters(*size, levels, _ORIENTATIONS, EVERYWHERE)


def resized(half: np.ndarray, width: int, size: Size) -> np.ndarray:
    """Returns the half spectra of pictures `width` wide on a finer or coarser grid: what both have, but for the highest
    frequencies of an even size."""
    height = half.shape[1]
    out = np.zeros((len(half), size[0], size[1] // 2 + 1), np.complex64)
    rows, columns = (min(a, b) for a, b in ((height, size[0]), (width, size[1])))
    down, up, across = (rows + 1) // 2, (rows - 1) // 2, (columns + 1) // 2
    scale = np.float32(size[0] * size[1] / (height * width))
    out[:, :down, :across] = half[:, :down, :across] * scale
    if up:
        out[:, -up:, :across] = half[:, -up:, :across] * scale
    return out


def regridded(planes: np.ndarray, size: Size) -> np.ndarray:
    """Returns periodic planes (n, h, w) on another grid: float32."""
    return irfft2(resized(rfft2(planes), planes.shape[2], size), size, True)


@remembered
def low_mask(size: Size) -> np.ndarray:
    """Gives the square of the low-pass of a grid (h, w//2 + 1): what its subbands and all coarser ones have of it."""
    high = steerable.filters(*size, 0, _ORIENTATIONS, EVERYWHERE).high
    out: np.ndarray = np.float32(1.0) - high * high
    out.flags.writeable = False
    return out


@remembered
def octave_mask(size: Size) -> np.ndarray:
    """Gives what of a grid the next coarser one has not got (h, w//2 + 1)."""
    made = steerable.filters(*size, 1, _ORIENTATIONS, EVERYWHERE)
    out: np.ndarray = made.high * made.high
    for band in made.bands[0]:
        out += band * band
    out.flags.writeable = False
    return out


def masked(half: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Returns half spectra times a mask (h, w//2 + 1)."""
    out = np.empty(half.shape, np.complex64)
    _mask(half.view(np.float32), mask, out.view(np.float32))
    return out


def bands_of(half: np.ndarray, width: int, made: Filters, level: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the real and the imaginary parts of the bands of a level of pictures, of which half spectra are given:
    float32 (orientations, n, h, w)."""
    size = made.sizes[level]
    own = resized(half, width, size) if size != made.sizes[0] else half
    parts = np.empty((2, made.orientations, *own.shape), np.complex64)
    floats = parts.view(np.float32)
    for k in range(made.orientations):
        _banded(own.view(np.float32), made.mask(Place(level, k)), floats[0, k], floats[1, k])
    real, imaginary = irfft2(parts, size, True)
    return real, imaginary


def quadrature(halves: np.ndarray, made: Filters, level: int) -> np.ndarray:
    """Returns the imaginary parts of bands whose real parts have the half spectra (orientations, n, h, w//2 + 1): waves
    a quarter turn on, along the direction of each."""
    out = np.empty(halves.shape, np.complex64)
    for k in range(made.orientations):
        _quarter(halves[k].view(np.float32), made.mask(Place(level, k)), out[k].view(np.float32))
    size = made.sizes[level]
    return irfft2(out.reshape(-1, *halves.shape[2:]), size, True).reshape(*halves.shape[:2], *size)


@kernel
def _mask(spectra: np.ndarray, mask: np.ndarray, out: np.ndarray) -> None:
    for n in range(spectra.shape[0]):
        for y in range(mask.shape[0]):
            line, row, into = spectra[n, y], mask[y], out[n, y]
            for x in range(row.size):
                into[2 * x] = line[2 * x] * row[x]
                into[2 * x + 1] = line[2 * x + 1] * row[x]


@kernel
def _banded(spectra: np.ndarray, mask: np.ndarray, real: np.ndarray, imaginary: np.ndarray) -> None:
    """real = spectra times i and the mask, imaginary = spectra times its size."""
    for n in range(spectra.shape[0]):
        for y in range(mask.shape[0]):
            line, row, one, other = spectra[n, y], mask[y], real[n, y], imaginary[n, y]
            for x in range(row.size):
                m = row[x]
                one[2 * x] = -m * line[2 * x + 1]
                one[2 * x + 1] = m * line[2 * x]
                other[2 * x] = abs(m) * line[2 * x]
                other[2 * x + 1] = abs(m) * line[2 * x + 1]


@kernel
def _quarter(spectra: np.ndarray, mask: np.ndarray, out: np.ndarray) -> None:
    """out = spectra times -i, or i where the mask is below 0, or nothing where it is 0."""
    for n in range(spectra.shape[0]):
        for y in range(mask.shape[0]):
            line, row, into = spectra[n, y], mask[y], out[n, y]
            for x in range(row.size):
                sign = np.float32(row[x] > np.float32(0.0)) - np.float32(row[x] < np.float32(0.0))
                into[2 * x] = line[2 * x + 1] * sign
                into[2 * x + 1] = -line[2 * x] * sign
