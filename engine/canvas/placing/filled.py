"""The tiles of a level in which something lies, found from coarse levels on: bounds of coarse paint are too wide."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from engine.numeric.address import TileKey

TilePlace = tuple[int, int]


def filled_tiles(
    stored: Callable[[int], Iterable[TilePlace]], filled: Callable[[TileKey], bool], coarsest: int, level: int
) -> set[TileKey]:
    """Returns the tiles of a level that are `filled`.  `stored`: where something new comes in at a level; `coarsest`:
    the first at which it does."""
    found: set[TileKey] = set()
    for _, tiles in filled_levels(stored, filled, coarsest, level):
        found = tiles
    return found


def filled_levels(
    stored: Callable[[int], Iterable[TilePlace]], filled: Callable[[TileKey], bool], coarsest: int, level: int
) -> Iterator[tuple[int, set[TileKey]]]:
    """Yields the levels on the way, each with its tiles that are filled."""
    known: set[TilePlace] = set()
    for k in range(coarsest, level + 1):
        near = {*_children(known), *stored(k)}
        known = {place for place in near if filled(TileKey(k, *place))}
        yield k, {TileKey(k, *place) for place in known}


def _children(places: Iterable[TilePlace]) -> Iterator[TilePlace]:
    """Yields the tiles of the next level that see something of some tiles: their own, and those around."""
    for x, y in places:
        for j in range(-1, 3):
            for i in range(-1, 3):
                yield 2 * x + i, 2 * y + j
