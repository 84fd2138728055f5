"""Attenuation that still waits: strokes at coarser levels weaken the detail stored below them (rule of the pyramid).

A finer record keeps the part A of itself for every later stroke above it: 1 - alpha where paint covers, more than 1
or less than 0 where contrast is raised or colours are turned round.  The stroke's A is carried to the
record's level by expand, and applied in the order of the commits when the record is next read.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import replace
from weakref import WeakKeyDictionary

import numpy as np

from engine.canvas import kernels
from engine.canvas.compact import compact
from engine.canvas.dither import dithering
from engine.canvas.rising.tile_blocks import Blocks
from engine.canvas.store import Attenuation, Pyramid, Record, finer_levels, level_bounds
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.column import Column
from engine.numeric.pyramid import expand

_NEAR, _APART = 3, 16  # levels below a stroke, and below one another, at which what it leaves of detail is noted,
_HIGH = 4  # no fewer levels than that above a tile: some pixels, which tiles of many levels have in common
_MOST_NOTED = 1 << 14
_NOTED: dict[tuple[int, int, Rect], np.ndarray] = {}  # by a stroke's serial, a level and a place there
_MOST_RENEWED = 24 << 20  # bytes


class _Renewed:
    """What records have become by the newest attenuation of their pyramid: of one view, most are asked for by several
    rectangles that meet them.  Safe for several threads: what is lost is worked out again."""

    def __init__(self) -> None:
        self._held: WeakKeyDictionary[Record, tuple[TileKey, int, Record | None]] = WeakKeyDictionary()
        self._bytes = 0
        self._lock = threading.Lock()

    def of(self, record: Record, key: TileKey, serial: int) -> tuple[bool, Record | None]:
        """Returns whether it is known what a record of a tile has become by the attenuation of a commit, and that; None
        where it is as it was."""
        found = self._held.get(record)
        return (True, found[2]) if found is not None and found[:2] == (key, serial) else (False, None)

    def note(self, record: Record, key: TileKey, serial: int, now: Record | None) -> None:
        """Keeps what a record has become."""
        more = 0 if now is None else now.nbytes
        if more > _MOST_RENEWED // 16:
            return
        with self._lock:
            if self._bytes + more > _MOST_RENEWED or len(self._held) >= _MOST_NOTED:
                self._forget()
            self._bytes += more
            self._held[record] = key, serial, now

    @property
    def held(self) -> int:
        """Returns the bytes that are held now, or of late were."""
        return self._bytes

    def shrink(self, by: int) -> None:
        """Forgets all, if anything is to be forgotten."""
        if by > 0:
            self.clear()

    def clear(self) -> None:
        """Forgets all."""
        with self._lock:
            self._forget()

    def _forget(self) -> None:
        self._held, self._bytes = WeakKeyDictionary(), 0


RENEWED = _Renewed()


def effective(pyramid: Pyramid, key: TileKey, record: Record) -> Record:
    """Returns the record as it is now: every attenuation since it was stored applied, oldest first."""
    newest = pyramid.waits
    if newest is None or newest.change.depth <= record.depth:
        return record
    known, now = RENEWED.of(record, key, newest.change.serial)
    if not known:
        pending = [waits for waits in pyramid.waiting(record.depth) if waits.change.level < key.level]
        data = _weakened(pyramid.step, pending, key, record) if pending else None
        now = None if data is None else Record(record.rect, data, record.inks, pyramid.depth)
        RENEWED.note(record, key, newest.change.serial, now)
    return record if now is None else now


def _weakened(step: np.float32, pending: Sequence[Attenuation], key: TileKey, record: Record) -> np.ndarray | None:
    """Returns what attenuations, newest first, leave of a record's data, of units of `step`: int32; None where that is
    all of it."""
    out, at = None, placed(key, record.rect)
    for waits in reversed(pending):
        keep = attenuation(waits, key.level, at)
        if keep is not None:
            data = record.data if out is None else out
            out = np.empty(data.shape, np.int32)
            dither = dithering(step, waits.number, key, record.rect, keep)
            kernels.attenuate(data, keep, waits.spares_alpha, out, step, dither)
    return out


def placed(key: TileKey, inner: Rect) -> Rect:
    """Returns a rectangle given from a tile's corner, in pixels of the tile's level."""
    x, y = key.x * TILE, key.y * TILE
    return Rect(x + inner.x0, y + inner.y0, x + inner.x1, y + inner.y1)


def attenuation(waits: Attenuation, level: int, rect: Rect) -> np.ndarray | None:
    """Returns a of a stroke carried down to a finer `level`: float32 (h, w) over `rect`, None where it is 1 all
    over."""
    if not waits.change.reach(level).meets(rect):
        return None
    column, here = Column(rect.evened()), level - waits.change.level
    keep: np.ndarray | None = None
    for stop in (*range(here - _NEAR, _HIGH - 1, -_APART), 0):
        place = waits.change.serial, level - stop, column.at(stop)
        found = _NOTED.get(place) if stop else None
        if found is None:
            found = _carried(_base(waits, column.at(here)) if keep is None else keep, column, here, stop)
            if stop:
                _note(place, found)
        keep, here = found, stop
        if (keep == keep[0, 0]).all():
            return None if keep[0, 0] == 1.0 else np.full((rect.height, rect.width), keep[0, 0], np.float32)
    assert keep is not None
    keep = keep[rect.slices(column.rect)]
    return None if (keep == 1.0).all() else np.ascontiguousarray(keep)


def _note(place: tuple[int, int, Rect], keep: np.ndarray) -> None:
    if len(_NOTED) >= _MOST_NOTED:
        _NOTED.clear()
    _NOTED[place] = keep


def _carried(keep: np.ndarray, column: Column, here: int, there: int) -> np.ndarray:
    """Returns a over what lies `there` levels above the foot of a column, from what it is `here` levels above."""
    last = max(there, 1)
    while here > there:
        first = keep[0, 0]
        if (keep == first).all():
            at = column.at(there)
            return np.full((at.height, at.width), first, np.float32)
        before, outer, here = keep[None], column.at(here), here - 1
        parents = column.at(here).parents()
        keep = expand(before[:, *parents.slices(outer)])[0]
        still = column.still(before, keep[None], here, last) if here > last else None
        if still is not None:
            keep, here = still[0], last
    return keep


def _base(waits: Attenuation, rect: Rect) -> np.ndarray:
    """Returns a at the stroke's own level: 1 outside its tiles."""
    keep = np.ones((rect.height, rect.width), np.float32)
    for key in rect.tiles(waits.change.level):
        kept = waits.keep.get((key.x, key.y))
        if kept is not None and not (part := kept.rect.intersect(rect)).empty:
            keep[part.slices(rect)] = kept.data[part.slices(kept.rect)]
    return keep


def fold(pyramid: Pyramid, depth: int | None = None) -> Pyramid:
    """Returns the same values without pending attenuations, or without those of the commits up to a `depth`: what a
    file stores.  The past of `pyramid` is kept."""
    until = pyramid.depth if depth is None else depth
    folded = [waits for waits in pyramid.waiting() if waits.change.depth <= until]
    levels, known, bounds = pyramid.levels, pyramid.known, level_bounds(pyramid)
    for level in _levels_met(pyramid, folded):
        stored = pyramid.levels[level]
        if not (places := _places(pyramid, level, folded)):
            continue
        editable, changed = stored.mutate(), False
        for place in places:
            record = stored[place]
            pending = [waits for waits in folded if record.depth < waits.change.depth and waits.change.level < level]
            data = _weakened(pyramid.step, pending, TileKey(level, *place), record)
            if data is None:
                continue
            changed = True
            smaller = compact(record.rect, data, record.inks, until)
            if smaller is None:
                editable.pop(place)
            else:
                editable.set(place, smaller)
        finished = editable.finish()
        if changed:
            levels = levels.set(level, finished) if len(finished) else levels.delete(level)
            blocks = pyramid.blocks(level)
            known = known.set(level, blocks.after(finished, places)) if isinstance(blocks, Blocks) else known
    bounds = None if bounds is None else bounds.after(levels, ())
    left = _left(pyramid, until)
    return replace(pyramid, levels=levels, settled=until, waits=left, known=known, bounds_known=bounds)


def _left(pyramid: Pyramid, depth: int) -> Attenuation | None:
    """Returns the attenuations of the commits since one."""
    left = None
    for waits in reversed(list(pyramid.waiting(depth))):
        left = replace(waits, before=left)
    return left


def _levels_met(pyramid: Pyramid, folded: Sequence[Attenuation]) -> set[int]:
    """Returns the levels that may have records which any of some attenuations meets."""
    changes = [waits.change for waits in folded]
    return {level for one in changes for level in finer_levels(pyramid, one.level, one.rect.grown(2))}


def _places(pyramid: Pyramid, level: int, folded: Sequence[Attenuation]) -> set[tuple[int, int]]:
    """Returns the places of a level's records that any of some attenuations meets."""
    found: set[tuple[int, int]] = set()
    for waiting in folded:
        if waiting.change.level < level:
            found.update((key.x, key.y) for key, _ in pyramid.records(level, waiting.change.reach(level)))
    return found
