"""Tiles of a file by pages, where they are many: of each is told in a few bytes where it lies in the file's blocks.

What somebody asks for is made by whole pages, and those asked for of late are kept.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain

from immutables import Map

from engine.archive.shelves.shelf import Block, Filed, Lessened
from engine.canvas.rising.page_places import LEAST_SIDE, NearPlaces, TilePlace, bit_of, page_of, place_in
from engine.canvas.rising.paged_level import MANY, Page, PagedLevel
from engine.canvas.store import Pyramid, Record
from engine.files.fault import FileError
from engine.numeric.address import Rect, TileKey
from engine.numeric.recent import Recent
from engine.texture.record import Instance

_READ = 24 << 20  # bytes of pages kept that were asked for
_FACT = struct.Struct("<7BI")  # of a tile: bit in the page, rectangle, inks and bits, number of the block, and in it
_WIDE = 32  # bits of each of the data, else half as many

Stack = tuple[Instance, ...]

PAGES_READ: Recent[Mapping[TilePlace, Record]] = Recent(lambda: _READ)


@dataclass(frozen=True, eq=False, slots=True)
class FiledPage:
    """Records of a page that lie in blocks of a file: `where` they lie in it; `inks`: stacks of inks that they have;
    `blocks`: that they lie in; `facts`: of each of them."""

    where: NearPlaces
    inks: tuple[Stack, ...]
    blocks: tuple[Block, ...]
    facts: bytes
    depth: int

    def records(self) -> Mapping[TilePlace, Record]:
        """Returns them, whose data are decoded when somebody asks for these."""
        known = PAGES_READ.get(self)
        if known is None:
            known = dict(self.made())
            PAGES_READ.keep(self, known, sum(record.nbytes for record in known.values()))
        return known

    def made(self) -> Iterator[tuple[TilePlace, Record]]:
        """Yields them, new each time."""
        for bit, x0, y0, x1, y1, told, block, number in _FACT.iter_unpack(self.facts):
            held = Filed(self.blocks[block], number, _WIDE >> (told & 1))
            yield place_in(self.where.at, bit), Record(Rect(x0, y0, x1, y1), held, self.inks[told >> 1], self.depth)


def blocks_of(pyramid: Pyramid) -> Iterator[Block | None]:
    """Yields the blocks of a file in which records of a pyramid lie, as often as there are some in one; None for each
    record, and each page, that lies in none: so whoever looks for them can stop at any time."""
    for stored in pyramid.levels.values():
        if isinstance(stored, PagedLevel):
            for page in stored.pages.values():
                away = page.held[0]
                yield from away.blocks if isinstance(away, FiledPage) else (None,)
        for record in stored.here() if isinstance(stored, PagedLevel) else stored.values():
            held = record.held if record.there else None
            filed = held.filed if isinstance(held, Lessened) else held
            yield filed.block if isinstance(filed, Filed) else None


class _Gathering:
    """A page of which tiles are being read."""

    __slots__ = ("_blocks", "_facts", "_inks", "bits")

    def __init__(self) -> None:
        self.bits = 0
        self._inks: dict[Stack, int] = {}
        self._blocks: dict[Block, int] = {}
        self._facts = bytearray()

    def add(self, bit: int, record: Record, held: Filed) -> None:
        """Adds a tile that it has not."""
        told = self._inks.setdefault(record.inks, len(self._inks)) << 1 | (held.bits < _WIDE)
        block = self._blocks.setdefault(held.block, len(self._blocks))
        self._facts += _FACT.pack(bit.bit_length() - 1, *record.rect, told, block, held.number)
        self.bits |= bit

    def page(self, at: TilePlace, depth: int) -> FiledPage:
        """Returns it with all that it has."""
        return FiledPage(NearPlaces(at, self.bits), tuple(self._inks), tuple(self._blocks), bytes(self._facts), depth)


class Gathered:
    """Tiles as they are read of a file, by their levels.  `name`: the file's; `count`: how many there will be."""

    def __init__(self, name: str, count: int, tiles: Iterable[tuple[TileKey, Record]] = ()) -> None:
        self._name, self._by_pages = name, count >= MANY
        self._filed: dict[int, dict[TilePlace, _Gathering]] = {}
        self._others: dict[int, dict[TilePlace, Record]] = {}
        for key, record in tiles:
            self.add(key, record)

    def add(self, key: TileKey, record: Record) -> None:
        """Takes a tile.  FileError if it is there already."""
        place, held = (key.x, key.y), record.held
        others = self._others.setdefault(key.level, {})
        if place in others:
            raise self._twice(key)
        if not self._by_pages:
            others[place] = record
            return
        pages, bit = self._filed.setdefault(key.level, {}), bit_of(place)
        page = pages.get(page_of(place))
        if page is not None and page.bits & bit:
            raise self._twice(key)
        if not isinstance(held, Filed):
            others[place] = record
            return
        if page is None:
            page = pages[page_of(place)] = _Gathering()
        page.add(bit, record, held)

    def levels(self, depth: int) -> dict[int, Mapping[TilePlace, Record]]:
        """Returns all of them by level, stored at a depth of the pyramid; by pages where they are many."""
        return {level: self._level(level, depth) for level in list(self._others)}

    def _twice(self, key: TileKey) -> FileError:
        return FileError(self._name, f"tile {key.x}, {key.y} of level {key.level} is there twice")

    def _level(self, level: int, depth: int) -> Mapping[TilePlace, Record]:
        pages = {at: page.page(at, depth) for at, page in self._filed.pop(level, {}).items()}
        others = {place: _at_depth(record, depth) for place, record in self._others.pop(level).items()}
        count = sum(len(page.where) for page in pages.values())
        if count < MANY:
            return dict(chain.from_iterable(page.made() for page in pages.values())) | others
        by_key = {(*at, LEAST_SIDE): Page[Record](page, Map()) for at, page in pages.items()}
        paged = PagedLevel(Map(by_key), None, count)
        if not others:
            return paged
        editable = paged.mutate()
        for place, record in others.items():
            editable.set(place, record)
        return editable.finish()


def _at_depth(record: Record, depth: int) -> Record:
    return record if record.depth == depth else replace(record, depth=depth)
