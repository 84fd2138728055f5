"""A front: one level's rectangle before and after a change, on its way up the pyramid."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

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
        rows, columns = self.changed.any(1).nonzero()[0], self.changed.any(0).nonzero()[0]
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


def climbs(pyramid: Pyramid, front: Front, cache: TileCache | None) -> Iterator[tuple[Rect, Planes | None]]:
    """The old values around a change, level after level upwards from its own: rectangles two pixels wider than it.

    They are computed downwards in one cascade, a dozen levels at a time.
    """
    at, level = front.rect, front.level
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
        yield from zip(rects, reversed(values), strict=True)
        level -= _CLIMBS


def climbed(front: Front, around: Rect, old: Planes | None) -> Front | None:
    """Rule U: the front one level up, None when nothing changes there.  `old` covers `around`."""
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
    return Front(
        front.level, at, widened(front.old.cut(*window), front.old.inks), widened(front.new.cut(*window), front.new.inks),
        np.ascontiguousarray(front.keep[window]), np.ascontiguousarray(front.changed[window]),
    )  # fmt: skip


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
    pyramid: Pyramid,
    front: Front,
    parent: Front | None,
    here: tuple[Rect, Planes | None],
    above: tuple[Rect, Planes | None],
    inside: Rect | None,
    records: NewRecords,
) -> None:
    """New residuals of the front's level: v' - expand(v' of the parents) - texture(ink'), on touched pixels.

    Touched is what the front marks, and the children of every parent that changed.  `here` and `above` are the old
    values of both levels around it; only tiles that meet `inside` are written (None: all).
    """
    rect, old = here
    parent_rect, parent_old = above
    value = _pasted(old, rect, front)
    parents = _pasted(parent_old, parent_rect, parent)
    inks = merged(value.inks, parents.inks)
    value, parents = widened(value, inks), widened(parents, inks)
    touched = np.zeros((rect.height, rect.width), np.uint8)
    touched[front.rect.slices(rect)] = front.changed
    corner = rect.parents()
    top, left = corner.y0 - parent_rect.y0, corner.x0 - parent_rect.x0
    if parent is not None:
        marks = np.zeros((parent_rect.height, parent_rect.width), np.uint8)
        part = np.zeros_like(parent.changed)
        kernels.differs(parent.old.data, parent.new.data, part)
        marks[parent.rect.slices(parent_rect)] = part
        kernels.spread(marks, top, left, touched)
    predicted = np.empty_like(value.data)
    expand_into(parents.data, top, left, np.arange(value.data.shape[0]), predicted, 0, rect.height)
    add_texture(predicted, value, front.level, rect)
    for key in rect.tiles(front.level):
        if inside is None or key.rect.meets(inside):
            _store_tile(pyramid, key, rect, value, predicted, touched, records)


def _pasted(old: Planes | None, rect: Rect, front: Front | None) -> Planes:
    """The new values around a front: its own inside, the old ones elsewhere."""
    whole = old if old is not None else Planes.empty(rect.height, rect.width)
    if front is None:
        return whole
    inks = merged(whole.inks, front.new.inks)
    out = widened(whole, inks).data.copy()
    rows, columns = front.rect.slices(rect)
    out[:, rows, columns] = widened(front.new, inks).data
    return Planes(out, inks)


def _store_tile(pyramid, key, rect: Rect, value: Planes, predicted, touched, records: NewRecords) -> None:
    part = key.rect.intersect(rect)
    top, left = part.y0 - rect.y0, part.x0 - rect.x0
    if not kernels.any_set(touched, top, left, part.height, part.width):
        return
    stored = pyramid.levels.get(key.level)
    old = stored.get((key.x, key.y)) if stored is not None else None
    at, inks = part, value.inks
    if old is not None:
        old = effective(pyramid, key, old)
        at, inks = part.union(placed(key, old.rect)), merged(value.inks, old.inks)
    before = np.zeros((COLOURS + 3 * len(inks), at.height, at.width), np.int32)
    if old is not None:
        rows, columns = placed(key, old.rect).slices(at)
        for c, source in enumerate(plane_map(old.inks, inks)):
            if source >= 0:
                before[c, rows, columns] = old.data[source]
    after = before.copy()
    if inks == value.inks:
        kernels.residual(
            value.data, predicted, touched, top, left, part.y0 - at.y0, part.x0 - at.x0, part.height, part.width, after
        )
    else:
        window = part.slices(rect)
        wide, wide_predicted = (
            widened(value.cut(*window), inks),
            widened(Planes(predicted, value.inks).cut(*window), inks),
        )
        mask = np.ascontiguousarray(touched[window])
        kernels.residual(
            wide.data, wide_predicted.data, mask, 0, 0, part.y0 - at.y0, part.x0 - at.x0, part.height, part.width, after
        )
    if not np.array_equal(before, after):
        x, y = key.x * TILE, key.y * TILE
        local = Rect(at.x0 - x, at.y0 - y, at.x1 - x, at.y1 - y)
        records[key] = compact(local, after, inks, pyramid.depth + 1)
