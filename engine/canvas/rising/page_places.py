"""Which tiles of a page have records, in few bytes: a small page has a bit for each, a wide one names those it has."""

from __future__ import annotations

from array import array
from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

TilePlace = tuple[int, int]  # column and row of a tile
PageKey = tuple[int, int, int]  # column and row of a page among those of its size; its tiles along, as a power of two

LEAST_SIDE = 3  # of a page, as a power of two: 8 tiles along
WIDEST_SIDE = 31  # as a page of more tiles has no place for theirs
_IN_PAGE = (1 << LEAST_SIDE) - 1
_HALF = 32  # bits of a row, or of a column, in a wide page
_LOW = (1 << _HALF) - 1


@dataclass(frozen=True, eq=False, slots=True)
class NearPlaces:
    """Places in a page of 8 x 8 tiles, `at` its column and row: their `bits`, by `bit_of`."""

    at: TilePlace
    bits: int

    def __contains__(self, place: TilePlace) -> bool:
        return self.bits & bit_of(place) != 0

    def __iter__(self) -> Iterator[TilePlace]:
        bits = self.bits
        while bits:
            yield place_in(self.at, (bits & -bits).bit_length() - 1)
            bits &= bits - 1

    def __len__(self) -> int:
        return self.bits.bit_count()


@dataclass(frozen=True, eq=False, slots=True)
class FarPlaces:
    """Places in a wide page, `corner` its first: `codes` of rows and columns from there on, in their order."""

    corner: TilePlace
    codes: array[int]

    def __contains__(self, place: TilePlace) -> bool:
        code = place[1] - self.corner[1] << _HALF | place[0] - self.corner[0]
        at = bisect_left(self.codes, code)
        return at < len(self.codes) and self.codes[at] == code

    def __iter__(self) -> Iterator[TilePlace]:
        x, y = self.corner
        return ((x + (code & _LOW), y + (code >> _HALF)) for code in self.codes)

    def __len__(self) -> int:
        return len(self.codes)


PagePlaces = NearPlaces | FarPlaces


def places_in(key: PageKey, places: Iterable[TilePlace]) -> PagePlaces:
    """Returns some places of a page."""
    x, y, side = key
    if side == LEAST_SIDE:
        return NearPlaces((x, y), sum(map(bit_of, places)))
    x, y = x << side, y << side
    return FarPlaces((x, y), array("Q", sorted(row - y << _HALF | column - x for column, row in places)))


def page_of(place: TilePlace) -> TilePlace:
    """Returns the column and row of the page of 8 x 8 tiles in which a tile lies."""
    return place[0] >> LEAST_SIDE, place[1] >> LEAST_SIDE


def place_in(page: TilePlace, number: int) -> TilePlace:
    """Returns the place of the tile whose bit has this number in the page of 8 x 8 tiles at a place."""
    return (page[0] << LEAST_SIDE) + (number & _IN_PAGE), (page[1] << LEAST_SIDE) + (number >> LEAST_SIDE)


def bit_of(place: TilePlace) -> int:
    """Returns the bit of a tile in its page."""
    return 1 << ((place[1] & _IN_PAGE) << LEAST_SIDE | place[0] & _IN_PAGE)
