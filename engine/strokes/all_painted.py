"""All that is painted on a layer, as what a fill covers."""

from __future__ import annotations

from collections.abc import Iterator

from engine.brush.mask import Coverage
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.painted import tile_bounds
from engine.canvas.placing.filled import filled_levels
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TileKey
from engine.painting.value import Refusal

MOST_FILLED = 1 << 14  # tiles
_AT_ONCE = 1 << 10  # tiles of the level that a layer is filled at best, at most
_CACHE = 64 << 20


def all_painted(pyramid: Pyramid, level: int, cache: TileCache | None) -> Coverage:
    """Returns the tiles of a level on which there is paint, covered in full.  Refusal if there is none, or too much."""
    last: set[TileKey] = set()
    for level_there, last in _descent(pyramid, level, cache, MOST_FILLED):
        if len(last) > MOST_FILLED:
            raise Refusal(f"fill: found paint on more than {MOST_FILLED} tiles of level {level_there}, expected fewer")
    if not last:
        raise Refusal("fill: found no paint on the layer, expected some to change")
    return Coverage(level, dict.fromkeys(sorted(last, key=lambda key: (key.y, key.x)), 1.0), tile_bounds(last))


def level_for_all(pyramid: Pyramid, cache: TileCache | None) -> int:
    """Returns the level to fill a whole layer at: the finest at which anything is stored, or a coarser one where that
    would take long."""
    finest, best = pyramid.finest, 0 if pyramid.coarsest is None else pyramid.coarsest
    for level, tiles in () if finest is None else _descent(pyramid, finest, cache, _AT_ONCE):
        if len(tiles) > _AT_ONCE:
            break
        best = level
    return best


def _descent(pyramid: Pyramid, level: int, cache: TileCache | None, most: int) -> Iterator[tuple[int, set[TileKey]]]:
    """Yields the tiles on which there is paint, of each level from the coarsest that is stored, or wanted, on; not all
    of one with more than `most`."""
    own = TileCache(_CACHE) if cache is None else cache
    start = pyramid.coarsest

    def filled(key: TileKey) -> bool:
        found = evaluate_sparse(pyramid, key.level, key.rect, own)
        return found is not None and bool(found.data.any())

    if start is None:
        return
    yield from filled_levels(lambda k: pyramid.levels.get(k, ()), filled, min(start, level), level, most)
