"""Paint without what a selection holds, at the selection's own level; finer detail goes with it, as under an eraser."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.node_checks import LayerError
from engine.canvas.painted import tile_bounds
from engine.canvas.placing.filled import filled_levels, filled_tiles, may_lead_to
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.texture.planes import COLOURS, Planes

_HELD_BYTES = 256 << 20
_MOST_CLEARED = 1 << 16  # tiles
_MOST_WALKED = 1 << 10  # tiles of a selection up to which it is worth knowing where it ends
_NO_PAINT = np.zeros((COLOURS, TILE, TILE), np.float32)


@dataclass(frozen=True, slots=True)
class Outside:
    """All that lies outside a frame of level 0."""

    frame: Rect
    level: int = 0

    def part(self, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray | float:
        """As `Selection.part`."""
        inner = self.frame.intersect(rect)
        if inner.empty or inner == rect:
            return float(inner.empty)
        out = np.ones((rect.height, rect.width), np.float32)
        out[inner.slices(rect)] = 0
        return out


def framing(frame: Rect) -> Outside:
    """Returns what lies outside a frame."""
    return Outside(frame)


@dataclass(frozen=True, eq=False)
class _Clearing:
    """The edit that takes it away: A = 1 - how far a pixel belongs to it."""

    level: int
    tiles: list[TileKey]
    taken: Selection | Outside
    spares_alpha: bool = False

    @property
    def rect(self) -> Rect:
        """Gives the tiles' bounds."""
        return tile_bounds(self.tiles)

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """As `Edit.stamp`."""
        part = self.taken.part(key.level, key.rect)
        if isinstance(part, float) and part == 0:
            return None
        keep = np.empty((TILE, TILE), np.float32)
        keep[...] = np.float32(1) - part
        return Stamp(snapped(keep), _NO_PAINT)


def without(paint: Pyramid, taken: Selection | Outside) -> Pyramid:
    """Returns paint without what is taken.  LayerError if that would be too much."""
    if paint.coarsest is None:
        return paint
    level = taken.level if isinstance(taken, Outside) else taken.pyramid.finest
    if level is None:  # all, or nothing
        level = paint.coarsest
        if isinstance(taken, Selection) and taken.inverse:
            return Pyramid(grid=paint.grid, commits=paint.commits)
    level, cache = max(level, paint.coarsest), TileCache(_HELD_BYTES)
    bounds = _bounds(taken, level, cache)

    def filled(key: TileKey) -> bool:
        if bounds is not None and not may_lead_to(key, level, bounds):
            return False
        found = evaluate_sparse(paint, key.level, key.rect, cache)
        return found is not None and bool(found.data.any())

    tiles = filled_tiles(lambda k: paint.levels.get(k, ()), filled, paint.coarsest, level)
    met = sorted((key for key in tiles if _meets(taken, key, cache)), key=lambda key: (key.y, key.x))
    if len(met) > _MOST_CLEARED:
        raise LayerError(f"layer: found more than {_MOST_CLEARED} tiles to clear, expected fewer")
    return commit(paint, _Clearing(level, met, taken)) if met else paint


def _bounds(taken: Selection | Outside, level: int, cache: TileCache) -> Rect | None:
    """Returns tiles of a level around all that is taken; None where that has no end, or lies on many."""
    if isinstance(taken, Outside) or taken.inverse or taken.pyramid.coarsest is None:
        return None
    chosen, start, found = taken.pyramid, taken.pyramid.coarsest, set[TileKey]()

    def filled(key: TileKey) -> bool:
        return _meets(taken, key, cache)

    for _, found in filled_levels(lambda k: chosen.levels.get(k, ()), filled, start, level, _MOST_WALKED):
        if len(found) > _MOST_WALKED:
            return None
    return tile_bounds(found)


def _meets(taken: Selection | Outside, key: TileKey, cache: TileCache) -> bool:
    part = taken.part(key.level, key.rect, cache)
    return part != 0 if isinstance(part, float) else bool(part.any())
