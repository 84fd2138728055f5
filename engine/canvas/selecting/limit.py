"""What a selection leaves of a stroke: its coverage times how far each pixel is selected."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np

from engine.brush.mask import Coverage
from engine.brush.thinning import LazyTiles, Plane, Thinning
from engine.canvas.placing.bake import baked
from engine.canvas.placing.pose import Pose, SourcePart
from engine.canvas.selecting.carried import Carried
from engine.canvas.selecting.folded import Folded
from engine.canvas.selecting.selection import Selection
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey

Value = TypeVar("Value")


@dataclass(frozen=True, eq=False)
class Limit:
    """A selection as strokes of one level meet it, after `relief`; `cache` keeps its tiles."""

    selection: Selection | Folded | Carried
    level: int
    cache: TileCache | None = None
    relief: Thinning | None = None
    _selected: dict[TileKey, Plane] = field(default_factory=dict, repr=False)
    _made: dict[TileKey, tuple[Plane, Plane]] = field(default_factory=dict, repr=False)

    @classmethod
    def of(
        cls,
        selection: Selection | None,
        level: int,
        cache: TileCache | None,
        wrap: SourcePart | None = None,
        seen: Pose | None = None,
    ) -> Limit | None:
        """Returns the limit that a selection sets; None where there is none, or all is selected.  `wrap`: the cell of a
        layer that is repeated, on which what is selected in any of its cells is selected in all.  `seen`: where the
        layer is seen, if not where it lies; LayerError if a layer with a cell is seen so finely that nobody could
        wait."""
        if selection is None or selection.everything:
            return None
        if seen is not None and wrap is None:
            return cls(Carried.of(selection, seen), level, cache)
        if seen is not None:
            selection = replace(selection, pyramid=baked(selection.pyramid, seen.similarity.inverse()))
        return cls(selection if wrap is None else Folded(selection, wrap), level, cache)

    def after(self, relief: Thinning) -> Limit:
        """Returns the same, taking hold after something else."""
        return replace(self, relief=relief)

    def over(self, coverage: Coverage) -> Coverage:
        """Returns what is left of a coverage; its tiles are made when they are asked for."""
        if self.relief is not None:
            coverage = self.relief.over(coverage)
        tiles = coverage.tiles
        return replace(coverage, tiles=LazyTiles(tiles, lambda key: self.left(key, tiles[key])))

    def left(self, key: TileKey, covered: Plane) -> Plane:
        """Returns what is left of a tile of a coverage.  Arrays are never written to: the same holds the same."""
        known = self._made.get(key)
        if known is not None and known[0] is covered:
            return known[1]
        selected = self._selected.get(key)
        if selected is None:
            selected = self._selected[key] = self.selection.part(key.level, key.rect, self.cache)
        if isinstance(selected, float):
            left: Plane = covered if selected == 1.0 else covered * selected if selected else 0.0
        else:
            left = selected * covered
        self._made[key] = covered, left
        return left

    def taken(self, level: int, rect: Rect, mask: np.ndarray) -> np.ndarray:
        """Returns the pixels of a mask, bool (h, w), that are selected at least half."""
        out: np.ndarray = mask & self.selection.chosen(level, rect, self.cache)
        return out

    def meets(self, rect: Rect) -> bool:
        """Tells whether any pixel of a rectangle is selected."""
        part = self.selection.part(self.level, rect, self.cache)
        return part > 0.0 if isinstance(part, float) else bool(part.any())

    def within(
        self, change: Callable[[Value, Rect, np.ndarray], Value], level: int
    ) -> Callable[[Value, Rect, np.ndarray], Value]:
        """Returns a change of the pixels of a mask, of a level, done to those that are selected."""

        def limited(value: Value, rect: Rect, mask: np.ndarray) -> Value:
            left = self.taken(level, rect, mask)
            return change(value, rect, left) if left.any() else value

        return limited
