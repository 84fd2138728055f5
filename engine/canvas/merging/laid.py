"""Paint laid over other paint, as one stroke would lay it: at its finest level, and coarser ones follow."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas import layers
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.layers import Layer
from engine.canvas.merging.merged import merged_paint
from engine.canvas.painted import tile_bounds
from engine.canvas.placing.filled import filled_tiles
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey
from engine.numeric.grid import snapped
from engine.texture.planes import Planes

_KEPT_BYTES = 256 << 20  # bytes
_MOST_LAID = 1 << 12  # tiles of its finest level; what has more is merged level by level
_ALPHA = 3


@dataclass(frozen=True, eq=False)
class _Laying:
    """The edit that lays paint: A = 1 - its alpha, B = the paint itself."""

    level: int
    tiles: list[TileKey]
    paint: Pyramid
    cache: TileCache
    spares_alpha: bool = False

    @property
    def rect(self) -> Rect:
        """Gives the tiles' bounds."""
        return tile_bounds(self.tiles)

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """As `Edit.stamp`."""
        found = evaluate_sparse(self.paint, key.level, key.rect, self.cache)
        if found is None:
            return None
        keep = np.float32(1) - np.clip(found.data[_ALPHA], 0, 1)
        return Stamp(snapped(keep), found.data, found.inks)


class _TooManyTiles(Exception):
    """The paint has more tiles than are laid at once."""


def laid_over(below: Pyramid, above: Pyramid) -> Pyramid:
    """Returns paint with other paint over it: ink stays ink.  LayerError if that would be too much."""
    if above.coarsest is None or above.finest is None or below.coarsest is None:
        return below if above.coarsest is None else replace(above, commits=below.commits + 1)
    cache, looked_at = TileCache(_KEPT_BYTES), 0

    def filled(key: TileKey) -> bool:
        nonlocal looked_at
        looked_at += 1
        if looked_at > 4 * _MOST_LAID:
            raise _TooManyTiles
        found = evaluate_sparse(above, key.level, key.rect, cache)
        return found is not None and bool(found.data.any())

    try:
        tiles = filled_tiles(lambda k: above.levels.get(k, ()), filled, above.coarsest, above.finest)
    except _TooManyTiles:
        nodes = Layer(1, "below", pyramid=below), Layer(2, "above", pyramid=above)
        return merged_paint(layers.together(nodes, layers.EMPTY), nodes, below.grid)
    ordered = sorted(tiles, key=lambda key: (key.y, key.x))
    return commit(below, _Laying(above.finest, ordered, above, cache)) if ordered else below
