"""Evaluation: the value of any rectangle at any level, from what is stored (features P1, P3).

The work goes down a cascade: the rectangle's ancestors, each half as large plus a pixel around, from the coarsest
stored level, or from the nearest level whose tiles are cached, to the level asked for.  It is a pure function of the
pyramid and the place; the cache only shortens it.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Iterable
from functools import partial

import numpy as np

from engine.canvas import kernels
from engine.canvas.attenuate import effective, placed
from engine.canvas.descent import from_afar
from engine.canvas.store import Change, Pyramid, Record, changes_between
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.column import Clip
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, Planes, merged, plane_map
from engine.texture.record import Instance
from engine.texture.sparse_planes import SparsePlanes

_CLOSE = 8  # levels above a rectangle that are gone through one by one
_NEAR = 1  # levels from the one that is looked at: farther ones are left behind
_BEHIND = 128 << 20  # bytes
_TILE_OVERHEAD = 300  # bytes of a tile's own objects, roughly
_MOST_SINCE = 256  # commits to look through for one that meets a tile: a tile is sooner made again than after more
_BAND = 64  # rows worked on at a time, so that a band of all planes stays in the cache of the processor


class TileCache:
    """Evaluated tiles, bounded by bytes.  Safe for several threads.

    Those of levels that were left behind are evicted first, of one level the least recently used; and however much room
    there is, all that were left behind together take an eighth of it, and at most `_BEHIND`.
    """

    def __init__(self, budget: int) -> None:
        self.budget = budget
        self._held = 0
        self.evicted = 0  # bytes, in all
        self._levels: dict[int, _LevelTiles] = {}
        self.level: int | None = None  # that is looked at
        self._uses = 0
        self._lock = threading.Lock()

    def look_at(self, level: int) -> None:
        """Tells which level is seen from now on."""
        if level != self.level:
            with self._lock:
                self.level = level
                self._evict()

    def get(self, pyramid: Pyramid, key: TileKey | Clip) -> tuple[bool, Planes | None]:
        """(known, value) of a tile; a value of None is an empty tile."""
        place = (pyramid.uid, key)
        with self._lock:
            there = self._levels.get(key.level)
            kept = there.tiles.get(place) if there is not None else None
            if there is None or kept is None:
                return False, None
            if kept.since is not pyramid.last:
                if _touched(kept.since, pyramid.last, key):
                    return False, None
                kept.since = pyramid.last
            there.tiles.move_to_end(place)
            self._uses += 1
            kept.used = self._uses
            return True, kept.value

    def keep(self, pyramid: Pyramid, key: TileKey, value: Planes | None) -> None:
        """Keep a copy of a tile's value; None is an empty tile."""
        self.adopt(pyramid, key, None if value is None else Planes(value.data.copy(), value.inks))

    def adopt(self, pyramid: Pyramid, key: TileKey | Clip, value: Planes | None) -> None:
        """Keep a tile's value itself: nobody may write to it any more."""
        if value is not None:
            value = without_empty_inks(value)
        place = (pyramid.uid, key)
        with self._lock:
            there = self._levels.setdefault(key.level, _LevelTiles())
            old = there.tiles.pop(place, None)
            self._count(there, -old.nbytes if old is not None else 0)
            self._uses += 1
            kept = there.tiles[place] = _Kept(pyramid.last, value, self._uses)
            self._count(there, kept.nbytes)
            self._evict()

    def clear(self) -> None:
        """Forgets all tiles."""
        with self._lock:
            self._levels.clear()
            self._held = 0

    def shrink(self, to: int) -> None:
        """Evicts tiles until at most so many bytes are held."""
        with self._lock:
            while self._held > to and self._levels:
                self._evict_from(self._farthest(self._levels))

    @property
    def held(self) -> int:
        """Returns bytes held now."""
        return self._held

    def _count(self, there: _LevelTiles, more: int) -> None:
        there.held += more
        self._held += more

    def _evict(self) -> None:
        while self._held > self.budget and self._levels:
            self._evict_from(self._farthest(self._levels))
        if self.level is None:
            return
        near = (self._levels.get(self.level + n) for n in range(-_NEAR, _NEAR + 1))
        behind = self._held - sum(there.held for there in near if there is not None)
        while behind > min(self.budget // 8, _BEHIND):
            level = self._farthest(level for level in self._levels if abs(level - self.level) > _NEAR)
            behind -= self._evict_from(level)

    def _farthest(self, levels: Iterable[int]) -> int:
        """Returns the level to evict from: the one farthest from what is looked at, else that of the oldest tile."""
        seen = self.level

        def rank(level: int) -> tuple[int, int]:
            return 0 if seen is None else -abs(level - seen), self._levels[level].oldest

        return min(levels, key=rank)

    def _evict_from(self, level: int) -> int:
        """Evicts a level's least recently used tile; returns its bytes."""
        there = self._levels[level]
        _, kept = there.tiles.popitem(last=False)
        self._count(there, -kept.nbytes)
        self.evicted += kept.nbytes
        if not there.tiles:
            del self._levels[level]
        return kept.nbytes


def _touched(since: Change | None, last: Change | None, key: TileKey | Clip) -> bool:
    """Tells whether a commit between two states may have changed a tile, or whether they are too many to be asked."""
    for n, change in enumerate(changes_between(since, last)):
        if n == _MOST_SINCE or change.reach(key.level).meets(key.rect):
            return True
    return False


class _Kept:
    """A tile's value as it was after the commit `since`; `used` orders tiles by when they were last asked for."""

    __slots__ = ("nbytes", "since", "used", "value")

    def __init__(self, since: Change | None, value: Planes | None, used: int) -> None:
        self.since, self.value, self.used = since, value, used
        self.nbytes = _TILE_OVERHEAD + (value.data.nbytes if value is not None else 0)


class _LevelTiles:
    """The tiles of one level, the least recently used first, and the bytes that they hold."""

    __slots__ = ("held", "tiles")

    def __init__(self) -> None:
        self.tiles: OrderedDict[tuple[int, TileKey | Clip], _Kept] = OrderedDict()
        self.held = 0

    @property
    def oldest(self) -> int:
        """Tells when the least recently used tile was used."""
        return next(iter(self.tiles.values())).used


def evaluate(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None = None) -> Planes:
    """Returns the value of `rect` at `level`: colour clamped in alpha only, ink as it lies there."""
    found = evaluate_sparse(pyramid, level, rect, cache)
    return Planes.empty(rect.height, rect.width) if found is None else found


def shown(pyramid: Pyramid, level: int, rect: Rect) -> np.ndarray | None:
    """Returns colour and alpha of `rect` at `level`, as `evaluate` has them: float32 (4, h, w), None where nothing
    lies.

    Ink that adds no texture down to this level is left out on the way: half the work where there is any.
    """
    bare = pyramid.bare
    start = min(level, 0) if bare is not None and min(level, 0) in bare.values else pyramid.coarsest
    if start is None or level < start:
        return None
    rects = [rect.evened()]
    for _ in range(level - start if bare is not None else min(level - start, _CLOSE)):
        rects.append(rects[-1].parents().evened())
    above = rects[-1]
    if level - start > _CLOSE and bare is None:
        start = level - _CLOSE
        known, value = True, from_afar(pyramid, start, above, None, partial(step, pyramid, finest=level))
    else:
        known, value = _of_ground(pyramid, start, above)
    for k in range(start + known, level + 1):
        inner = rects[level - k]
        value = step(pyramid, value, above, k, inner, level)
        above = inner
    return None if value is None else value.rgba[:, *rect.slices(rects[0])]


def evaluate_sparse(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None) -> Planes | None:
    """As `evaluate`, but None where nothing lies."""
    known, value = _known(pyramid, level, rect, cache)
    if known:
        return value
    rects = [rect.evened()]
    start = level
    value = None
    coarsest = pyramid.coarsest
    while coarsest is not None and start > coarsest:
        start -= 1
        rects.append(rects[-1].parents().evened())
        known, value = _known(pyramid, start, rects[-1], cache)
        if not known and len(rects) > _CLOSE:
            known, value = True, from_afar(pyramid, start, rects[-1], cache, partial(step, pyramid))
        if known:
            rects.pop()
            break
    if coarsest is None or level < coarsest:
        return None
    inner = None
    above = rects[-1] if not known else rects[-1].parents().evened()
    for k in range(level - len(rects) + 1, level + 1):
        inner = rects[level - k]
        value = step(pyramid, value, above, k, inner)
        above = inner
    assert inner is not None
    if cache is not None:
        _keep_tiles(pyramid, level, inner, value, cache)
    return None if value is None else value.cut(*rect.slices(inner))


def step(
    pyramid: Pyramid, parent: Planes | None, parent_at: Rect, level: int, rect: Rect, finest: int | None = None
) -> Planes | None:
    """Returns one level down: v of the even `rect` from its parents, which lie at `parent_at`; without the ink that
    adds no texture down to the level `finest`, where that is given."""
    stored = ((key, effective(pyramid, key, record)) for key, record in pyramid.records(level, rect))
    cut = ((key, _within(key, record, rect)) for key, record in stored)
    records = [(key, record) for key, record in cut if record is not None]
    if parent is None and not records:
        return None
    inks = merged(() if parent is None else parent.inks, *(record.inks for _, record in records))
    if finest is not None:
        inks = tuple(ink for ink in inks if ink.base < finest)
    out = np.empty((COLOURS + 3 * len(inks), rect.height, rect.width), np.float32)
    if parent is None:
        out[:] = 0.0
    sources = plane_map(() if parent is None else parent.inks, inks)
    top = (rect.y0 >> 1) - 1 - parent_at.y0
    left = (rect.x0 >> 1) - 1 - parent_at.x0
    laid = [(placed(key, record.rect), record, plane_map(record.inks, inks)) for key, record in records]
    for first in range(0, rect.height, _BAND):
        last = min(first + _BAND, rect.height)
        if parent is not None:
            expand_into(parent.data, top, left, sources, out, first, last)
        band = Rect(rect.x0, rect.y0 + first, rect.x1, rect.y0 + last)
        for at, record, planes in laid:
            if at.y0 < band.y1 and band.y0 < at.y1:
                _add_record(out, rect, band, at, record, planes)
        _add_texture_band(out, inks, level, rect, band)
        kernels.clamp_alpha(out, first, last)
    return without_empty_inks(Planes(out, inks))


def _within(key: TileKey, record: Record, rect: Rect) -> Record | None:
    """Returns a record, of one of many inks only the part that lies in a rectangle: most of them do not."""
    held = record.held
    if not isinstance(held, SparsePlanes):
        return record
    x, y = key.x * TILE, key.y * TILE
    inner = Rect(rect.x0 - x, rect.y0 - y, rect.x1 - x, rect.y1 - y).intersect(record.rect)
    if inner.empty:
        return None
    inks = held.within(inner)
    data = held.over(inner, inks, held.kind)
    data.flags.writeable = False  # as those of other records are: so the kernel is compiled once
    return Record(inner, data, inks, record.depth)


def _add_record(out: np.ndarray, rect: Rect, band: Rect, at: Rect, record: Record, planes: np.ndarray) -> None:
    part = at.intersect(band)
    if not part.empty:
        kernels.add_residual(
            out, part.y0 - rect.y0, part.x0 - rect.x0,
            record.data, part.y0 - at.y0, part.x0 - at.x0, part.height, part.width, planes,
        )  # fmt: skip


def add_texture(out: np.ndarray, ink: Planes, level: int, rect: Rect) -> None:
    """Add to the colour planes of `out` what the ink lying on `rect` adds at this level."""
    for first in range(0, rect.height, _BAND):
        last = min(first + _BAND, rect.height)
        band = Rect(rect.x0, rect.y0 + first, rect.x1, rect.y0 + last)
        _add_texture_band(out, ink.inks, level, rect, band, ink.data)


def _add_texture_band(
    out: np.ndarray,
    inks: tuple[Instance, ...],
    level: int,
    rect: Rect,
    band: Rect,
    ink_planes: np.ndarray | None = None,
) -> None:
    """colour += snap(ink amplitude * bandpass) for every instance (Perlin & Velho 1995, section 5.2)."""
    amplitudes = out if ink_planes is None else ink_planes
    first, last = band.y0 - rect.y0, band.y1 - rect.y0
    for i, ink in enumerate(inks):
        plane = COLOURS + 3 * i
        if level <= ink.base or not kernels.any_nonzero(amplitudes, plane, plane + 3, first, last):
            continue
        detail = ink.bandpass(level, band)
        if detail is not None:
            kernels.add_texture(out, amplitudes, plane, np.ascontiguousarray(detail, np.float32), first)


def without_empty_inks(planes: Planes) -> Planes | None:
    """Returns planes of ink that are zero all over are dropped; a stack that is zero all over is None."""
    data, inks = planes.data, planes.inks
    height = data.shape[1]
    kept = [i for i in range(len(inks)) if kernels.any_nonzero(data, COLOURS + 3 * i, COLOURS + 3 * i + 3, 0, height)]
    if not kept and not kernels.any_nonzero(data, 0, COLOURS, 0, height):
        return None
    if len(kept) == len(inks):
        return planes
    wanted = [*range(COLOURS), *(COLOURS + 3 * i + c for i in kept for c in range(3))]
    return Planes(data[wanted], tuple(inks[i] for i in kept))


def _known(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None) -> tuple[bool, Planes | None]:
    """(known, value) of what need not be worked out."""
    known, value = _of_ground(pyramid, level, rect)
    return (known, value) if known else _from_cache(pyramid, level, rect, cache)


def _of_ground(pyramid: Pyramid, level: int, rect: Rect) -> tuple[bool, Planes | None]:
    """Returns the picture that a layer is, where it is nothing else."""
    ground = pyramid.bare
    values = ground.values.get(level) if ground is not None else None
    return (False, None) if values is None else (True, without_empty_inks(Planes(values(rect), ())))


def _from_cache(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None) -> tuple[bool, Planes | None]:
    if cache is None:
        return False, None
    tiles = []
    for key in rect.tiles(level):
        known, value = cache.get(pyramid, key)
        if not known:
            return False, None
        if value is not None:
            tiles.append((key, value))
    if not tiles:
        return True, None
    inks = merged(*(value.inks for _, value in tiles))
    out = np.zeros((COLOURS + 3 * len(inks), rect.height, rect.width), np.float32)
    for key, value in tiles:
        part = key.rect.intersect(rect)
        source = value.data[:, *part.slices(key.rect)]
        target = out[:, *part.slices(rect)]
        if value.inks == inks:
            target[:] = source
        else:
            for c, s in enumerate(plane_map(value.inks, inks)):
                if s >= 0:
                    target[c] = source[s]
    return True, Planes(out, inks)


def _keep_tiles(pyramid: Pyramid, level: int, rect: Rect, value: Planes | None, cache: TileCache) -> None:
    for key in rect.tiles(level):
        at = key.rect
        if rect.intersect(at) == at:
            cache.keep(pyramid, key, None if value is None else value.cut(*at.slices(rect)))
