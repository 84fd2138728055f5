"""Planes through solid textures, along two axes and at a slant, and flat textures to measure them by.

A plane shows the waves of a solid in projection: what it has of a frequency is the sum of the solid's power along a
line across it.  So planes at a slant, which all draw on the same waves, cannot have a spectrum that rises with
frequency, as sand's does: what is fine in the solid gives them more of what is large.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from scipy.ndimage import map_coordinates

from engine.texture import matching, solid
from engine.texture.matching import Shape, analysed, matched, matched_colours

DIRECTIONS, SHIFTS = 8, 4


def solid_of(example: np.ndarray, side: int, seed: int = 1) -> np.ndarray:
    """(C, side, side, side), as the program makes it."""
    wanted = solid.patterns(example, side, Shape())
    start = solid.noise(wanted.oriented.colours.count, side, seed)
    with ThreadPoolExecutor(2) as threads:
        *_, last = solid.matching(wanted, start, threads=threads)
    return matched_colours(wanted.oriented, last.planes)


def flat_of(example: np.ndarray, side: int, seed: int) -> np.ndarray:
    """The same in a plane, (C, side, side)."""
    pattern = analysed(example, Shape().within((side, side)))
    return matched_colours(pattern, matched(pattern, matching.noise(pattern.colours.count, (side, side), seed)))


def along_axes(cube: np.ndarray) -> Iterator[np.ndarray]:
    """All its planes that lie along two axes."""
    for axis in (1, 2, 3):
        for n in range(cube.shape[1]):
            yield np.ascontiguousarray(np.take(cube, n, axis))


def at_a_slant(cube: np.ndarray) -> Iterator[np.ndarray]:
    """Some in directions that have nothing to do with the axes, between voxels by cubic splines."""
    side = cube.shape[1]
    down, across = np.mgrid[:side, :side] - side / 2
    rng = np.random.default_rng(5)
    for _ in range(DIRECTIONS):
        normal, a, b = np.linalg.qr(rng.normal(size=(3, 3)))[0].T[:, :, None, None]
        for n in range(SHIFTS):
            places = a * across + b * down + normal * (n * side / SHIFTS)
            yield np.stack([map_coordinates(p, places, order=3, mode="grid-wrap") for p in cube]).astype(np.float32)


def pieces(example: np.ndarray, side: int) -> Iterator[np.ndarray]:
    """Pieces of flat textures of twice the size, cut out at a slant in the same way."""
    down, across = np.mgrid[:side, :side].astype(float)
    for seed in range(3):
        whole = flat_of(example, 2 * side, seed)
        for y in (0, side):
            for x in (0, side):
                cos, sin = np.cos(0.1 + seed), np.sin(0.1 + seed)
                places = np.stack([y + down * cos - across * sin, x + across * cos + down * sin])
                found = [map_coordinates(plane, places, order=3, mode="grid-wrap") for plane in whole]
                yield np.stack(found).astype(np.float32)
