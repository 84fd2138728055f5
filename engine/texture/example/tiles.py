"""Planes over the unbounded plane as values: what was is kept by whoever holds it, and tiles that did not change are
the same objects, so that what changed is found by comparing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from immutables import Map

from engine.numeric.address import Rect
from engine.numeric.kernel import kernel

TILE_SIDE = 64  # pixels along a tile
Key = tuple[int, int]  # row and column of a tile, of any size
_LAST = slice(-1, None)
_OVERHEAD = 180  # bytes of a tile's own objects, roughly


class CodedPlanes(Protocol):
    """Planes of a tile in fewer bytes."""

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that they take."""
        ...

    def made(self) -> np.ndarray:
        """Returns the planes, read-only."""
        ...


@dataclass(frozen=True, eq=False, slots=True)
class TilePlanes:
    """The planes of one tile; `held`: these, or what they are made of."""

    held: np.ndarray | CodedPlanes

    @property
    def data(self) -> np.ndarray:
        """Gives them, read-only: (planes, TILE_SIDE, TILE_SIDE)."""
        held = self.held
        return held if isinstance(held, np.ndarray) else held.made()

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that the tile takes."""
        return self.held.nbytes + _OVERHEAD

    def exchange(self, held: np.ndarray | CodedPlanes) -> None:
        """Holds the same planes in another form.  Other threads may read them meanwhile."""
        object.__setattr__(self, "held", held)


Tiles = Map[Key, TilePlanes]  # a tile that is not there is empty
NONE: Tiles = Map()


def sealed(planes: np.ndarray) -> TilePlanes:
    """Returns a tile of planes that nobody writes to any more."""
    planes.flags.writeable = False
    return TilePlanes(planes)


def keys_of(rect: Rect) -> Iterator[Key]:
    """Yields the tiles that meet a rectangle, row by row."""
    if rect.empty:
        return
    for row in range(rect.y0 // TILE_SIDE, (rect.y1 - 1) // TILE_SIDE + 1):
        for column in range(rect.x0 // TILE_SIDE, (rect.x1 - 1) // TILE_SIDE + 1):
            yield row, column


def rect_of(key: Key) -> Rect:
    """Gives the pixels that a tile covers."""
    return Rect.at(key[1] * TILE_SIDE, key[0] * TILE_SIDE, TILE_SIDE, TILE_SIDE)


def hull(tiles: Tiles) -> Rect:
    """Returns the smallest rectangle around all tiles."""
    if not tiles:
        return Rect(0, 0, 0, 0)
    rows, columns = zip(*tiles, strict=True)
    return Rect(
        min(columns) * TILE_SIDE, min(rows) * TILE_SIDE, (max(columns) + 1) * TILE_SIDE, (max(rows) + 1) * TILE_SIDE
    )


def _shared(rect: Rect) -> Iterator[tuple[Key, tuple[slice, slice], tuple[slice, slice]]]:
    """Yields the tiles that meet a rectangle, and where what they share lies in the rectangle and in the tile."""
    if rect.empty:
        return
    for row in range(rect.y0 // TILE_SIDE, -(-rect.y1 // TILE_SIDE)):
        top = row * TILE_SIDE
        y0, y1 = max(top, rect.y0), min(top + TILE_SIDE, rect.y1)
        outer, inner = slice(y0 - rect.y0, y1 - rect.y0), slice(y0 - top, y1 - top)
        for column in range(rect.x0 // TILE_SIDE, -(-rect.x1 // TILE_SIDE)):
            left = column * TILE_SIDE
            x0, x1 = max(left, rect.x0), min(left + TILE_SIDE, rect.x1)
            yield (row, column), (outer, slice(x0 - rect.x0, x1 - rect.x0)), (inner, slice(x0 - left, x1 - left))


def gathered(tiles: Tiles, rect: Rect, out: np.ndarray) -> np.ndarray:
    """Copies what tiles hold of a rectangle into `out` (planes, h, w), and leaves the rest of it alone."""
    for key, outer, inner in _shared(rect):
        tile = tiles.get(key)
        if tile is not None:
            out[:, *outer] = tile.data[:, *inner]
    return out


def gathered_last(tiles: Tiles, rect: Rect, out: np.ndarray) -> np.ndarray:
    """Returns the same with the last plane of each tile alone; `out` (1, h, w)."""
    for key, outer, inner in _shared(rect):
        tile = tiles.get(key)
        if tile is not None:
            out[0, *outer] = tile.data[-1, *inner]
    return out


def laid(tiles: Tiles, rect: Rect, values: np.ndarray, empty: int, within: Rect) -> Tiles:
    """With `values` (planes, h, w), which cover `rect`, laid on the part `within` of it.

    Tiles that keep their values stay the same objects, and so do `tiles` if all do; those that are wholly `empty` are
    left out.
    """
    changing, altered = tiles.mutate(), False
    given = values[(slice(None), *within.slices(rect))]
    for key, outer, inner in _shared(within):
        new, there = given[:, *outer], tiles.get(key)
        old = None if there is None else there.data
        if old is not None and (old[:, *inner] == new).all():
            continue
        blank = (new == empty).all()
        if old is None and blank:
            continue
        altered = True
        tile = np.full((len(values), TILE_SIDE, TILE_SIDE), empty, values.dtype) if old is None else old.copy()
        tile[:, *inner] = new
        if blank and (tile == empty).all():
            changing.pop(key, None)
        else:
            changing[key] = sealed(tile)
    return changing.finish() if altered else tiles


def changed(old: Tiles, new: Tiles) -> set[Key]:
    """Returns the tiles that differ."""
    if old is new:
        return set()
    keys = {key for key, tile in new.items() if old.get(key) is not tile}
    keys.update(key for key in old if key not in new)
    return keys


def changed_rect(old: Tiles, new: Tiles, empty: int) -> Rect:
    """Returns the smallest rectangle around what differs, in the last of the planes."""
    found = Rect(0, 0, 0, 0)
    for rect in changed_rects(old, new, empty):
        found = found.union(rect)
    return found


def changed_rects(old: Tiles, new: Tiles, empty: int, planes: slice = _LAST) -> Iterator[Rect]:
    """Yields what differs in each tile, in the last of the planes or in those named: the smallest rectangle around
    it."""
    nothing = None
    for key in changed(old, new):
        before, after = old.get(key), new.get(key)
        one, other = (None if tile is None else tile.data for tile in (before, after))
        if one is None or other is None:
            there = one if one is not None else new[key].data
            if nothing is None:
                nothing = np.full(there.shape, empty, there.dtype)
                nothing.flags.writeable = False  # as tiles are: so the kernel is compiled once for each type
            one, other = (nothing, there) if one is None else (there, nothing)
        y0, y1, x0, x1 = _differing(one[planes], other[planes])
        if y1 > y0:
            x, y = key[1] * TILE_SIDE, key[0] * TILE_SIDE
            yield Rect(x + x0, y + y0, x + x1, y + y1)


@kernel
def bounds(planes: np.ndarray) -> tuple[int, int, int, int]:
    """Returns rows [0, 1) and columns [2, 3) outside which arrays (planes, h, w) are 0; empty ones if all of it is."""
    y0, y1, x0, x1 = planes.shape[1], 0, planes.shape[2], 0
    for c in range(planes.shape[0]):
        for y in range(planes.shape[1]):
            row, first, last = planes[c, y], 0, planes.shape[2]
            while first < last and row[first] == 0:
                first += 1
            if first == last:
                continue
            while row[last - 1] == 0:
                last -= 1
            y0, y1 = min(y0, y), max(y1, y + 1)
            x0, x1 = min(x0, first), max(x1, last)
    return (y0, y1, x0, x1) if y1 > y0 else (0, 0, 0, 0)


@kernel
def _differing(one: np.ndarray, other: np.ndarray) -> tuple[int, int, int, int]:
    """Returns rows [0, 1) and columns [2, 3) within which two arrays (planes, h, w) of tiles differ; none if they do
    not."""
    y0, y1, x0, x1 = TILE_SIDE, 0, TILE_SIDE, 0
    for c in range(one.shape[0]):
        for y in range(TILE_SIDE):
            first, last = 0, TILE_SIDE
            while first < TILE_SIDE and one[c, y, first] == other[c, y, first]:
                first += 1
            if first == TILE_SIDE:
                continue
            while one[c, y, last - 1] == other[c, y, last - 1]:
                last -= 1
            y0, y1 = min(y0, y), max(y1, y + 1)
            x0, x1 = min(x0, first), max(x1, last)
    return y0, y1, x0, x1
