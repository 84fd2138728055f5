"""Squares of what is drawn pixel by pixel, kept for a while: strokes, the screen and saves ask for the same ones.

The newest are in memory.  Those that took long to draw are put away on disk when their turn is over: a square of a
dear texture takes a second, and reading it a thousandth of that.
"""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from contextlib import suppress
from typing import Protocol

import numpy as np

from engine.numeric.address import TILE, Rect
from engine.numeric.recent import Recent

_KEPT = 64 << 20  # bytes of squares of all that is drawn
_LEAST = 32 << 20  # bytes that stay where memory is short: about what a stroke asks for, which may take seconds to make
_WORTH = 8  # of a square: what is asked for less of it is not kept
_DEAR = 0.02  # seconds of drawing from which on a square is put away before it is forgotten
_AWAY = 1 << 30  # bytes of squares on disk


class PutAway(Protocol):
    """Bytes that were put away."""

    def read(self) -> bytes:
        """Returns them.  OSError if they cannot be read, or are not what was put away."""
        ...


class KeptSquares(Recent[np.ndarray]):
    """Squares by what they show, float32.  Safe for several threads.

    `put`: puts bytes away on disk, None where there is no room; without it, squares are forgotten.
    """

    def __init__(self) -> None:
        super().__init__(lambda: _KEPT, _LEAST)
        self.put: Callable[[bytes], PutAway | None] | None = None
        self._dear = set[Hashable]()  # of those in memory
        self._away = OrderedDict[Hashable, tuple[PutAway, tuple[int, ...], int]]()
        self._held_away = 0

    def get(self, key: Hashable) -> np.ndarray | None:
        """Returns the square of a key, None if it is to be drawn."""
        found = super().get(key)
        return self._read_back(key) if found is None and key in self._away else found

    def keep_drawn(self, key: Hashable, square: np.ndarray, seconds: float) -> None:
        """Keeps a square that took so long to draw."""
        if seconds >= _DEAR:
            with self._lock:
                self._dear.add(key)
        self.keep(key, square, square.nbytes)

    def _let_go(self, forgotten: list[tuple[Hashable, np.ndarray]]) -> None:
        for key, square in forgotten:
            with self._lock:
                dear = key in self._dear and key not in self._away
                self._dear.discard(key)
            piece = self.put(square.tobytes()) if dear and self.put is not None else None
            if piece is not None:
                self._note(key, piece, square)

    def _note(self, key: Hashable, piece: PutAway, square: np.ndarray) -> None:
        with self._lock:
            self._away[key] = piece, square.shape, square.nbytes
            self._held_away += square.nbytes
            while self._held_away > _AWAY:
                self._lose(next(iter(self._away)))

    def _lose(self, key: Hashable) -> None:
        found = self._away.pop(key, None)
        self._held_away -= found[2] if found is not None else 0

    def _read_back(self, key: Hashable) -> np.ndarray | None:
        with self._lock:
            found = self._away.get(key)
            if found is None:
                return None
            self._away.move_to_end(key)
        piece, shape, nbytes = found
        with suppress(OSError):
            square = np.frombuffer(piece.read(), np.float32).reshape(shape)
            self.keep(key, square, nbytes)
            return square
        with self._lock:
            self._lose(key)
        return None


SQUARES = KeptSquares()


def from_squares(draw: Callable[..., np.ndarray], about: tuple[Hashable, ...], channels: int, rect: Rect) -> np.ndarray:
    """Returns what `draw(*about, rect)` does, float32 (channels, h, w), an array as new as that is.  It gives each
    pixel the same value in whatever rectangle."""
    small = 0 < rect.area * _WORTH < TILE * TILE
    if small and any(SQUARES.get((draw, about, square)) is None for _, square in _squares(rect)):
        return draw(*about, rect)  # in one piece
    out = np.empty((channels, rect.height, rect.width), np.float32)
    for piece, square in _squares(rect):
        found = _kept(draw, about, square, piece.area * _WORTH >= square.area)
        out[:, *piece.slices(rect)] = draw(*about, piece) if found is None else found[:, *piece.slices(square)]
    return out


def _squares(rect: Rect) -> Iterator[tuple[Rect, Rect]]:
    """Yields the pieces of a rectangle, each with the square of TILE pixels that it lies in."""
    for top in range(rect.y0 // TILE * TILE, rect.y1, TILE):
        for left in range(rect.x0 // TILE * TILE, rect.x1, TILE):
            square = Rect.at(left, top, TILE, TILE)
            yield rect.intersect(square), square


def _kept(draw: Callable[..., np.ndarray], about: tuple[Hashable, ...], square: Rect, worth: bool) -> np.ndarray | None:
    """Returns a square that is known, or is `worth` being drawn."""
    key = draw, about, square
    known = SQUARES.get(key)
    if known is None and worth:
        begun = time.thread_time()
        known = draw(*about, square)
        SQUARES.keep_drawn(key, known, time.thread_time() - begun)
    return known
