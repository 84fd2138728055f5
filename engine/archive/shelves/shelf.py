"""Tiles of a file that are decoded when somebody looks at them.

An opening checks that the bytes are those that were saved, and that they are tiles; it keeps them.  What a record holds
is made of them when it is asked for, and what was made of late is kept, so that a painting that is open takes the room
of its file and of what is looked at.  What ink implies of colour (engine/archive/implied.py) is put back then, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from engine.archive.implied import Coded, Implied, square_of, square_restored
from engine.canvas.store import Pyramid, Record
from engine.canvas.tile_cache import TileCache
from engine.keeping import memory
from engine.keeping.spill import PLACE_OVERHEAD, Spilled, spill
from engine.numeric.address import TileKey
from engine.numeric.recent import Recent

_PART = 8  # of the budget of memory: tiles that are kept as they were decoded
CACHE = 16 << 20  # bytes of a layer's values that are kept while colour is put back
_TILE_OVERHEAD = 200  # bytes of a tile's own objects, roughly


DECODED: Recent[np.ndarray] = Recent(lambda: memory.budget() // _PART)


@dataclass(frozen=True, eq=False, slots=True)
class Block:
    """A run of so many tiles as a file holds them: `decode` gives their integers, of the stored bytes, which are
    `plain` ones deflated; `held`: those, or where on disk they are."""

    decode: Callable[[bytes | memoryview], Sequence[np.ndarray]]
    count: int
    plain: int
    held: memoryview | Spilled

    @property
    def stored(self) -> bytes | memoryview:
        """Gives the stored bytes.  OSError if they cannot be read."""
        held = self.held
        return held.read() if isinstance(held, Spilled) else held

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that they take."""
        held = self.held
        return PLACE_OVERHEAD if isinstance(held, Spilled) else held.nbytes

    def put_away(self) -> int:
        """Puts the stored bytes away on disk.  Returns the bytes of memory that they take less: 0 where they lie there
        already, are too few for that, or have no room."""
        held = self.held
        if isinstance(held, Spilled) or held.nbytes <= PLACE_OVERHEAD:
            return 0
        put = spill().put(bytes(held))
        if put is None:
            return 0
        object.__setattr__(self, "held", put)
        return put.size - PLACE_OVERHEAD


@dataclass(frozen=True, eq=False, slots=True)
class Filed:
    """The data of a record, as they lie in a block at a place: integers of so many `bits`."""

    block: Block
    number: int
    bits: int

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return self.block.nbytes // self.block.count + _TILE_OVERHEAD

    @property
    def itemsize(self) -> int:
        """Counts the bytes of each of the data."""
        return self.bits // 8

    def forget(self) -> None:
        """Lets the data go, which nobody asks for as they lie in the file."""
        DECODED.forget((self.block, self.number))

    def made(self) -> np.ndarray:
        """Returns the data, read-only."""
        known = DECODED.get((self.block, self.number))
        if known is None:
            for number, data in enumerate(self.block.decode(self.block.stored)):
                data.flags.writeable = False
                DECODED.keep((self.block, number), data, data.nbytes)
                known = data if number == self.number else known
        assert known is not None
        return known


@dataclass(frozen=True, eq=False, slots=True)
class Lessened:
    """The data of a record of whose colour the file holds only what its ink does not imply."""

    shelf: Shelf
    key: TileKey
    filed: Filed
    implied: Implied

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return self.filed.nbytes

    @property
    def itemsize(self) -> int:
        """Counts the bytes of each of the data."""
        return self.filed.itemsize

    def made(self) -> np.ndarray:
        """Returns the data, read-only."""
        known = DECODED.get(self)
        return self.shelf.restored(self) if known is None else known


class Shelf:
    """The tiles of one layer that a file holds.  Safe for several threads once it has its pyramid."""

    def __init__(self) -> None:
        self.pyramid = Pyramid()
        self._squares: dict[tuple[int, int, int], list[tuple[TileKey, Record, Implied, Lessened]]] = {}
        self._values = TileCache(CACHE)

    def record(self, key: TileKey, record: Record, implied: Implied | None) -> Record:
        """Returns the record of a tile, of which `record` holds what lies in the file."""
        if implied is None or not isinstance(record.held, Filed):
            return record
        held = Lessened(self, key, record.held, implied)
        self._squares.setdefault(square_of(key), []).append((key, record, implied, held))
        return Record(record.rect, held, record.inks, record.depth)

    def laid(self, pyramid: Pyramid) -> Pyramid:
        """Takes the pyramid that the file tells of, on which what is implied stands."""
        self.pyramid = pyramid
        return pyramid

    def restored(self, held: Lessened) -> np.ndarray:
        """Returns the data of a record with the colour that its ink implies, and keeps those of its square."""
        square = self._squares[square_of(held.key)]
        found = square_restored(self.pyramid, [tile[:3] for tile in square], self._values)
        asked: np.ndarray | None = None
        for (_, _, _, each), data in zip(square, found, strict=True):
            DECODED.keep(each, data, data.nbytes)
            each.filed.forget()
            asked = data if each is held else asked
        assert asked is not None
        return asked

    def others(self) -> int:
        """Counts the tiles of inks whose texture is not what it was, by one tile of each stack of inks."""
        count, told = 0, dict[tuple[object, ...], bool]()
        for square in self._squares.values():
            for key, record, implied, _ in square:
                if implied.inks not in told:
                    (data,) = square_restored(self.pyramid, [(key, record, implied)], self._values)
                    told[implied.inks] = implied.is_of(data)
                count += not told[implied.inks]
        return count


def as_filed(pyramid: Pyramid, tiles: Sequence[tuple[TileKey, Record]]) -> list[Coded] | None:
    """Returns tiles of a pyramid as the file holds them that it was opened from; None if they have been painted on
    since, or no ink implies anything of them."""
    found: list[Coded] = []
    for key, record in tiles:
        held = record.held
        if isinstance(held, Lessened):
            if held.shelf.pyramid.levels is not pyramid.levels or held.shelf.pyramid.last is not pyramid.last:
                return None
            found.append((key, replace(record, held=held.filed), held.implied))
        else:
            found.append((key, record, None))
    return found if any(implied is not None for _, _, implied in found) else None


def block_at(tiles: Sequence[Coded], start: int) -> Block | None:
    """Returns the block that some of the tiles, from a place on, are as a file holds them; None if they are not."""
    first = tiles[start][1].held
    if not isinstance(first, Filed) or first.number or start + first.block.count > len(tiles):
        return None
    there = [record.held for _, record, _ in tiles[start : start + first.block.count]]
    same = all(isinstance(h, Filed) and h.block is first.block and h.number == n for n, h in enumerate(there))
    return first.block if same else None


def shelved(tiles: Iterable[Coded], shelf: Shelf) -> Iterator[Coded]:
    """Yields tiles as a layer has them whose records hold what lies in the file."""
    return ((key, shelf.record(key, record, implied), implied) for key, record, implied in tiles)
