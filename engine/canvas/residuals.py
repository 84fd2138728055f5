"""New residuals after a change: v' - expand(v' of the parents) - texture(ink'), on the pixels it touches.

Touched are the pixels that changed, and the children of every parent that changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

import numpy as np

from engine.canvas import kernels
from engine.canvas.attenuate import effective, placed
from engine.canvas.compact import compact
from engine.canvas.evaluate import add_texture, step
from engine.canvas.front import Front, Surroundings, widened
from engine.canvas.painted import Painted
from engine.canvas.store import Pyramid, Record
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, Planes, merged, plane_map
from engine.texture.sparse_planes import MANY, SparsePlanes

NewRecords = dict[TileKey, Record | None]


class _Same(Enum):
    """Stands for the record that a tile has: None says that it is to have none."""

    SAME = "same"


_SAME = _Same.SAME


class Parents:
    """The level above a change: its values before and after, and which of its pixels changed."""

    def __init__(self, above: Surroundings, front: Front | None) -> None:
        self.before = above
        self.after = _pasted(above, front)
        self.changed = np.zeros((above.rect.height, above.rect.width), np.uint8)
        if front is not None:
            part = np.empty_like(front.changed)
            kernels.differs(front.old.data, front.new.data, part)
            self.changed[front.rect.slices(above.rect)] = part

    def spread(self, rect: Rect, touched: np.ndarray) -> bool:
        """Mark the children of changed pixels in `touched`, uint8 over the even `rect`; whether any is marked now."""
        corner = rect.parents()
        out: bool = kernels.spread(
            self.changed, corner.y0 - self.before.rect.y0, corner.x0 - self.before.rect.x0, touched
        )
        return out


def store_painted(
    pyramid: Pyramid, painted: Sequence[Painted], parents: Parents, inside: Rect | None, records: NewRecords
) -> None:
    """Residuals of the edit's own level: of the painted tiles, and of the rims of their neighbours.

    Only tiles that meet `inside` are written (None: all).
    """
    tiles = {tile.key: tile for tile in painted}
    rims: dict[TileKey, Rect] = {}
    for key in tiles:
        reach = key.rect.grown(2)
        for beside in reach.tiles(key.level):
            if beside not in tiles:
                part = beside.rect.intersect(reach)
                rims[beside] = rims.get(beside, part).union(part)
    for key, tile in tiles.items():
        if inside is None or key.rect.meets(inside):
            touched = tile.changed.copy()
            parents.spread(key.rect, touched)
            _write(pyramid, key, key.rect, tile.new, touched, parents, records)
    for key, part in rims.items():
        touched = np.zeros((part.height, part.width), np.uint8)
        if (inside is None or key.rect.meets(inside)) and parents.spread(part, touched):
            before = parents.before
            value = step(pyramid, before.planes, before.rect, key.level, part)
            _write(pyramid, key, part, value, touched, parents, records)


def store_front(pyramid: Pyramid, front: Front, parents: Parents, inside: Rect | None, records: NewRecords) -> None:
    """Residuals of a coarser level; only tiles that meet `inside` are written (None: all)."""
    around = front.rect.grown(2)
    for key in around.tiles(front.level):
        if inside is not None and not key.rect.meets(inside):
            continue
        part = key.rect.intersect(around)
        touched = np.zeros((part.height, part.width), np.uint8)
        common = part.intersect(front.rect)
        if not common.empty:
            touched[common.slices(part)] = front.changed[common.slices(front.rect)]
        if parents.spread(part, touched):
            _write(pyramid, key, part, _value(pyramid, front, part, parents.before), touched, parents, records)


def _value(pyramid: Pyramid, front: Front, part: Rect, above: Surroundings) -> Planes:
    """Returns the new values of `part`: the front's inside its rectangle, the old ones elsewhere."""
    if part.intersect(front.rect) == part:
        return front.new.cut(*part.slices(front.rect))
    return _pasted(Surroundings(part, step(pyramid, above.planes, above.rect, front.level, part)), front)


def _pasted(around: Surroundings, front: Front | None) -> Planes:
    """Old values with a front's new ones in their place."""
    rect, whole = around.rect, around.planes
    common = Rect(0, 0, 0, 0) if front is None else front.rect.intersect(rect)
    if front is None or common.empty:
        return whole if whole is not None else Planes.empty(rect.height, rect.width)
    if whole is None:
        inks = front.new.inks
        out = Planes(np.zeros((COLOURS + 3 * len(inks), rect.height, rect.width), np.float32), inks)
    else:
        inks = merged(whole.inks, front.new.inks)
        out = widened(whole, inks)
        if out.data is whole.data:
            out = Planes(whole.data.copy(), inks)
    rows, columns = common.slices(rect)
    out.data[:, rows, columns] = widened(front.new.cut(*common.slices(front.rect)), inks).data
    return out


def _write(
    pyramid: Pyramid,
    key: TileKey,
    part: Rect,
    value: Planes | None,
    touched: np.ndarray,
    parents: Parents,
    records: NewRecords,
) -> None:
    shown = value if value is not None else Planes.empty(part.height, part.width)
    record = _record(pyramid, key, part, shown, touched, parents)
    if not isinstance(record, _Same):
        records[key] = record


def _record(
    pyramid: Pyramid, key: TileKey, part: Rect, value: Planes, touched: np.ndarray, parents: Parents
) -> Record | _Same | None:
    """Returns the new record of a tile whose values of `part` became `value`; `_SAME` if the one it has still holds."""
    stored = pyramid.levels.get(key.level)
    old = stored.get((key.x, key.y)) if stored is not None else None
    at, inks = part, merged(value.inks, parents.after.inks)
    if old is None and all(key.level <= ink.base for ink in inks):
        return _first_record(pyramid, key, part, widened(value, inks), touched, parents)
    if old is not None:
        old = effective(pyramid, key, old)
        if isinstance(old.held, SparsePlanes):
            return _sparse_record(pyramid, key, part, value, touched, parents, old.held)
        at, inks = part.union(placed(key, old.rect)), merged(inks, old.inks)
    value = widened(value, inks)
    predicted = _predicted(parents, part, value, key.level)
    data = np.zeros((COLOURS + 3 * len(inks), at.height, at.width), np.int32)
    if old is not None:
        rows, columns = placed(key, old.rect).slices(at)
        for c, source in enumerate(plane_map(old.inks, inks)):
            if source >= 0:
                data[c, rows, columns] = old.data[source]
    if not kernels.residual(value.data, predicted, touched, part.y0 - at.y0, part.x0 - at.x0, data):
        return _SAME
    x, y = key.x * TILE, key.y * TILE
    return compact(Rect(at.x0 - x, at.y0 - y, at.x1 - x, at.y1 - y), data, inks, pyramid.depth + 1)


def _sparse_record(
    pyramid: Pyramid, key: TileKey, part: Rect, value: Planes, touched: np.ndarray, parents: Parents, held: SparsePlanes
) -> Record | _Same | None:
    """As `_record` where many inks lie in the tile: those that do not meet `part` stay as they are."""
    x, y = key.x * TILE, key.y * TILE
    inner = Rect(part.x0 - x, part.y0 - y, part.x1 - x, part.y1 - y)
    inks = merged(value.inks, parents.after.inks, held.within(inner))
    value, data = widened(value, inks), held.over(inner, inks, np.int32)
    if not kernels.residual(value.data, _predicted(parents, part, value, key.level), touched, 0, 0, data):
        return _SAME
    new = held.replaced(inner, data, inks)
    if new is None:
        return None
    kept = tuple(new.inks)
    return Record(new.rect, new if len(kept) >= MANY else new.made(), kept, pyramid.depth + 1)


def _first_record(
    pyramid: Pyramid, key: TileKey, part: Rect, value: Planes, touched: np.ndarray, parents: Parents
) -> Record | _Same | None:
    """As `_record` where none was, and where no ink adds texture: nothing has to be made but the residual itself."""
    corner, above = part.parents(), parents.before.rect
    planes = plane_map(parents.after.inks, value.inks)
    data, used = np.empty(value.data.shape, np.int32), np.empty(len(value.data), np.int32)
    extent = kernels.first_residual(
        value.data, parents.after.data, corner.y0 - above.y0, corner.x0 - above.x0, planes, touched, data, used
    )
    if extent[0] == 0:
        return _SAME
    x, y = key.x * TILE, key.y * TILE
    inside = Rect(part.x0 - x, part.y0 - y, part.x1 - x, part.y1 - y)
    return compact(inside, data, value.inks, pyramid.depth + 1, (extent, used))


def _predicted(parents: Parents, part: Rect, value: Planes, level: int) -> np.ndarray:
    """Returns what expand and the ink make of `part` without a residual: float32 (4 + 3n, h, w)."""
    corner, above = part.parents(), parents.before.rect
    out = np.empty_like(value.data)
    planes = plane_map(parents.after.inks, value.inks)
    expand_into(parents.after.data, corner.y0 - above.y0, corner.x0 - above.x0, planes, out, 0, part.height)
    add_texture(out, value, level, part)
    return out
