"""The tiles of a level in which something lies, found from coarse levels on: bounds of coarse paint are too wide."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import islice

from engine.numeric.address import TILE, Rect, TileKey

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
    stored: Callable[[int], Iterable[TilePlace]],
    filled: Callable[[TileKey], bool],
    coarsest: int,
    level: int,
    most: int | None = None,
) -> Iterator[tuple[int, set[TileKey]]]:
    """Yields the levels on the way, each with its tiles that are filled; of one with more than `most`, so many and one
    more."""
    known: set[TilePlace] = set()
    for k in range(coarsest, level + 1):
        near = {*_children(known), *stored(k)}
        known = set(islice((place for place in near if filled(TileKey(k, *place))), None if most is None else most + 1))
        yield k, {TileKey(k, *place) for place in known}


def may_lead_to(key: TileKey, level: int, bounds: Rect) -> bool:
    """Tells whether the way from a tile to those of a finer level may lead into `bounds` of that: each tile sees its
    own four of the next level and those around."""
    finer = level - key.level
    reached = Rect(TILE * (key.x - 1), TILE * (key.y - 1), TILE * (key.x + 2), TILE * (key.y + 2)).zoomed(finer)
    return not reached.intersect(bounds).empty


def _children(places: Iterable[TilePlace]) -> Iterator[TilePlace]:
    """Yields the tiles of the next level that see something of some tiles: their own, and those around."""
    for x, y in places:
        for j in range(-1, 3):
            for i in range(-1, 3):
                yield 2 * x + i, 2 * y + j
