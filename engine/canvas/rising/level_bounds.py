"""Where the tiles of many levels lie, by bands of levels: so that those in a rectangle are found without going through
all levels."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import immutables

from engine.numeric.address import TILE, Rect

MANY_LEVELS = 64  # from which on it is worth it
_BAND = 5  # a band is 32 levels, as a power of two
_NOWHERE = Rect(0, 0, 0, 0)


class LevelTiles(NamedTuple):
    """Some tiles of a level, by their columns and rows."""

    level: int
    places: Iterable[tuple[int, int]]


@dataclass(frozen=True, eq=False, slots=True)
class LevelBounds:
    """By bands of levels: a rectangle of the band's coarsest level out of which none of them has a tile.  Immutable.

    `levels`: those of which that is true.
    """

    levels: Mapping[int, object]
    bands: immutables.Map[int, Rect]

    @classmethod
    def of(cls, levels: Mapping[int, Mapping[tuple[int, int], object]]) -> LevelBounds:
        """Goes through all tiles."""
        empty = cls(levels, immutables.Map())
        return empty.after(levels, [LevelTiles(level, stored) for level, stored in levels.items()])

    def after(self, levels: Mapping[int, object], written: Iterable[LevelTiles]) -> LevelBounds:
        """Returns those of another state, in which no other tiles were written."""
        bands = self.bands
        for level, places in written:
            band = level >> _BAND
            held, at = bands.get(band, _NOWHERE), _extent(places).zoomed((band << _BAND) - level)
            whole = held.union(at)
            if whole != held:
                bands = bands.set(band, whole)
        return LevelBounds(levels, bands)

    @property
    def coarsest(self) -> int | None:
        """Gives the coarsest level that there is."""
        for band in sorted(self.bands):
            found = next((k for k in _of_band(band) if k in self.levels), None)
            if found is not None:
                return found
        return None

    def finer(self, level: int, rect: Rect) -> Iterator[int]:
        """Yields the levels finer than one, of which some may have a tile in a rectangle of it."""
        for band, held in self.bands.items():
            first = band << _BAND
            if first + (1 << _BAND) > level + 1 and held.meets(rect.zoomed(first - level)):
                yield from (k for k in _of_band(band) if k > level and k in self.levels)


def _of_band(band: int) -> range:
    """Returns the levels of a band, the coarsest first."""
    return range(band << _BAND, (band + 1) << _BAND)


def _extent(places: Iterable[tuple[int, int]]) -> Rect:
    """Returns the smallest rectangle of pixels that holds some tiles."""
    columns, rows = zip(*places, strict=True)
    return Rect(min(columns) * TILE, min(rows) * TILE, (max(columns) + 1) * TILE, (max(rows) + 1) * TILE)
