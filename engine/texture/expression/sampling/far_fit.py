"""Written textures from far: where a pixel holds more than a part of a repeat, no few samples tell its mean, as what
they are of is grey already, and what is not linear of a mean is not the mean of that.

There the pixels of a level are fitted to what is seen from nearer, at places that are the same for every text: a factor
and a summand for each channel, by least squares.  The mean over the texture so stands at every level, and what comes of
samples that meet its repeats now so, now so, shrinks.  It is the next finer level that they are fitted to, the mean of
the pixels within each, but from where that would be many levels: there it is one level for all.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache

import numpy as np

FITTED_BELOW, FITTED_TO = 16, 64  # pixels a period: below which pixels are fitted, and from which on to what
PAIRED_FROM = 2  # pixels a period, from which on it is the next finer level
UNSURE_BELOW, CROWDED_BELOW = 32, 8  # below which those with edges take more than sixteen samples where these are not
# sure, and below which all do;
FAR_SIDES = (8, 12)  # so many each way, the more where the fewer are not sure,
_FAR_COST = ((2, 200_000.0), (0, 90_000.0))  # where these are no more nanoseconds a pixel, of so many pixels a period
_PLACES, _PAIRED, _ACROSS = 2048, 256, 16.0  # how many, of those of the next finer level, within how many periods
_UNIT = 1 << 14
_TURNS = (0.7548776662466927, 0.5698402909980532)  # as in `sample_trial`
_LEAST = 4.0 / 255.0 / 255.0  # variance of what is seen from far: of less it cannot be told whether it is there
_STEEPEST, _SLIGHTLY, _SURE = 8.0, 0.15, 4.0  # a factor; how far from 1 it must be, and in standard errors
_NEARLY, _ASIDE = 0.02, 0.5 / 255.0  # likewise where it is the next finer level, and of a summand
_AtPixels = Callable[[np.ndarray, np.ndarray], np.ndarray]  # what pixels show, by their columns and rows


def far_cost(period: Fraction) -> float:
    """Returns how many nanoseconds a pixel may take from far, where a period has so many pixels: the more the fewer
    levels as far there are."""
    return next(cost for least, cost in _FAR_COST if period >= least)


def near_level(period: float) -> int:
    """Returns how many levels finer than where the period is told is what others are fitted to."""
    part, level = math.frexp(FITTED_TO / period)
    return level - (part == 0.5)


def shown_at_places(shown: _AtPixels, period: Fraction, some: bool = False) -> np.ndarray:
    """Returns what the pixels at all places show, or at some: whole numbers, int64 (channels, places)."""
    return _counted(shown(*(way[: _PAIRED if some else _PLACES] for way in _pixels(float(period)))))


def shown_within(shown: _AtPixels, period: Fraction) -> np.ndarray:
    """Returns the means of what the next finer pixels within those at some places show, as `shown_at_places`; `period`:
    pixels of those places."""
    columns, rows = (2 * way[:_PAIRED] for way in _pixels(float(period)))
    across, down = (
        np.concatenate([columns + n % 2 for n in range(4)]),
        np.concatenate([rows + n // 2 for n in range(4)]),
    )
    found: np.ndarray = _counted(shown(across, down)).reshape(-1, 4, _PAIRED).sum(axis=1) // 4
    return found


def _counted(shown: np.ndarray) -> np.ndarray:
    found: np.ndarray = np.rint(shown.astype(np.float64) * _UNIT).astype(np.int64)
    return found


def fit_to_near(far: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Returns by what pixels that show `far` are multiplied, and what is then added, so that they are about `near`:
    float32 (2, channels, 1).  Sums are of whole numbers, so that they are the same on every machine."""
    out = np.empty((2, len(far), 1), np.float32)
    for n, (x, y) in enumerate(zip(far, near, strict=True)):
        out[:, n, 0] = _line(x, y)
    return out


def _line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Returns the factor and the summand of one channel: 1 and 0 where what is found may be chance."""
    count, (slightly, aside) = x.size, (_NEARLY, _ASIDE) if x.size == _PAIRED else (_SLIGHTLY, 0.0)
    sums = [int(a.sum()) for a in (x, y)]
    xx, xy, yy = (
        (int((a * b).sum()) * count - sums[n] * sums[m]) / (count * _UNIT) ** 2
        for a, b, n, m in ((x, x, 0, 0), (x, y, 0, 1), (y, y, 1, 1))
    )
    far, near = (one / (count * _UNIT) for one in sums)
    if xx > _LEAST:
        slope = min(max(xy / xx, 0.0), _STEEPEST)
        error = math.sqrt(max(yy - xy * xy / xx, 0.0) / xx / count)
        if abs(1.0 - slope) > max(_SURE * error, slightly):
            return slope, near - slope * far
    apart = near - far
    sure = abs(apart) > max(_SURE * math.sqrt(max(xx + yy - 2.0 * xy, 0.0) / count), aside)
    return 1.0, apart if sure else 0.0


@lru_cache(64)
def _pixels(period: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns the columns and the rows of the pixels at all places: int64 (places,), twice."""
    places = (np.arange(1, _PLACES + 1) * turn % 1.0 * _ACROSS for turn in _TURNS)
    columns, rows = (np.floor(place * period).astype(np.int64) for place in places)
    return columns, rows
