"""Commit: how an edit changes the pyramid, at its own level, at all coarser ones, and lazily at the finer ones.

An edit gives (A, B) by tile: v' = snap(A v) + B, or on the coarse grid what module `dither` tells.  Coarser levels
follow by rule U (`lifting.climb`), until nothing changes any more; finer levels keep the part A of their residuals,
applied when they are next looked at.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from engine.brush.stamp import Edit
from engine.canvas.attenuate import fold
from engine.canvas.evaluate import evaluate
from engine.canvas.front import Around, Patch, climbs, cropped, known_around, united
from engine.canvas.painted import paint, tile_bounds
from engine.canvas.residuals import NewRecords, store, values_beside
from engine.canvas.rising.lasting import Lasting
from engine.canvas.rising.level_bounds import LevelTiles
from engine.canvas.rising.paged_level import PagedLevel
from engine.canvas.rising.risen import Risen, rise
from engine.canvas.rising.tile_blocks import Blocks
from engine.canvas.store import Attenuation, Change, Pyramid, Record, finer_levels, level_bounds, level_of
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.texture.planes import COLOURS, Planes, merged, widened
from engine.texture.record import Instance

if TYPE_CHECKING:
    from immutables._protocols import MapMutation

    from engine.canvas.rising.paged_level import PageEditor

    _Editor = MapMutation[tuple[int, int], Record] | PageEditor[Record]

Keeps = dict[tuple[int, int], Lasting]
Lessen = Callable[[Iterable[Record | None]], None]
_AT_ONCE = 224 << 20  # bytes of the planes of an edit's bounds up to which it is worked on as one rectangle
_CACHE_PART = 4  # but no more than such a part of what the cache may hold: several times as much comes and goes
_LEAST_AT_ONCE = 48 << 20
_FEW = 1 << 16  # pixels of bounds whose inks are not counted: smaller pieces would not be fewer bytes,
_NOT_MANY = 1 << 18  # and of those whose planes may take twice as much: smaller pieces take longer
_SLAB_LEVELS = 3  # larger edits: squares of 1024 pixels, each three levels up by itself, then all together; where much
# ink lies smaller ones, one level up at least
_MOST_WAITING = 32  # strokes whose attenuation may wait: beyond, reading a fine tile would take too long
_MARGIN = 4  # pixels around a square that its residuals can see, at the coarsest of its levels


def _as_they_are(records: Iterable[Record | None]) -> None:
    """Leaves records as they are."""


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


def commit(pyramid: Pyramid, edit: Edit, cache: TileCache | None = None, lessen: Lessen = _as_they_are) -> Pyramid:
    """Returns the pyramid after an edit; the same object when the edit changes no pixel at any level.  `lessen`: what
    is done to new records as soon as they are there, to hold them in fewer bytes."""
    keys = list(edit.tiles)
    if not keys:
        return pyramid
    keeps: Keeps | None = {} if _stored_below(pyramid, edit.level, tile_bounds(keys)) else None
    records: NewRecords = {}
    painted: list[Patch] = []
    risen: list[Risen] = []
    around: list[Around] = []
    if _is_at_once(pyramid, edit.level, tile_bounds(keys), _most(cache)):
        painted = paint(pyramid, edit, keys, cache)
        changed = _noted(painted, keeps)
        if painted:
            bounds = tile_bounds([patch.key for patch in painted])
            around = known_around(pyramid, edit.level, bounds, cache)
            levels = climbs(pyramid, edit.level, bounds, cache, around)
            risen = _climb_to_the_top(pyramid, painted, None, levels, records, cache)
            lessen(records.values())
    else:
        changed = _by_slabs(pyramid, edit, keys, (records, keeps, lessen), cache)
    if not records and not keeps:
        return pyramid
    after = _with_records(pyramid, edit, changed, keeps or None, records)
    if cache is not None and painted and after.last is not None:
        cache.raised(after.last, painted, risen)
        cache.front.keep(after, around)
        for tile in painted:  # they are on the screen
            cache.adopt(after, tile.key, tile.new)
    return after


def _noted(painted: Sequence[Patch], keeps: Keeps | None) -> Rect:
    """Returns the bounds of what changed; A by tile for the finer levels."""
    if keeps is not None:
        keeps.update(((patch.key.x, patch.key.y), _lasting(patch)) for patch in painted)
    return united(patch.dirty for patch in painted)


def _lasting(patch: Patch) -> Lasting:
    """Returns A of a patch where it is not 1."""
    return Lasting(patch.dirty, patch.keep[patch.dirty.slices(patch.at)].copy())


def _climb_to_the_top(
    pyramid: Pyramid,
    patches: Sequence[Patch],
    here: Around | None,
    levels: Iterator[Around],
    records: NewRecords,
    cache: TileCache | None,
) -> list[Risen]:
    """Stores this level's residuals and all coarser ones', up to where nothing changes any more.  Returns the coarser
    levels that change.

    `here` has the level's new values; None if the patches are the edit's own.
    """
    return _climb(pyramid, patches, here, levels, None, None, records, cache)


def _climb(
    pyramid: Pyramid,
    patches: Sequence[Patch],
    here: Around | None,
    levels: Iterator[Around],
    most: int | None,
    inside: Callable[[int], Rect] | None,
    records: NewRecords,
    cache: TileCache | None,
) -> list[Risen]:
    """As `_climb_to_the_top`, so many levels at `most`, of the last of which no residuals are stored; and only of tiles
    that meet `inside`."""
    first = next(levels)
    values = values_beside(pyramid, patches, first, cache) if here is None else {}
    found, changes = rise(pyramid, patches, itertools.chain([first], levels), most)
    store(pyramid, patches, here, found, inside, records, values)
    return found if changes else found[:-1]


def _by_slabs(
    pyramid: Pyramid,
    edit: Edit,
    keys: Sequence[TileKey],
    into: tuple[NewRecords, Keeps | None, Lessen],
    cache: TileCache | None,
) -> Rect:
    """Commits a large edit, square by square, so that memory does not grow with it.  Returns the bounds of what
    changed."""
    records, keeps, lessen = into
    changed, tops, rects = Rect(0, 0, 0, 0), [], [key.rect for key in keys]
    squares = _slabs(rects, _SLAB_LEVELS)
    each = max(_bytes_of_each(len(_inks_near(pyramid, edit.level, square))) for square in squares)
    climb = _levels_of_slabs(each, _most(cache))
    for slab in _slabs(rects, climb):
        seen = slab.grown(_MARGIN << climb)
        painted = paint(pyramid, edit, [key for key in keys if key.rect.meets(seen)], cache, seen)
        if painted:
            changed = changed.union(_noted([patch for patch in painted if patch.key.rect.meets(slab)], keeps))
            levels = climbs(pyramid, edit.level, united(patch.at for patch in painted), cache)
            found: NewRecords = {}
            tops += _climb_slab(pyramid, painted, None, levels, (slab, climb), found, cache)
            lessen(found.values())
            records.update(found)
    while _bytes_of(tops) > _most(cache):
        tops = _higher(pyramid, tops, records, cache)
    if tops:
        here, levels = _joined(pyramid, tops, cache)
        _climb_to_the_top(pyramid, tops, here, levels, records, cache)
    return changed


def _most(cache: TileCache | None) -> int:
    """Returns the bytes of planes up to which bounds are worked on as one rectangle: no pixel depends on it."""
    return _AT_ONCE if cache is None else min(_AT_ONCE, max(cache.budget // _CACHE_PART, _LEAST_AT_ONCE))


def _is_at_once(pyramid: Pyramid, level: int, rect: Rect, most: int) -> bool:
    """Tells whether an edit of these bounds is worked on as one rectangle, of `most` bytes of planes."""
    if rect.area <= _FEW or rect.area * _bytes_of_each(0) > most:
        return rect.area * _bytes_of_each(0) <= most
    more = 2 if rect.area <= _NOT_MANY else 1
    return rect.area * _bytes_of_each(len(_inks_near(pyramid, level, rect))) <= more * most


def _inks_near(pyramid: Pyramid, level: int, rect: Rect) -> set[Instance]:
    """Returns the inks that lie in a rectangle of a level, or near it."""
    found: set[Instance] = set()
    for k in pyramid.levels:
        if level - _SLAB_LEVELS <= k <= level:
            for _, record in pyramid.records(k, rect.zoomed(k - level)):
                found.update(record.inks)
    return found


def _bytes_of_each(inks: int) -> int:
    """Counts the bytes of a pixel with so many inks."""
    return 4 * (COLOURS + 3 * inks)


def _bytes_of(patches: Sequence[Patch]) -> int:
    """Counts the bytes of the planes of all that lies between some patches."""
    inks = merged(*(patch.new.inks for patch in patches))
    return united(patch.at for patch in patches).area * _bytes_of_each(len(inks))


def _levels_of_slabs(each: int, most: int) -> int:
    """Returns how many levels each square goes up by itself, where a pixel has so many bytes and a square `most`."""
    fitting = (j for j in range(_SLAB_LEVELS, 1, -1) if (TILE << j) ** 2 * each <= most)
    return next(fitting, 1)


def _joined(pyramid: Pyramid, patches: Sequence[Patch], cache: TileCache | None) -> tuple[Around, Iterator[Around]]:
    """Returns the new values around patches of one level, and the old ones at the levels above."""
    level, rect = patches[0].key.level, united(patch.at for patch in patches)
    here = Around(level, rect.grown(2), evaluate(pyramid, level, rect.grown(2), cache))
    here.take(patches)
    return here, climbs(pyramid, level, rect, cache)


def _higher(pyramid: Pyramid, patches: Sequence[Patch], records: NewRecords, cache: TileCache | None) -> list[Patch]:
    """Patches of one level, far apart, as those of a coarser one: square by square, as the edit itself."""
    climb = _levels_of_slabs(_bytes_of_each(len(merged(*(patch.new.inks for patch in patches)))), _most(cache))
    squares: dict[Rect, list[Patch]] = {}
    for patch in patches:
        for slab in _slabs([patch.at], climb):
            squares.setdefault(slab, []).append(patch)
    tops = []
    for slab, near in squares.items():
        cut = (cropped(patch, slab.grown(_MARGIN << climb)) for patch in near)
        parts = [patch for patch in cut if patch is not None]
        if parts:
            here, levels = _joined(pyramid, parts, cache)
            tops += _climb_slab(pyramid, parts, here, levels, (slab, climb), records, cache)
    return tops


def _climb_slab(
    pyramid: Pyramid,
    patches: Sequence[Patch],
    here: Around | None,
    levels: Iterator[Around],
    square: tuple[Rect, int],
    records: NewRecords,
    cache: TileCache | None,
) -> list[Patch]:
    """Stores the residuals of one square, of its own tiles only, at so many levels.  Returns the patches within it that
    are left for all together."""
    slab, climb = square
    found = _climb(pyramid, patches, here, levels, climb, lambda j: slab.zoomed(-j), records, cache)
    if len(found) < climb:
        return []
    tops = found[-1].patches(patches[0].spares_alpha)
    return [patch for patch in tops if patch.key.rect.meets(slab.zoomed(-climb))]


def _slabs(rects: Sequence[Rect], climb: int) -> list[Rect]:
    """Returns the squares of the fixed grid in which pixels can change at any of the levels that a square goes up."""
    places, side = set(), TILE << climb
    for rect in rects:
        r = rect.grown(_MARGIN << climb)
        for y in range(r.y0 // side, (r.y1 - 1) // side + 1):
            for x in range(r.x0 // side, (r.x1 - 1) // side + 1):
                places.add((y, x))
    return [Rect.at(x * side, y * side, side, side) for y, x in sorted(places)]


def _stored_below(pyramid: Pyramid, level: int, rect: Rect) -> bool:
    """Tells whether a finer level holds residuals that a stroke over `rect` would weaken."""
    around = rect.grown(2)
    return any(pyramid.has_records(k, around.zoomed(k - level)) for k in finer_levels(pyramid, level, around))


def _with_records(pyramid: Pyramid, edit: Edit, rect: Rect, keeps: Keeps | None, records: NewRecords) -> Pyramid:
    coarsest = min((key.level for key in records), default=edit.level)
    change = Change(edit.level, rect, pyramid.last, depth=pyramid.depth + 1, coarsest=coarsest)
    number = pyramid.commits + 1
    waits = Attenuation(change, keeps, pyramid.waits, edit.spares_alpha, number) if keeps else pyramid.waits
    by_level: dict[int, list[TileKey]] = {}
    for key in records:
        by_level.setdefault(key.level, []).append(key)
    levels, known, bounds = pyramid.levels, pyramid.known, level_bounds(pyramid)
    for k, keys in by_level.items():
        stored = levels.get(k)
        editable = level_of({} if stored is None else stored).mutate()
        _write(editable, keys, records)
        finished = level_of(editable.finish())
        levels = levels.set(k, finished) if len(finished) else (levels.delete(k) if k in levels else levels)
        blocks = pyramid.blocks(k)
        if isinstance(finished, PagedLevel):
            known = known.delete(k) if k in known else known
        elif isinstance(blocks, Blocks):
            known = known.set(k, blocks.after(finished, [(key.x, key.y) for key in keys]))
    if bounds is not None:
        written = (LevelTiles(k, [(key.x, key.y) for key in keys]) for k, keys in by_level.items())
        bounds = bounds.after(levels, written)
    after = replace(pyramid, levels=levels, last=change, waits=waits, commits=number, known=known, bounds_known=bounds)
    waiting = list(after.waiting()) if keeps else []
    if len(waiting) <= _MOST_WAITING:
        return after
    folded = fold(after, waiting[_MOST_WAITING].change.depth)
    for gone in waiting[_MOST_WAITING:]:  # only older states have them by now
        for kept in gone.keep.values():
            kept.pack()
    return folded


def _write(
    editable: MapMutation[tuple[int, int], Record] | PageEditor[Record], keys: Iterable[TileKey], records: NewRecords
) -> None:
    for key in keys:
        record = records[key]
        if record is not None:
            editable.set((key.x, key.y), record)
        else:
            editable.pop((key.x, key.y), None)
