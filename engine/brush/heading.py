"""Which way a stroke runs at each of its pixels, as written textures see it: one of sixteen ways."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from engine.numeric import elementary
from engine.numeric.address import TILE
from engine.texture.expression.written import STROKE_WAYS

_DIRECTIONS = np.array(
    [[turn(k * math.tau / STROKE_WAYS) for turn in (elementary.cos, elementary.sin)] for k in range(STROKE_WAYS)],
    np.float32,
)
_BORDER = np.float32(0.006)  # between two ways: half a degree to each side


class Ways(NamedTuple):
    """Of each pixel of a tile the numbers of the two ways that are nearest, int8 (128, 128), and how much the second
    one counts: float32, 0 but for a narrow border between them, where it comes to half."""

    first: np.ndarray
    second: np.ndarray
    share: np.ndarray

    def part(self, way: int) -> np.ndarray:
        """Returns how much each pixel goes one way: float32 (128, 128)."""
        out: np.ndarray = (self.first == way) * (np.float32(1.0) - self.share) + (self.second == way) * self.share
        return out

    def has(self, way: int) -> bool:
        """Tells whether any pixel goes one way."""
        return bool((self.first == way).any() or ((self.second == way) & (self.share > 0.0)).any())


def nearest_ways(told: np.ndarray | None) -> Ways:
    """Returns the ways that are nearest to what each pixel of a tile knows, float32 (2, 128, 128): the first one, to
    the right, where nothing is known."""
    first, second = np.zeros((TILE, TILE), np.int8), np.zeros((TILE, TILE), np.int8)
    best, next_ = np.zeros((TILE, TILE), np.float32), np.zeros((TILE, TILE), np.float32)
    for k, (across, down) in enumerate(_DIRECTIONS if told is not None else ()):
        assert told is not None
        near = told[0] * across + told[1] * down
        leads, follows = near > best, near > next_
        second = np.where(leads, first, np.where(follows, np.int8(k), second))
        next_ = np.where(leads, best, np.where(follows, near, next_))
        first, best = np.where(leads, np.int8(k), first), np.where(leads, near, best)
    share = np.float32(0.5) - (best - next_) / np.maximum(best * _BORDER, np.float32(1e-30))
    return Ways(first, second, np.where(best > 0.0, np.maximum(share, np.float32(0.0)), np.float32(0.0)))


FIRST_WAY = nearest_ways(None)  # where there is no stroke
