"""A region painted with an example, as a value: its masks and what control channels tell of it, and what is refined."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.numeric.address import Rect
from engine.texture.example import tiles
from engine.texture.example.exemplar import Exemplar
from engine.texture.example.tiles import NONE, Tiles


@dataclass(frozen=True, slots=True, eq=False)
class Filled:
    """A level as it was refined: for which region, from which sources one level coarser; `sources`: int32 planes, one
    for each pass, the last of which counts; `told`: what control channels told; `seen`: the region at the level where
    narrow parts are looked for."""

    mask: Tiles = NONE
    above: Tiles = NONE
    sources: Tiles = NONE
    told: Tiles = NONE
    seen: Tiles = NONE


@dataclass(frozen=True, slots=True, eq=False)
class Region:
    """`masks`: uint8 tiles of one plane, the region at each level, the finest first; `levels`: what is refined; `told`:
    uint8 tiles of the control channels that are stored, 0 outside the region; none where it has no such channels."""

    exemplar: Exemplar
    seed: int
    masks: tuple[Tiles, ...]
    levels: tuple[Filled, ...]
    told: tuple[Tiles, ...] = ()

    def fresh(self, level: int) -> bool:
        """Tells whether a level, and so every coarser one, is as it will stay for this region."""
        count = len(self.levels)
        return all(self._agrees(n) for n in range(level, count))

    def _agrees(self, n: int) -> bool:
        own = self.levels[n]
        same = own.mask is self.masks[n] and own.above is self.above(n)
        return same and (not self.told or own.told is self.told[n])

    def above(self, n: int) -> Tiles:
        """Returns the sources one level coarser."""
        return self.levels[n + 1].sources if n + 1 < len(self.levels) else NONE

    @property
    def finest(self) -> int:
        """Returns the finest level that is refined; as many as there are levels if none is."""
        count = len(self.levels)
        return next((n + 1 for n in reversed(range(count)) if not self._agrees(n)), 0)

    def both_masks(self, n: int, rect: Rect) -> np.ndarray:
        """Returns what of a rectangle of a level belongs to the region now, and did when it was refined: (2, h, w)."""
        both = np.zeros((2, 1, rect.height, rect.width), np.uint8)
        tiles.gathered(self.masks[n], rect, both[0])
        tiles.gathered(self.levels[n].mask, rect, both[1])
        out: np.ndarray = both[:, 0]
        return out
