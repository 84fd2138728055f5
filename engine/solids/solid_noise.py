"""Noise in three dimensions, by seed and place alone, that repeats after one unit along each axis.

Perlin 1985, with the weights of 2002: at each corner of a lattice a direction is drawn by a hash of its place, and the
noise between corners is what their planes give, faded.  Octaves are added until they are finer than what is asked for,
so a solid has detail however near it is looked at.  Sums and products only: the same bits on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.numeric.hashing import fold_key, mix64
from engine.numeric.kernel import inlined, kernel

_DOMAIN = 0x736F6E6F  # "sono": tells these hashes from those of other textures
_LEVELLED = 1.8  # brings the standard deviation of one octave near 0.33
_MOST_CELLS = 1 << 20  # along an axis: a place is a number of 21 bits


@dataclass(frozen=True, slots=True)
class Octaves:
    """Which noise: `cells` of the first octave along each axis (x, y, z), a whole number of them in one unit; how much
    of an octave the next has, `gain`; how many there are at most."""

    cells: tuple[int, int, int]
    gain: float = 0.5
    most: int = 24

    def count(self, finest: float) -> int:
        """Returns how many octaves have cells of at least twice `finest`, a length in units; at least 1."""
        found = 1
        while found < self.most and max(self.cells) << found < _MOST_CELLS:
            if max(self.cells) * 2.0**found * finest > 0.5:
                break
            found += 1
        return found


def noise_at(points: np.ndarray, octaves: Octaves, seed: int, finest: float) -> np.ndarray:
    """Noise around 0, mostly within -1..1, at points (N, 3) of x, y, z: float64 (N,).  Octaves finer than `finest` are
    left out."""
    out = np.zeros(len(points))
    count = octaves.count(finest)
    keys = np.array([fold_key(_DOMAIN, seed, octave) for octave in range(count)], np.uint64)
    if len(points):
        places = np.ascontiguousarray(points, np.float64)
        _add_octaves(places, keys, np.array(octaves.cells, np.int64), octaves.gain, out)
    out *= _LEVELLED
    return out


@kernel
def _add_octaves(points: np.ndarray, keys: np.ndarray, cells: np.ndarray, gain: float, out: np.ndarray) -> None:
    for n in range(points.shape[0]):
        total = 0.0
        weight = 1.0
        for octave in range(keys.size):
            nx, ny, nz = cells[0] << octave, cells[1] << octave, cells[2] << octave
            x, y, z = points[n, 0] * nx, points[n, 1] * ny, points[n, 2] * nz
            fx, fy, fz = np.floor(x), np.floor(y), np.floor(z)
            total += weight * _cell(keys[octave], (int(fx), int(fy), int(fz)), (nx, ny, nz), (x - fx, y - fy, z - fz))
            weight *= gain
        out[n] = total


@inlined
def _faded(t: float) -> float:
    """Returns the weight of the farther corner: its first and second derivatives vanish at 0 and 1."""
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0)


@kernel
def _cell(key: int, at: tuple[int, int, int], cells: tuple[int, int, int], inside: tuple[float, float, float]) -> float:
    """One octave at a place `inside` a cell, of which there are `cells` in a unit."""
    u, v, w = _faded(inside[0]), _faded(inside[1]), _faded(inside[2])
    total = 0.0
    for corner in range(8):
        i, j, k = corner & 1, (corner >> 1) & 1, corner >> 2
        x, y, z = (at[0] + i) % cells[0], (at[1] + j) % cells[1], (at[2] + k) % cells[2]
        h = mix64(np.uint64(key) ^ np.uint64(x | (y << 21)) ^ (np.uint64(z) << np.uint64(42)))
        dx, dy, dz = inside[0] - i, inside[1] - j, inside[2] - k
        # Three numbers of 16 bits, evenly in -1..1: their mean length does not matter, it is levelled.
        gx = (h & np.uint64(0xFFFF)) * 2.0**-15 - 1.0
        gy = ((h >> np.uint64(16)) & np.uint64(0xFFFF)) * 2.0**-15 - 1.0
        gz = ((h >> np.uint64(32)) & np.uint64(0xFFFF)) * 2.0**-15 - 1.0
        share = (u if i else 1.0 - u) * (v if j else 1.0 - v) * (w if k else 1.0 - w)
        total += share * (gx * dx + gy * dy + gz * dz)
    return total
