"""Cubes grown from an example, every plane through which looks like it (Heeger & Bergen 1995, section 4)."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from typing import NamedTuple

import numpy as np

from engine.numeric.pyramid import reduce
from engine.solids.cube_files import opaque
from engine.texture import solid
from engine.texture.matching import Shape, matched_colours

GROWN_SIDE = 64  # voxels each way


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
