"""Records of the painting itself, made smaller and put away on disk where the process would take too much.

A record keeps its value: its data are made, or read, when somebody asks for them, and those asked for of late are kept.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator, Sequence
from itertools import starmap, takewhile

import numpy as np

from engine.archive.shelves.filed_pages import blocks_of
from engine.canvas import growth as growths
from engine.canvas.layers import Group, layers
from engine.canvas.rising.paged_level import PagedLevel
from engine.canvas.store import Pyramid, Record
from engine.session.coding.coded_records import CodedData, encode, links_of, put_away
from engine.session.coding.coded_tiles import CodedTile, encode_tile
from engine.session.coding.paged_records import put_page_away
from engine.session.differing import placed_records
from engine.session.held_pyramids import pyramids
from engine.texture.even_planes import EvenPlanes
from engine.texture.sparse_planes import SparsePlanes

_SMALL = 2 << 10  # bytes of data that are not worth it
_OF_LATE = 32  # commits: what these stored is most likely read next
_AT_ONCE = 1 << 20  # bytes that are looked for in one piece of work
_LOOKS = 1 << 13  # records that are looked at in one
_TIMED = 64  # of them, after which the clock is looked at, too; it is as soon as one was made smaller
_GROWN = 32 << 20  # bytes that the process grows by before all are looked through again


class Paging:
    """Frees bytes of the records of a painting.  It belongs to the session's thread.

    First what older states have alone that are kept aside is coded and goes to disk; then records of levels that have
    many, by pages, as far as they were stored long ago, and what a file brought.  Then it codes what was stored long
    ago, of the levels farthest from the one that is seen; then what was stored of late; then what is coded goes to
    disk; at last what was painted with examples is coded, and goes there.  `wanted`: bytes that are still to be freed.

    All records of one state of the painting are looked through before those of another are, and then not until the
    process has grown: where nearly all is small already, each look finds little.
    """

    def __init__(self) -> None:
        self.wanted = 0
        self._root: Group | None = None  # whose records are looked through, or were
        self._found: Iterator[int] | None = None  # what those free that are not yet; None where all were
        self._left = 0  # bytes that were wanted still when all were, or fewer since

    def want(self, root: Group, level: int | None, size: int, aside: Iterable[Group] = ()) -> None:
        """Tells what is to be freed of the layers `root`; `level`: that is seen, None for none; `aside`: of states that
        are kept, too."""
        self.wanted, self._left = size, min(self._left, size)
        grown = size > self._left + (_GROWN if self._left else 0)
        if self._found is None and root is not self._root and grown:
            self._root, self._found = root, _freed(root, level, tuple(aside))

    def step(self, size: int = _AT_ONCE, seconds: float = math.inf) -> None:
        """Frees as many bytes, or all that are wanted, or all that there are; or looks at so many records, or for so
        many seconds of the processor: the last of them may take longer."""
        least, end, freed = max(self.wanted - size, 0), time.thread_time() + seconds, None
        for looks in range(_LOOKS):
            timed = freed or looks % _TIMED == 0
            if self.wanted <= least or (timed and time.thread_time() >= end):
                return
            freed = None if self._found is None else next(self._found, None)
            if freed is None:
                if self._found is not None:
                    self._found, self._left = None, self.wanted
                self.wanted = 0
                return
            self.wanted = max(self.wanted - freed, 0)


def _freed(root: Group, level: int | None, aside: Sequence[Group]) -> Iterator[int]:
    """Makes one record after the other smaller; yields the bytes that were freed."""
    for state in aside:
        yield from starmap(_put_aside, placed_records(state, root))
    held = pyramids(root).values()
    for pyramid in held:
        for k in _farthest_first(pyramid, level):
            stored = pyramid.levels[k]
            if isinstance(stored, PagedLevel):
                yield from (put_page_away(at, page, _old_until(pyramid)) for at, page in stored.pages.items())
    for pyramid in held:
        yield from (0 if block is None else block.put_away() for block in blocks_of(pyramid))
    for late in (False, True):
        for pyramid in held:
            old = _old_until(pyramid)
            for record in _records(pyramid, level):
                yield encode(record, None) if (late or record.depth <= old) and _is_worth(record) else 0
    for pyramid in held:
        for record in _records(pyramid, level):
            yield put_away(record.held) if record.there and isinstance(record.held, CodedData) else 0
    grown = [tile for layer in layers(root) for tile in growths.tiles_of(layer.growth)]
    yield from map(encode_tile, grown)
    for tile in grown:
        yield put_away(tile.held) if isinstance(tile.held, CodedTile) else 0


def _put_aside(record: Record, live: Record | None) -> int:
    """Makes a record smaller, and all those of which it is made, but for the one that is in its place now."""
    freed = 0
    for one in takewhile(lambda one: one is not live, links_of(record)):
        freed += encode(one, None) if _is_worth(one) else 0
        freed += put_away(one.held) if one.there and isinstance(one.held, CodedData) else 0
    return freed


def _old_until(pyramid: Pyramid) -> int:
    """Returns the newest commit that is not of late: what it and all before it stored is old, and so is what a file
    brought."""
    return max(pyramid.depth - _OF_LATE, 0)


def _is_worth(record: Record) -> bool:
    """Tells whether a record is to be coded: it holds something, as it was stored."""
    plain = record.there and isinstance(record.held, np.ndarray | EvenPlanes | SparsePlanes)
    return plain and record.held.nbytes >= _SMALL


def _records(pyramid: Pyramid, level: int | None) -> Iterator[Record]:
    """Yields all records in memory, those of the levels farthest from one first."""
    for k in _farthest_first(pyramid, level):
        stored = pyramid.levels[k]
        yield from stored.here() if isinstance(stored, PagedLevel) else stored.values()


def _farthest_first(pyramid: Pyramid, level: int | None) -> list[int]:
    """Returns the levels of a pyramid, those farthest from one first."""
    seen = 0 if level is None else level
    return sorted(pyramid.levels, key=lambda k: -abs(k - seen))
