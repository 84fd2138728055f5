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
from engine.canvas.front import Around, Patch, widened
from engine.canvas.store import Pyramid, Record
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, Planes, merged, plane_map
from engine.texture.record import Instance
from engine.texture.sparse_planes import MANY, SparsePlanes

NewRecords = dict[TileKey, Record | None]


class _Same(Enum):
    """Stands for the record that a tile has: None says that it is to have none."""

    SAME = "same"


_SAME = _Same.SAME


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
    for key, part in parts.items():
        if here is not None:
            values[key] = here
        elif key in changed:
            values[key] = Around(level, key.rect, changed[key].new)
        else:
            values[key] = Around(level, part, step(pyramid, before, above.rect, level, part))
    above.take(lifted)
    for key, part in parts.items():
        touched = np.zeros((part.height, part.width), np.uint8)
        patch = changed.get(key)
        if patch is not None:
            own = patch.dirty
            touched[own.slices(part)] = patch.changed[own.slices(patch.at)]
        if above.spread(part, touched):
            record = _record(pyramid, key, part, values[key], touched, above)
            if not isinstance(record, _Same):
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


def _record(
    pyramid: Pyramid, key: TileKey, part: Rect, new: Around, touched: np.ndarray, above: Around
) -> Record | _Same | None:
    """Returns the new record of a tile whose values of `part` became those of `new`; `_SAME` if the one it has still
    holds."""
    stored = pyramid.levels.get(key.level)
    old = stored.get((key.x, key.y)) if stored is not None else None
    value, coarse = new.with_inks(()), above.with_inks(())
    at, inks = part, merged(value.inks, coarse.inks)
    if old is None and all(key.level <= ink.base for ink in inks):
        return _first_record(pyramid, key, part, _read(new, part, inks), touched, above)
    if old is not None:
        old = effective(pyramid, key, old)
        if isinstance(old.held, SparsePlanes):
            return _sparse_record(pyramid, key, part, value.cut(*part.slices(new.rect)), touched, above, old.held)
        at, inks = part.union(placed(key, old.rect)), merged(inks, old.inks)
    read = _read(new, part, inks)
    predicted = _predicted(above, part, read, key.level)
    data = np.zeros((COLOURS + 3 * len(inks), at.height, at.width), np.int32)
    if old is not None:
        rows, columns = placed(key, old.rect).slices(at)
        for c, source in enumerate(plane_map(old.inks, inks)):
            if source >= 0:
                data[c, rows, columns] = old.data[source]
    return _compacted(pyramid, key, at, data, read, predicted, touched, part)


def _compacted(
    pyramid: Pyramid,
    key: TileKey,
    at: Rect,
    data: np.ndarray,
    read: Around,
    predicted: np.ndarray,
    touched: np.ndarray,
    part: Rect,
) -> Record | _Same | None:
    """Writes the residual of `part` into `data`, which has that of `at`."""
    assert read.planes is not None
    used = np.empty(len(data), np.int32)
    start, corner = _corner(part, read.rect), _corner(part, at)
    changed, bits, y0, y1, x0, x1 = kernels.residual(read.planes.data, start, predicted, touched, corner, data, used)
    if not changed:
        return _SAME
    x, y = key.x * TILE, key.y * TILE
    inner = Rect(at.x0 - x, at.y0 - y, at.x1 - x, at.y1 - y)
    return compact(inner, data, read.planes.inks, pyramid.depth + 1, ((bits, y0, y1, x0, x1), used))


def _read(new: Around, part: Rect, inks: tuple[Instance, ...]) -> Around:
    """Returns values that hold `part`, with these inks."""
    planes = new.with_inks(())
    if planes.inks == inks:
        return new
    return Around(new.level, part, widened(planes.cut(*part.slices(new.rect)), inks))


def _sparse_record(
    pyramid: Pyramid, key: TileKey, part: Rect, value: Planes, touched: np.ndarray, above: Around, held: SparsePlanes
) -> Record | _Same | None:
    """As `_record` where many inks lie in the tile: those that do not meet `part` stay as they are."""
    x, y = key.x * TILE, key.y * TILE
    inner = Rect(part.x0 - x, part.y0 - y, part.x1 - x, part.y1 - y)
    inks = merged(value.inks, above.with_inks(()).inks, held.within(inner))
    value, data = widened(value, inks), held.over(inner, inks, np.int32)
    read, used = Around(key.level, part, value), np.empty(COLOURS + 3 * len(inks), np.int32)
    predicted = _predicted(above, part, read, key.level)
    if not kernels.residual(value.data, (0, 0), predicted, touched, (0, 0), data, used)[0]:
        return _SAME
    new = held.replaced(inner, data, inks)
    if new is None:
        return None
    kept = tuple(new.inks)
    return Record(new.rect, new if len(kept) >= MANY else new.made(), kept, pyramid.depth + 1)


def _first_record(
    pyramid: Pyramid, key: TileKey, part: Rect, read: Around, touched: np.ndarray, above: Around
) -> Record | _Same | None:
    """As `_record` where none was, and where no ink adds texture: nothing has to be made but the residual itself."""
    value, coarse = read.with_inks(()), above.with_inks(())
    planes = plane_map(coarse.inks, value.inks)
    data = np.empty((len(value.data), part.height, part.width), np.int32)
    used = np.empty(len(data), np.int32)
    start, corner = _corner(part, read.rect), _corner(part.parents(), above.rect)
    extent = kernels.first_residual(value.data, start, coarse.data, corner, planes, touched, data, used)
    if extent[0] == 0:
        return _SAME
    x, y = key.x * TILE, key.y * TILE
    inside = Rect(part.x0 - x, part.y0 - y, part.x1 - x, part.y1 - y)
    return compact(inside, data, value.inks, pyramid.depth + 1, (extent, used))


def _corner(rect: Rect, inside: Rect) -> tuple[int, int]:
    """Returns the row and column of a rectangle's corner in an array that covers `inside`."""
    return rect.y0 - inside.y0, rect.x0 - inside.x0


def _predicted(above: Around, part: Rect, read: Around, level: int) -> np.ndarray:
    """Returns what expand and the ink make of `part` without a residual: float32 (4 + 3n, h, w)."""
    value, coarse = read.with_inks(()), above.with_inks(())
    top, left = _corner(part.parents(), above.rect)
    out = np.empty((len(value.data), part.height, part.width), np.float32)
    planes = plane_map(coarse.inks, value.inks)
    expand_into(coarse.data, top, left, planes, out, 0, part.height)
    if any(level > ink.base for ink in value.inks):
        ink = widened(value.cut(*part.slices(read.rect)), value.inks)
        add_texture(out, ink, level, part)
    return out
