"""Squares of what is drawn pixel by pixel, kept for a while: strokes, the screen and saves ask for the same ones."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator

import numpy as np

from engine.numeric.address import TILE, Rect
from engine.numeric.recent import Recent

_KEPT = 64 << 20  # bytes of squares of all that is drawn
_LEAST = 32 << 20  # bytes that stay where memory is short: about what a stroke asks for, which may take seconds to make
_WORTH = 8  # of a square: what is asked for less of it is not kept

SQUARES: Recent[np.ndarray] = Recent(lambda: _KEPT, _LEAST)


def from_squares(draw: Callable[..., np.ndarray], about: tuple[Hashable, ...], channels: int, rect: Rect) -> np.ndarray:
    """Returns what `draw(*about, rect)` does, float32 (channels, h, w), an array as new as that is.  It gives each
    pixel the same value in whatever rectangle."""
    if 0 < rect.area * _WORTH < TILE * TILE:
        return draw(*about, rect)
    out = np.empty((channels, rect.height, rect.width), np.float32)
    for piece, square in _squares(rect):
        if piece.area * _WORTH >= square.area:
            out[:, *piece.slices(rect)] = _kept(draw, about, square)[:, *piece.slices(square)]
        else:
            out[:, *piece.slices(rect)] = draw(*about, piece)
    return out


def _squares(rect: Rect) -> Iterator[tuple[Rect, Rect]]:
    """Yields the pieces of a rectangle, each with the square of TILE pixels that it lies in."""
    for top in range(rect.y0 // TILE * TILE, rect.y1, TILE):
        for left in range(rect.x0 // TILE * TILE, rect.x1, TILE):
            square = Rect.at(left, top, TILE, TILE)
            yield rect.intersect(square), square


def _kept(draw: Callable[..., np.ndarray], about: tuple[Hashable, ...], square: Rect) -> np.ndarray:
    key = draw, about, square
    known = SQUARES.get(key)
    if known is None:
        known = draw(*about, square)
        SQUARES.keep(key, known, known.nbytes)
    return known
