"""Solid textures: a cube of noise is coerced until every plane through it looks like an example.

Heeger & Bergen 1995, section 4: a pyramid in three dimensions takes the sizes of things from the example, steerable
pyramids of all slices in three directions their forms, and what they make of the cube is averaged.  There the first
counts more than each of the others: it knows no directions, and keeps slices from agreeing on streaks along the axes,
which each of them would take for its own fine detail.  The cube is seamless in all three directions.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor

import numpy as np

from engine.numeric import histograms, laplacian, steerable
from engine.numeric.colour_axes import axes_of
from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.steerable import Filters, Place, finished
from engine.texture.matching import Pattern, Shape, Step, analysed, filters_for

ITERATIONS = 8

_DOMAIN = 0x736F6C64  # "sold": tells these hashes from those of other textures
_ROUND = np.float32(1.5)  # the weight of the pyramid in three dimensions, each direction's slices having 1
# How far each turn goes, the average being 1: solids that agree in part pull slowly.
_STRIDE = np.float32(1.6)
_TOGETHER = 1 << 18  # voxels of the slices that are worked on at once


def patterns(picture: np.ndarray, side: int, shape: Shape) -> tuple[Pattern, Pattern]:
    """What is matched of an example (C, h, w) in a cube of `side`: its steerable pyramid and its Laplacian one."""
    shape = shape.within((side, side))
    axes = axes_of(picture)
    return analysed(picture, shape, axes), analysed(picture, Shape("laplacian", shape.levels), axes)


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
    oriented: Pattern,
    round_: Pattern,
    start: np.ndarray,
    iterations: int = ITERATIONS,
    threads: Executor | None = None,
) -> Iterator[Step]:
    """The steps that make cubes `start` (R, n, n, n) like an example's `patterns`; the last has the finished solid."""
    cubes = np.array(start, np.float32)
    made = filters_for(cubes, oriented.shape)
    _match_voxels(cubes, oriented)
    total, done = iterations * len(cubes), 0
    for turn in range(iterations):
        for channel, cube in enumerate(cubes):
            mean = _ROUND * _round(cube, round_, channel)
            yield Step((done + 0.25) / total)
            for axis in range(3):
                mean += _sliced(cube, axis, made, oriented.bands[channel], threads)
                yield Step((done + 0.25 * (axis + 2)) / total)
            mean *= np.float32(1.0) / (_ROUND + np.float32(3.0))
            mean -= cube
            mean *= _STRIDE
            cube += mean
            done += 1
        _match_voxels(cubes, oriented)
        yield Step((turn + 1) / iterations, cubes.copy())
    if not total:
        yield Step(1.0, cubes)


def _round(cube: np.ndarray, pattern: Pattern, channel: int) -> np.ndarray:
    """The cube with the bands of its three-dimensional pyramid matched."""
    pyramid = laplacian.build(cube, pattern.shape.levels, dimensions=3)
    for level, band in enumerate(pyramid):
        histograms.match(band, pattern.bands[channel][Place(level)])
    return laplacian.collapse(pyramid, dimensions=3)


def _sliced(
    cube: np.ndarray, axis: int, made: Filters, bands: dict[Place, np.ndarray], threads: Executor | None
) -> np.ndarray:
    """The cube with the subbands of all its slices across `axis` matched, each slice by itself."""
    slices = np.moveaxis(cube, axis, 0).copy()
    step = max(1, _TOGETHER // slices[0].size)

    def change(place: Place, values: np.ndarray) -> None:
        histograms.match_rows(values, bands[place])

    def part(start: int) -> None:
        steps = steerable.changed(slices[start : start + step], made, change)
        slices[start : start + step] = finished(steps)

    starts = range(0, len(slices), step)
    for _ in map(part, starts) if threads is None else threads.map(part, starts):
        pass
    return np.moveaxis(slices, 0, axis)


def _match_voxels(cubes: np.ndarray, pattern: Pattern) -> None:
    for cube, ordered in zip(cubes, pattern.pixels or (), strict=False):
        histograms.match(cube, ordered)
