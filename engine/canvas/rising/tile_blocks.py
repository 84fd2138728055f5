"""Where a level's tiles lie, by blocks: so that those in a large rectangle are found without going through them all.

The tiles of a block are the bits of one number, row by row: each state of the history keeps the block that it changed.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import immutables
import numpy as np

from engine.numeric.address import Rect

Place = tuple[int, int]  # column and row of a tile, or of a block
_SIDE = 5  # a block is 32 tiles along, as a power of two
_ALONG = 1 << _SIDE
_INSIDE = _ALONG - 1
_FEW = 12  # bits that are gone through one by one


@dataclass(frozen=True, eq=False, slots=True)
class Blocks:
    """The places of a level's tiles `stored`, as the bits of their blocks.  Immutable."""

    stored: Container[Place]
    blocks: immutables.Map[Place, int]

    @classmethod
    def of(cls, stored: Mapping[Place, object]) -> Blocks:
        """Goes through all tiles."""
        found: dict[Place, int] = {}
        for place in stored:
            block = _block(place)
            found[block] = found.get(block, 0) | _bit(place)
        return cls(stored, immutables.Map(found))

    def after(self, stored: Container[Place], places: Iterable[Place]) -> Blocks:
        """Returns those of another state of the level, which differs at no other places."""
        changed: dict[Place, int] = {}
        for place in places:
            if (place in stored) != (place in self.stored):
                block = _block(place)
                held = changed[block] if block in changed else self.blocks.get(block, 0)
                changed[block] = held ^ _bit(place)
        if not changed:
            return Blocks(stored, self.blocks)
        editable = self.blocks.mutate()
        for block, held in changed.items():
            if held:
                editable[block] = held
            else:
                del editable[block]
        return Blocks(stored, editable.finish())

    def within(self, places: Rect) -> Iterator[Place]:
        """Yields those that lie in a rectangle of places."""
        for (x, y), held in self._met(places):
            left, top = x << _SIDE, y << _SIDE
            for at in _set_bits(held):
                yield left + (at & _INSIDE), top + (at >> _SIDE)

    def _met(self, places: Rect) -> Iterator[tuple[Place, int]]:
        """Yields the blocks that a rectangle of places meets, and the bits of those of their tiles that lie in it."""
        if places.empty:
            return
        x0, y0, x1, y1 = places.x0 >> _SIDE, places.y0 >> _SIDE, (places.x1 - 1) >> _SIDE, (places.y1 - 1) >> _SIDE
        if (x1 - x0 + 1) * (y1 - y0 + 1) > len(self.blocks):
            for at, held in self.blocks.items():
                if x0 <= at[0] <= x1 and y0 <= at[1] <= y1:
                    yield at, held & _bits(at, places)
            return
        for y in range(y0, y1 + 1):
            for x in range(x0, x1 + 1):
                held = self.blocks.get((x, y), 0)
                if held:
                    yield (x, y), held & _bits((x, y), places)


def _block(place: Place) -> Place:
    """Returns the block in which a place lies."""
    return place[0] >> _SIDE, place[1] >> _SIDE


def _bit(place: Place) -> int:
    """Returns the bit of a place in its block."""
    return 1 << ((place[1] & _INSIDE) << _SIDE | place[0] & _INSIDE)


def _set_bits(held: int) -> Sequence[int]:
    """Returns which bits of a block are set."""
    if held.bit_count() > _FEW:
        raw = np.frombuffer(held.to_bytes(_ALONG * _ALONG // 8, "little"), np.uint8)
        found: list[int] = np.flatnonzero(np.unpackbits(raw, bitorder="little")).tolist()
        return found
    out = []
    while held:
        out.append((held & -held).bit_length() - 1)
        held &= held - 1
    return out


def _bits(block: Place, places: Rect) -> int:
    """Returns the bits of a block that lie in a rectangle of places which it meets."""
    x, y = block[0] << _SIDE, block[1] << _SIDE
    left, right = max(places.x0 - x, 0), min(places.x1 - x, _ALONG)
    top, bottom = max(places.y0 - y, 0), min(places.y1 - y, _ALONG)
    rows = ((1 << (bottom << _SIDE)) - 1) // ((1 << _ALONG) - 1) >> (top << _SIDE) << (top << _SIDE)
    return rows * ((1 << right) - (1 << left))
