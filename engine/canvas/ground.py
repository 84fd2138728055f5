"""Ground: a picture laid down on an empty layer, as fast as its pixels can be reduced.

It is what the commit of an opaque edit makes on nothing.  There, rule U has no mismatch to keep: every coarser level
is the mean of the finer one, and every residual is v - expand(v above).  The picture stands for all these residuals:
a file that holds its pixels need not hold them.
"""

from __future__ import annotations

from collections.abc import Callable

import immutables
import numpy as np

from engine.canvas import kernels
from engine.canvas.compact import compact
from engine.canvas.store import Change, Ground, Level, Pyramid, Record
from engine.numeric.address import TILE, Rect, TileKey

Tile = Callable[[Rect], np.ndarray]
_COLOURS = np.arange(4)
_WHOLE = Rect(0, 0, TILE, TILE)


def laid(tile: Tile, rect: Rect, pixels: bytes | None = None, level: int = 0) -> Pyramid:
    """The pyramid of a picture that covers `rect` of `level`.

    `tile` gives its values over any part of `rect`: float32 (4, h, w), premultiplied, on the grid.  `pixels`: the
    picture as a PNG, kept so that files can hold it in place of the residuals.
    """
    levels: dict[int, Level] = {}
    below = _Picture(tile, rect)
    above = below.reduced(rect.evened().zoomed(-1))
    while True:
        records = _records(below, above, level)
        if records:
            levels[level] = immutables.Map(records)
        if not above.values.any():
            break
        level -= 1
        at = above.rect.evened()
        below, above = above, above.reduced(at.zoomed(-1))
    if not levels:
        return Pyramid()
    stored = immutables.Map(levels)
    change = Change(max(levels), rect, None, None)
    return Pyramid(stored, change, ground=None if pixels is None else Ground(rect, stored, pixels))


class _Picture:
    """The finest level: read tile by tile, twice."""

    def __init__(self, tile: Tile, rect: Rect) -> None:
        self.rect = rect
        self._tile = tile

    def read(self, rect: Rect) -> np.ndarray:
        """Values over `rect`, zero outside the picture: float32 (4, h, w)."""
        part = rect.intersect(self.rect)
        if part == rect:
            return self._tile(rect)
        out = np.zeros((4, rect.height, rect.width), np.float32)
        if not part.empty:
            rows, columns = part.slices(rect)
            out[:, rows, columns] = self._tile(part)
        return out

    def reduced(self, rect: Rect) -> _Dense:
        """The level above, over `rect`, the parents of all pixels."""
        values = np.zeros((4, rect.height, rect.width), np.float32)
        for key in rect.zoomed(1).tiles(0):
            part = key.rect.intersect(rect.zoomed(1))
            fine = np.ascontiguousarray(self.read(part))
            kernels.halve(fine, _COLOURS, values, (part.y0 >> 1) - rect.y0, (part.x0 >> 1) - rect.x0)
        return _Dense(values, rect)


class _Dense(_Picture):
    """A coarser level, whole in memory."""

    def __init__(self, values: np.ndarray, rect: Rect) -> None:
        super().__init__(lambda part: values[:, *part.slices(rect)], rect)
        self.values = values


def _records(below: _Picture, above: _Dense, level: int) -> dict[tuple[int, int], Record]:
    """All residuals of a level: v - expand(v above), where a pixel or a parent of it is painted."""
    records = {}
    touched = np.ones((TILE, TILE), np.uint8)
    data, used = np.empty((4, TILE, TILE), np.int32), np.empty(4, np.int32)
    for key in below.rect.grown(2).tiles(level):
        value, at = np.ascontiguousarray(below.read(key.rect)), key.rect.parents()
        if at.intersect(above.rect) == at:
            coarse, top, left = above.values, at.y0 - above.rect.y0, at.x0 - above.rect.x0
        else:
            coarse, top, left = np.ascontiguousarray(above.read(at)), 0, 0
        extent = kernels.first_residual(value, coarse, top, left, _COLOURS, touched, data, used)
        record = compact(_WHOLE, data, (), 1, (extent, used))
        if record is not None:
            records[key.x, key.y] = record
    return records


def unchanged(pyramid: Pyramid, key: TileKey, record: Record) -> bool:
    """Whether a record is still the one that the layer's ground made."""
    ground = pyramid.ground
    if ground is None:
        return False
    stored = ground.levels.get(key.level)
    return stored is not None and stored.get((key.x, key.y)) is record
