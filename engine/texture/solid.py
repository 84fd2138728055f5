"""Solid textures: a cube of noise is coerced until every plane through it looks like an example.

Heeger & Bergen 1995, section 4: a pyramid in three dimensions takes the sizes of things from the example, steerable
pyramids of all slices in three directions their forms, and what they make of the cube is averaged.  Here the first
counts little: the histograms of its bands are those of a plane's, which a cube that looks right need not have.  Slices
in three directions agree on streaks along the axes, which each of them takes for its own fine detail.  So the six
diagonal directions have slices too: x + y = const and so on, whose voxels are as far apart as those of an example of
which every sqrt(2)nd row is looked at.  The cube is seamless in all three directions, and so are all slices.

A cube grows from one of half its size, of what the example has at that size, which takes an eighth of the time for each
turn.  In the end it is settled, until planes in all directions are as like the example as they can be (settling.py).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from engine.numeric import bspline, histograms, laplacian, steerable
from engine.numeric.colour_axes import ColourAxes, axes_of
from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.pyramid import reduce
from engine.numeric.resample import rows_at
from engine.numeric.steerable import Filters, Place, finished
from engine.texture.matching import Pattern, Shape, Step, analysed, filters_for
from engine.texture.settling import Settling

ITERATIONS, SETTLING = 6, 10

_DOMAIN = 0x736F6C64  # "sold": tells these hashes from those of other textures
_ROUND = np.float32(0.3)  # the weight of the pyramid in three dimensions, that of slices across the axes being 1
_SLANTED = np.float32(0.5)  # that of slices across diagonals
# How far each turn goes, the average being 1: solids that agree in part pull slowly.
_STRIDE = np.float32(2.4)
_TOGETHER = 1 << 18  # voxels of the slices that are worked on at once
_SMALLEST = 32  # side of a cube that grows from a smaller one
_MORE = 3  # times as many turns of matching smaller cubes
_COARSER = 0.2  # what part of the time these take


class Turns(NamedTuple):
    """Of matching all slices in some directions, and then of settling planes in all directions."""

    matching: int
    settling: int


class Cut(NamedTuple):
    """All slices in a direction: row r of slice n lies at r along the axis `down` and at n - slant r along `across`;
    columns go along the third axis."""

    down: int
    across: int
    slant: int = 0


CUTS = (Cut(1, 0), Cut(0, 1), Cut(0, 2), *(Cut(a, b, slant) for a, b in ((0, 1), (0, 2), (1, 2)) for slant in (1, -1)))


@dataclass(frozen=True, slots=True, eq=False)
class Patterns:
    """What is matched of an example in a cube: `oriented`, by slices across the axes; `slanted`, across diagonals;
    `round`, by the pyramid in three dimensions; `between` voxels, by planes in any direction; `coarser`, in the cube of
    half the size from which it grows."""

    oriented: Pattern
    slanted: Pattern
    round: Pattern
    between: Pattern
    coarser: Patterns | None = None


def patterns(picture: np.ndarray, side: int, shape: Shape) -> Patterns:
    """Returns the patterns of an example (C, h, w) for a cube of `side`."""
    return _patterns(picture, side, shape, axes_of(picture))


def _patterns(picture: np.ndarray, side: int, shape: Shape, axes: ColourAxes) -> Patterns:
    shape = shape.within((side, side), picture.shape[1:])
    coarser = None
    if side % 2 == 0 and side >= _SMALLEST and shape.levels > 1:
        even = picture[:, : picture.shape[1] // 2 * 2, : picture.shape[2] // 2 * 2]
        half = reduce(np.ascontiguousarray(even))
        coarser = _patterns(half, side // 2, replace(shape, levels=shape.levels - 1), axes)
    mirrored = np.concatenate([picture, picture[:, ::-1]], axis=1)
    spread = rows_at(mirrored, np.arange(0.0, mirrored.shape[1] - 1.0, 2.0**0.5))
    round_ = analysed(picture, Shape("laplacian", shape.levels), axes)
    between = analysed(bspline.blur(picture), shape, axes)
    return Patterns(analysed(picture, shape, axes), analysed(spread, shape, axes), round_, between, coarser)


def noise(count: int, side: int, seed: int) -> np.ndarray:
    """White noise, even in -1..1, by seed and place alone: float32 (count, side, side, side)."""
    out = np.empty((count, side, side, side), np.float32)
    for channel in range(count):
        for z in range(side):
            hashed = hash_plane(fold_key(_DOMAIN, seed, channel, z), 0, 0, side, side)
            np.multiply((hashed >> np.uint64(40)).astype(np.float32), np.float32(2.0**-23), out=out[channel, z])
    out -= np.float32(1.0)
    return out


def matching(
    wanted: Patterns,
    start: np.ndarray,
    iterations: int = ITERATIONS,
    threads: Executor | None = None,
    settling: int = SETTLING,
) -> Iterator[Step]:
    """Yields the steps that make cubes `start` (R, n, n, n) like an example's `patterns`; the last has the finished
    solid.

    Each iteration has `settling` turns of settling with it, which come after all of them.
    """
    if not len(start):
        yield Step(1.0, start)
        return
    yield from _grown(wanted, np.array(start, np.float32), Turns(iterations, iterations * settling), threads)


def _grown(wanted: Patterns, cubes: np.ndarray, turns: Turns, threads: Executor | None) -> Iterator[Step]:
    """Cubes, worked on in place, that first are of half the size."""
    part = 0.0
    if wanted.coarser is not None and turns.matching:
        part = _COARSER
        fine, coarse = zip(*(laplacian.build(cube, 1, dimensions=3) for cube in cubes), strict=True)
        smaller = np.stack(coarse)
        before = Turns(_MORE * turns.matching, math.ceil(turns.settling / 2))
        for step in _grown(wanted.coarser, smaller, before, threads):
            yield Step(part * step.done)
        for cube, *bands in zip(cubes, fine, smaller, strict=True):
            cube[...] = laplacian.collapse(bands, dimensions=3)
        del fine, coarse, smaller, cube, bands  # their place is needed
    for step in _turned(wanted, cubes, turns, threads):
        yield Step(part + (1.0 - part) * step.done, step.planes)


def _turned(wanted: Patterns, cubes: np.ndarray, turns: Turns, threads: Executor | None) -> Iterator[Step]:
    """Turns of cubes, in place."""
    made = filters_for(cubes, wanted.oriented.shape)
    _match_voxels(cubes, wanted.oriented)
    pieces = 1 + len(CUTS)
    total, done = len(cubes) * (turns.matching * pieces + turns.settling), 0
    for _ in range(turns.matching):
        for channel, cube in enumerate(cubes):
            for piece in _changed(wanted, cube, channel, made, threads):
                yield Step((done + piece) / total)
            _match_voxels(cube[None], wanted.oriented, channel)
            done += pieces
        yield Step(done / total, cubes.copy())
    for channel, cube in enumerate(cubes):
        for part in _settled(cube, wanted, channel, turns.settling, threads):
            yield Step((done + part * turns.settling) / total)
        done += turns.settling
    yield Step(1.0, cubes)


def _changed(
    wanted: Patterns, cube: np.ndarray, channel: int, made: Filters, threads: Executor | None
) -> Iterator[int]:
    """Yields one turn of a cube, in place; tells how many pyramids are done."""
    mean = _ROUND * _round(cube, wanted.round, channel)
    whole = _ROUND
    yield 1
    for k, cut in enumerate(CUTS):
        pattern, weight = (wanted.slanted, _SLANTED) if cut.slant else (wanted.oriented, np.float32(1.0))
        slices = _sliced(cube, cut, made, pattern.bands[channel], threads)
        slices *= weight
        _laid(mean, cut)[_places(len(cube), cut)] += slices
        whole += weight
        yield k + 2
    mean *= np.float32(1.0) / whole
    mean -= cube
    mean *= _STRIDE
    cube += mean


def _laid(cube: np.ndarray, cut: Cut) -> np.ndarray:
    """Returns a view of the cube with the cut's axes first."""
    return np.moveaxis(cube, (cut.down, cut.across, 3 - cut.down - cut.across), (0, 1, 2))


def _places(side: int, cut: Cut) -> tuple[np.ndarray, np.ndarray]:
    """Tells where in such a view the rows of all slices are: each place once, int64 (slice, row)."""
    rows = np.arange(side)[None]
    return np.broadcast_to(rows, (side, side)), (rows.T - cut.slant * rows) % side


def _round(cube: np.ndarray, pattern: Pattern, channel: int) -> np.ndarray:
    """Returns the cube with the bands of its three-dimensional pyramid matched."""
    pyramid = laplacian.build(cube, pattern.shape.levels, dimensions=3)
    for level, band in enumerate(pyramid):
        histograms.match(band, pattern.bands[channel][Place(level)])
    return laplacian.collapse(pyramid, dimensions=3)


def _sliced(
    cube: np.ndarray, cut: Cut, made: Filters, bands: dict[Place, np.ndarray], threads: Executor | None
) -> np.ndarray:
    """Returns the slices of the cube with their subbands matched, each slice by itself."""
    slices = np.ascontiguousarray(_laid(cube, cut)[_places(len(cube), cut)])
    step = max(1, _TOGETHER // slices[0].size)

    def change(place: Place, values: np.ndarray) -> None:
        histograms.match_rows(values, bands[place])

    def part(start: int) -> None:
        steps = steerable.changed(slices[start : start + step], made, change)
        slices[start : start + step] = finished(steps)

    starts = range(0, len(slices), step)
    for _ in map(part, starts) if threads is None else threads.map(part, starts):
        pass
    return slices


def _settled(cube: np.ndarray, wanted: Patterns, channel: int, turns: int, threads: Executor | None) -> Iterator[float]:
    pattern, between = wanted.oriented, wanted.between.bands[channel]
    voxels = None if pattern.pixels is None else pattern.pixels[channel]
    settling = Settling(len(cube), pattern.shape, pattern.bands[channel], between, voxels)
    return settling.turns(cube, turns, threads)


def _match_voxels(cubes: np.ndarray, pattern: Pattern, first: int = 0) -> None:
    for cube, ordered in zip(cubes, (pattern.pixels or ())[first:], strict=False):
        histograms.match(cube, ordered)
