"""How large the pages of a level are: the farther its records lie apart, the wider, so that one never holds few.

A page that gets too many is split in four, down to 8 x 8 tiles; which were is noted, so that a tile finds its page.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Iterable, Iterator, Mapping
from typing import TypeVar

from engine.canvas.rising.page_places import LEAST_SIDE, WIDEST_SIDE, PageKey, TilePlace
from engine.numeric.address import Rect

R = TypeVar("R")

PAGE_FULL = 64  # records of a page, from which on it is split
_FILLED = 32  # at most, after that


def key_for(place: TilePlace, pages: Container[PageKey], split: Container[PageKey] | None) -> PageKey:
    """Returns the page that a tile lies in, whether that has records or none: the widest that was not split; where
    `split` is None all are of 8 x 8 tiles."""
    x, y = place
    near = x >> LEAST_SIDE, y >> LEAST_SIDE, LEAST_SIDE
    if split is None or near in pages:
        return near
    low, high = LEAST_SIDE, WIDEST_SIDE
    while low < high:
        side = low + high + 1 >> 1
        if (x >> side, y >> side, side) in split:
            high = side - 1
        else:
            low = side
    return x >> low, y >> low, low


def by_pages(
    records: Mapping[TilePlace, R], page: PageKey | None
) -> tuple[dict[PageKey, dict[TilePlace, R]], list[PageKey]]:
    """Returns records by pages that are not full, and which were split for that; `page`: that all lie in, None for any
    number of the widest."""
    out: dict[PageKey, dict[TilePlace, R]] = {}
    marks: list[PageKey] = []
    todo = list(_grouped(records, WIDEST_SIDE).items()) if page is None else [(page, dict(records))]
    while todo:
        key, some = todo.pop()
        if len(some) <= _FILLED or key[2] == LEAST_SIDE:
            out[key] = some
            continue
        inside = _around(some, key[2])
        x, y = next(iter(some))
        marks += ((x >> side, y >> side, side) for side in range(inside, key[2] + 1))
        todo += _grouped(some, inside - 1).items()
    return out, marks


def keys_met(pages: Collection[PageKey], split: Container[PageKey] | None, places: Rect) -> Iterable[PageKey]:
    """Returns the pages that a rectangle of places meets, and perhaps others where these are many."""
    side = LEAST_SIDE if split is None else WIDEST_SIDE
    x0, y0, x1, y1 = _met_of_size(places, side)
    if places.empty or (x1 - x0) * (y1 - y0) > len(pages):
        return () if places.empty else pages
    met = ((x, y, side) for y in range(y0, y1) for x in range(x0, x1))
    return (key for key in _smallest(met, split or (), places) if key in pages)


def _smallest(keys: Iterable[PageKey], split: Container[PageKey], places: Rect) -> Iterator[PageKey]:
    """Yields pages that were not split in the place of those that were, as far as a rectangle of places meets them."""
    todo = list(keys)
    while todo:
        x, y, side = key = todo.pop()
        if key not in split:
            yield key
            continue
        a0, b0, a1, b1 = _met_of_size(places, side - 1)
        columns, rows = range(max(2 * x, a0), min(2 * x + 2, a1)), range(max(2 * y, b0), min(2 * y + 2, b1))
        todo += ((column, row, side - 1) for row in rows for column in columns)


def _met_of_size(places: Rect, side: int) -> tuple[int, int, int, int]:
    """Returns the pages of a size that a rectangle of places meets: the first ones, and those behind the last."""
    x0, y0, x1, y1 = places
    return x0 >> side, y0 >> side, (x1 - 1 >> side) + 1, (y1 - 1 >> side) + 1


def _around(places: Mapping[TilePlace, object], most: int) -> int:
    """Returns the size of the smallest page that holds some places but is not of the least; `most`: of one that
    does."""
    x, y = next(iter(places))
    apart = 0
    for column, row in places:
        apart |= (column ^ x) | (row ^ y)
    return min(max(apart.bit_length(), LEAST_SIDE + 1), most)


def _grouped(records: Mapping[TilePlace, R], side: int) -> dict[PageKey, dict[TilePlace, R]]:
    """Returns records by pages of a size."""
    found: dict[PageKey, dict[TilePlace, R]] = {}
    for place, record in records.items():
        found.setdefault((place[0] >> side, place[1] >> side, side), {})[place] = record
    return found
