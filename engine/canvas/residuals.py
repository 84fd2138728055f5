"""New residuals after a change: v' - expand(v' of the parents) - texture(ink'), on the pixels it touches.

Touched are the pixels that changed, and the children of every parent that changed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise

import numpy as np

from engine.canvas.attenuate import effective, placed
from engine.canvas.compact import compact, trimmed
from engine.canvas.evaluate import add_texture, step
from engine.canvas.front import Around, Patch
from engine.canvas.rising import counting
from engine.canvas.rising.risen import Risen, Touched
from engine.canvas.store import Pyramid, Record, Since
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, merged, plane_map, widened
from engine.texture.record import Instance
from engine.texture.sparse_planes import MANY, SparsePlanes

_SHORT = 2  # bytes of int16
NewRecords = dict[TileKey, Record | None]


class _Told(Enum):
    """Told in place of a record: None says that a tile is to have none."""

    SAME = "the one that it has"
    LARGE = "one that int16 does not hold"


_SAME = _Told.SAME


def store(
    pyramid: Pyramid,
    patches: Sequence[Patch],
    here: Around | None,
    above: Sequence[Risen],
    inside: Callable[[int], Rect] | None,
    records: NewRecords,
    beside: Mapping[TileKey, Around],
) -> None:
    """Residuals of a level, and of those above it but the last: of what changed, and of the children of what changed
    above.

    `here` has the level's new values; None for an edit's own, whose patches are whole tiles, and then `beside` has
    those of tiles beside them.  Only tiles that meet `inside`, so many levels above, are written (None: all).
    """
    values = {patch.key: Around(patch.key.level, patch.at, patch.new) for patch in patches} | dict(beside)
    touched = Touched.of_patches(patches, above[0])
    _store(pyramid, touched, values if here is None else here, above[0].around, inside and inside(0), records)
    for n, (level, coarser) in enumerate(pairwise(above), 1):
        touched = Touched.of_level(level, coarser)
        _store(pyramid, touched, level.around, coarser.around, inside and inside(n), records)


def _store(
    pyramid: Pyramid,
    touched: Touched,
    new: Mapping[TileKey, Around] | Around,
    above: Around,
    inside: Rect | None,
    records: NewRecords,
) -> None:
    """Residuals of one level, where they are touched."""
    for key, part in touched.tiles():
        value = new if isinstance(new, Around) else new.get(key)
        if value is None or not (inside is None or key.rect.meets(inside)):
            continue
        record = _record(pyramid, _Renewed(key, part, touched, value, above, pyramid.depth + 1, pyramid.step))
        if not isinstance(record, _Told):
            records[key] = record


def values_beside(
    pyramid: Pyramid, patches: Sequence[Patch], above: Around, cache: TileCache | None
) -> dict[TileKey, Around]:
    """Returns the values of an edit's level beside its patches, in tiles that it leaves as they are, where what it
    makes of the level above, whose old values are given, can change residuals."""
    parts: dict[TileKey, Rect] = {}
    known = {patch.key for patch in patches}
    for patch in patches:
        reach = patch.dirty.evened().grown(2)
        if reach.intersect(patch.key.rect) != reach:
            for key in reach.tiles(patch.key.level):
                if key not in known:
                    part = reach.intersect(key.rect)
                    parts[key] = part if key not in parts else parts[key].union(part)
    return {key: _there(pyramid, key, part, above, cache) for key, part in parts.items()}


def _there(pyramid: Pyramid, key: TileKey, part: Rect, above: Around, cache: TileCache | None) -> Around:
    """Returns the values of a part of a tile at least, given those above."""
    there, value = cache.view(pyramid, key) if cache is not None else (False, None)
    if there:
        return Around(key.level, key.rect, value)
    return Around(key.level, part, step(pyramid, above.planes, above.rect, key.level, part))


@dataclass(eq=False, slots=True)  # not frozen: one is made for each tile, which takes three times as long then
class _Renewed:
    """What is renewed of a tile: its residual in the even rectangle `part`, where it is `touched`; `new` has the new
    values there, `above` those of the level above."""

    key: TileKey
    part: Rect
    touched: Touched
    new: Around
    above: Around
    depth: int  # of the new record
    unit: np.float32  # the step of the values' grid
    spans: np.ndarray | None = None  # of the rows of `part`, uint8 (h, 2), where they are told already

    def within(self, at: Rect) -> Rect:
        """Returns a rectangle of the level from the tile's corner."""
        x, y = self.key.x * TILE, self.key.y * TILE
        return Rect(at.x0 - x, at.y0 - y, at.x1 - x, at.y1 - y)

    def textured(self, inks: Sequence[Instance]) -> bool:
        """Tells whether any ink adds texture."""
        return any(self.key.level > ink.base for ink in inks)


def _record(pyramid: Pyramid, it: _Renewed) -> Record | _Told | None:
    """Returns the new record of a tile; `_SAME` if the one it has still holds."""
    stored = pyramid.levels.get(it.key.level)
    before = stored.get((it.key.x, it.key.y)) if stored is not None else None
    if before is None:
        return _dense_record(it, None)
    old = effective(pyramid, it.key, before)
    sheets = old.sheets
    record = _dense_record(it, old) if sheets is None else _sparse_record(it, sheets)
    if old is before and isinstance(record, Record):
        spans = it.touched.spans(it.key, it.part) if it.spans is None else it.spans
        record.came_from(Since.it(before, it.within(it.part), spans))
    return record


def _dense_record(it: _Renewed, old: Record | None) -> Record | _Told | None:
    """As `_record`, where few inks lie in the tile."""
    inks = merged(it.new.with_inks(()).inks, it.above.with_inks(()).inks, () if old is None else old.inks)
    if len(inks) < MANY and not it.textured(inks) and (old is None or old.held.itemsize == _SHORT):
        record = _renewed(it, old, inks)
        if record is not _Told.LARGE:
            return record
    return _from_data(it, old, inks)


def _from_data(it: _Renewed, old: Record | None, inks: tuple[Instance, ...]) -> Record | _Told | None:
    """As `_record`, whatever there is."""
    at = it.part if old is None else it.part.union(placed(it.key, old.rect))
    read = _read(it.new, it.part, inks)
    predicted = _predicted(it, read)
    data, used = _unpacked(old, it.within(at), inks), np.empty(COLOURS + 3 * len(inks), np.int32)
    assert read.planes is not None
    start, corner = _corner(it.part, read.rect), _corner(it.part, at)
    touched = it.touched.within(it.part)
    changed, *extent = counting.residual(read.planes.data, start, predicted, touched, corner, data, used, it.unit)
    if not changed:
        return _SAME
    bits, y0, y1, x0, x1 = extent
    return compact(it.within(at), data, inks, it.depth, ((bits, y0, y1, x0, x1), used))


def _unpacked(old: Record | None, at: Rect, inks: tuple[Instance, ...], kind: type = np.int32) -> np.ndarray:
    """Returns a record's data over a rectangle of its tile, with these inks: new."""
    if old is not None and old.rect == at and old.inks == inks:
        return old.data.astype(kind)
    data: np.ndarray = np.zeros((COLOURS + 3 * len(inks), at.height, at.width), kind)
    if old is not None:
        rows, columns = old.rect.slices(at)
        for c, source in enumerate(plane_map(old.inks, inks).tolist()):
            if source >= 0:
                data[c, rows, columns] = old.data[source]
    return data


def _renewed(it: _Renewed, old: Record | None, inks: tuple[Instance, ...]) -> Record | _Told | None:
    """As `_record` where no ink adds texture and int16 holds what there was; LARGE if it does not hold what is."""
    (x0, y0, _, y1), rect, corner = it.part, it.touched.rect, it.above.rect
    at = it.within(it.part)
    at = at if old is None else at.union(old.rect)
    data = _unpacked(old, at, inks, np.int16)
    read, coarse = _read(it.new, it.part, inks), it.above.with_inks(())
    assert read.planes is not None
    row, it.spans = np.empty(TILE, np.int32), np.empty((y1 - y0, 2), np.uint8)
    start = rect.y0 - read.rect.y0, rect.x0 - read.rect.x0
    down, right = rect.y0 - it.key.y * TILE - at.y0, rect.x0 - it.key.x * TILE - at.x0
    window = y0 - rect.y0, y1 - y0, it.key.x - rect.x0 // TILE, down, right, x0 - rect.x0
    changed, bits, full = counting.renew(
        read.planes.data, start, coarse.data, ((rect.y0 >> 1) - corner.y0 - 1, (rect.x0 >> 1) - corner.x0 - 1),
        plane_map(coarse.inks, inks), it.touched.marks, window, row, data, it.spans, it.unit,
    )  # fmt: skip
    if bits >= 1 << 15:
        return _Told.LARGE
    return trimmed(at, data, inks, it.depth, full) if changed else _SAME


def _read(new: Around, part: Rect, inks: tuple[Instance, ...]) -> Around:
    """Returns values that hold `part`, with these inks."""
    planes = new.with_inks(())
    if planes.inks == inks:
        return new
    return Around(new.level, part, widened(planes.cut(*part.slices(new.rect)), inks))


def _sparse_record(it: _Renewed, held: SparsePlanes) -> Record | _Told | None:
    """As `_record` where many inks lie in the tile: those that do not meet `part` stay as they are."""
    inner, value = it.within(it.part), it.new.with_inks(())
    value = value.cut(*it.part.slices(it.new.rect))
    inks = merged(value.inks, it.above.with_inks(()).inks, held.within(inner))
    value, data = widened(value, inks), held.over(inner, inks, np.int32)
    before = data.copy()
    read, used = Around(it.key.level, it.part, value), np.empty(COLOURS + 3 * len(inks), np.int32)
    predicted = _predicted(it, read)
    touched = it.touched.within(it.part)
    if not counting.residual(value.data, (0, 0), predicted, touched, (0, 0), data, used, it.unit)[0]:
        return _SAME
    new = held.replaced(inner, data, inks, before)
    if new is None:
        return None
    kept = tuple(new.inks)
    return Record(new.rect, new if len(kept) >= MANY else new.made(), kept, it.depth)


def _corner(rect: Rect, inside: Rect) -> tuple[int, int]:
    """Returns the row and column of a rectangle's corner in an array that covers `inside`."""
    return rect.y0 - inside.y0, rect.x0 - inside.x0


def _predicted(it: _Renewed, read: Around) -> np.ndarray:
    """Returns what expand and the ink make of the part without a residual: float32 (4 + 3n, h, w)."""
    part, level = it.part, it.key.level
    value, coarse = read.with_inks(()), it.above.with_inks(())
    top, left = _corner(part.parents(), it.above.rect)
    out = np.empty((len(value.data), part.height, part.width), np.float32)
    planes = plane_map(coarse.inks, value.inks)
    expand_into(coarse.data, top, left, planes, out, 0, part.height, it.unit)
    if any(level > ink.base for ink in value.inks):
        ink = widened(value.cut(*part.slices(read.rect)), value.inks)
        add_texture(out, ink, level, part, it.unit)
    return out
