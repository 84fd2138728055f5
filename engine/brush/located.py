"""Textures that are fixed to a stroke, turning and running with it, or to its dabs.

Each pixel of the stroke knows its place in them, u and v, px of the stroke's level: that in the last dab which made at
least half of it.  Along a stroke u grows with the way, and v is how far a pixel lies to its right.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from engine.brush.copies import Copies, Torus, each
from engine.brush.felt import PLACE_COLUMNS
from engine.brush.mask import StrokeMask
from engine.brush.print_form import Print
from engine.brush.tip import ways_of
from engine.numeric.address import Rect, TileKey
from engine.numeric.kernel import Array, Int, kernel

_SIDE = 64  # px of a texture that are worked out at once
_HALF = np.float32(0.5)

_FEW = 64  # squares for which there is room at first
_MEMO = 256  # squares kept: 4 MB for each channel


class Patches:
    """A texture over rectangles, float32 (n, h, w), that are kept."""

    def __init__(self, fetch: Callable[[Rect], np.ndarray]) -> None:
        self._fetch = fetch
        self._memo: dict[Rect, np.ndarray] = {}

    def __call__(self, rect: Rect) -> np.ndarray:
        """Returns it over one, not to be written to."""
        known = self._memo.get(rect)
        if known is None:
            while len(self._memo) >= _MEMO:
                self._memo.pop(next(iter(self._memo)), None)
            known = self._memo[rect] = self._fetch(rect)
        return known


def located(places: np.ndarray, fetch: Patches) -> np.ndarray:
    """Returns a texture as it is seen at places, float32 (2, h, w), with straight lines between its pixels: float32
    (n, h, w)."""
    codes, which = np.empty((_FEW, 2), np.int64), np.empty(places.shape[1:], np.int64)
    count = _squares(places, codes, which)
    if count > len(codes):
        codes = np.empty((count, 2), np.int64)
        _squares(places, codes, which)
    seen = np.stack([fetch(Rect.at(x, y, _SIDE + 1, _SIDE + 1)) for x, y in codes[:count].tolist()])
    out = np.empty((seen.shape[1], *which.shape), np.float32)
    _sample(places, codes, which, seen, out)
    return out


@kernel
def _squares(places: Array, codes: Array, which: Array) -> Int:
    """Writes the corners of the squares in which places lie, (k, 2), and in which of these each does, as far as there
    is room; returns how many there are."""
    count, last = 0, 0
    for i in range(which.shape[0]):
        for j in range(which.shape[1]):
            x = math.floor(places[0, i, j] - _HALF) // _SIDE * _SIDE
            y = math.floor(places[1, i, j] - _HALF) // _SIDE * _SIDE
            if last < count and codes[last, 0] == x and codes[last, 1] == y:
                which[i, j] = last
                continue
            last = 0
            while last < min(count, codes.shape[0]) and not (codes[last, 0] == x and codes[last, 1] == y):
                last += 1
            if last >= codes.shape[0]:
                count, last = count + 1, 0
                continue
            if last == count:
                codes[count, 0], codes[count, 1] = x, y
                count += 1
            which[i, j] = last
    return count


@kernel
def _sample(places: Array, codes: Array, which: Array, seen: Array, out: Array) -> None:
    for i in range(which.shape[0]):
        for j in range(which.shape[1]):
            k = which[i, j]
            u, v = places[0, i, j] - _HALF, places[1, i, j] - _HALF
            across, down = math.floor(u), math.floor(v)
            a, b = np.float32(u - across), np.float32(v - down)
            x, y = across - codes[k, 0], down - codes[k, 1]
            for c in range(out.shape[0]):
                plane = seen[k, c]
                upper = plane[y, x] + (plane[y, x + 1] - plane[y, x]) * a
                lower = plane[y + 1, x] + (plane[y + 1, x + 1] - plane[y + 1, x]) * a
                out[c, i, j] = upper + (lower - upper) * b


class PlacedMask(StrokeMask):
    """The coverage of a stroke whose dabs say where their textures lie; in its copies these are turned and mirrored."""

    def __init__(
        self, place: tuple[int, tuple[int, int]], tip: Print, copies: Copies | Torus, columns: int | None
    ) -> None:
        """`columns`: of a dab after those that say it, None where none do."""
        super().__init__(*place, tip=tip, each=each(copies))
        told = ways_of(copies.copies if isinstance(copies, Torus) else copies)
        self._ways = np.repeat(told.reshape(-1, 2, 2), each(copies) // len(told), axis=0)
        self._columns = columns

    def paint(self, dabs: np.ndarray) -> set[TileKey]:
        """As `StrokeMask.paint`."""
        if self._columns is not None and len(self._ways) > 1:
            first = dabs.shape[1] - self._columns - PLACE_COLUMNS
            (a, b), (c, d) = self._ways[(self._laid + np.arange(len(dabs))) % len(self._ways)].transpose(1, 2, 0)
            dabs, own = dabs.copy(), dabs[:, first : first + 4].T
            turned = own[0] * a + own[1] * c, own[0] * b + own[1] * d, own[2] * a + own[3] * c, own[2] * b + own[3] * d
            dabs[:, first : first + 4] = np.stack(turned, axis=1)
        return super().paint(dabs)
