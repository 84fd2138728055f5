"""What joint statistics of a picture are: how its bands go together, within a scale and from scale to scale.

Portilla & Simoncelli 2000; of colours as Briand & Vacher 2021 have it, all planes of colour together.  A statistic is a
plain array, and between those of two pictures lies another: what is mixed is mixed number by number.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass, fields, replace
from typing import TypeVar

import numpy as np

from engine.numeric import histograms, steerable
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.colour_axes import ColourAxes, axes_of
from engine.numeric.lags import lags_of, shortened
from engine.numeric.matrices import products
from engine.numeric.real_fourier import irfft2, rfft2
from engine.numeric.sums import mean, total
from engine.texture.structure import bands
from engine.texture.structure.half_spectra import (
    bands_of,
    filters_of,
    low_mask,
    masked,
    resized,
)

_SCALES = 4
_LAGS = 3  # pixels that autocorrelations reach to each side
_QUANTILES = 1024
Kind = TypeVar("Kind", "LowStatistics", "BandStatistics")
Outcome = TypeVar("Outcome")


@dataclass(frozen=True, slots=True, eq=False)
class LowStatistics:
    """Of the low-pass of a scale, R planes: `lags` (R, 2l + 1, 2l + 1), `quantiles` (R, _QUANTILES), `together`
    (R, R)."""

    lags: np.ndarray
    quantiles: np.ndarray
    together: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class BandStatistics:
    """Of a scale's bands, B = orientations x R: their magnitudes' `means` (B,), `lags` (B, ...), what they have
    `together` (B, B) and with their parents' `under` (B, B); the same of the real parts, `real` (B, B) and `turned`
    (B, 2 B).  The coarsest scale has no parents: nothing."""

    means: np.ndarray
    lags: np.ndarray
    together: np.ndarray
    real: np.ndarray
    under: np.ndarray
    turned: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """The joint statistics of a picture (C, h, w) along R axes of colour.

    `pixels` (R, quantiles), `alpha` (1, quantiles), or (0, quantiles) where there is none: sorted values, by their
    means in equal parts; `high` (R,): the variance of the high-pass; `lows`: of the scales and of what is left below
    them, the finest first; `scales`; `size`: the picture's.
    """

    axes: ColourAxes
    pixels: np.ndarray
    alpha: np.ndarray
    high: np.ndarray
    lows: tuple[LowStatistics, ...]
    scales: tuple[BandStatistics, ...]
    size: tuple[int, int]


def joint_of(picture: np.ndarray, axes: ColourAxes | None = None) -> Joint:
    """Returns the joint statistics of a picture (C, h, w), float32 in 0..1, along given axes or its own."""
    return _ended(analysing(picture, axes))


def analysing(picture: np.ndarray, axes: ColourAxes | None = None) -> Generator[None, None, Joint]:
    """Yields after each piece of the work of `joint_of`; returns what that does."""
    axes = axes or axes_of(picture, EVERYWHERE)
    planes = axes.planes(picture)
    size = planes.shape[1], planes.shape[2]
    scales = yield from _measuring(planes, _SCALES)
    made, half = filters_of(size, len(scales)), rfft2(planes)
    yield
    lows = []
    for at in made.sizes:
        lows.append(_of_low(masked(resized(half, size[1], at), low_mask(at)), at))
        yield
    pixels = sorted_quantiles(planes)
    yield
    high = variances(masked(half, made.high), size[1])
    return Joint(axes, pixels, sorted_quantiles(picture[3:]), high, tuple(lows), scales, size)


def bands_measured(planes: np.ndarray, most: int) -> tuple[BandStatistics, ...]:
    """Returns the statistics of the finest scales of planes (R, h, w): so many, or as many as there is room for."""
    return _ended(_measuring(planes, most))


def _ended(work: Generator[None, None, Outcome]) -> Outcome:
    while True:
        try:
            next(work)
        except StopIteration as stop:
            found: Outcome = stop.value
            return found


def _measuring(planes: np.ndarray, most: int) -> Generator[None, None, tuple[BandStatistics, ...]]:
    size = planes.shape[1], planes.shape[2]
    levels = min(most, steerable.most_levels(*size)) if len(planes) else 0
    made, half = filters_of(size, levels), rfft2(planes)
    parts, out = [], []
    for level in range(levels):
        parts.append(bands_of(half, size[1], made, level))
        yield
    for level, (real, imaginary) in enumerate(parts):
        parents = None
        if level + 1 < levels:
            coarse, waves = parts[level + 1]
            parents = bands.parents_of(bands.flat(coarse), bands.flat(waves), made.sizes[level])
            yield
        out.append(_of_bands(bands.flat(real), bands.flat(imaginary), parents))
        yield
    return tuple(out)


def unlike(ones: tuple[BandStatistics, ...], others: tuple[BandStatistics, ...]) -> float:
    """Tells how far statistics are from others: the sum of what each kind differs by, in parts of the others'."""
    far = 0.0
    for one, other in zip(ones, others, strict=False):
        for name in ("means", "lags", "together", "real"):
            a, b = getattr(one, name), getattr(other, name)
            if a.ndim == 3:
                reach = min(a.shape[1], b.shape[1]) // 2
                a, b = shortened(a, reach), shortened(b, reach)
            far += math.sqrt(float(total(np.square(a - b))) / (float(total(np.square(b))) + 1e-20))
    return far


def _of_bands(real: np.ndarray, waves: np.ndarray, parents: tuple[np.ndarray, np.ndarray] | None) -> BandStatistics:
    count, height, width = real.shape
    pixels = height * width
    real_flat = real.reshape(count, -1)
    sizes, means = bands.magnitudes(real_flat, waves.reshape(count, -1))
    reach = reach_of((height, width), _LAGS, 8)
    lags = lags_of(rfft2(sizes.reshape(real.shape)), width, reach)
    none = np.zeros((count, 0))
    return BandStatistics(
        means,
        lags,
        products(sizes, sizes) / pixels,
        products(real_flat, real_flat) / pixels,
        none if parents is None else products(sizes, parents[0]) / pixels,
        none if parents is None else products(real_flat, parents[1]) / pixels,
    )


def _of_low(half: np.ndarray, size: tuple[int, int]) -> LowStatistics:
    half[:, 0, 0] = 0.0
    values = irfft2(half, size).reshape(len(half), size[0] * size[1])
    lags = lags_of(half, size[1], reach_of(size, _LAGS, 4))
    return LowStatistics(lags, sorted_quantiles(values), products(values, values) / values.shape[1])


def reach_of(size: tuple[int, int], most: int, part: int) -> int:
    """Tells how far lags reach in a picture: no farther than a part of its sides."""
    return max(0, min(most, min(size) // part - 1 if part < 8 else min(size) // part))


def sorted_quantiles(planes: np.ndarray) -> np.ndarray:
    """Returns the means of as many equal parts of the sorted values of each of some planes (n, ...).  Means, so that a
    pixel far from all others does not drag a part of them along."""
    out = np.zeros((len(planes), _QUANTILES), np.float32)
    for plane, means in zip(planes, out, strict=True):
        ordered = histograms.sorted_values(plane)
        below = np.concatenate([np.zeros(1), np.cumsum(ordered, dtype=np.float64)])
        edges = np.arange(_QUANTILES + 1) * (ordered.size / _QUANTILES)
        first = np.minimum(edges.astype(np.int64), ordered.size - 1)
        means[:] = np.diff(below[first] + (edges - first) * ordered[first]) * (_QUANTILES / ordered.size)
    return out


def variances(half: np.ndarray, width: int) -> np.ndarray:
    """Returns the variances of pictures of which half spectra are given, `width` wide: float64."""
    power = half.real.astype(np.float64) ** 2 + half.imag.astype(np.float64) ** 2
    found: np.ndarray = 2.0 * total(power, axis=(1, 2)) - total(power[:, :, 0], axis=1)
    if width % 2 == 0:
        found -= total(power[:, :, -1], axis=1)
    return found / float(half.shape[1] * width) ** 2


def low_spread(low: LowStatistics) -> float:
    """Tells the mean variance of the planes of a low-pass."""
    middle = low.lags.shape[1] // 2
    return float(mean(low.lags[:, middle, middle])) if len(low.lags) else 0.0


def joint_between(one: Joint, other: Joint, weight: float) -> Joint:
    """Returns statistics between two, both along the same axes: at `weight` 0 the first's, at 1 the other's."""
    levels = min(len(one.scales), len(other.scales))
    lows = tuple(_between(a, b, weight) for a, b in zip(one.lows[: levels + 1], other.lows, strict=False))
    scales = [_between(a, b, weight) for a, b in zip(one.scales[:levels], other.scales, strict=False)]
    low, high = np.minimum(one.axes.low, other.axes.low), np.maximum(one.axes.high, other.axes.high)
    return replace(
        one,
        axes=replace(one.axes, low=low, high=high),
        pixels=_part(one.pixels, other.pixels, weight),
        alpha=_part(one.alpha, other.alpha, weight),
        high=_part(one.high, other.high, weight),
        lows=lows,
        scales=tuple(scales),
    )


def _between(one: Kind, other: Kind, weight: float) -> Kind:
    given = {field.name: (getattr(one, field.name), getattr(other, field.name)) for field in fields(one)}
    return type(one)(**{name: _part(*pair, weight) for name, pair in given.items()})


def _part(one: np.ndarray, other: np.ndarray, weight: float) -> np.ndarray:
    if one.ndim == 3:
        reach = min(one.shape[1], other.shape[1]) // 2
        one, other = shortened(one, reach), shortened(other, reach)
    if one.shape != other.shape:  # the coarsest scale of one has parents in the other
        return one[:, :0]
    out: np.ndarray = (one.dtype.type(1.0 - weight) * one + one.dtype.type(weight) * other).astype(one.dtype)
    return out
