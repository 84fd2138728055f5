"""Where layers have no paint, told from the level of their finest: it holds at any depth below."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.layers import Layer
from engine.canvas.placing.sampling import source_level
from engine.canvas.placing.through import Seen
from engine.canvas.reading import Read
from engine.numeric.address import TILE, Rect, TileKey

_FROM = 3  # levels finer than the finest from which on it is worth it
_AROUND = 3  # pixels of that level that those below can see
_WIDEST = TILE * 9 // 4  # pixels of that level along a side, of what is looked at
_KEPT = 1 << 11  # tiles


class Unpainted:
    """The unpainted places of layers, tile by tile of the level of their finest paint.  Safe for several threads."""

    def __init__(self) -> None:
        self._painted: dict[tuple[int, TileKey], np.ndarray | None] = {}

    def __contains__(self, place: tuple[Layer, int, Rect, Seen]) -> bool:
        """Tells whether nothing of a layer is in a rectangle of a level, seen so; False where it is not known."""
        layer, level, rect, seen = place
        finest = _finest_of(layer)
        if finest is None or source_level(seen.similarity, level) < finest + _FROM:
            return False
        return self._nothing(layer, seen.similarity.box(rect, level, finest, _AROUND))

    def empty(self, layers: Sequence[Layer], level: int, rect: Rect, seen: Seen) -> bool:
        """As `in`, of several layers; False also where looking takes as long as reading."""
        at = source_level(seen.similarity, level)
        for layer in layers:
            finest = _finest_of(layer)
            if finest is None or at <= finest:
                return False
            if not self._nothing(layer, seen.similarity.box(rect, level, finest, _AROUND)):
                return False
        return True

    def reading(self, read: Read, painted: int | None) -> Read:
        """Returns what reads layers, without a look at where nothing of them is.  `painted`: the id of the one that
        may show other paint than it has."""

        def spared(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
            finest = None if layer.id == painted else _finest_of(layer)
            if finest is None or level < finest:
                return read(layer, level, rect)
            near = rect if level == finest else rect.zoomed(finest - level).grown(_AROUND)
            return None if self._nothing(layer, near) else read(layer, level, rect)

        return spared

    def _nothing(self, layer: Layer, near: Rect) -> bool:
        """Tells whether nothing of a layer is in a rectangle of the level of its finest paint."""
        finest = layer.pyramid.finest
        if finest is None or max(near.width, near.height) > _WIDEST:
            return False
        return not any(self._any(layer, key, near) for key in near.tiles(finest))

    def _any(self, layer: Layer, key: TileKey, near: Rect) -> bool:
        held, known = (layer.id, key), self._painted
        if held not in known:
            if len(known) >= _KEPT:
                known = self._painted = {}
            planes = evaluate_sparse(layer.pyramid, key.level, key.rect, None)
            known[held] = None if planes is None else np.any(planes.data, axis=0)
        painted = known[held]
        return painted is not None and bool(painted[near.intersect(key.rect).slices(key.rect)].any())


def _finest_of(layer: Layer) -> int | None:
    """Returns the level of a layer's finest paint, if it is all that the layer shows."""
    other = layer.growth or layer.wrap is not None or layer.pyramid.bare is not None
    return None if other else layer.pyramid.finest
