"""New residuals after a change: v' - expand(v' of the parents) - texture(ink'), on the pixels it touches.

Touched are the pixels that changed, and the children of every parent that changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from engine.canvas.attenuate import effective, placed
from engine.canvas.compact import compact, trimmed
from engine.canvas.evaluate import add_texture, step
from engine.canvas.front import Around, Patch, blank_marks
from engine.canvas.rising import counting
from engine.canvas.rising.spans import Marks
from engine.canvas.store import Pyramid, Record, Since
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, merged, plane_map, widened
from engine.texture.record import Instance
from engine.texture.sparse_planes import MANY, SparsePlanes

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
    lifted: Sequence[Patch],
    above: Around,
    inside: Rect | None,
    records: NewRecords,
) -> None:
    """Residuals of a level: of what changed there, and of the children of what changed above.

    `here` has the level's new values; None for an edit's own, whose patches are whole tiles.  `lifted` are the patches
    above: `above` takes them.  Only tiles that meet `inside` are written (None: all).
    """
    changed = {patch.key: patch for patch in patches}
    level = patches[0].key.level
    parts = {key: part for key, part in _reached(patches, lifted).items() if inside is None or key.rect.meets(inside)}
    values: dict[TileKey, Around] = {}
    before = None if above.blank else above.planes
    above.mark(lifted)
    for key, part in parts.items():
        if here is not None:
            values[key] = here
        elif key in changed:
            values[key] = Around(level, key.rect, changed[key].new)
        elif above.spread(part, blank_marks(part.height, part.width)):
            values[key] = Around(level, part, step(pyramid, before, above.rect, level, part))
    above.take(lifted)
    for key, value in values.items():
        part = parts[key]
        touched = blank_marks(part.height, part.width)
        patch = changed.get(key)
        if patch is not None:
            own = patch.dirty
            touched[0][own.slices(part)] = patch.marks[0][own.slices(patch.at)]
        if above.spread(part, touched):
            record = _record(pyramid, _Renewed(key, part, touched, value, above, pyramid.depth + 1, pyramid.step))
            if not isinstance(record, _Told):
                records[key] = record


def _reached(patches: Sequence[Patch], lifted: Sequence[Patch]) -> dict[TileKey, Rect]:
    """Returns by tile the even rectangles in which the residual may change."""
    level = patches[0].key.level
    parts = {patch.key: patch.dirty.evened() for patch in patches}
    for parent in lifted:
        reach = parent.dirty.zoomed(1).grown(2)
        for key in reach.tiles(level):
            part = reach.intersect(key.rect)
            held = parts.get(key)
            parts[key] = part if held is None else held.union(part)
    return parts


@dataclass(frozen=True, eq=False, slots=True)
class _Renewed:
    """What is renewed of a tile: its residual in the even rectangle `part`, where it is `touched`; `new` has the new
    values there, `above` those of the level above."""

    key: TileKey
    part: Rect
    touched: Marks
    new: Around
    above: Around
    depth: int  # of the new record
    unit: np.float32  # the step of the values' grid

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
        record.came_from(Since.it(before, it.within(it.part), it.touched[1]))
    return record


def _dense_record(it: _Renewed, old: Record | None) -> Record | _Told | None:
    """As `_record`, where few inks lie in the tile."""
    inks = merged(it.new.with_inks(()).inks, it.above.with_inks(()).inks, () if old is None else old.inks)
    if len(inks) < MANY and not it.textured(inks) and (old is None or old.data.dtype == np.int16):
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
    changed, *extent = counting.residual(read.planes.data, start, predicted, it.touched[0], corner, data, used, it.unit)
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
    at = it.part if old is None else it.part.union(placed(it.key, old.rect))
    data = _unpacked(old, it.within(at), inks, np.int16)
    read, coarse = _read(it.new, it.part, inks), it.above.with_inks(())
    assert read.planes is not None
    start, corner = _corner(it.part, read.rect), _corner(it.part.parents(), it.above.rect)
    planes, inner = plane_map(coarse.inks, inks), _corner(it.part, at)
    row = np.empty(it.part.width, np.int32)
    changed, bits = counting.renew(
        read.planes.data, start, coarse.data, corner, planes, it.touched, row, inner, data, it.unit
    )
    if bits >= 1 << 15:
        return _Told.LARGE
    return trimmed(it.within(at), data, inks, it.depth) if changed else _SAME


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
    if not counting.residual(value.data, (0, 0), predicted, it.touched[0], (0, 0), data, used, it.unit)[0]:
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
