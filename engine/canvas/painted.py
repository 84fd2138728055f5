"""The tiles that an edit paints, at its own level, before and after."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from functools import cache

import numpy as np

from engine.brush.stamp import Edit
from engine.canvas import kernels
from engine.canvas.dither import dithering
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.front import Patch, blank_marks, cropped, placed_extent
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache, without_empty_inks
from engine.numeric.address import TILE, Rect, TileKey
from engine.texture.planes import COLOURS, Planes, merged, plane_map, widened


@cache
def _zeros(planes: int) -> np.ndarray:
    """Returns a blank tile; not to be written to."""
    return np.zeros((planes, TILE, TILE), np.float32)


_FIRST = 16  # tiles that are worked out together at most, until one knows how much ink lies there
_PIECE = 16 << 20  # bytes of tiles that are worked out together, as far as one knows
_MUCH = 2 << 20  # bytes of a tile from which on it is worked out only where it is asked for, and not kept for others
_NO_COLOUR = np.empty(0, np.float32)
_BLANK, _TILE = Planes(_zeros(COLOURS)), Rect(0, 0, TILE, TILE)


def tile_bounds(keys: Collection[TileKey]) -> Rect:
    """Returns the smallest rectangle that holds all of some tiles of one level."""
    if not keys:
        return Rect(0, 0, 0, 0)
    if len(keys) == 1:  # as of most batches of a pen's points
        return next(iter(keys)).rect
    xs, ys = [key.x for key in keys], [key.y for key in keys]
    return Rect(min(xs) * TILE, min(ys) * TILE, (max(xs) + 1) * TILE, (max(ys) + 1) * TILE)


def paint(
    pyramid: Pyramid, edit: Edit, keys: Sequence[TileKey], cache: TileCache | None, within: Rect | None = None
) -> list[Patch]:
    """(A, B) of an edit applied to some of its tiles: patches of whole tiles, of those in which a pixel changes, or of
    what of them lies `within` an even rectangle."""
    found: dict[TileKey, Patch | None] = {}
    for before in _tiles(pyramid, keys, cache, within):
        while before:  # what was worked out is held for no longer
            key, old = before.popitem()
            patch = _painted(pyramid, edit, key, old)
            found[key] = patch if patch is None or within is None else cropped(patch, within)
    return [patch for key in keys if (patch := found[key]) is not None]


def _painted(pyramid: Pyramid, edit: Edit, key: TileKey, old: Planes | None) -> Patch | None:
    stamp = edit.stamp(key, _BLANK if old is None else old)
    if stamp is None:
        return None
    inks = merged(() if old is None else old.inks, stamp.inks)
    before = Planes(_zeros(COLOURS + 3 * len(inks)), inks) if old is None else widened(old, inks)
    new, marks = np.empty_like(before.data), blank_marks(TILE, TILE)
    planes, spares, step = plane_map(stamp.inks, inks), edit.spares_alpha, pyramid.step
    dither = dithering(step, pyramid.commits + 1, key, _TILE, stamp.keep)
    add, colour = (stamp.paint, _NO_COLOUR) if stamp.paint.ndim > 1 else (_zeros(COLOURS), stamp.paint)
    extent = kernels.apply_stamp(
        before.data, stamp.keep, add, colour, planes, stamp.plain, spares, new, marks, step, dither
    )
    at = key.rect
    dirty = placed_extent(at, extent)
    if dirty.empty:
        return None
    there = None if old is None else widened(old, old.inks)
    return Patch(key, at, dirty, there, Planes(new, inks), stamp.keep, marks, spares)


def _tiles(
    pyramid: Pyramid, keys: Sequence[TileKey], cache: TileCache | None, within: Rect | None
) -> Iterator[dict[TileKey, Planes | None]]:
    """Yields the present values of tiles of one level, some at a time; where much lies there, only those that lie
    `within` a rectangle."""
    missing = []
    for key in keys:
        known, value = cache.get(pyramid, key) if cache is not None else (False, None)
        if known:
            yield {key: value}
        else:
            missing.append(key)
    most = _stored(pyramid, missing)
    if within is not None and most >= _MUCH:
        yield from ({key: _evaluated_within(pyramid, key, within, cache)} for key in missing)
        return
    size, first = min(_fitting(most), _FIRST), 0
    while first < len(missing):
        found = _evaluated(pyramid, missing[first : first + size], cache)
        first += size
        size = _fitting(max((value.data.nbytes for value in found.values() if value is not None), default=0))
        yield found


def _stored(pyramid: Pyramid, keys: Sequence[TileKey]) -> int:
    """Returns the most bytes that one of some tiles of a level takes with the inks that are stored there; 0 where
    nothing is."""
    level = pyramid.levels.get(keys[0].level) if keys else None
    if level is None:
        return 0
    inks = (len(record.inks) for key in keys if (record := level.get((key.x, key.y))) is not None)
    return 4 * TILE * TILE * max((COLOURS + 3 * count for count in inks), default=0)


def _fitting(most: int) -> int:
    """Returns how many tiles of so many bytes at most are worked out together."""
    return max(_PIECE // most, 1) if most else _FIRST


def _evaluated(pyramid: Pyramid, keys: Sequence[TileKey], cache: TileCache | None) -> dict[TileKey, Planes | None]:
    """Returns the values of some tiles of one level: worked out together, unless they lie far apart."""
    bounds = tile_bounds(keys)
    if bounds.area > 4 * TILE * TILE * len(keys):
        return {key: evaluate_sparse(pyramid, key.level, key.rect, cache) for key in keys}
    whole = evaluate_sparse(pyramid, keys[0].level, bounds, cache, tiled=False)
    values: dict[TileKey, Planes | None] = dict.fromkeys(keys)
    for key in keys:
        if whole is not None:
            cut = np.ascontiguousarray(whole.data[:, *key.rect.slices(bounds)])
            values[key] = without_empty_inks(Planes(cut, whole.inks))
        if cache is not None:
            cache.lend(pyramid, key, values[key])
    return values


def _evaluated_within(pyramid: Pyramid, key: TileKey, within: Rect, cache: TileCache | None) -> Planes | None:
    """Returns the values of a tile as far as they lie within an even rectangle, and zero elsewhere."""
    part = key.rect.intersect(within)
    value = evaluate_sparse(pyramid, key.level, part, cache, tiled=False)
    if value is None or part == key.rect:
        return value
    out = np.zeros((len(value.data), TILE, TILE), np.float32)
    out[:, *part.slices(key.rect)] = value.data
    return Planes(out, value.inks)
