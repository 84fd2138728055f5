"""Paint laid over other paint, as one stroke would lay it: at its finest level, and coarser ones follow."""

from __future__ import annotations

from dataclasses import replace

from engine.canvas import layers
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.layers import Layer
from engine.canvas.merging.laying import laid_at
from engine.canvas.merging.merged import merged_paint
from engine.canvas.placing.filled import filled_tiles
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TileKey
from engine.texture.planes import Planes

_KEPT_BYTES = 256 << 20  # bytes
_MOST_LAID = 1 << 12  # tiles of its finest level; what has more is merged level by level


class _TooManyTiles(Exception):
    """The paint has more tiles than are laid at once."""


def laid_over(below: Pyramid, above: Pyramid) -> Pyramid:
    """Returns paint with other paint over it: ink stays ink.  LayerError if that would be too much."""
    if above.coarsest is None or above.finest is None or below.coarsest is None:
        return below if above.coarsest is None else replace(above, commits=below.commits + 1)
    cache, looked_at = TileCache(_KEPT_BYTES), 0

    def paint(key: TileKey) -> Planes | None:
        return evaluate_sparse(above, key.level, key.rect, cache)

    def filled(key: TileKey) -> bool:
        nonlocal looked_at
        looked_at += 1
        if looked_at > 4 * _MOST_LAID:
            raise _TooManyTiles
        found = paint(key)
        return found is not None and bool(found.data.any())

    try:
        tiles = filled_tiles(lambda k: above.levels.get(k, ()), filled, above.coarsest, above.finest)
    except _TooManyTiles:
        nodes = Layer(1, "below", pyramid=below), Layer(2, "above", pyramid=above)
        return merged_paint(layers.together(nodes, layers.EMPTY), nodes, below.grid)
    return laid_at(below, above.finest, tiles, paint)
