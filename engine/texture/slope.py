"""How far the subbands of pictures are from an example's, and how that grows with each of their pixels.

The measure is the 1-Wasserstein distance of histograms (Heeger & Bergen 1995, section 3.2), in
units of the example's standard deviation, but rounded off near nought, so that it has a slope there too.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from typing import NamedTuple

import numpy as np

from engine.numeric import histograms, steerable
from engine.numeric.steerable import Filters, Place, finished
from engine.texture.matching import Bands

_FLAT = 1e-4  # subbands of a smaller spread say nothing
_TOGETHER = 1 << 18  # pixels of the pictures that are worked on at once
_NEAR = np.float32(1e-4)  # the square of the distance, in spreads, below which values count as right


class Wanted(NamedTuple):
    """A subband's sorted values, float32 (n,), and their standard deviation."""

    ordered: np.ndarray
    spread: float


Inside = Callable[[Place, int], slice]  # which of so many samples along an axis of a subband count


def wanted_of(bands: Bands) -> dict[Place, Wanted]:
    """Returns those subbands of an example that say something."""
    found = {place: Wanted(ordered, float(ordered.std(dtype=np.float64))) for place, ordered in bands.items()}
    return {place: band for place, band in found.items() if band.spread > _FLAT}


def sloped(
    pictures: np.ndarray,
    filters: Filters,
    wanted: dict[Place, Wanted],
    inside: Inside,
    threads: Executor | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Tells how far float32 pictures (m, h, w) are, added up over the subbands that are wanted, float64 (m,); and
    the slope of that by the pixels of each, (m, h, w)."""
    step = max(1, _TOGETHER // pictures[0].size)
    parts = [pictures[start : start + step] for start in range(0, len(pictures), step)]
    found = list((map if threads is None else threads.map)(lambda part: _sloped(part, filters, wanted, inside), parts))
    distances, slopes = (np.concatenate(each) for each in zip(*found, strict=True))
    return distances, slopes


def _sloped(
    pictures: np.ndarray, filters: Filters, wanted: dict[Place, Wanted], inside: Inside
) -> tuple[np.ndarray, np.ndarray]:
    size, distances = pictures[0].size, np.zeros(len(pictures))

    def change(place: Place, values: np.ndarray) -> None:
        band = wanted.get(place)
        if band is None:
            values[...] = 0.0
            return
        seen = (slice(None), *(inside(place, count) for count in values.shape[1:]))
        away = values[seen].copy()
        matched = away.copy()
        histograms.match_rows(matched, band.ordered)
        away -= matched
        away *= np.float32(1.0 / band.spread)
        distance = np.sqrt(away * away + _NEAR)
        distances[:] += distance.mean(axis=(1, 2))
        away /= distance
        # The pyramid put together is the transpose of the pyramid taken apart, but for the sizes of its subbands.
        away *= np.float32(values[0].size / (away[0].size * size * band.spread))
        values[...] = 0.0
        values[seen] = away

    return distances, finished(steerable.changed(pictures, filters, change))


def mirrored(pictures: np.ndarray) -> np.ndarray:
    """Returns pictures (m, n, n) in the middle of their mirror images: (m, 2n, 2n)."""
    before, after = beyond(pictures.shape[1])
    return np.pad(pictures, ((0, 0), (before, after), (before, after)), mode="symmetric")


def beyond(count: int) -> tuple[int, int]:
    """Tells how many pixels of mirror images are before and after `count` of a picture's own."""
    return count // 2, count - count // 2


def folded(values: np.ndarray) -> np.ndarray:
    """Returns the transpose of `mirrored`: what each pixel has to do with all its images, (m, n, n) of (m, 2n, 2n)."""
    for axis in (1, 2):
        whole = np.moveaxis(values, axis, 0)
        before, after = beyond(len(whole) // 2)
        own = whole[before : len(whole) - after].copy()
        own[:before] += whole[:before][::-1]
        own[before:] += whole[len(whole) - after :][::-1]
        values = np.moveaxis(own, 0, axis)
    return values
