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

_LONG, _HIGH = 8, 6  # bits of the px of a piece of a texture: strokes are long
_PIECE = (1 << _LONG) + 1, (1 << _HIGH) + 1  # of which the last are the next one's first
_ZERO, _HALF = np.float32(0.0), np.float32(0.5)

_FEW = 64  # pieces for which there is room at first
_MEMO = 64  # pieces kept: 4 MB for each channel


class Patches:
    """A texture in pieces, which `fetch` makes, float32 (n, h, w), and which are kept."""

    def __init__(self, fetch: Callable[[Rect], np.ndarray]) -> None:
        self._fetch = fetch
        self._slots: dict[tuple[int, int], int] = {}
        self._made: np.ndarray | None = None

    def held(self, codes: np.ndarray) -> np.ndarray:
        """Returns pieces, float32 (m, n, h, w), not to be written to, and writes behind corners, (k, 3), which are
        theirs."""
        corners: list[tuple[int, int]] = [(x, y) for x, y, _ in codes.tolist()]
        if len(self._slots.keys() | set(corners)) > (_MEMO if self._made is None else len(self._made)):
            self._slots.clear()
            self._made = None
        made = self._made
        for i, corner in enumerate(corners):
            if corner not in self._slots:
                piece = self._fetch(Rect.at(*corner, *_PIECE))
                if made is None:
                    made = self._made = np.empty((max(_MEMO, len(corners)), *piece.shape), np.float32)
                made[len(self._slots)] = piece
                self._slots[corner] = len(self._slots)
            codes[i, 2] = self._slots[corner]
        assert made is not None
        return made


def located(places: np.ndarray, covered: np.ndarray, fetch: Patches) -> np.ndarray:
    """Returns a texture as it is seen at places, float32 (2, h, w), with straight lines between its pixels, where
    anything is `covered`, float32 (h, w); 0 elsewhere: float32 (n, h, w)."""
    codes, which = np.empty((_FEW, 3), np.int64), np.empty(covered.shape, np.int64)
    count = _pieces(places, covered, codes, which)
    if not count:
        return np.zeros((1, *covered.shape), np.float32)
    if count > len(codes):
        codes = np.empty((count, 3), np.int64)
        _pieces(places, covered, codes, which)
    made = fetch.held(codes[:count])
    out = np.empty((made.shape[1], *covered.shape), np.float32)
    _sample(places, covered, codes, which, made, out)
    return out


@kernel
def _pieces(places: Array, covered: Array, codes: Array, which: Array) -> Int:
    """Writes the corners of the pieces in which places lie, (k, 3), and in which of these each does, as far as there is
    room; returns how many there are."""
    count, last, left, top = 0, 0, 1, 1  # no corner
    for i in range(which.shape[0]):
        for j in range(which.shape[1]):
            if covered[i, j] == _ZERO:
                continue
            x = (math.floor(places[0, i, j] - _HALF) >> _LONG) << _LONG
            y = (math.floor(places[1, i, j] - _HALF) >> _HIGH) << _HIGH
            if x != left or y != top:
                last = 0
                while last < min(count, codes.shape[0]) and not (codes[last, 0] == x and codes[last, 1] == y):
                    last += 1
                if last >= codes.shape[0]:
                    count, left = count + 1, 1
                    continue
                if last == count:
                    codes[count, 0], codes[count, 1] = x, y
                    count += 1
                left, top = x, y
            which[i, j] = last
    return count


@kernel
def _sample(places: Array, covered: Array, codes: Array, which: Array, made: Array, out: Array) -> None:
    for i in range(which.shape[0]):
        for j in range(which.shape[1]):
            if covered[i, j] == _ZERO:
                for c in range(out.shape[0]):
                    out[c, i, j] = _ZERO
                continue
            k = which[i, j]
            u, v = places[0, i, j] - _HALF, places[1, i, j] - _HALF
            across, down = math.floor(u), math.floor(v)
            a, b = np.float32(u - across), np.float32(v - down)
            x, y = across - codes[k, 0], down - codes[k, 1]
            for c in range(out.shape[0]):
                plane = made[codes[k, 2], c]
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
