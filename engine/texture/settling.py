"""A cube of texture is settled until planes in all directions look as much like the example as they can.

Slices across axes and diagonals, of which a cube is made first (solid.py), say nothing of planes in between, and have
few samples of what is large, which go together by chance.  No cube can be right for all planes: a plane shows the waves
of a cube in projection, what it has of a frequency is the sum of the cube's power along a line across it.  So what is
fine in planes in one direction is large in others, and where an example has little that is large, as sand has, they
cannot all have as little.  What can be had is the best for all together.

So the measure itself goes down its slope: the distances of the histograms of subbands from the example's (Heeger &
Bergen 1995, section 4), on average over planes across the axes and over others.  Whichever kind is further off than
flat textures are counts for more, so that neither is left behind.  Fine subbands are seen in single planes, others in
each turn; coarse ones in whole sheaves of parallel planes, whose smooth parts are quickly had from the cube's spectrum.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from typing import Any

import numpy as np

from engine.numeric import bspline, histograms, steerable
from engine.numeric.bspline import Plane
from engine.numeric.directions import frame, frames
from engine.numeric.hashing import fold_key, uniform
from engine.numeric.sheaf import Rod, Sheaves
from engine.numeric.steerable import Place
from engine.texture.matching import Bands, Shape
from engine.texture.slope import Inside, Wanted, beyond, folded, mirrored, sloped, wanted_of

_DOMAIN = 0x73657474  # "sett": tells these hashes from those of other textures
_FEW = 16  # samples along an axis of a subband that is seen in sheaves
_SEEN = 16  # turns after which all directions have been seen whose sheaves overlap but little
_MOST = 48  # directions of a level in a turn
_PLANES = 12  # slanted ones in each turn
_SLICES = 5  # turns after which all slices across the axes have been seen
_EDGE = 12  # pixels along the edges of slanted planes, which do not tile, that do not count
_STRIDE = 0.03  # how far voxels go in a turn, in spreads of the cube
_LASTING = np.float32(0.9)  # what is left of a turn's way in the next
_TILE = 0.6  # flat textures are so far from an example, pieces that were cut out of them at a slant being 1 away
_EAGER = 3  # the power of how far planes of one kind are, relative to the other, with which they count for more
_LATELY = 0.2  # of how far planes are from the example, what part is news in a turn
_MATCHED = 5  # turns after which voxels are given the example's values again

_SLANTED, _ACROSS = 0, 1  # kinds of planes: at a slant, and across the axes
_ALL = (0, 1, 2)


class Settling:
    """What turns a cube of `side` towards an example's sorted values: its `bands`; those of it `between` voxels, where
    there is less of what is fine; and `voxels` unless None."""

    def __init__(self, side: int, shape: Shape, bands: Bands, between: Bands, voxels: np.ndarray | None) -> None:
        self._voxels = voxels
        self._away = np.ones(2)  # how far from the example planes of each kind have been lately
        wanted = wanted_of(bands)
        coarse = [level for level in range(1, shape.levels + 1) if -(-side >> level) <= _FEW]
        self._fine = _Fine(side, shape, *(_without(coarse, each) for each in (wanted, wanted_of(between))))
        self._coarse = [_Coarse(side, level, shape, wanted) for level in coarse]

    def turns(self, cube: np.ndarray, count: int, threads: Executor | None = None) -> Iterator[float]:
        """Settles a cube (n, n, n), float32, in place; it is right after the last turn.  Tells what part is done."""
        from scipy.fft import irfftn, rfftn

        spread = float(cube.std(dtype=np.float64))
        spectrum = rfftn(cube)
        way = np.zeros_like(spectrum)
        for turn in range(count):
            way *= _LASTING
            way += self._slope(spectrum, turn, threads)
            stride = _STRIDE * spread * min(1.0, 2.0 - 2.0 * turn / count)
            spectrum -= way * np.float32(stride / max(_size(way, len(cube)), 1e-30))
            if turn % _MATCHED == _MATCHED - 1 or turn == count - 1:
                cube[...] = irfftn(spectrum, s=cube.shape, axes=_ALL)
                if self._voxels is not None:
                    histograms.match(cube, self._voxels)
                spectrum = rfftn(cube)
            yield (turn + 1) / count

    def _slope(self, spectrum: np.ndarray, turn: int, threads: Executor | None) -> np.ndarray:
        """Tells how the measure grows with each voxel, as half of a spectrum, by the planes that are looked at in a
        turn."""
        weight = (self._away[_ACROSS] / max(_TILE * self._away[_SLANTED], 1e-9)) ** _EAGER
        total, away = self._fine.slope(spectrum, turn, weight, threads)
        for coarse in self._coarse:
            away += coarse.slope(total, spectrum, turn, weight, threads)
        self._away += (away - self._away) * (_LATELY if turn else 1.0)
        return total


class _Fine:
    """The subbands that are seen in single planes: what is `wanted` of slices, and `between` voxels."""

    def __init__(self, side: int, shape: Shape, wanted: dict[Place, Wanted], between: dict[Place, Wanted]) -> None:
        self._side, self._wanted, self._between = side, wanted, between
        self._filters = steerable.filters(side, side, shape.levels, shape.orientations)
        along = bspline.prefilter(side)
        self._prefilter = along[:, None, None] * along[:, None] * along[: side // 2 + 1]

    def slope(
        self, spectrum: np.ndarray, turn: int, weight: float, threads: Executor | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Returns the slope as half of a spectrum, planes across the axes having the `weight`; how far those of each
        kind are, float64 (2,)."""
        total, across = self._across(spectrum, turn, weight, threads)
        laid, slanted = self._slanted(spectrum * self._prefilter, turn, threads)
        total += laid * self._prefilter
        return total, np.array([slanted, across])

    def _across(
        self, spectrum: np.ndarray, turn: int, weight: float, threads: Executor | None
    ) -> tuple[np.ndarray, float]:
        from scipy.fft import irfftn, rfftn

        cube = irfftn(spectrum, s=(self._side,) * 3, axes=_ALL)
        step = min(_SLICES, self._side)
        slices = [(axis, k) for axis in _ALL for k in range(3 * turn % step, self._side, step)]
        found = np.stack([np.take(cube, k, axis) for axis, k in slices])
        distances, slope = sloped(found, self._filters, self._wanted, _within(0), threads)
        slope *= _outstanding(distances) * np.float32(weight / len(slices))
        cube[...] = 0.0
        for (axis, k), values in zip(slices, slope, strict=True):
            np.moveaxis(cube, axis, 0)[k] += values
        return rfftn(cube), float(distances.mean())

    def _slanted(self, spectrum: np.ndarray, turn: int, threads: Executor | None) -> tuple[np.ndarray, float]:
        """Of and by the coefficients of splines between voxels."""
        from scipy.fft import rfftn

        numbers = uniform(fold_key(_DOMAIN, turn), 3 + 3 * _PLANES)
        corners = numbers[3:].reshape(-1, 3) * self._side
        planes = [Plane(corner, *at[1:]) for corner, at in zip(corners, frames(_PLANES, numbers[:3]), strict=True)]
        found = self._cut(spectrum, planes, threads)
        inside = _within(min(_EDGE, self._side // 8))
        distances, slope = sloped(found, self._filters, self._between, inside, threads)
        slope *= np.float32(1.0 / _PLANES)
        pairs = list(zip(planes, slope, strict=True))
        one, other = _each(threads)(self._laid, (pairs[::2], pairs[1::2]))
        one += other
        return rfftn(one), float(distances.mean())

    def _cut(self, spectrum: np.ndarray, planes: list[Plane], threads: Executor | None) -> np.ndarray:
        from scipy.fft import irfftn

        spline = irfftn(spectrum, s=(self._side,) * 3, axes=_ALL)
        return np.stack(list(_each(threads)(lambda plane: bspline.cut(spline, plane, self._side), planes)))

    def _laid(self, pairs: list[tuple[Plane, np.ndarray]]) -> np.ndarray:
        total = np.zeros((self._side,) * 3, np.float32)
        for plane, values in pairs:
            bspline.lay(total, plane, values)
        return total


class _Coarse:
    """The subbands of a level that are seen in sheaves, of planes as pictures: beyond their edges are mirror images."""

    def __init__(self, side: int, level: int, shape: Shape, wanted: dict[Place, Wanted]) -> None:
        self._side, self._level = side, level
        small = -(-side >> level)
        self._own = slice(beyond(small)[0], beyond(small)[0] + small)
        self._sheaves = Sheaves(side, small, 0.5 * side * 2.0**-level)
        self._filters = steerable.filters(2 * small, 2 * small, shape.levels - level, shape.orientations)
        self._wanted = {Place(0, place.orientation): band for place, band in wanted.items() if place.level == level}

    def slope(
        self, total: np.ndarray, spectrum: np.ndarray, turn: int, weight: float, threads: Executor | None
    ) -> np.ndarray:
        """Adds the slope to half of a spectrum, in place; how far planes of each kind are, float64 (2,)."""
        flat, each, away = total.reshape(-1), _each(threads), np.zeros(2)
        views = {_SLANTED: self._slanted(turn), _ACROSS: self._across(turn)}
        for kind, rods in views.items():
            planes = list(each(lambda rod: self._sheaves.planes(spectrum, rod), rods))
            pictures = mirrored(np.concatenate(planes))
            distances, slope = sloped(pictures, self._filters, self._wanted, lambda *_: self._own, threads)
            away[kind] = distances.mean()
            slope = folded(slope) * np.float32(1.0 / len(slope))
            if kind == _ACROSS:
                slope *= _outstanding(distances) * np.float32(weight)
            parts = slope.reshape(len(rods), *planes[0].shape)
            for rod, values in zip(rods, each(self._sheaves.given, rods, parts), strict=True):
                flat[rod.places] += values
        return away

    def _slanted(self, turn: int) -> list[Rod]:
        count = min(max(2 * 4**self._level // _SEEN, 1), _MOST)
        numbers = uniform(fold_key(_DOMAIN, turn, self._level), 3 + 3 * count)
        between = bspline.response(np.arange(self._side // 2 + 1) / self._side)
        centres = numbers[3:].reshape(-1, 3) * self._side
        places = zip(frames(count, numbers[:3]), centres, strict=True)
        return [self._sheaves.rod(at, centre, between) for at, centre in places]

    def _across(self, turn: int) -> list[Rod]:
        """Their pictures have their edges along the cube's faces and in its middle by turns."""
        centre, all_of_it = np.full(3, self._side // 2 * (1.0 + turn % 2)), np.ones(self._side // 2 + 1)
        return [self._sheaves.rod(frame(normal), centre, all_of_it) for normal in np.eye(3)]


def _without(levels: list[int], wanted: dict[Place, Wanted]) -> dict[Place, Wanted]:
    return {place: band for place, band in wanted.items() if place.level not in levels}


def _outstanding(distances: np.ndarray) -> np.ndarray:
    """Tells how much more planes count that are further off than others: float32 (m, 1, 1)."""
    out: np.ndarray = (distances / max(distances.mean(), 1e-9)).astype(np.float32)[:, None, None]
    return out


def _within(edge: int) -> Inside:
    """Returns all of a picture but `edge` pixels along its edges."""

    def inside(place: Place, count: int) -> slice:
        away = edge >> max(place.level, 0)
        return slice(away, count - away)

    return inside


def _each(threads: Executor | None) -> Callable[..., Iterator[Any]]:
    return map if threads is None else threads.map


def _size(half: np.ndarray, side: int) -> float:
    """Returns the root of the mean square of the voxels of half of a spectrum."""
    whole = 2.0 * np.vdot(half, half).real - np.vdot(half[..., 0], half[..., 0]).real
    return float(np.sqrt(max(whole, 0.0))) / side**3
