"""Textures by joint statistics alone: noise at an eighth of the size, swept, and finer noise added, size by size."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from engine.numeric import steerable
from engine.numeric.real_fourier import irfft2, rfft2
from engine.texture.matching import noise
from engine.texture.structure.half_spectra import Size, halved_size, masked, octave_mask, resized
from engine.texture.structure.statistics import Joint, low_spread, variances
from engine.texture.structure.sweep import match_quantiles, swept

SWEEPS = (5, 6, 8, 8)  # of the grids of scales 0, 1, 2, 3
_PIECES = 20  # of a sweep, about
_FARTHER = np.float32(0.8)  # than a sweep goes, the next one begins
_EVEN = np.float32(3.0**0.5)  # by which noise even in -1..1 has the variance 1


@dataclass(frozen=True, slots=True)
class Progressed:
    """How far the work is, `done` 0..1; `planes` of the last grid that was swept, now and then."""

    done: float
    planes: np.ndarray | None = None


def synthesised(
    wanted: Joint, size: Size, seed: int, sweeps: Sequence[int] = SWEEPS, start: tuple[np.ndarray, int] | None = None
) -> Iterator[Progressed]:
    """Yields the steps to planes (R, *size) with the joint statistics; the last has them.

    `sweeps`: of each scale's grid, the finest first; coarser ones than the size has room for are left out.  `start`:
    planes to begin with, and the scale of their grid, instead of noise.
    """
    top = min(len(sweeps) - 1, max(min(len(wanted.scales), steerable.most_levels(*size)) - 1, 0))
    field = rfft2(noise(wanted.axes.count, size, seed) * _EVEN)
    planes = None
    if start is not None:
        planes, top = start
    work = _Work(size, sweeps[: top + 1])
    for scale in range(top, -1, -1):
        grid = halved_size(size, scale)
        if planes is None:
            planes = irfft2(resized(field, size[1], grid), grid, True)
        elif planes.shape[1:] != grid:
            planes = _with_octave(planes, wanted, scale, resized(field, size[1], grid), grid)
        for found in often_swept(planes, wanted, scale, sweeps[scale]):
            planes = planes if found is None else found
            yield Progressed(work.after(scale, 1.0 / _PIECES))
        yield Progressed(work.after(scale, 0.0) if scale else 1.0, planes)


def often_swept(planes: np.ndarray, wanted: Joint, scale: int, times: int) -> Iterator[np.ndarray | None]:
    """Yields None after each piece of work, and last planes of a scale's grid after so many sweeps."""
    for turn in range(times):
        found = None
        for found in swept(planes, wanted, scale):
            if found is None:
                yield None
        assert found is not None
        if scale == 0:
            match_quantiles(found, wanted.pixels)
            found = wanted.axes.planes(_within(wanted.axes.unclipped(found)))
        planes = found if turn == times - 1 else found + _FARTHER * (found - planes)
    yield planes


def from_noise(wanted: Joint, size: Size, seed: int, scale: int, times: int) -> np.ndarray:
    """Returns planes of the grid of one scale, of `size`, made of noise by so many sweeps."""
    *_, found = often_swept(noise(wanted.axes.count, size, seed) * _EVEN, wanted, scale, times)
    assert found is not None
    return found


def colours_of(wanted: Joint, planes: np.ndarray) -> np.ndarray:
    """Returns the colours (C, h, w) of finished planes, in 0..1.  Alpha has the example's values; were colours given
    theirs one by one, the fainter axes would lose what they have together."""
    out = wanted.axes.unclipped(planes)
    match_quantiles(out[3:], wanted.alpha)
    return _within(out)


def _within(colours: np.ndarray) -> np.ndarray:
    return np.clip(colours, np.float32(0.0), np.float32(1.0), out=colours)


class _Work:
    """Tells how far the work is, by the pixels that are swept."""

    def __init__(self, size: Size, sweeps: Sequence[int]) -> None:
        self._size = size
        self._whole = sum(count * self._cost(scale) for scale, count in enumerate(sweeps)) or 1.0
        self._gone = 0.0

    def _cost(self, scale: int) -> float:
        height, width = halved_size(self._size, scale)
        return float(height * width)

    def after(self, scale: int, part: float) -> float:
        """Counts a part of a sweep of a scale's grid; tells the whole, 0..1."""
        self._gone += part * self._cost(scale)
        return min(self._gone / self._whole, 1.0)


def _with_octave(planes: np.ndarray, wanted: Joint, scale: int, field: np.ndarray, size: Size) -> np.ndarray:
    """Returns planes on the next finer grid, that of `scale`, with an octave of noise as strong as the example's; the
    noise as the half spectra of that grid."""
    octave = masked(field, octave_mask(size))
    lost = low_spread(wanted.lows[scale]) - low_spread(wanted.lows[scale + 1])
    found = variances(octave, size[1])
    strength = np.sqrt(max(lost, 1e-6) * len(found) / max(float(sum(found)), 1e-20))
    octave *= np.float32(strength)
    octave += resized(rfft2(planes), planes.shape[2], size)
    return irfft2(octave, size, True)
