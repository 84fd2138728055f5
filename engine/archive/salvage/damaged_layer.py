"""A layer of which tiles are missing: its picture, as other programs see it, stands in for them.

The picture has 8 bits and one level.  A tile of that level or a coarser one that is missing gets a residual by which it
shows the picture, reduced; so does whatever else there shows something other than the picture.  All other tiles stay
as they are, so that levels coarser than what is missing are as they were, and finer ones keep what they add.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from engine.archive.grounds import with_tiles
from engine.archive.implied import Coded, restored
from engine.archive.imports import Pasted, pasted
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate
from engine.canvas.growth import Growth, meets
from engine.canvas.layers import Layer
from engine.canvas.reading import layer_planes
from engine.canvas.store import Pyramid, Record
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.colour import from_rgba8, from_rgba16, to_rgba8
from engine.numeric.grid import Q, snapped
from engine.numeric.pyramid import reduce

_WHOLE = Rect(0, 0, TILE, TILE)
ROUNDING = np.float32(1.02 / 255)  # of premultiplied values that have gone through straight ones of 8 bits
ROWS_AT_ONCE = 256  # of a picture that is made smaller


class Shown:
    """A picture, uint8 or uint16 RGBA (h, w, 4), and where it lies: `rect` of `level`."""

    def __init__(self, pixels: np.ndarray, rect: Rect, level: int = 0) -> None:
        self.pixels, self.rect, self.level = pixels, rect, level
        self._smaller: list[tuple[Rect, np.ndarray]] = []  # at the next coarser level and on

    def laid(self) -> Pyramid:
        """Returns a layer of nothing else."""
        if self.level == 0:
            return pasted(iter([self.pixels]), self.rect.x0, self.rect.y0)
        return commit(Pyramid(), Pasted(self.pixels, self.rect, self.level))

    def planes(self, level: int, rect: Rect) -> np.ndarray:
        """Returns what the picture is like over `rect` of its level or a coarser one: float32 (4, h, w) on the grid, 0
        outside it."""
        if level == self.level:
            part = rect.intersect(self.rect)
            pixels = np.ascontiguousarray(self.pixels[part.slices(self.rect)])
            return _padded((from_rgba16 if pixels.dtype == np.uint16 else from_rgba8)(pixels), part, rect)
        while len(self._smaller) < self.level - level:
            self._smaller.append(self._next())
        at, planes = self._smaller[self.level - level - 1]
        part = rect.intersect(at)
        return _padded(planes[:, *part.slices(at)], part, rect)

    def _next(self) -> tuple[Rect, np.ndarray]:
        """Returns the picture at the next coarser level, and the rectangle that it takes there."""
        finer, (at, _) = len(self._smaller), self._smaller[-1] if self._smaller else (self.rect, None)
        whole = at.evened()
        rows = range(whole.y0, whole.y1, ROWS_AT_ONCE)
        bands = (Rect(whole.x0, y, whole.x1, min(y + ROWS_AT_ONCE, whole.y1)) for y in rows)
        planes = [snapped(reduce(self.planes(self.level - finer, band))) for band in bands]
        return whole.zoomed(-1), np.concatenate(planes, axis=1)

    def is_same(self, seen: np.ndarray | None, rect: Rect) -> np.ndarray:
        """Tells where what a layer shows over `rect` of the picture's level, float32 (4, h, w), None for nothing, is
        what the picture does, as far as 8 bits tell: bool (h, w)."""
        wanted = self.planes(self.level, rect)
        seen = np.zeros_like(wanted) if seen is None else np.ascontiguousarray(seen)
        there = to_rgba8(wanted)
        near: np.ndarray = np.abs(wanted - seen).max(axis=0) <= ROUNDING
        same: np.ndarray = (there == to_rgba8(seen)).all(axis=-1) & (near | (there[..., 3] > 0))
        return same


@dataclass(frozen=True, eq=False, slots=True)
class Rest:
    """What is left of a layer's tiles: those that are whole, the places of those that are not, and how many these are,
    some of which may have had nothing in them."""

    tiles: Sequence[Coded]
    gone: Sequence[TileKey] = ()
    missing: int = 0


def rebuilt(ground: Pyramid, rest: Rest, growth: Growth = (), shown: Shown | None = None) -> Pyramid:
    """Returns a layer of the tiles that are whole, on the picture that it began with; `shown` stands in for others."""
    if shown is None:
        return _with(ground, rest.tiles)
    coarse = [tile for tile in rest.tiles if tile[0].level <= shown.level]
    pyramid = _with(ground, coarse)
    for key in sorted({key for key in rest.gone if key.level <= shown.level}):
        if not meets(growth, key.level, key.rect):
            pyramid = _showing(pyramid, key, shown)
    layer = Layer(1, "layer", pyramid=pyramid)
    for key in shown.rect.tiles(shown.level):
        part = key.rect.intersect(shown.rect)
        if meets(growth, shown.level, part):
            continue
        if not shown.is_same(layer_planes(layer, shown.level, part), part).all():
            pyramid = _showing(pyramid, key, shown)
    return _with(pyramid, [tile for tile in rest.tiles if tile[0].level > shown.level])


def _with(pyramid: Pyramid, tiles: Sequence[Coded]) -> Pyramid:
    levels: dict[int, dict[tuple[int, int], Record]] = {}
    for key, record, _ in tiles:
        levels.setdefault(key.level, {})[key.x, key.y] = record
    pyramid = with_tiles(pyramid, levels)
    restored(pyramid, tiles)
    return pyramid


def _showing(pyramid: Pyramid, key: TileKey, shown: Shown) -> Pyramid:
    """With a residual by which a tile shows the picture, where that lies; at the picture's own level only pixels that
    are others in 8 bits are changed."""
    part = key.rect.intersect(shown.rect.zoomed(key.level - shown.level))
    if part.empty:
        return pyramid
    rows, columns = part.slices(key.rect)
    wanted, old = shown.planes(key.level, part), _residual(pyramid, key)
    # Alpha is clamped where it is seen: without a residual of its own it is what the parents give.
    new = old.data.copy()
    new[3, rows, columns] = 0
    bare = evaluate(_with_record(pyramid, key, replace(old, held=new)), key.level, part).rgba
    new[:4, rows, columns] += np.rint((wanted - bare) / np.float32(Q)).astype(np.int32)
    if key.level == shown.level:
        same = shown.is_same(evaluate(pyramid, key.level, part).rgba, part)
        new[:4, rows, columns] = np.where(same, old.data[:4, rows, columns], new[:4, rows, columns])
    new.flags.writeable = False
    return _with_record(pyramid, key, replace(old, held=new))


def _residual(pyramid: Pyramid, key: TileKey) -> Record:
    """Returns the record of a tile, over all of it."""
    stored = pyramid.levels.get(key.level)
    old = None if stored is None else stored.get((key.x, key.y))
    data = np.zeros((4 if old is None else len(old.data), TILE, TILE), np.int32)
    if old is not None:
        data[:, *old.rect.slices(_WHOLE)] = old.data
    return Record(_WHOLE, data, () if old is None else old.inks, pyramid.depth)


def _with_record(pyramid: Pyramid, key: TileKey, record: Record) -> Pyramid:
    return with_tiles(pyramid, {key.level: {(key.x, key.y): record}})


def _padded(planes: np.ndarray, part: Rect, rect: Rect) -> np.ndarray:
    """Returns planes over `part` as planes over `rect`, 0 elsewhere: a new array."""
    out = np.zeros((4, rect.height, rect.width), np.float32)
    if not part.empty:
        out[:, *part.slices(rect)] = planes
    return out
