"""What is stored of a pyramid: residuals of painted tiles, and what later strokes take away from them.

Everything is immutable.  A `Pyramid` is one state of one layer; an undo step is a reference to an older one.
The shown value of a level k is (Perlin & Velho 1995, section 4.2)

    v_k = clamp( expand(v_(k-1)) + texture_k(ink of v_k) + residual_k )

where the residual of a tile is its newest record, times the attenuation of every later stroke at a coarser level.
Above the coarsest stored level v = 0.
"""

from __future__ import annotations

import itertools
import weakref
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import IO, Protocol

import immutables
import numpy as np

from engine.canvas.rising import paged_level
from engine.canvas.rising.lasting import Lasting
from engine.canvas.rising.level_bounds import MANY_LEVELS, LevelBounds
from engine.canvas.rising.paged_level import PagedLevel
from engine.canvas.rising.tile_blocks import Blocks
from engine.numeric.address import Rect, TileKey
from engine.numeric.arithmetic import FINE
from engine.numeric.grid import step_of
from engine.texture.planes import COLOURS
from engine.texture.record import Instance
from engine.texture.sparse_planes import OfSheets, SparsePlanes

RECORD_OVERHEAD = 200  # bytes of a record's own objects, roughly
_NOWHERE = Rect(0, 0, 0, 0)
_FINEST = 1 << 14  # finer than any level
_ANYWHERE = Rect(-(1 << 2 * _FINEST), -(1 << 2 * _FINEST), 1 << 2 * _FINEST, 1 << 2 * _FINEST)
_FEW = 256  # tiles of a level: so many are gone through one by one
_serials = itertools.count(1)


class PutAway(Protocol):
    """Bytes that are not in memory."""

    def __len__(self) -> int:
        """Counts them."""
        ...

    def opened(self) -> IO[bytes]:
        """Returns them as a file."""
        ...


class Coded(Protocol):
    """Data of a record in fewer bytes."""

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        ...

    @property
    def itemsize(self) -> int:
        """Counts the bytes of each of the data."""
        ...

    def made(self) -> np.ndarray:
        """Returns the data, read-only."""
        ...


@dataclass(frozen=True, eq=False, slots=True)
class Since:
    """Where a record may differ from the one whose place it took: `of` gives that one, while it is there.

    `at`: a part of the tile, from its corner; `spans`, uint8 (h, 2): the columns of each of its rows, from its left
    edge on, out of which both are the same.
    """

    of: Callable[[], Record | None]
    at: Rect
    spans: np.ndarray

    @classmethod
    def it(cls, record: Record, at: Rect, spans: np.ndarray) -> Since:
        """Tells of a record, which need not stay for that."""
        return cls(weakref.ref(record), at, spans.astype(np.uint8))


@dataclass(frozen=True, eq=False, slots=True, weakref_slot=True)
class Record:
    """The residual of one tile.

    `rect`: the part of the tile it covers, in pixels from the tile's corner; zero elsewhere.
    `held`: its `data`, or what they are made of; `inks`: the n instances of its ink planes.
    `depth`: how many commits the pyramid had when it was stored: later attenuations are still to be applied.
    `since`: how it came from the record before, where that is known.
    """

    rect: Rect
    held: np.ndarray | Coded
    inks: tuple[Instance, ...]
    depth: int
    since: Since | None = None

    @property
    def data(self) -> np.ndarray:
        """Gives int16 or int32 (4 + 3n, h, w) in steps of the grid, read-only."""
        held = self.held
        return held if isinstance(held, np.ndarray) else held.made()

    @property
    def there(self) -> bool:
        """Tells whether anything is held: the data of some are only made when they are asked for."""
        return True

    @property
    def sheets(self) -> SparsePlanes | None:
        """Gives what is held of many inks; None for others."""
        held = self.held
        if isinstance(held, OfSheets):
            return held.plain()
        return held if isinstance(held, SparsePlanes) else None

    @property
    def plain_size(self) -> int:
        """Counts the bytes of the data, which need not be made for that."""
        return (COLOURS + 3 * len(self.inks)) * self.rect.area * self.held.itemsize

    def exchange(self, held: np.ndarray | Coded) -> None:
        """Holds the same data in another form.  Other threads may read them meanwhile."""
        object.__setattr__(self, "held", held)

    def came_from(self, since: Since | None) -> Record:
        """Notes how it came from the record before, or forgets it; returns the record itself."""
        object.__setattr__(self, "since", since)
        return self

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that the record takes."""
        return self.held.nbytes + RECORD_OVERHEAD


@dataclass(frozen=True, eq=False, slots=True)
class Change:
    """One commit, linked to the one before, until that is forgotten.

    `level`, `rect`: where pixels changed.  `coarsest`: the coarsest level that has another record now, above which no
    value changed; None where that is not known.
    """

    level: int
    rect: Rect
    before: Change | None
    serial: int = field(default_factory=lambda: next(_serials))
    depth: int = 1
    coarsest: int | None = None

    def reach(self, level: int) -> Rect:
        """Returns the pixels of `level` whose value this change can alter (notes of the pyramid: locality)."""
        if self.coarsest is not None and level < self.coarsest:
            return _NOWHERE
        if level <= self.level:
            return self.rect.zoomed(level - self.level)
        return self.rect.grown(2).zoomed(level - self.level)

    def forget_before(self) -> None:
        """Forgets the commits before it.  Other threads may go through them meanwhile."""
        object.__setattr__(self, "before", None)


@dataclass(frozen=True, eq=False, slots=True)
class Attenuation:
    """What a commit leaves of finer detail, waiting to be applied; linked to the one before.

    `keep`: A at the commit's level by tile, 1 elsewhere; `spares_alpha`: alpha keeps all of itself;
    `number`: of the commit (`Pyramid.commits`).
    """

    change: Change
    keep: Mapping[tuple[int, int], Lasting]
    before: Attenuation | None
    spares_alpha: bool = False
    number: int = 0

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return RECORD_OVERHEAD + sum(kept.nbytes for kept in self.keep.values())


Level = immutables.Map[tuple[int, int], Record] | PagedLevel[Record]


def level_of(records: Mapping[tuple[int, int], Record]) -> Level:
    """Returns a level with some records, by pages where they are many."""
    if isinstance(records, PagedLevel):
        return records
    if len(records) >= paged_level.MANY:
        return PagedLevel.of(records)
    return records if isinstance(records, immutables.Map) else immutables.Map(records)


@dataclass(frozen=True, eq=False, slots=True)
class Ground:
    """A picture laid down before anything was painted: its `rect` of level 0, the records that it made, its `pixels`
    as a PNG, from which they can be made again, and what gives its values over any rectangle of some levels, float32
    (4, h, w) on the grid, new each time."""

    rect: Rect
    levels: immutables.Map[int, Level]
    pixels: bytes | PutAway
    values: Mapping[int, Callable[[Rect], np.ndarray]]


@dataclass(frozen=True, eq=False, slots=True)
class Pyramid:
    """One state of a layer's canvas.

    `uid` names the layer's line of history, for caches, `family` the one that it branched from: only those of one
    family share records.  `waits`: the newest attenuation that was not applied to the records; `settled`: those of the
    commits up to this depth have been.  `ground`: the picture that the layer began with, if it began with one.
    `grid`: on which all values lie, by its bits; `commits`: how many there were in all the layer's life, which counts
    where the grid is coarse.  `known`: where the records of some levels lie (`blocks`), `bounds_known` those of all
    (`level_bounds`).
    """

    levels: immutables.Map[int, Level] = field(default_factory=immutables.Map)
    last: Change | None = None
    uid: int = field(default_factory=lambda: next(_serials))
    settled: int = 0
    ground: Ground | None = None
    waits: Attenuation | None = None
    grid: int = FINE
    commits: int = 0
    known: immutables.Map[int, Blocks] = field(default_factory=immutables.Map, repr=False)
    family: int = field(default_factory=lambda: next(_serials))
    bounds_known: LevelBounds | None = field(default=None, repr=False)

    @property
    def step(self) -> np.float32:
        """Gives the step of the grid, 2^-16 or 2^-12."""
        return step_of(self.grid)

    @property
    def depth(self) -> int:
        """Counts the commits that led to this state."""
        return self.last.depth if self.last else 0

    @property
    def coarsest(self) -> int | None:
        """Gives the coarsest level with a record; None if there is none."""
        bounds = level_bounds(self)
        return min(self.levels, default=None) if bounds is None else bounds.coarsest

    @property
    def finest(self) -> int | None:
        """Gives the finest level with a record; None if there is none."""
        return max(self.levels, default=None)

    @property
    def bare(self) -> Ground | None:
        """Returns the ground, if it is all that there is: nobody has painted on it."""
        return self.ground if self.ground is not None and self.ground.levels is self.levels else None

    def branched(self) -> Pyramid:
        """Returns the same state at the start of a line of history of its own."""
        return replace(self, uid=next(_serials))

    def waiting(self, since: int = 0) -> Iterator[Attenuation]:
        """Yields the attenuations that have not been applied to a record stored at depth `since`, newest first."""
        waits = self.waits
        while waits is not None and waits.change.depth > since:
            yield waits
            waits = waits.before

    def records(self, level: int, rect: Rect) -> Iterator[tuple[TileKey, Record]]:
        """Yields the stored tiles of a level that meet a rectangle."""
        stored = self.levels.get(level)
        if not stored or rect.empty:
            return
        places = rect.within_tiles()
        x0, y0, x1, y1 = places
        if places.area <= min(len(stored), _FEW):
            found = [(x, y) for y in range(y0, y1) for x in range(x0, x1)]
        else:
            near = stored if (known := self.blocks(level)) is None else known.within(places)
            found = sorted(at for at in near if x0 <= at[0] < x1 and y0 <= at[1] < y1)
        for place in found:
            record = stored.get(place)
            if record is not None:
                yield TileKey(level, *place), record

    def holds(self, key: TileKey, record: Record) -> bool:
        """Tells whether a record is the one of its tile."""
        stored = self.levels.get(key.level)
        return stored is not None and stored.get((key.x, key.y)) is record

    def has_records(self, level: int, rect: Rect) -> bool:
        """Tells whether a stored tile of a level meets a rectangle."""
        stored, places = self.levels.get(level), rect.within_tiles()
        if not stored or rect.empty:
            return False
        if places.area <= min(len(stored), _FEW):
            return any((key.x, key.y) in stored for key in rect.tiles(level))
        if (known := self.blocks(level)) is not None:
            return next(known.within(places), None) is not None
        x0, y0, x1, y1 = places
        return any(x0 <= x < x1 and y0 <= y < y1 for x, y in stored)

    def blocks(self, level: int) -> Blocks | PagedLevel[Record] | None:
        """Returns what tells where the records of a level lie; None where they are few.  Going through all is noted."""
        stored = self.levels.get(level)
        if isinstance(stored, PagedLevel):
            return stored
        if stored is None or len(stored) < _FEW:
            return None
        known = self.known.get(level)
        if known is None or known.stored is not stored:
            known = Blocks.of(stored)
            object.__setattr__(self, "known", self.known.set(level, known))
        return known

    def all_records(self) -> Iterator[tuple[TileKey, Record]]:
        """Gives all records with their places, the coarsest level first, row by column of tiles."""
        for level in sorted(self.levels):
            stored = self.levels[level]
            for part in stored.lines(0) if isinstance(stored, PagedLevel) else [stored.items()]:
                for place, record in sorted(part):
                    yield TileKey(level, *place), record

    def stacks(self, level: int) -> Iterator[tuple[Instance, ...]]:
        """Yields the inks of the records of a level; those on disk are read only where some were painted over."""
        stored = self.levels[level]
        if not isinstance(stored, PagedLevel):
            yield from (record.inks for record in stored.values())
            return
        for page in stored.pages.values():
            away, changed = page.held
            if away is None or any(place in away.where for place in changed):
                yield from (record.inks for _, record in page.items())
                continue
            yield from away.inks
            yield from (record.inks for record in changed.values() if record is not None)

    def bounds(self, level: int) -> Rect:
        """Returns the smallest rectangle of `level` that holds every stored residual; empty if there is none."""
        whole = Rect(0, 0, 0, 0)
        for key, record in self.all_records():
            r = record.rect
            x, y = key.rect.x0, key.rect.y0
            placed = Rect(x + r.x0, y + r.y0, x + r.x1, y + r.y1)
            whole = whole.union(placed.zoomed(level - key.level))
        return whole

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that all records take; those of pages on disk take hardly any."""
        levels = (s.here() if isinstance(s, PagedLevel) else s.values() for s in self.levels.values())
        return sum(record.nbytes for records in levels for record in records)


def level_bounds(pyramid: Pyramid) -> LevelBounds | None:
    """Returns where the records of all levels lie; None where these are few.  Going through all is noted."""
    if len(pyramid.levels) < MANY_LEVELS:
        return None
    known = pyramid.bounds_known
    if known is None or known.levels is not pyramid.levels:
        known = LevelBounds.of(pyramid.levels)
        object.__setattr__(pyramid, "bounds_known", known)
    return known


def finer_levels(pyramid: Pyramid, level: int, rect: Rect) -> Iterator[int]:
    """Yields the finer levels that may have records in a rectangle of a level."""
    bounds = level_bounds(pyramid)
    return (k for k in pyramid.levels if k > level) if bounds is None else bounds.finer(level, rect)


def changes_between(a: Change | None, b: Change | None) -> Iterator[Change]:
    """Yields the commits that one of two states has and the other has not, newest first; where some of them are
    forgotten, at last one that may have changed anything."""
    while a is not b:
        if b is None or (a is not None and a.depth >= b.depth):
            assert a is not None
            newer, a = a, a.before
        else:
            newer, b = b, b.before
        yield newer
        if newer.depth > 1 and newer.before is None:
            yield Change(_FINEST, _ANYWHERE, None)
            return


def changed_rects(old: Pyramid, new: Pyramid, level: int) -> list[Rect]:
    """Returns the rectangles of `level` in which two states of one line of history may differ."""
    rects = (change.reach(level) for change in changes_between(old.last, new.last))
    return [rect for rect in rects if not rect.empty]
