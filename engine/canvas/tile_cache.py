"""Evaluated tiles that are kept: what was worked out once is not worked out again while there is room for it."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from engine.canvas.rising import raised
from engine.canvas.rising.raised import Front, PaintedTile, Raised, RisenLevel, brought_up
from engine.canvas.store import Change, Pyramid, changes_between
from engine.numeric.address import Rect, TileKey, lies_within
from engine.numeric.column import Clip
from engine.numeric.kernel import kernel
from engine.numeric.stand_in import or_plain
from engine.texture.planes import COLOURS, Planes

_NEAR = 1  # levels from the one that is looked at: farther ones are left behind
_BEHIND = 128 << 20  # bytes
_BESIDE = 176 << 20  # bytes of all levels but the one that is looked at
_TILE_OVERHEAD = 300  # bytes of a tile's own objects, roughly
_RAISED = 16 << 20  # bytes of what commits made of coarser levels, at most
_FRONT = 64 << 20  # bytes of the levels around the newest one, at most
_MOST = 60  # inks that are told apart in one number
_ZERO = np.float32(0.0)
_SQUARE, _MARGIN = 64, 20  # pixels of the side of what is kept of coarse levels, and around it


class Square(NamedTuple):
    """A square of a coarse level, and some pixels around it: what lies above many tiles of a finer one."""

    level: int
    x: int
    y: int
    margin: int

    @property
    def rect(self) -> Rect:
        """Gives the pixels of the level that it covers."""
        return Rect.at(self.x * _SQUARE, self.y * _SQUARE, _SQUARE, _SQUARE).grown(self.margin)

    @classmethod
    def of(cls, level: int, rect: Rect) -> Square | None:
        """Returns one that holds a rectangle; None where that is too large for it."""
        found = cls(level, (rect.x0 + rect.x1) // 2 // _SQUARE, (rect.y0 + rect.y1) // 2 // _SQUARE, _MARGIN)
        return found if lies_within(rect, found.rect) else None


CacheKey = TileKey | Square | Clip


class TileCache:
    """Evaluated tiles, bounded by bytes.  Safe for several threads.

    Those of levels that were left behind are evicted first, of one level the least recently used; and however much room
    there is, all that were left behind together take an eighth of it, and at most `_BEHIND`; with those next to the one
    that is looked at half of it, and at most `_BESIDE`.  `front`: what the newest commit left of the levels around it.
    """

    def __init__(self, budget: int) -> None:
        self.budget = budget
        self._held = 0
        self.evicted = 0  # bytes, in all
        self._levels: dict[int, _LevelTiles] = {}
        self.level: int | None = None  # that is looked at
        self._uses = 0
        self._raised = Raised(min(budget // 8, _RAISED))
        self.front = Front(min(budget // 8, _FRONT))
        self._lock = threading.Lock()

    def look_at(self, level: int | None) -> None:
        """Tells which level is seen from now on; None: no one more than others."""
        if level != self.level:
            with self._lock:
                self.level = level
                self._evict()

    def get(self, pyramid: Pyramid, key: CacheKey) -> tuple[bool, Planes | None]:
        """(known, value) of a tile, contiguous; a value of None is an empty tile."""
        with self._lock:
            kept = self._find(pyramid, key)
            if kept is None:
                return False, None
            if kept.value is not None and not kept.value.data.flags.c_contiguous:
                kept.value = Planes(kept.value.data.copy(), kept.value.inks)
            return True, kept.value

    def view(self, pyramid: Pyramid, key: CacheKey) -> tuple[bool, Planes | None]:
        """As `get`, but the planes may be a part of larger ones."""
        with self._lock:
            kept = self._find(pyramid, key)
            return (False, None) if kept is None else (True, kept.value)

    def _find(self, pyramid: Pyramid, key: CacheKey) -> _Kept | None:
        """Returns what is kept of a tile, brought up to a state; with the lock held, as another state may be asked for
        next."""
        place = (pyramid.uid, key)
        there = self._levels.get(key.level)
        kept = there.tiles.get(place) if there is not None else None
        if there is None or kept is None:
            return None
        if kept.since is not pyramid.last:
            written = self._raised.since(kept.since, pyramid.last, key.level, key.rect)
            if written:
                self._count(there, -kept.nbytes)
                kept.exchange(brought_up(kept.value, key.rect, written))
                self._count(there, kept.nbytes)
            elif written is None and _touched(kept.since, pyramid.last, key):
                return None
            kept.since = pyramid.last
        there.tiles.move_to_end(place)
        self._uses += 1
        kept.used = self._uses
        return kept

    def keep(self, pyramid: Pyramid, key: TileKey, value: Planes | None) -> None:
        """Keep a copy of a tile's value; None is an empty tile."""
        self.adopt(pyramid, key, None if value is None else Planes(value.data.copy(), value.inks))

    def adopt(self, pyramid: Pyramid, key: CacheKey, value: Planes | None) -> None:
        """Keep a tile's value itself: nobody may write to it any more."""
        self.lend(pyramid, key, None if value is None else without_empty_inks(value))

    def lend(self, pyramid: Pyramid, key: CacheKey, value: Planes | None) -> None:
        """As `adopt`, with all inks that it has; it may be a part of larger planes, all of whose parts are kept."""
        place = (pyramid.uid, key)
        with self._lock:
            there = self._levels.setdefault(key.level, _LevelTiles())
            old = there.tiles.pop(place, None)
            self._count(there, -old.nbytes if old is not None else 0)
            self._uses += 1
            kept = there.tiles[place] = _Kept(pyramid.last, value, self._uses)
            self._count(there, kept.nbytes)
            self._evict()

    def raised(self, change: Change, painted: Sequence[PaintedTile], risen: Sequence[RisenLevel]) -> None:
        """Takes what a commit made of its own level and of all coarser ones: tiles kept from before it stay good."""
        with self._lock:
            self._raised.note(change, painted, risen)
            self._evict()

    def clear(self) -> None:
        """Forgets all tiles."""
        with self._lock:
            self.front.clear()
            self._levels.clear()
            self._raised.clear()
            self._held = 0

    def shrink(self, to: int, alone: bool = False) -> None:
        """Evicts tiles until at most so many bytes are held; `alone`: tiles hold them, and what commits left of coarser
        levels stays, by which the tiles that a stroke changes next are soon there."""
        with self._lock:
            if self.held > to and not alone:
                self.front.clear()
                self._raised.clear()
            while self._held > to and self._levels:
                self._evict_from(_farthest(self._levels, self.level))

    @property
    def held(self) -> int:
        """Returns bytes held now."""
        return self._held + self._raised.held + self.front.held

    def _count(self, there: _LevelTiles, more: int) -> None:
        there.held += more
        self._held += more

    def _evict(self) -> None:
        while self.held > self.budget and self._levels:
            self._evict_from(_farthest(self._levels, self.level))
        if self.level is None:
            return
        near = (self._levels.get(self.level + n) for n in range(-_NEAR, _NEAR + 1))
        behind = self._held - sum(there.held for there in near if there is not None)
        while behind > min(self.budget // 8, _BEHIND):
            farther = {k: there for k, there in self._levels.items() if abs(k - self.level) > _NEAR}
            level = _farthest(farther, self.level)
            behind -= self._evict_from(level)
        there = self._levels.get(self.level)
        beside = self._held - (there.held if there is not None else 0)
        while beside > min(self.budget // 2, _BESIDE):
            others = (level for level in self._levels if level != self.level)
            beside -= self._evict_from(min(others, key=lambda level: self._levels[level].oldest))

    def _evict_from(self, level: int) -> int:
        """Evicts a level's least recently used tile; returns its bytes."""
        there = self._levels[level]
        _, kept = there.tiles.popitem(last=False)
        self._count(there, -kept.nbytes)
        self.evicted += kept.nbytes
        if not there.tiles:
            del self._levels[level]
        return kept.nbytes


def _touched(since: Change | None, last: Change | None, key: CacheKey) -> bool:
    """Tells whether a commit between two states may have changed a tile, or whether they are too many to be asked."""
    for n, change in enumerate(changes_between(since, last)):
        if n == raised.MOST or change.reach(key.level).meets(key.rect):
            return True
    return False


class _Kept:
    """A tile's value as it was after the commit `since`; `used` orders tiles by when they were last asked for."""

    __slots__ = ("nbytes", "since", "used", "value")

    def __init__(self, since: Change | None, value: Planes | None, used: int) -> None:
        self.since, self.used = since, used
        self.exchange(value)

    def exchange(self, value: Planes | None) -> None:
        """Holds another value."""
        self.value = value
        self.nbytes = _TILE_OVERHEAD + (value.data.nbytes if value is not None else 0)


class _LevelTiles:
    """The tiles of one level, the least recently used first, and the bytes that they hold."""

    __slots__ = ("held", "tiles")

    def __init__(self) -> None:
        self.tiles: OrderedDict[tuple[int, CacheKey], _Kept] = OrderedDict()
        self.held = 0

    @property
    def oldest(self) -> int:
        """Tells when the least recently used tile was used."""
        return next(iter(self.tiles.values())).used


def _farthest(levels: Mapping[int, _LevelTiles], seen: int | None) -> int:
    """Returns the level to evict from: the one farthest from what is looked at, else that of the oldest tile."""
    return min(levels, key=lambda k: (0 if seen is None else -abs(k - seen), levels[k].oldest))


# --- planes in which nothing lies


def _occupied(data: np.ndarray, top: int, left: int, height: int, width: int) -> int:
    """As `occupied`, plainly."""
    part = data[:, top : top + height, left : left + width]
    groups = [part[:COLOURS], *(part[c : c + 3] for c in range(COLOURS, len(part), 3))]
    return sum(bool(group.any()) << i for i, group in enumerate(groups))


@or_plain(_occupied)
@kernel
def occupied(data: np.ndarray, top: int, left: int, height: int, width: int) -> int:
    """Tells which planes of a rectangle of `data` (4 + 3n, h, w) are not zero all over: bit 0 the first four, bit 1 + i
    those of ink i; of `_MOST` inks at most."""
    bits = np.int64(0)
    for c in range(data.shape[0]):
        bit = np.int64(1) << np.int64(0 if c < 4 else 1 + (c - 4) // 3)
        y = 0
        while y < height and not bits & bit:
            row = data[c, top + y][left : left + width]
            found = np.int32(0)
            for i in range(row.size):
                found |= np.int32(row[i] != _ZERO)
            if found:
                bits |= bit
            y += 1
    return bits  # type: ignore[return-value]


def lies_in(planes: Planes, rows: slice, columns: slice) -> bool:
    """Tells whether anything lies in a part of planes."""
    data = planes.data
    if len(planes.inks) > _MOST or not data.flags.c_contiguous:  # for others it is not compiled
        return bool(data[:, rows, columns].any())
    return occupied(data, rows.start, columns.start, rows.stop - rows.start, columns.stop - columns.start) > 0


def without_empty_inks(planes: Planes) -> Planes | None:
    """Returns planes of ink that are zero all over are dropped; a stack that is zero all over is None."""
    data, inks = planes.data, planes.inks
    _, height, width = data.shape
    filled, some = [], False
    for first in range(0, max(len(inks), 1), _MOST):  # a part of the stack begins, as the whole, with four planes
        part = data[3 * first : COLOURS + 3 * (first + _MOST)]
        bits = occupied(part, 0, 0, height, width)
        filled += _of_bits(bits, min(len(inks) - first, _MOST))
        some = some or bits > 0
    if not some:
        return None
    return planes if all(filled) else _with_inks(planes, filled)


def parted(planes: Planes, places: list[tuple[slice, slice]]) -> list[Planes | None]:
    """Returns parts of planes, all of one size, each without the ink that is nowhere in it; None where nothing is.

    They are parts of the same array if none of them leaves anything out; copies otherwise.
    """
    data, inks = planes.data, planes.inks
    if len(inks) > _MOST:
        return [without_empty_inks(Planes(data[:, *place].copy(), inks)) for place in places]
    found = [occupied(data, y.start, x.start, y.stop - y.start, x.stop - x.start) for y, x in places]
    full = (2 << len(inks)) - 1
    if all(bits >> 1 == full >> 1 and bits for bits in found):
        return [planes.cut(*place) for place in places]
    return [
        _with_inks(planes.cut(*place), _of_bits(bits, len(inks))) if bits else None
        for bits, place in zip(found, places, strict=True)
    ]


def _of_bits(bits: int, count: int) -> list[bool]:
    return [bool(bits >> i & 1) for i in range(1, count + 1)]


def _with_inks(planes: Planes, wanted: list[bool]) -> Planes:
    """Returns a contiguous copy with those of its inks that are wanted."""
    data, kept = planes.data, [i for i, one in enumerate(wanted) if one]
    stack = [data[:COLOURS], *(data[COLOURS + 3 * i : COLOURS + 3 * i + 3] for i in kept)]
    return Planes(np.concatenate(stack), tuple(planes.inks[i] for i in kept))
