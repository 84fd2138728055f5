"""One sweep: planes of a grid are given the joint statistics of an example, from the coarsest scale to the finest."""

from __future__ import annotations

from collections.abc import Generator, Iterator

import numpy as np

from engine.numeric import histograms, steerable
from engine.numeric.lags import apply_filter, lags_of, shortened
from engine.numeric.real_fourier import irfft2, rfft2
from engine.numeric.steerable import Filters, Place
from engine.texture.structure import bands
from engine.texture.structure.covariance import coerced
from engine.texture.structure.half_spectra import (
    Size,
    bands_of,
    filters_of,
    low_mask,
    masked,
    quadrature,
    resized,
)
from engine.texture.structure.statistics import BandStatistics, Joint, LowStatistics, reach_of, variances

_BINS = 1024  # of the tables by which values are brought to the example's


def swept(planes: np.ndarray, wanted: Joint, scale: int) -> Iterator[np.ndarray | None]:
    """Yields None after each piece of work, and last the planes (R, h, w) of the grid of a scale after a sweep."""
    size = planes.shape[1], planes.shape[2]
    levels = min(len(wanted.scales) - scale, steerable.most_levels(*size))
    made, half = filters_of(size, levels), rfft2(planes)
    parts = []
    for level in range(levels):
        parts.append(bands_of(half, size[1], made, level))
        yield None
    coarsest = made.sizes[-1]
    below = masked(resized(half, size[1], coarsest), low_mask(coarsest))
    below = _low_corrected(below, wanted.lows[scale + levels], coarsest)
    above = None
    for level in reversed(range(levels)):
        at = made.sizes[level]
        found = yield from _bands_corrected(parts[level], wanted.scales[scale + level], at, above)
        halves = rfft2(found)
        yield None
        above = _parents(found, halves, made, level) if level else None
        below = resized(below, made.sizes[level + 1][1], at)
        for k in range(made.orientations):
            steerable.give(below, halves[k], made, Place(level, k))
        below = _low_corrected(below, wanted.lows[scale + level], at)
        yield None
    if scale == 0:
        below += _high_limited(half, made, wanted.high, size)
    yield irfft2(below, size, True)


def match_quantiles(planes: np.ndarray, quantiles: np.ndarray) -> None:
    """Moves the values of planes, in place, to those of an example."""
    for plane, ordered in zip(planes, quantiles, strict=True):
        histograms.match(plane, ordered, _BINS)


def _parents(real: np.ndarray, halves: np.ndarray, made: Filters, level: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns what corrected bands of a level, and their half spectra, are as parents of the next finer one's."""
    waves = quadrature(halves, made, level)
    return bands.parents_of(bands.flat(real), bands.flat(waves), made.sizes[level - 1])


def _low_corrected(half: np.ndarray, wanted: LowStatistics, size: Size) -> np.ndarray:
    """Returns the half spectra of a low-pass with what is wanted of it."""
    half[:, 0, 0] = 0.0
    _filtered(half, size, wanted.lags, reach_of(size, 6, 2))
    values = irfft2(half, size, True).reshape(len(half), -1)
    if len(values) > 1:
        values = coerced(values, wanted.together)
    match_quantiles(values, wanted.quantiles)
    return rfft2(values.reshape(len(half), *size))


def _filtered(half: np.ndarray, size: Size, wanted: np.ndarray, far: int) -> None:
    """Gives half spectra the autocorrelations wanted, where there is room for any."""
    reach = min(wanted.shape[1] // 2, far)
    if reach > 0:
        now = lags_of(half, size[1], min(2 * reach, far))
        apply_filter(half, size[1], now, shortened(wanted, reach))


def _bands_corrected(
    parts: tuple[np.ndarray, np.ndarray],
    wanted: BandStatistics,
    size: Size,
    parents: tuple[np.ndarray, np.ndarray] | None,
) -> Generator[None, None, np.ndarray]:
    """Yields between pieces of work; returns the real parts of a level's bands (orientations, R, h, w), both parts
    being given and written over: first magnitudes are corrected, then what the real parts have in common."""
    shape = parts[0].shape
    real, imaginary = (part.reshape(shape[0] * shape[1], -1) for part in parts)
    sizes, _ = bands.magnitudes(real, imaginary)
    sizes = coerced(sizes, wanted.together, parents and parents[0], wanted.under)
    yield
    half = rfft2(sizes.reshape(-1, *size))
    _filtered(half, size, wanted.lags, reach_of(size, 6, 2))
    bands.impose(real, imaginary, irfft2(half, size, True).reshape(real.shape), wanted.means)
    yield
    return coerced(real, wanted.real, parents and parents[1], wanted.turned).reshape(shape)


def _high_limited(half: np.ndarray, made: Filters, wanted: np.ndarray, size: Size) -> np.ndarray:
    """Returns the half spectra of the high-pass, no stronger than is wanted."""
    high = masked(half, made.high)
    strong = np.maximum(variances(high, size[1]), 1e-20)
    scale = np.sqrt(np.minimum(1.0, wanted / strong)).astype(np.float32)
    out: np.ndarray = masked(high, made.high) * scale[:, None, None]
    return out
