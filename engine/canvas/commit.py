"""Commit: how an edit changes the pyramid, at its own level, at all coarser ones, and lazily at the finer ones.

An edit gives (A, B) by tile: v' = snap(A v) + B.  Coarser levels follow by rule U (`kernels.climb`), until nothing
changes any more; finer levels keep the part A of their residuals, applied when they are next looked at.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from engine.brush.stamp import Edit
from engine.canvas.evaluate import TileCache, evaluate
from engine.canvas.fold import fold
from engine.canvas.front import Front, Surroundings, climbed, climbs, cut_front, joined, widened
from engine.canvas.painted import Painted, lift, paint, tile_bounds
from engine.canvas.residuals import NewRecords, Parents, store_front, store_painted
from engine.canvas.store import Change, Level, Pyramid, Record
from engine.numeric.address import TILE, Rect, TileKey
from engine.texture.planes import Planes, merged

if TYPE_CHECKING:
    from immutables._protocols import MapMutation

Keeps = dict[tuple[int, int], np.ndarray]
_AT_ONCE = 1 << 22  # pixels of an edit's bounds up to which it is worked on as one rectangle
_SLAB_LEVELS = 3  # larger edits: squares of 1024 pixels, each three levels up by itself, then all together
_SLAB = TILE << _SLAB_LEVELS
_MOST_WAITING = 32  # strokes whose attenuation may wait: beyond, reading a fine tile would take too long
_MARGIN = 4 << _SLAB_LEVELS  # pixels around a square that its residuals can see, at the coarsest of its levels


def preview(pyramid: Pyramid, edit: Edit, rect: Rect, cache: TileCache | None = None) -> Planes:
    """Returns what `rect` of the edit's level will be once the edit is committed."""
    old = evaluate(pyramid, edit.level, rect, cache)
    painted = paint(pyramid, edit, [key for key in edit.tiles if key.rect.meets(rect)], cache)
    inks = merged(old.inks, *(tile.new.inks for tile in painted))
    out = Planes(widened(old, inks).data.copy(), inks)
    for tile in painted:
        part = tile.key.rect.intersect(rect)
        rows, columns = part.slices(rect)
        out.data[:, rows, columns] = widened(tile.new.cut(*part.slices(tile.key.rect)), inks).data
    return out


def commit(pyramid: Pyramid, edit: Edit, cache: TileCache | None = None) -> Pyramid:
    """Returns the pyramid after an edit; the same object when the edit changes no pixel at any level."""
    keys = list(edit.tiles)
    if not keys:
        return pyramid
    keeps: Keeps | None = {} if _stored_below(pyramid, edit.level, tile_bounds(keys)) else None
    records: NewRecords = {}
    painted: list[Painted] = []
    if tile_bounds(keys).area <= _AT_ONCE:
        painted = paint(pyramid, edit, keys, cache)
        changed = _noted(painted, keeps)
        if painted:
            levels = climbs(pyramid, edit.level, tile_bounds([tile.key for tile in painted]), cache)
            _climb_to_the_top(pyramid, _climb_from(pyramid, painted, levels, None, records), levels, records)
    else:
        changed = _by_slabs(pyramid, edit, keys, records, keeps, cache)
    if not records and not keeps:
        return pyramid
    after = _with_records(pyramid, edit, changed, keeps or None, records)
    if cache is not None:
        for tile in painted:  # they are on the screen
            cache.adopt(after, tile.key, tile.new)
    return after


def _noted(painted: Sequence[Painted], keeps: Keeps | None) -> Rect:
    """Returns the bounds of what changed; A by tile for the finer levels."""
    changed = Rect(0, 0, 0, 0)
    for tile in painted:
        changed = changed.union(tile.bounds)
        if keeps is not None:
            keeps[tile.key.x, tile.key.y] = tile.keep
    return changed


def _climb_from(
    pyramid: Pyramid,
    painted: Sequence[Painted],
    levels: Iterator[Surroundings],
    inside: Rect | None,
    records: NewRecords,
) -> Front | None:
    """Store the residuals of painted tiles; the front at the level above."""
    above = next(levels)
    front = lift(painted, above, painted[0].key.level - 1)
    store_painted(pyramid, painted, Parents(above, front), inside, records)
    return front


def _climb_to_the_top(
    pyramid: Pyramid, front: Front | None, levels: Iterator[Surroundings], records: NewRecords
) -> None:
    """Store this level's residuals and all coarser ones', up to where nothing changes any more."""
    while front is not None:
        above = next(levels)
        parent = climbed(front, above)
        store_front(pyramid, front, Parents(above, parent), None, records)
        front = parent


def _by_slabs(
    pyramid: Pyramid,
    edit: Edit,
    keys: Sequence[TileKey],
    records: NewRecords,
    keeps: Keeps | None,
    cache: TileCache | None,
) -> Rect:
    """Returns a large edit, square by square, so that memory does not grow with it.  Returns the bounds of what
    changed."""
    changed, tops = Rect(0, 0, 0, 0), []
    for slab in _slabs([key.rect for key in keys]):
        near = [key for key in keys if key.rect.meets(slab.grown(_MARGIN))]
        painted = paint(pyramid, edit, near, cache)
        if not painted:
            continue
        changed = changed.union(_noted(painted, keeps))
        levels = climbs(pyramid, edit.level, tile_bounds([tile.key for tile in painted]), cache)
        front = _climb_from(pyramid, painted, levels, slab, records)
        top = _climb_slab(pyramid, front, levels, slab.zoomed(-1), records)
        if top is not None:
            tops.append(top)
    while tops and _area(tops) > _AT_ONCE:
        tops = _higher(pyramid, tops, records, cache)
    if tops:
        front = joined(pyramid, tops, cache)
        _climb_to_the_top(pyramid, front, climbs(pyramid, front.level, front.rect, cache), records)
    return changed


def _area(fronts: Sequence[Front]) -> int:
    """Returns pixels of the rectangle around some fronts."""
    whole = Rect(0, 0, 0, 0)
    for front in fronts:
        whole = whole.union(front.rect)
    return whole.area


def _higher(pyramid: Pyramid, fronts: Sequence[Front], records: NewRecords, cache: TileCache | None) -> list[Front]:
    """Fronts of one level, far apart, as those of a coarser one: square by square, as the edit itself."""
    squares: dict[Rect, list[Front]] = {}
    for front in fronts:
        for slab in _slabs([front.rect]):
            squares.setdefault(slab, []).append(front)
    tops = []
    for slab, near in squares.items():
        front = joined(pyramid, near, cache)
        levels = climbs(pyramid, front.level, front.rect, cache)
        top = _climb_slab(pyramid, front, levels, slab, records)
        if top is not None:
            tops.append(top)
    return tops


def _climb_slab(
    pyramid: Pyramid, front: Front | None, levels: Iterator[Surroundings], slab: Rect, records: NewRecords
) -> Front | None:
    """Returns the further levels of one square; residuals only of its own tiles.  Returns what is left for all
    together."""
    if front is None:
        return None
    for j, above in zip(range(_SLAB_LEVELS - 1), levels, strict=False):
        parent = climbed(front, above)
        store_front(pyramid, front, Parents(above, parent), slab.zoomed(-j), records)
        if parent is None:
            return None
        front = parent
    return cut_front(front, slab.zoomed(1 - _SLAB_LEVELS))


def _slabs(rects: Sequence[Rect]) -> Iterator[Rect]:
    """Yields the squares of the fixed grid in which pixels can change at any of the levels a square deals with."""
    places = set()
    for rect in rects:
        r = rect.grown(_MARGIN)
        for y in range(r.y0 // _SLAB, (r.y1 - 1) // _SLAB + 1):
            for x in range(r.x0 // _SLAB, (r.x1 - 1) // _SLAB + 1):
                places.add((y, x))
    for y, x in sorted(places):
        yield Rect.at(x * _SLAB, y * _SLAB, _SLAB, _SLAB)


def _stored_below(pyramid: Pyramid, level: int, rect: Rect) -> bool:
    """Tells whether a finer level holds residuals that a stroke over `rect` would weaken."""
    return any(
        next(iter(pyramid.records(k, rect.grown(2).zoomed(k - level))), None) is not None
        for k in pyramid.levels
        if k > level
    )


def _with_records(pyramid: Pyramid, edit: Edit, rect: Rect, keeps: Keeps | None, records: NewRecords) -> Pyramid:
    last, depth = pyramid.last, pyramid.depth + 1
    attenuating = last if last is not None and last.keep is not None else (last.attenuating if last else None)
    spares = edit.spares_alpha
    change = Change(edit.level, rect, keeps, last, depth=depth, attenuating=attenuating, spares_alpha=spares)
    by_level: dict[int, list[TileKey]] = {}
    for key in records:
        by_level.setdefault(key.level, []).append(key)
    levels = pyramid.levels
    for k, keys in by_level.items():
        stored = levels.get(k)
        editable = (Level() if stored is None else stored).mutate()
        _write(editable, keys, records)
        finished = editable.finish()
        levels = levels.set(k, finished) if len(finished) else (levels.delete(k) if k in levels else levels)
    after = replace(pyramid, levels=levels, last=change)
    return fold(after) if keeps and sum(1 for _ in after.waiting()) > _MOST_WAITING else after


def _write(editable: MapMutation[tuple[int, int], Record], keys: Iterable[TileKey], records: NewRecords) -> None:
    for key in keys:
        record = records[key]
        if record is not None:
            editable.set((key.x, key.y), record)
        else:
            editable.pop((key.x, key.y), None)
