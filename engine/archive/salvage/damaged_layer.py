"""A layer of which tiles are missing: its picture, as other programs see it, stands in for them.

A tile that is missing gets a residual by which it is what finer ones say (`finer_told`).  Where the layer then shows
something else within the frame than its picture does, which has 8 bits and one level, it gets residuals by which it
does, from the coarsest level on at which anything is missing.  All else stays as it is, so that levels coarser than
what is missing are as they were, and finer ones keep what they add.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from engine.archive.grounds import with_tiles
from engine.archive.implied import Coded, restored
from engine.archive.salvage.finer_levels import finer_told
from engine.archive.salvage.seen import Compared, Shown
from engine.canvas.growth import Growth, meets
from engine.canvas.store import Pyramid, Record
from engine.numeric.address import TileKey

Placed = TypeVar("Placed", bound=tuple[Any, ...])


@dataclass(frozen=True, eq=False, slots=True)
class Rest:
    """What is left of a layer's tiles: those that are whole, the places of those that are not, and how many these are,
    some of which may have had nothing in them; `first`: no tile of a coarser level is missing, None where one may be
    at any."""

    tiles: Sequence[Coded]
    gone: Sequence[TileKey] = ()
    missing: int = 0
    first: int | None = None


def rebuilt(ground: Pyramid, rest: Rest, growth: Growth = (), shown: Shown | None = None) -> Pyramid:
    """Returns a layer of the tiles that are whole, on the picture that it began with; `shown` stands in for others."""
    if shown is None:
        return _with(ground, rest.tiles)
    if rest.first is None and ground.ground is None and not meets(growth, shown.level, shown.frame):
        ground = shown.laid(ground.grid)
    pyramid, tiles, gone = ground, _by_level(rest.tiles), _by_level([(key,) for key in rest.gone])
    coarsest = min({*tiles, *gone, *ground.levels, shown.level})
    untold: list[TileKey] = []
    for level in range(coarsest, shown.level + 1):
        pyramid, lost = _with(pyramid, tiles.get(level, [])), [key for (key,) in gone.get(level, [])]
        finer = tiles.get(level + 1, [])
        if any(record.inks or implied for _, record, implied in finer):  # which hides what is wrong here
            untold += lost
        else:
            pyramid = finer_told(pyramid, lost, finer, level - 1 not in gone)
    first = coarsest if rest.first is None else min(rest.first, shown.level)
    pyramid = Compared(shown, growth, pyramid).put_right(first, untold)
    return _with(pyramid, [tile for tile in rest.tiles if tile[0].level > shown.level])


def _by_level(tiles: Iterable[Placed]) -> dict[int, list[Placed]]:
    found: dict[int, list[Placed]] = {}
    for tile in tiles:
        found.setdefault(tile[0].level, []).append(tile)
    return found


def _with(pyramid: Pyramid, tiles: Sequence[Coded]) -> Pyramid:
    levels: dict[int, dict[tuple[int, int], Record]] = {}
    for key, record, _ in tiles:
        levels.setdefault(key.level, {})[key.x, key.y] = record
    pyramid = with_tiles(pyramid, levels)
    restored(pyramid, tiles)
    return pyramid
