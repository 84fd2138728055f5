"""Pages of records put away on disk, as one piece each: small records are many, and each has objects of its own.

What somebody asks for is read by whole pages, coded as it was put away, and those read of late are kept.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from engine.archive.shelves.filed_pages import PAGES_READ
from engine.archive.shelves.shelf import Filed
from engine.canvas.rising.page_places import PageKey, PagePlaces, TilePlace, places_in
from engine.canvas.rising.paged_level import Page
from engine.canvas.store import Record
from engine.keeping.spill import PLACE_OVERHEAD, Spilled, spill
from engine.numeric.address import Rect
from engine.session.coding.coded_records import CodedData, CodedSheets, coded_alone
from engine.texture.even_planes import EvenPlanes
from engine.texture.record import Instance

_FACTS = 10  # int64 that are told of a record, before what it is made of
_WORTH_PART = 8  # of the records of a page that were changed since: fewer are not worth that the page is written anew
_PAGE_OVERHEAD = 400 + PLACE_OVERHEAD  # bytes of memory that a page on disk takes, roughly: it may be of one tile
_INTEGERS = np.dtype(np.int16), np.dtype(np.int32)


@dataclass(frozen=True, eq=False, slots=True)
class RecordsAway:
    """Records of a page that are not in memory: `first`, the place of one of them, from which the others' are told;
    `where` they all lie; `inks`: stacks of inks that they have; `piece`: what they are made of."""

    first: TilePlace
    where: PagePlaces
    inks: tuple[tuple[Instance, ...], ...]
    piece: Spilled | bytes

    def records(self) -> Mapping[TilePlace, Record]:
        """Returns them; they are read, if they were not of late.  OSError if they cannot be."""
        known = PAGES_READ.get(self)
        if known is None:
            known = self._read()
            PAGES_READ.keep(self, known, sum(record.nbytes for record in known.values()))
        return known

    def _read(self) -> dict[TilePlace, Record]:
        piece = self.piece if isinstance(self.piece, bytes) else self.piece.read()
        count, (x, y) = len(self.where), self.first
        facts = np.frombuffer(piece, np.int64, count * _FACTS).reshape(count, _FACTS)
        found, start = {}, facts.nbytes
        for right, down, x0, y0, x1, y1, depth, told, edges, length in facts.tolist():
            rect, inks = Rect(x0, y0, x1, y1), self.inks[told >> 1]
            coded = CodedData(rect, inks, _INTEGERS[told & 1], None, edges, piece[start : start + length])
            found[x + right, y + down] = Record(rect, coded, inks, depth)
            start += length
        return found


def put_page_away(key: PageKey, page: Page[Record], newest: int) -> int:
    """Puts the records of a page away that were not stored after the commit `newest`.  Returns the bytes of memory
    that they take less: 0 where too few are worth it."""
    away, changed = page.held
    gone = [place for place, record in changed.items() if record is None]
    old = {at: record for at, record in changed.items() if record is not None and _is_old(record, newest)}
    before = 0 if away is None else len(away.where)
    freed = sum(record.nbytes for record in old.values()) - (_PAGE_OVERHEAD if away is None else 0)
    if freed <= 0 or len(old) * _WORTH_PART < before:
        return 0
    kept = {} if away is None else {at: record for at, record in away.records().items() if at not in changed}
    left = changed.mutate()
    for place in (*gone, *old):
        del left[place]
    page.put_away(_away(key, kept | old), left.finish())
    return freed


def _is_old(record: Record, newest: int) -> bool:
    held = record.held
    plain = isinstance(held, np.ndarray | EvenPlanes | Filed) or (
        isinstance(held, CodedData) and not isinstance(held, CodedSheets)
    )
    return plain and record.depth <= newest


def _away(key: PageKey, records: Mapping[TilePlace, Record]) -> RecordsAway:
    first, stacks = next(iter(records)), dict[tuple[Instance, ...], int]()
    facts, parts = np.empty((len(records), _FACTS), np.int64), [b""]
    for number, (place, record) in enumerate(records.items()):
        coded, packed = coded_alone(record)
        told = stacks.setdefault(record.inks, len(stacks)) << 1 | _INTEGERS.index(coded.dtype)
        at = place[0] - first[0], place[1] - first[1]
        facts[number] = *at, *record.rect, record.depth, told, coded.edges, len(packed)
        parts.append(packed)
    parts[0] = facts.tobytes()
    piece = b"".join(parts)
    return RecordsAway(first, places_in(key, records), tuple(stacks), spill().put(piece) or piece)
