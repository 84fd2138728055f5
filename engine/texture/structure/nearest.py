"""Which of an example's patches is nearest to each place of a picture, all of them compared.

In the few directions that tell them apart most, and so that those that lie far from all places are not forgotten
(Granot et al. 2022): a distance counts the more, the nearer the patch comes to any place.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.kernel import Array, Real, dividing, kernel
from engine.numeric.matrices import combinations, products
from engine.numeric.sums import mean
from engine.texture.structure.patches import gathered, weights_of

_DIRECTIONS, _ROUNDS = 32, 3
_LOOKED_AT = 2048  # patches, by which directions are found
_COMPLETE = 0.05  # of the patches' variance: how near is so near that nearer is the same
_COMPARED = 6 << 20  # pairs of a place and a patch: where there would be more, patches are left out evenly
_DOMAIN = 0x70617463  # "patc"


class Patches:
    """The patches of an example (h, w, C), as places in a space of few directions; for pictures of so many `places`."""

    def __init__(self, example: np.ndarray, side: int, places: int) -> None:
        self.side, self._weights = side, weights_of(side)
        self._wide = example.shape[1] - side + 1
        found = gathered(example, side, False, self._weights)
        self._step = -(-found.shape[1] * places // _COMPARED)
        found = np.ascontiguousarray(found[:, :: self._step])
        self._middle = mean(found, axis=1, dtype=np.float64).astype(np.float32)[:, None]
        found -= self._middle
        self._directions = principal(np.ascontiguousarray(found[:, :: found.shape[1] // _LOOKED_AT + 1]))
        own = combinations(self._directions, found)
        self._sizes = _lengths(own)
        self._spread = float(mean(self._sizes))
        self._factors = np.ascontiguousarray(own.T) * np.float32(-2.0)

    def nearest(self, picture: np.ndarray, part: tuple[int, int]) -> np.ndarray:
        """Returns the sources (h, w, 2) of a picture (h, w, C) on a torus; which patches are forgotten is seen within
        each part of it, about as large as `part`."""
        height, width = picture.shape[:2]
        around = gathered(picture, self.side, True, self._weights) - self._middle
        there = combinations(self._directions, around).reshape(-1, height, width)
        out = np.empty((height, width, 2), np.int32)
        for rows in _parts(height, part[0]):
            for columns in _parts(width, part[1]):
                piece = there[:, rows, columns]
                which = self._step * self._best(np.ascontiguousarray(piece.reshape(len(piece), -1)))
                found = np.stack([which // self._wide, which % self._wide], axis=-1) + self.side // 2
                out[rows, columns] = found.reshape(*piece.shape[1:], 2)
        return out

    def _best(self, places: np.ndarray) -> np.ndarray:
        apart = combinations(self._factors, places)
        out = np.empty(places.shape[1], np.int64)
        least = np.float32(_COMPLETE * self._spread + 1e-12)
        _find(apart, self._sizes, _lengths(places), least, out)
        return out


def _parts(n: int, usual: int) -> list[slice]:
    count = max(1, round(n / usual))
    return [slice(k * n // count, (k + 1) * n // count) for k in range(count)]


def principal(patches: np.ndarray, most: int = _DIRECTIONS) -> np.ndarray:
    """Returns the directions (rows, few) along which patches (rows, n) vary most, as rows of length 1: float32."""
    count = min(most, len(patches))
    hashed = hash_plane(fold_key(_DOMAIN, 0), 0, 0, len(patches), count) >> np.uint64(40)
    out = hashed.astype(np.float32) * np.float32(2.0**-23) - np.float32(1.0)
    for _ in range(_ROUNDS):
        found = np.ascontiguousarray(products(combinations(out, patches), patches))
        _orthonormalise(found)
        out = found.astype(np.float32)
    return out


@kernel
def _lengths(places: Array) -> Array:
    """Returns the squares of the lengths of columns (d, n): float32."""
    out = np.zeros(places.shape[1], np.float32)
    for k in range(places.shape[0]):
        row = places[k]
        for i in range(out.size):
            out[i] += row[i] * row[i]
    return out


@dividing
def _find(apart: Array, sizes: Array, lengths: Array, least: Real, out: Array) -> None:
    """out (places,) = the nearest patch; apart (patches, places) holds -2 times the products of both."""
    best = np.empty(out.size, np.float32)
    best[:] = np.float32(3e38)
    out[:] = 0
    for k in range(sizes.size):
        row, size = apart[k], sizes[k]
        nearest = np.float32(3e38)
        for i in range(row.size):
            row[i] = max(row[i] + size + lengths[i], np.float32(0.0))
        for i in range(row.size):
            nearest = min(nearest, row[i])
        by = np.float32(1.0) / (nearest + least)
        for i in range(row.size):
            if row[i] * by < best[i]:
                best[i] = row[i] * by
                out[i] = k


@kernel
def _orthonormalise(rows: Array) -> None:
    """Makes each row upright on those before it, and of length 1."""
    for k in range(rows.shape[0]):
        for _ in range(2):
            for j in range(k):
                share = 0.0
                for i in range(rows.shape[1]):
                    share += rows[k, i] * rows[j, i]
                for i in range(rows.shape[1]):
                    rows[k, i] -= share * rows[j, i]
        size = 0.0
        for i in range(rows.shape[1]):
            size += rows[k, i] * rows[k, i]
        by = 1.0 / np.sqrt(size) if size > 1e-300 else 0.0
        for i in range(rows.shape[1]):
            rows[k, i] *= by
