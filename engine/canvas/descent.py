"""The way down from levels far above a rectangle, of which most hold nothing there."""

from __future__ import annotations

from typing import Protocol

from engine.canvas.attenuate import placed
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect, TileKey
from engine.numeric.column import Clip, Column
from engine.texture.planes import Planes


class LevelDown(Protocol):
    """Returns one level down: the values of an even rectangle from its parents, which lie at `parent_at`."""

    def __call__(self, parent: Planes | None, parent_at: Rect, level: int, rect: Rect) -> Planes | None: ...


class Kept(Protocol):
    """Keeps values of clips: `engine.canvas.tile_cache.TileCache`."""

    def get(self, pyramid: Pyramid, key: TileKey | Clip) -> tuple[bool, Planes | None]:
        """Returns whether the values are known, and them."""
        ...

    def adopt(self, pyramid: Pyramid, key: TileKey | Clip, value: Planes | None) -> None:
        """Keeps values; nobody may write to them any more."""
        ...


def from_afar(pyramid: Pyramid, level: int, rect: Rect, kept: Kept | None, step: LevelDown) -> Planes | None:
    """Returns the values of an even rectangle, None where nothing lies, from the coarsest level on, or from what was
    kept the last time.

    Levels that hold nothing there are gone through only until they change nothing any more.
    """
    column = Column(rect)
    here, value, stops = _begin(pyramid, level, column, kept)
    for k in stops:
        value = _sunk(value, column, level, (here, k - 1), step)
        value = step(value, column.at(level - k + 1), k, column.at(level - k))
        here = k
        if kept is not None and k < level:
            kept.adopt(pyramid, Clip(k, column.at(level - k)), value)
    if here == level:
        return value
    value = _sunk(value, column, level, (here, level - 1), step)
    return step(value, column.at(1), level, rect)


def _begin(pyramid: Pyramid, level: int, column: Column, kept: Kept | None) -> tuple[int, Planes | None, list[int]]:
    """Returns the nearest level with values that were kept, those values, and the levels below it that hold something,
    downwards.  Where nothing was kept, it is the level above all of these, without a value."""
    stops: list[int] = []
    for k in sorted((k for k in pyramid.levels if k <= level), reverse=True):
        rect = column.at(level - k)
        if not any(placed(key, record.rect).meets(rect) for key, record in pyramid.records(k, rect)):
            continue
        if kept is not None and k < level:
            known, value = kept.get(pyramid, Clip(k, rect))
            if known:
                return k, value, stops[::-1]
        stops.append(k)
    return min(stops, default=level) - 1, None, stops[::-1]


def _sunk(value: Planes | None, column: Column, level: int, span: tuple[int, int], step: LevelDown) -> Planes | None:
    """Returns what values of the first level of a span come to at its last, where none of the others holds anything;
    `column` begins at `level`, below all of these."""
    first, last = span
    for k in range(first + 1, last + 1):
        if value is None:
            return None
        up = level - k
        new = step(value, column.at(up + 1), k, column.at(up))
        if new is not None and new.inks == value.inks and all(ink.base >= last for ink in new.inks):
            still = column.still(value.data, new.data, up, level - last)
            if still is not None:
                return Planes(still, new.inks)
        value = new
    return value
