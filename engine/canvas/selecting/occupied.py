"""Where a pyramid has any alpha at a level, however far away that is from where it was painted."""

from __future__ import annotations

import numpy as np

from engine.brush.mask import Coverage
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.painted import tile_bounds
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect, TileKey

PLACES_CAP = 1 << 12
_CACHE = 64 << 20  # bytes of tiles of the levels above
_ALPHA = 3


def alpha_at(pyramid: Pyramid, level: int, where: str) -> Coverage:
    """Returns the alpha of a pyramid at a level as a coverage.  FieldError if it lies on too many tiles there.

    The way goes down from the coarsest level that is stored, by the tiles that have any; what is stored at a level may
    begin there.
    """
    start = pyramid.coarsest
    tiles: dict[TileKey, np.ndarray | float] = {}
    if start is None or level < start:
        return Coverage(level, tiles, Rect(0, 0, 0, 0))
    cache, below = TileCache(_CACHE), set[tuple[int, int]]()
    for k in range(start, level + 1):
        places = below | set(pyramid.levels.get(k, ()))
        if len(places) > PLACES_CAP:
            raise FieldError(where, f"what lies on {len(places)} tiles", f"at most {PLACES_CAP}; take a coarser level")
        below, tiles = set(), {}
        for x, y in sorted(places):
            key = TileKey(k, x, y)
            value = evaluate_sparse(pyramid, k, key.rect, cache)
            if value is None:
                continue
            alpha = value.data[_ALPHA]
            rows, columns = np.flatnonzero(alpha.any(axis=1)), np.flatnonzero(alpha.any(axis=0))
            if not len(rows):
                continue
            tiles[key] = _alike(alpha)
            x0, y0 = key.rect.x0 + int(columns[0]), key.rect.y0 + int(rows[0])
            inner = Rect(x0, y0, key.rect.x0 + int(columns[-1]) + 1, key.rect.y0 + int(rows[-1]) + 1)
            below.update((child.x, child.y) for child in inner.grown(1).zoomed(1).tiles(k + 1))
    return Coverage(level, tiles, tile_bounds(list(tiles)))


def raster(coverage: Coverage, around: Rect) -> np.ndarray:
    """Returns a coverage over a rectangle: float32 (h, w)."""
    out = np.zeros((around.height, around.width), np.float32)
    for key, tile in coverage.tiles.items():
        part = key.rect.intersect(around)
        if not part.empty:
            out[part.slices(around)] = tile[part.slices(key.rect)] if isinstance(tile, np.ndarray) else tile
    return out


def _alike(alpha: np.ndarray) -> np.ndarray | float:
    return float(alpha[0, 0]) if (alpha == alpha[0, 0]).all() else np.ascontiguousarray(alpha)
