"""Commit: how an edit changes the pyramid, at its own level, at all coarser ones, and lazily at the finer ones.

An edit gives (A, B) by tile: v' = snap(A v) + B.  Coarser levels follow by rule U (`kernels.climb`), until nothing
changes any more; finer levels keep the part A of their residuals, applied when they are next looked at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from engine.brush.stamp import Edit
from engine.canvas.evaluate import TileCache, evaluate
from engine.canvas.front import (
    Front,
    Keeps,
    NewRecords,
    climbed,
    climbs,
    cut_front,
    joined,
    stamped,
    store,
    tile_bounds,
)
from engine.canvas.store import Change, Level, Pyramid
from engine.numeric.address import TILE, Rect, TileKey
from engine.texture.planes import Planes

_AT_ONCE = 1 << 22  # pixels of an edit's bounds up to which it is worked on as one rectangle
_SLAB_LEVELS = 3  # larger edits: squares of 1024 pixels, each three levels up by itself, then all together
_SLAB = TILE << _SLAB_LEVELS
_MARGIN = 4 << _SLAB_LEVELS  # pixels around a square that its residuals can see, at the coarsest of its levels


def preview(pyramid: Pyramid, edit: Edit, rect: Rect, cache: TileCache | None = None) -> Planes:
    """What `rect` of the edit's level will be once the edit is committed."""
    keys = [key for key in edit.tiles if key.rect.meets(rect)]
    whole = tile_bounds(keys).union(rect).evened()
    old = evaluate(pyramid, edit.level, whole, cache)
    front = stamped(edit, keys, whole, old, _reader(pyramid, edit.level, cache), None)
    return (old if front is None else front.new).cut(*rect.slices(whole))


def commit(pyramid: Pyramid, edit: Edit, cache: TileCache | None = None) -> Pyramid:
    """The pyramid after an edit; the same object when the edit changes no pixel at any level."""
    keys = list(edit.tiles)
    if not keys:
        return pyramid
    keeps: Keeps | None = {} if _stored_below(pyramid, edit.level, tile_bounds(keys)) else None
    records: NewRecords = {}
    if tile_bounds(keys).area <= _AT_ONCE:
        rect = tile_bounds(keys).evened()
        read = _reader(pyramid, edit.level, cache)
        front = stamped(edit, keys, rect, read(rect), read, keeps)
        if front is None:
            return pyramid
        changed = front.bounds
        _climb_to_the_top(pyramid, front, records, cache)
    else:
        front = None
        changed = _by_slabs(pyramid, edit, keys, records, keeps, cache)
    if not records and not keeps:
        return pyramid
    after = _with_records(pyramid, edit.level, changed, keeps or None, records)
    if cache is not None and front is not None:
        _remember(after, front, cache)
    return after


def _reader(pyramid: Pyramid, level: int, cache: TileCache | None) -> Callable[[Rect], Planes]:
    return lambda rect: evaluate(pyramid, level, rect, cache)


def _climb_to_the_top(pyramid: Pyramid, front: Front, records: NewRecords, cache: TileCache | None) -> None:
    """Store this level's residuals and all coarser ones', up to where nothing changes any more."""
    for above in climbs(pyramid, front, cache):
        parent = climbed(front, above)
        store(pyramid, front, parent, above, None, records)
        if parent is None:
            return
        front = parent


def _by_slabs(pyramid, edit, keys, records, keeps, cache) -> Rect:
    """A large edit, square by square, so that memory does not grow with it.  Returns the bounds of what changed."""
    changed, tops = Rect(0, 0, 0, 0), []
    read = _reader(pyramid, edit.level, cache)
    for slab in _slabs(keys):
        near = [key for key in keys if key.rect.meets(slab.grown(_MARGIN))]
        base = _aligned(tile_bounds(near).intersect(slab.grown(_MARGIN)))
        front = stamped(edit, near, base, read(base), read, keeps)
        if front is None:
            continue
        changed = changed.union(front.bounds)
        top = _climb_slab(pyramid, front, slab, records, cache)
        if top is not None:
            tops.append(top)
    if tops:
        _climb_to_the_top(pyramid, joined(pyramid, tops, cache), records, cache)
    return changed


def _climb_slab(pyramid, front: Front, slab: Rect, records: NewRecords, cache) -> Front | None:
    """Three levels up within one square; residuals only of its own tiles.  Returns what is left for all together."""
    for j, above in zip(range(_SLAB_LEVELS), climbs(pyramid, front, cache), strict=False):
        parent = climbed(front, above)
        store(pyramid, front, parent, above, slab.zoomed(-j), records)
        if parent is None:
            return None
        front = parent
    return cut_front(front, slab.zoomed(-_SLAB_LEVELS))


def _slabs(keys: Sequence[TileKey]) -> Iterator[Rect]:
    """The squares of the fixed grid in which pixels can change at any of the levels a square deals with."""
    places = set()
    for key in keys:
        r = key.rect.grown(_MARGIN)
        for y in range(r.y0 // _SLAB, (r.y1 - 1) // _SLAB + 1):
            for x in range(r.x0 // _SLAB, (r.x1 - 1) // _SLAB + 1):
                places.add((y, x))
    for y, x in sorted(places):
        yield Rect.at(x * _SLAB, y * _SLAB, _SLAB, _SLAB)


def _aligned(rect: Rect) -> Rect:
    step = 2 << _SLAB_LEVELS
    return Rect(
        rect.x0 // step * step, rect.y0 // step * step, -(-rect.x1 // step) * step, -(-rect.y1 // step) * step
    )  # fmt: skip


def _stored_below(pyramid: Pyramid, level: int, rect: Rect) -> bool:
    """Whether a finer level holds residuals that a stroke over `rect` would weaken."""
    return any(
        next(iter(pyramid.records(k, rect.grown(2).zoomed(k - level))), None) is not None
        for k in pyramid.levels
        if k > level
    )


def _with_records(pyramid: Pyramid, level: int, rect: Rect, keeps: Keeps | None, records: NewRecords) -> Pyramid:
    last = pyramid.last
    attenuating = last if last is not None and last.keep is not None else (last.attenuating if last else None)
    change = Change(level, rect, keeps, last, depth=pyramid.depth + 1, attenuating=attenuating)
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
    return Pyramid(levels, change, pyramid.uid)


def _write(editable, keys: Iterable[TileKey], records: NewRecords) -> None:
    for key in keys:
        record = records[key]
        if record is not None:
            editable.set((key.x, key.y), record)
        else:
            editable.pop((key.x, key.y), None)


def _remember(after: Pyramid, front: Front, cache: TileCache) -> None:
    """The tiles just painted are known: keep them, they are on the screen."""
    for key in front.rect.tiles(front.level):
        if front.rect.intersect(key.rect) == key.rect:
            cache.keep(after, key, front.new.cut(*key.rect.slices(front.rect)))
