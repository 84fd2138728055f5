"""Ground: a picture laid down on an empty layer, as fast as its pixels can be reduced.

It is what the commit of an opaque edit makes on nothing.  There, rule U has no mismatch to keep: every coarser level
is the mean of the finer one, and every residual is v - expand(v above).  The picture stands for all these residuals:
a file that holds its pixels need not hold them, and those of the two finest levels, nearly all, are only made where
they are needed.  As long as nobody has painted on it, the values of these levels are the picture and its reduction.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable

import immutables
import numpy as np

from engine.canvas import kernels
from engine.canvas.compact import blank_found, compact
from engine.canvas.rising import counting
from engine.canvas.store import RECORD_OVERHEAD, Change, Ground, Level, PutAway, Pyramid, Record, level_of
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import FINE_STEP
from engine.numeric.parted import Raster, Room

Tile = Callable[[Rect], np.ndarray]
_COLOURS = np.arange(4)
_WHOLE = Rect(0, 0, TILE, TILE)
_DENSE = 1 << 22  # pixels of a level that are held in memory
_AT_ONCE = 1 << 18  # pixels of a larger one that are made at a time
_PIXELS = 1 << 16  # reduced at a time, so that all planes of them stay in the cache of the processor
_ALL = np.ones((TILE, TILE), np.uint8), np.full((TILE, 2), (0, TILE), np.int32)
_BYTES = 4 * TILE * TILE * 2  # of a whole tile's data, as a rule


def laid(tile: Tile, rect: Rect, pixels: bytes | PutAway | None = None, room: Room = np.empty) -> Pyramid:
    """Returns the pyramid of a picture that covers `rect` of level 0.

    `tile` gives its values over any part of `rect`: float32 (4, h, w), premultiplied, on the grid; always the same
    ones, as long as the pyramid is there.  `pixels`: the picture as a PNG, kept so that files can hold it in place of
    the residuals.  `room`: makes an array, or what takes its place, for the values of a level that has many.
    """
    levels: dict[int, Level] = {}
    picture = _Picture(tile, rect)
    half = _Reduced(picture)
    values: dict[int, Tile] = {0: picture.read, -1: half.read}
    below: _Picture = picture
    above: _Picture = half
    for level in itertools.count(0, -1):
        records = _records(below, above, level)
        if records:
            levels[level] = level_of(records)
        if isinstance(above, _Dense) and not above.values.any():
            break
        below, above = above, _next(above, room)
        if isinstance(below, _Spread):
            values[level - 1] = below.read
    if not levels:
        return Pyramid()
    stored = immutables.Map(levels)
    change = Change(max(levels), rect, None)
    if pixels is None:
        return Pyramid(stored, change)
    return Pyramid(stored, change, ground=Ground(rect, stored, pixels, values))


class _Picture:
    """The finest level, read part by part."""

    def __init__(self, tile: Tile, rect: Rect) -> None:
        self.rect = rect
        self._tile = tile

    def read(self, rect: Rect) -> np.ndarray:
        """Returns values over `rect`, zero outside the picture: float32 (4, h, w)."""
        part = rect.intersect(self.rect)
        if part == rect:
            return np.ascontiguousarray(self._tile(rect))
        out = np.zeros((4, rect.height, rect.width), np.float32)
        if not part.empty:
            rows, columns = part.slices(rect)
            out[:, rows, columns] = self._tile(part)
        return out

    def reduced(self, rect: Rect) -> _Dense:
        """Returns the level above, over `rect`, the parents of all pixels."""
        values = np.empty((4, rect.height, rect.width), np.float32)
        rows = max(_PIXELS // (2 * rect.width), 1)
        for y in range(rect.y0, rect.y1, rows):
            part = Rect(rect.x0, y, rect.x1, min(y + rows, rect.y1)).zoomed(1)
            kernels.halve(self.read(part), _COLOURS, values, y - rect.y0, 0, FINE_STEP)
        return _Dense(values, rect)


class _Reduced(_Picture):
    """The level above another one, worked out anew each time."""

    def __init__(self, finer: _Picture) -> None:
        super().__init__(lambda part: finer.reduced(part).values, finer.rect.evened().zoomed(-1))


class _Dense(_Picture):
    """A level, or a part of one, whole in memory."""

    def __init__(self, values: np.ndarray, rect: Rect) -> None:
        super().__init__(lambda part: values[:, *part.slices(rect)], rect)
        self.values = values


class _Spread(_Picture):
    """A level put away, (h, w, 4), where there is room for it."""

    def __init__(self, held: Raster, rect: Rect) -> None:
        super().__init__(lambda part: np.ascontiguousarray(held[part.slices(rect)].transpose(2, 0, 1)), rect)


def _next(finer: _Picture, room: Room) -> _Picture:
    """Returns the level above, held: in memory, or, if it is large, in `room`."""
    rect = finer.rect.evened().zoomed(-1)
    if rect.area <= _DENSE:
        return finer.reduced(rect)
    held, rows = room((rect.height, rect.width, 4), np.float32), max(_AT_ONCE // rect.width, 1)
    for y in range(rect.y0, rect.y1, rows):
        part = Rect(rect.x0, y, rect.x1, min(y + rows, rect.y1))
        held[y - rect.y0 : part.y1 - rect.y0] = finer.reduced(part).values.transpose(1, 2, 0)
    return _Spread(held, rect)


def _records(below: _Picture, above: _Picture, level: int) -> dict[tuple[int, int], Record]:
    """Returns all residuals of a level: v - expand(v above), where a pixel or a parent of it is painted."""
    records = {}
    data = np.empty((4, TILE, TILE), np.int32)
    put_off = {} if isinstance(below, _Dense) else _spanned(below, above)
    for key in below.rect.grown(2).tiles(level):
        if put_off.get((key.x, key.y)):
            records[key.x, key.y] = _later(below, key)
            continue
        record = _record(below, above, key, data)
        if record is not None:
            records[key.x, key.y] = record
    return records


def _record(below: _Picture, above: _Picture, key: TileKey, data: np.ndarray) -> Record | None:
    """Returns the residual of a tile; `data` int32 (4, 128, 128) is written to."""
    value, at = below.read(key.rect), key.rect.parents()
    if isinstance(above, _Dense) and at.intersect(above.rect) == at:
        coarse, top, left = above.values, at.y0 - above.rect.y0, at.x0 - above.rect.x0
    else:
        coarse, top, left = above.read(at), 0, 0
    found = blank_found(data)
    extent = counting.first_residual(value, (0, 0), coarse, (top, left), _COLOURS, _ALL, data, found, FINE_STEP)
    return compact(_WHOLE, data, (), 1, (extent, found[0]))


# ---- the finest levels ----


def _spanned(below: _Picture, above: _Picture) -> dict[tuple[int, int], bool]:
    """Returns the tiles whose residual certainly reaches all four of their sides, as their first and last rows show."""
    x0, x1 = below.rect.x0 // TILE, (below.rect.x1 - 1) // TILE + 1
    found = {}
    for y in range(below.rect.y0 // TILE, (below.rect.y1 - 1) // TILE + 1):
        first = _reached(below, above, Rect(x0 * TILE, y * TILE, x1 * TILE, y * TILE + 2))
        last = _reached(below, above, Rect(x0 * TILE, y * TILE + TILE - 2, x1 * TILE, y * TILE + TILE))
        columns = (first | last).any(axis=0).reshape(-1, TILE)
        rows = first[0].reshape(-1, TILE).any(axis=1) & last[1].reshape(-1, TILE).any(axis=1)
        for x, spans in enumerate((rows & columns[:, 0] & columns[:, -1]).tolist(), x0):
            found[x, y] = spans
    return found


def _reached(below: _Picture, above: _Picture, rect: Rect) -> np.ndarray:
    """Tells where the residual within an even rectangle is not zero: bool (h, w)."""
    value, coarse = below.read(rect), above.read(rect.parents())
    data, touched = np.empty(value.shape, np.int32), np.ones(value.shape[1:], np.uint8)
    marks = touched, np.full((rect.height, 2), (0, rect.width), np.int32)
    counting.first_residual(value, (0, 0), coarse, (0, 0), _COLOURS, marks, data, blank_found(data), FINE_STEP)
    return np.asarray(data.any(axis=0))


class _Later(Record):
    """A record of a whole tile whose data are made when they are first asked for, and kept."""

    __slots__ = ("source",)
    source: tuple[_Picture, TileKey]

    def __getattr__(self, name: str) -> np.ndarray:
        """Returns the data, while there are none."""
        if name != "held":
            raise AttributeError(name)
        whole, key = self.source
        at = key.rect.parents()
        below = _Dense(whole.read(at.zoomed(1)), at.zoomed(1))
        record = _record(below, below.reduced(at), key, np.empty((4, TILE, TILE), np.int32))
        assert record is not None
        assert record.rect == self.rect
        self.exchange(record.data)  # two threads may do so at a time: it is the same
        return record.data

    @property
    def there(self) -> bool:
        try:
            object.__getattribute__(self, "held")
        except AttributeError:
            return False
        return True

    @property
    def nbytes(self) -> int:
        return _BYTES + RECORD_OVERHEAD


def _later(picture: _Picture, key: TileKey) -> Record:
    record = object.__new__(_Later)
    for name, value in (("rect", _WHOLE), ("inks", ()), ("depth", 1), ("source", (picture, key))):
        object.__setattr__(record, name, value)
    return record


# ---- what is asked of it ----


def unchanged(pyramid: Pyramid, key: TileKey, record: Record) -> bool:
    """Tells whether a record is still the one that the layer's ground made."""
    ground = pyramid.ground
    if ground is None:
        return False
    stored = ground.levels.get(key.level)
    return stored is not None and stored.get((key.x, key.y)) is record
