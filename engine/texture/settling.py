"""What is large in a cube of texture is settled by itself: the coarse subbands of whole sheaves of parallel planes.

A plane has a few samples of its coarsest subbands only, which go together by chance in planes whose neighbours are as
they should be; and planes that none of the cube's pyramids are made of may be blotchier than all that are.  The
coarse subbands of a whole sheaf of parallel planes are a rod in the spectrum of the cube, along the planes' normal.  So
little is worked on that there is time for sheaves across the three axes, the six diagonals of faces, and the four of
the cube.

The histograms are the example's (Heeger & Bergen 1995, section 4).  Each frequency moves by the mean of what those
planes want that see it as coarse.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from itertools import product

import numpy as np

from engine.numeric import histograms
from engine.numeric.steerable import Place, masks
from engine.texture.matching import Bands, Shape

_ALONG_AXES, _OBLIQUE = 2, 3  # the finest levels that are settled
_WEIGHTS = {1: 1.0, 2: 0.5, 3: 0.5}  # of sheaves, by the squared length of their normals
# Half of a change stays that goes to and fro so many times a voxel along the normal: without it, cubes have layers.
_LAYERS = 0.25
_LEAST = 2  # the finest level of which oblique planes, whose voxels are farther apart, have all frequencies


@dataclass(frozen=True, slots=True)
class Sheaf:
    """Parallel planes n . x = 0, 1, 2 ... of a cube: `normal` n of numbers -1, 0 and 1, not 0 at the axis `step`;
    `down` and `across`, of length 1, are how pictures lie on them."""

    normal: tuple[int, int, int]
    step: int
    down: np.ndarray
    across: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class Rod:
    """One level of the subbands of a sheaf: its `places` in the cube's spectrum, flat, int64 (n, h, w//2 + 1), first
    along the normal; its `masks` (K, h, w//2 + 1); the `size` (h, w) of its bands."""

    places: np.ndarray
    masks: np.ndarray
    size: tuple[int, int]
    level: int
    odd: bool
    weight: np.float32


def sheaves() -> Iterator[Sheaf]:
    """Across the axes, with rows and columns as the cube's own slices have them, and across all diagonals."""
    for normal in product((-1, 0, 1), (-1, 0, 1), (-1, 0, 1)):
        if normal > (0, 0, 0):
            unit = np.array(normal) / math.hypot(*normal)
            level = [axis for axis, v in enumerate(normal) if not v] or [2]
            across = np.eye(3)[level[-1]]
            across -= unit * (unit @ across)
            across /= math.hypot(*across)
            down = np.cross(across, unit)
            down *= np.sign(down[np.flatnonzero(np.abs(down) > 1e-9)[0]])
            yield Sheaf(normal, [abs(v) for v in normal].index(1), down, across)


class Settling:
    """What turns a cube of `side`, again and again, towards the coarse subbands of an example."""

    def __init__(self, side: int, shape: Shape) -> None:
        self._rods = list(_rods(side, shape))
        whole = np.zeros(side**3, np.float32)
        for rod in self._rods:
            whole[rod.places] += rod.weight * np.square(rod.masks).sum(axis=0) * _shares(rod.size)
        cube = whole.reshape(side, side, side)
        cube = cube + cube[np.ix_(*[-np.arange(side) % side] * 3)]
        self._share = np.float32(1.0) / np.maximum(cube, np.float32(1.0))

    def turn(self, cube: np.ndarray, bands: Bands, threads: Executor | None = None) -> None:
        """Moves a cube (n, n, n), in place, towards the example's `bands`."""
        from scipy.fft import fftn, ifftn

        spectrum = fftn(cube).reshape(-1)

        def change(rod: Rod) -> np.ndarray:
            return _changed(spectrum, rod, bands)

        whole = np.zeros_like(spectrum)
        found = map(change, self._rods) if threads is None else threads.map(change, self._rods)
        for rod, values in zip(self._rods, found, strict=True):
            whole[rod.places] += values
        way = whole.reshape(cube.shape)
        way *= self._share
        cube += ifftn(way, overwrite_x=True).real


def _rods(side: int, shape: Shape) -> Iterator[Rod]:
    for sheaf in sheaves():
        length = sum(v * v for v in sheaf.normal)
        first = min(_ALONG_AXES if length == 1 else _OBLIQUE, shape.levels)
        if length == 1 or first >= _LEAST:
            for level in range(first, shape.levels + 1):
                yield _rod(side, sheaf, level, shape, np.float32(_WEIGHTS[length]))


def _rod(side: int, sheaf: Sheaf, level: int, shape: Shape, weight: np.float32) -> Rod:
    n, step = sheaf.normal, sheaf.step
    first, second = (axis for axis in range(3) if axis != step)
    size = _size(side, math.hypot(n[step], n[first]), level), _size(side, math.hypot(n[step], n[second]), level)
    # Frequencies of the sheaf are those of the cube: k of the step along the normal, i and j along the other axes.
    k, i = np.arange(side)[:, None, None], _frequencies(size[0])[None, :, None]
    j = np.arange(size[1] // 2 + 1)[None, None]
    where = {step: n[step] * k, first: n[first] * k + i, second: n[second] * k + j}
    places = sum(where[axis] % side * side ** (2 - axis) for axis in range(3))
    rows, columns = (i[0] * axis[first] + j[0] * axis[second] for axis in (sheaf.down, sheaf.across))
    logarithm = np.log2(np.maximum(np.hypot(rows, columns) * (2.0 / side), 1e-9))
    made = masks(logarithm, np.arctan2(rows, columns), level, shape.levels, shape.orientations)
    made *= (2 * np.abs(i[0]) < size[0]) & (2 * j[0] < size[1])
    odd = level < shape.levels and shape.orientations % 2 == 0
    return Rod(np.asarray(places), made.astype(np.float32), size, level, odd, weight)


def _size(side: int, spread: float, level: int) -> int:
    """Samples along an axis of a band whose frequencies reach `spread` times as far as along a cube's axis."""
    return min(2 * math.ceil(-(-side >> level) * spread / 2.0), side)


def _frequencies(count: int) -> np.ndarray:
    places = np.arange(count)
    return np.where(places < -(-count // 2), places, places - count)


def _shares(size: tuple[int, int]) -> np.ndarray:
    """What part of a wave is at one of the two places where the whole spectrum has it: float32 (w//2 + 1,)."""
    return np.where(np.arange(size[1] // 2 + 1) > 0, np.float32(1.0), np.float32(0.5))


def _changed(spectrum: np.ndarray, rod: Rod, bands: Bands) -> np.ndarray:
    """What is to be added to a cube's spectrum at a rod's places for its bands to be those of the example; twice there
    for what is at none of the mirrored places."""
    from scipy.fft import fft, ifft, irfft2, rfft2

    planes = ifft(spectrum[rod.places], axis=0)
    scale = math.prod(rod.size) / round(spectrum.size ** (2.0 / 3.0))
    turn = 1j if rod.odd else 1.0
    whole = np.zeros_like(planes)
    for k, mask in enumerate(rod.masks):
        values = np.ascontiguousarray(irfft2(planes * (mask * np.complex64(scale * turn)), s=rod.size))
        matched = values.copy()
        histograms.match_rows(matched, bands[Place(rod.level, k)])
        matched -= values
        whole += rfft2(matched) * (mask * np.complex64(rod.weight / (scale * turn)))
    whole *= np.float32(2.0) * _shares(rod.size)
    return fft(whole, axis=0, overwrite_x=True) * _slowly(len(whole))[:, None, None]


def _slowly(side: int) -> np.ndarray:
    """Which part of a change stays, by its frequency along the normal, float32 (side,): neighbours change together."""
    away = np.abs(_frequencies(side)) / side
    return np.clip(2.5 - 2.0 * away / _LAYERS, 0.0, 1.0).astype(np.float32)
