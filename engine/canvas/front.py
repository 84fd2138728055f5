"""A front: one level's rectangle before and after a change, on its way up the pyramid."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from engine.brush.stamp import Edit, Stamp
from engine.canvas import kernels
from engine.canvas.attenuate import effective, placed
from engine.canvas.compact import compact
from engine.canvas.evaluate import TileCache, add_texture, evaluate, evaluate_sparse, step
from engine.canvas.store import Pyramid, Record
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, Planes, merged, plane_map
from engine.texture.record import Instance

Keeps = dict[tuple[int, int], np.ndarray]
NewRecords = dict[TileKey, Record | None]
_CLIMBS = 14  # levels a change usually climbs before it is less than the grid can show


@dataclass(frozen=True, eq=False, slots=True)
class Front:
    """`rect` is even; `old` and `new` have the same inks; `keep` is A, float32 (h, w); `changed`, uint8 (h, w), marks
    where A != 1 or v' != v."""

    level: int
    rect: Rect
    old: Planes
    new: Planes
    keep: np.ndarray
    changed: np.ndarray

    @property
    def bounds(self) -> Rect:
        """The smallest rectangle of the level that holds every marked pixel."""
        rows, columns = np.flatnonzero(self.changed.any(1)), np.flatnonzero(self.changed.any(0))
        if not rows.size:
            return Rect(0, 0, 0, 0)
        x, y = self.rect.x0, self.rect.y0
        return Rect(x + int(columns[0]), y + int(rows[0]), x + int(columns[-1]) + 1, y + int(rows[-1]) + 1)


def tile_bounds(keys: Sequence[TileKey]) -> Rect:
    """The smallest rectangle that holds all of some tiles of one level."""
    if not keys:
        return Rect(0, 0, 0, 0)
    xs, ys = [key.x for key in keys], [key.y for key in keys]
    return Rect(min(xs) * TILE, min(ys) * TILE, (max(xs) + 1) * TILE, (max(ys) + 1) * TILE)


def widened(planes: Planes, inks: tuple[Instance, ...]) -> Planes:
    """The same values in a stack that has room for more inks, contiguous."""
    if planes.inks == inks:
        return Planes(np.ascontiguousarray(planes.data), inks)
    out = np.zeros((COLOURS + 3 * len(inks), *planes.data.shape[1:]), np.float32)
    for c, source in enumerate(plane_map(planes.inks, inks)):
        if source >= 0:
            out[c] = planes.data[source]
    return Planes(out, inks)


def stamped(
    edit: Edit, keys: Sequence[TileKey], rect: Rect, old: Planes, read: Callable[[Rect], Planes], keeps: Keeps | None
) -> Front | None:
    """The front at the edit's own level: (A, B) of every tile applied.  None when no pixel changes.

    `old` covers `rect`; tiles that reach beyond it are taken from `read`.  `keeps` collects A by tile for the finer
    levels.
    """
    stamps = []
    for key in keys:
        part = key.rect.intersect(rect)
        if part.empty:
            continue
        stamp = edit.stamp(key, old.cut(*part.slices(rect)) if part == key.rect else read(key.rect))
        if stamp is not None:
            stamps.append((key, part, stamp))
    if not stamps:
        return None
    inks = merged(old.inks, *(stamp.inks for _, _, stamp in stamps))
    before = widened(old, inks)
    new = before.data.copy()
    keep = np.ones((rect.height, rect.width), np.float32)
    changed = np.zeros((rect.height, rect.width), np.uint8)
    for key, part, stamp in stamps:
        _apply(before, rect, key, part, stamp, inks, new, keep, changed)
        if keeps is not None:
            keeps[key.x, key.y] = stamp.keep
    return Front(edit.level, rect, before, Planes(new, inks), keep, changed) if changed.any() else None


def _apply(before, rect: Rect, key: TileKey, part: Rect, stamp: Stamp, inks, new, keep, changed) -> None:
    rows, columns = part.slices(key.rect)
    a, b = stamp.keep[rows, columns], stamp.add[:, rows, columns]
    kernels.apply_stamp(
        before.data, part.y0 - rect.y0, part.x0 - rect.x0,
        np.ascontiguousarray(a), np.ascontiguousarray(b), plane_map(stamp.inks, inks), new, keep, changed,
    )  # fmt: skip


# ---- upwards ----------------------------------------------------------------------------------------------------


def halved(rect: Rect) -> Rect:
    """The parents of an even rectangle, made even."""
    return rect.zoomed(-1).evened()


@dataclass(frozen=True, eq=False, slots=True)
class Surroundings:
    """Old values of a level around a change: `planes` over `rect`, None where nothing lies."""

    rect: Rect
    planes: Planes | None


def climbs(pyramid: Pyramid, front: Front, cache: TileCache | None) -> Iterator[Surroundings]:
    """What lies around a change at the levels above its own, upwards: rectangles two pixels wider than it.

    They are computed downwards in one cascade, a dozen levels at a time.
    """
    at, level = halved(front.rect), front.level - 1
    while True:
        rects = []
        for _ in range(_CLIMBS):
            rects.append(at.grown(2))
            at = halved(at)
        value = evaluate_sparse(pyramid, level - _CLIMBS + 1, rects[-1], cache)
        values = [value]
        for j in range(_CLIMBS - 2, -1, -1):
            value = step(pyramid, value, rects[j + 1], level - j, rects[j])
            values.append(value)
        yield from map(Surroundings, rects, reversed(values))
        level -= _CLIMBS


def climbed(front: Front, above: Surroundings) -> Front | None:
    """Rule U: the front one level up, None when nothing changes there."""
    around, old = above.rect, above.planes
    children = front.rect.zoomed(-1)
    at = children.evened()
    whole = old if old is not None else Planes.empty(around.height, around.width)
    inks = merged(whole.inks, front.old.inks)
    before = widened(whole.cut(*at.slices(around)), inks)
    fine_old, fine_new = widened(front.old, inks), widened(front.new, inks)
    keep = np.ones((at.height, at.width), np.float32)
    changed = np.zeros((at.height, at.width), np.uint8)
    if children == at:
        new = np.empty_like(before.data)
        any_changed = kernels.climb(
            fine_old.data, fine_new.data, front.keep, front.changed, before.data, new, keep, changed
        )
    else:
        new = before.data.copy()
        rows, columns = children.slices(at)
        parts = [np.ascontiguousarray(before.data[:, rows, columns]), np.empty_like(new[:, rows, columns])]
        a, s = np.ascontiguousarray(keep[rows, columns]), np.ascontiguousarray(changed[rows, columns])
        any_changed = kernels.climb(fine_old.data, fine_new.data, front.keep, front.changed, *parts, a, s)
        new[:, rows, columns], keep[rows, columns], changed[rows, columns] = parts[1], a, s
    if not any_changed:
        return None
    return Front(front.level - 1, at, before, Planes(new, inks), keep, changed)


def cut_front(front: Front, rect: Rect) -> Front | None:
    """The part of a front inside `rect`, whose corners are even."""
    at = front.rect.intersect(rect)
    if at.empty:
        return None
    window = at.slices(front.rect)
    old = widened(front.old.cut(*window), front.old.inks)
    new = widened(front.new.cut(*window), front.new.inks)
    keep, changed = np.ascontiguousarray(front.keep[window]), np.ascontiguousarray(front.changed[window])
    return Front(front.level, at, old, new, keep, changed)


def joined(pyramid: Pyramid, fronts: Sequence[Front], cache: TileCache | None) -> Front:
    """Fronts of one level that do not overlap, as one; unchanged in between."""
    rect = Rect(0, 0, 0, 0)
    for front in fronts:
        rect = rect.union(front.rect)
    level = fronts[0].level
    around = evaluate(pyramid, level, rect, cache)
    inks = merged(around.inks, *(front.old.inks for front in fronts))
    old = widened(around, inks)
    new = old.data.copy()
    keep = np.ones((rect.height, rect.width), np.float32)
    changed = np.zeros((rect.height, rect.width), np.uint8)
    for front in fronts:
        rows, columns = front.rect.slices(rect)
        new[:, rows, columns] = widened(front.new, inks).data
        keep[rows, columns], changed[rows, columns] = front.keep, front.changed
    return Front(level, rect, old, Planes(new, inks), keep, changed)


# ---- residuals --------------------------------------------------------------------------------------------------


def store(
    pyramid: Pyramid, front: Front, parent: Front | None, above: Surroundings, inside: Rect | None, records: NewRecords
) -> None:
    """New residuals of the front's level: v' - expand(v' of the parents) - texture(ink'), on touched pixels.

    Touched is what the front marks, and the children of every parent that changed.  `above` holds the old values of
    the parents around it; only tiles that meet `inside` are written (None: all).
    """
    parents = _pasted(above, parent)
    marks = np.zeros((above.rect.height, above.rect.width), np.uint8)
    if parent is not None:
        part = np.zeros_like(parent.changed)
        kernels.differs(parent.old.data, parent.new.data, part)
        marks[parent.rect.slices(above.rect)] = part
    around = front.rect.grown(2)
    for key in around.tiles(front.level):
        if inside is None or key.rect.meets(inside):
            part_at = key.rect.intersect(around)
            touched = _touched(front, part_at, marks, above.rect)
            if touched is not None:
                value = _value(pyramid, front, part_at, above)
                record = _residual(pyramid, key, part_at, value, touched, Surroundings(above.rect, parents))
                if record is not _SAME:
                    records[key] = record


_SAME: Any = object()


def _touched(front: Front, part: Rect, marks: np.ndarray, marks_at: Rect) -> np.ndarray | None:
    """The touched pixels of `part`, uint8 (h, w); None if there are none."""
    touched = np.zeros((part.height, part.width), np.uint8)
    common = part.intersect(front.rect)
    if not common.empty:
        touched[common.slices(part)] = front.changed[common.slices(front.rect)]
    corner = part.parents()
    kernels.spread(marks, corner.y0 - marks_at.y0, corner.x0 - marks_at.x0, touched)
    return touched if kernels.any_set(touched) else None


def _value(pyramid: Pyramid, front: Front, part: Rect, above: Surroundings) -> Planes:
    """The new values of `part`: the front's inside its rectangle, the old ones elsewhere."""
    if part.intersect(front.rect) == part:
        return widened(front.new.cut(*part.slices(front.rect)), front.new.inks)
    return _pasted(Surroundings(part, step(pyramid, above.planes, above.rect, front.level, part)), front)


def _pasted(around: Surroundings, front: Front | None) -> Planes:
    rect = around.rect
    whole = around.planes if around.planes is not None else Planes.empty(rect.height, rect.width)
    common = Rect(0, 0, 0, 0) if front is None else front.rect.intersect(rect)
    if front is None or common.empty:
        return whole
    inks = merged(whole.inks, front.new.inks)
    out = widened(whole, inks).data.copy()
    rows, columns = common.slices(rect)
    out[:, rows, columns] = widened(front.new.cut(*common.slices(front.rect)), inks).data
    return Planes(out, inks)


def _residual(
    pyramid: Pyramid, key: TileKey, part: Rect, value: Planes, touched: np.ndarray, parents: Surroundings
) -> Record | None:
    """The new record of a tile whose values of `part` became `value`; `_SAME` if the one it has still holds."""
    assert parents.planes is not None
    stored = pyramid.levels.get(key.level)
    old = stored.get((key.x, key.y)) if stored is not None else None
    at, inks = part, merged(value.inks, parents.planes.inks)
    if old is not None:
        old = effective(pyramid, key, old)
        at, inks = part.union(placed(key, old.rect)), merged(inks, old.inks)
    value = widened(value, inks)
    corner = part.parents()
    predicted = np.empty_like(value.data)
    expand_into(
        parents.planes.data, corner.y0 - parents.rect.y0, corner.x0 - parents.rect.x0,
        plane_map(parents.planes.inks, inks), predicted, 0, part.height,
    )  # fmt: skip
    add_texture(predicted, value, key.level, part)
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
