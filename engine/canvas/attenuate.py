"""Attenuation that still waits: strokes at coarser levels weaken the detail stored below them (rule of the pyramid).

A finer record keeps the part A of itself for every later stroke above it: 1 - alpha where paint covers, more than 1
or less than 0 where contrast is raised or colours are turned round.  The stroke's A is carried to the
record's level by expand, and applied in the order of the commits when the record is next read.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engine.canvas import kernels
from engine.canvas.compact import compact
from engine.canvas.store import Attenuation, Pyramid, Record
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.column import Column
from engine.numeric.pyramid import expand


def effective(pyramid: Pyramid, key: TileKey, record: Record) -> Record:
    """Returns the record as it is now: every attenuation since it was stored applied, oldest first."""
    pending = [waits for waits in pyramid.waiting(record.depth) if waits.change.level < key.level]
    if not pending:
        return record
    data = first = record.data
    at = placed(key, record.rect)
    for waits in reversed(pending):
        keep = attenuation(waits, key.level, at)
        if keep is not None:
            out = np.empty(data.shape, np.int32)
            kernels.attenuate(data, keep, waits.spares_alpha, out)
            data = out
    return record if data is first else Record(record.rect, data, record.inks, pyramid.depth)


def placed(key: TileKey, inner: Rect) -> Rect:
    """Returns a rectangle given from a tile's corner, in pixels of the tile's level."""
    x, y = key.x * TILE, key.y * TILE
    return Rect(x + inner.x0, y + inner.y0, x + inner.x1, y + inner.y1)


def attenuation(waits: Attenuation, level: int, rect: Rect) -> np.ndarray | None:
    """Returns a of a stroke carried down to a finer `level`: float32 (h, w) over `rect`, None where it is 1 all
    over."""
    if not waits.change.reach(level).meets(rect):
        return None
    column, up = Column(rect.evened()), level - waits.change.level
    keep = _base(waits, column.at(up))
    while up:
        first = keep[0, 0]
        if (keep == first).all():
            return None if first == 1.0 else np.full((rect.height, rect.width), first, np.float32)
        before, outer, up = keep[None], column.at(up), up - 1
        parents = column.at(up).parents()
        keep = expand(before[:, *parents.slices(outer)])[0]
        still = column.still(before, keep[None], up, 1) if up > 1 else None
        if still is not None:
            keep, up = still[0], 1
    keep = keep[rect.slices(column.rect)]
    return None if (keep == 1.0).all() else np.ascontiguousarray(keep)


def _base(waits: Attenuation, rect: Rect) -> np.ndarray:
    """Returns a at the stroke's own level: 1 outside its tiles."""
    keep = np.ones((rect.height, rect.width), np.float32)
    for key in rect.tiles(waits.change.level):
        tile = waits.keep.get((key.x, key.y))
        if tile is not None:
            part = key.rect.intersect(rect)
            keep[part.slices(rect)] = tile[part.slices(key.rect)]
    return keep


def fold(pyramid: Pyramid) -> Pyramid:
    """Returns the same values without pending attenuations: what a file stores.  The past of `pyramid` is kept."""
    levels = pyramid.levels
    for level, stored in pyramid.levels.items():
        if not (places := _places(pyramid, level)):
            continue
        editable = stored.mutate()
        for place in places:
            record = stored[place]
            settled = effective(pyramid, TileKey(level, *place), record)
            if settled is record:
                continue
            smaller = compact(settled.rect, settled.data.astype(np.int32), settled.inks, pyramid.depth)
            if smaller is None:
                editable.pop(place)
            else:
                editable.set(place, smaller)
        finished = editable.finish()
        levels = levels.set(level, finished) if len(finished) else levels.delete(level)
    return replace(pyramid, levels=levels, settled=pyramid.depth, waits=None)


def _places(pyramid: Pyramid, level: int) -> set[tuple[int, int]]:
    """Returns the places of a level's records that any attenuation meets."""
    found: set[tuple[int, int]] = set()
    for waiting in pyramid.waiting():
        if waiting.change.level < level:
            found.update((key.x, key.y) for key, _ in pyramid.records(level, waiting.change.reach(level)))
    return found
