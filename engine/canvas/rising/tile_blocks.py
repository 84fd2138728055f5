"""Where a level's tiles lie, by blocks: so that those in a large rectangle are found without going through them all."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass

import immutables

from engine.numeric.address import Rect

Place = tuple[int, int]  # column and row of a tile, or of a block
_SIDE = 5  # a block is 32 tiles along, as a power of two


@dataclass(frozen=True, eq=False, slots=True)
class Blocks:
    """The places of a level's tiles `stored`, by block.  Immutable."""

    stored: Container[Place]
    blocks: immutables.Map[Place, frozenset[Place]]

    @classmethod
    def of(cls, stored: Mapping[Place, object]) -> Blocks:
        """Goes through all tiles."""
        found: dict[Place, list[Place]] = {}
        for place in stored:
            found.setdefault(_block(place), []).append(place)
        return cls(stored, immutables.Map({block: frozenset(places) for block, places in found.items()}))

    def after(self, stored: Container[Place], places: Iterable[Place]) -> Blocks:
        """Returns those of another state of the level, which differs at no other places."""
        changed: dict[Place, set[Place]] = {}
        for place in places:
            if (place in stored) != (place in self.stored):
                block = _block(place)
                held = changed.get(block)
                held = changed[block] = set(self.blocks.get(block, ())) if held is None else held
                held.symmetric_difference_update((place,))
        if not changed:
            return Blocks(stored, self.blocks)
        editable = self.blocks.mutate()
        for block, held in changed.items():
            if held:
                editable[block] = frozenset(held)
            else:
                del editable[block]
        return Blocks(stored, editable.finish())

    def within(self, places: Rect) -> Iterator[Place]:
        """Yields those that lie in a rectangle of places."""
        x0, y0, x1, y1 = places
        for held in self._met(places):
            yield from (place for place in held if x0 <= place[0] < x1 and y0 <= place[1] < y1)

    def any_within(self, places: Rect) -> bool:
        """Tells whether any lies in a rectangle of places."""
        return next(self.within(places), None) is not None

    def _met(self, places: Rect) -> Iterator[frozenset[Place]]:
        if places.empty:
            return
        x0, y0, x1, y1 = places.x0 >> _SIDE, places.y0 >> _SIDE, (places.x1 - 1) >> _SIDE, (places.y1 - 1) >> _SIDE
        if (x1 - x0 + 1) * (y1 - y0 + 1) > len(self.blocks):
            yield from (held for at, held in self.blocks.items() if x0 <= at[0] <= x1 and y0 <= at[1] <= y1)
            return
        for y in range(y0, y1 + 1):
            for x in range(x0, x1 + 1):
                held = self.blocks.get((x, y))
                if held is not None:
                    yield held


def _block(place: Place) -> Place:
    """Returns the block in which a place lies."""
    return place[0] >> _SIDE, place[1] >> _SIDE
