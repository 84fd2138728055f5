"""Cubes grown from an example, every plane through which looks like it (Heeger & Bergen 1995, section 4), or drawn out
of one, under a signal along their third axis (section 6)."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from typing import NamedTuple

import numpy as np

from engine.numeric.pyramid import reduce
from engine.solids.cube_files import opaque
from engine.solids.solid_noise import Octaves, noise_at
from engine.texture import solid
from engine.texture.matching import Shape, analysed, matched_colours, matching, noise

GROWN_SIDE = 64  # voxels each way
_BEDS, _DARKEST = 9, 0.6  # of the signal along z: about so many in the cube, and how much light the darkest takes


class Grown(NamedTuple):
    """How much is done, 0..1; the cube, float32 (z, y, x, 3), once all is."""

    done: float
    cube: np.ndarray | None = None


def as_fine_as_voxels(picture: np.ndarray, side: int = GROWN_SIDE) -> np.ndarray:
    """Returns a picture (C, h, w) halved while it is at least four times as large as a cube: so that a cube has several
    of what the picture has many of, not a part of one."""
    while min(picture.shape[1:]) >= 4 * side:
        even = picture[:, : picture.shape[1] // 2 * 2, : picture.shape[2] // 2 * 2]
        picture = reduce(np.ascontiguousarray(even))
    return picture


def growing_cube(
    example: np.ndarray, seed: int, side: int = GROWN_SIDE, threads: Executor | None = None
) -> Iterator[Grown]:
    """Yields the steps that grow a cube from an example, float32 (1, 3 or 4, h, w) in 0..1; the last has it."""
    wanted = solid.patterns(example, side, Shape("steerable", 4, 4))
    start, cubes = solid.noise(wanted.oriented.colours.count, side, seed), None
    for step in solid.matching(wanted, start, solid.ITERATIONS, threads):
        cubes = step.planes
        yield Grown(0.999 * step.done)
    assert cubes is not None
    yield Grown(1.0, opaque(np.moveaxis(matched_colours(wanted.oriented, cubes), 0, -1)))


def drawn_cube(
    example: np.ndarray, seed: int, side: int = GROWN_SIDE, threads: Executor | None = None
) -> Iterator[Grown]:
    """Yields as `growing_cube` the steps to the outer product of an example, made seamless, with a signal along z: the
    picture on every slice, and grain or layers along all cuts across."""
    pattern = analysed(example, Shape("steerable", 4, 4).within((side, side)))
    start, planes = noise(pattern.colours.count, (side, side), seed), None
    for step in matching(pattern, start, threads=threads):
        planes = step.planes
        yield Grown(0.999 * step.done)
    assert planes is not None
    picture = np.moveaxis(matched_colours(pattern, planes), 0, -1)
    yield Grown(1.0, opaque(picture[None] * _signal(seed, side)[:, None, None, None]))


def _signal(seed: int, side: int) -> np.ndarray:
    """Returns light along z, float32 (side,): 1, less in beds that noise lays, the last before the first."""
    points = np.full((side, 3), 0.37)
    points[:, 2] = (np.arange(side) + 0.5) / side
    laid = np.clip(0.5 + 0.6 * noise_at(points, Octaves((1, 1, _BEDS), 0.6, 4), seed, 1.0 / side), 0.0, 1.0)
    return (1.0 - _DARKEST * laid).astype(np.float32)
