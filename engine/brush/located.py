"""Textures that are fixed to a stroke, turning and running with it, or to its dabs.

Each pixel of the stroke knows its place in them, u and v, px of the stroke's level: that in the last dab which made at
least half of it.  Along a stroke u grows with the way, and v is how far a pixel lies to its right.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.brush.copies import Copies, Torus, each
from engine.brush.felt import PLACE_COLUMNS
from engine.brush.mask import StrokeMask
from engine.brush.print_form import Print
from engine.brush.tip import ways_of
from engine.numeric.address import Rect, TileKey

_SIDE = 64  # px of a texture that are worked out at once
_HALF = np.float32(0.5)

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
    u, v = places[0] - _HALF, places[1] - _HALF
    across, down = np.floor(u), np.floor(v)
    right, below = (u - across).ravel(), (v - down).ravel()
    x, y = across.astype(np.int64).ravel(), down.astype(np.int64).ravel()
    squares = (y // _SIDE << 32) + x // _SIDE
    order = np.argsort(squares, kind="stable")
    starts = np.flatnonzero(np.diff(squares[order], prepend=squares[order[0]] - 1))
    out: np.ndarray | None = None
    for group in np.split(order, starts[1:]):
        i, j = int(x[group[0]]) // _SIDE * _SIDE, int(y[group[0]]) // _SIDE * _SIDE
        seen = fetch(Rect.at(i, j, _SIDE + 1, _SIDE + 1))
        column, row, a, b = x[group] - i, y[group] - j, right[group], below[group]
        upper = seen[:, row, column] + (seen[:, row, column + 1] - seen[:, row, column]) * a
        lower = seen[:, row + 1, column] + (seen[:, row + 1, column + 1] - seen[:, row + 1, column]) * a
        if out is None:
            out = np.empty((len(seen), x.size), np.float32)
        out[:, group] = upper + (lower - upper) * b
    assert out is not None
    return out.reshape(len(out), *u.shape)


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
