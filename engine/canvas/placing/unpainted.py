"""Where layers have no paint, told from the level of their finest: it holds at any depth below."""

from __future__ import annotations

import numpy as np

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.layers import Layer
from engine.canvas.placing.sampling import source_level
from engine.canvas.placing.through import Seen
from engine.numeric.address import TILE, Rect, TileKey

_FROM = 3  # levels finer than the finest from which on it is worth it
_AROUND = 3  # pixels of that level that those below can see
_KEPT = 1 << 11  # tiles


class Unpainted:
    """The unpainted places of layers, tile by tile of the level of their finest paint."""

    def __init__(self) -> None:
        self._painted: dict[tuple[int, TileKey], np.ndarray | None] = {}

    def __contains__(self, place: tuple[Layer, int, Rect, Seen]) -> bool:
        """Tells whether nothing of a layer is in a rectangle of a level, seen so; False where it is not known."""
        layer, level, rect, seen = place
        finest = layer.pyramid.finest
        if finest is None or layer.growth or layer.wrap is not None or layer.pyramid.bare is not None:
            return False
        if source_level(seen.similarity, level) < finest + _FROM:
            return False
        near = seen.similarity.box(rect, level, finest, _AROUND)
        if max(near.width, near.height) > TILE:
            return False
        return not any(self._any(layer, key, near) for key in near.tiles(finest))

    def _any(self, layer: Layer, key: TileKey, near: Rect) -> bool:
        held = layer.id, key
        if held not in self._painted:
            if len(self._painted) >= _KEPT:
                self._painted = {}
            planes = evaluate_sparse(layer.pyramid, key.level, key.rect, None)
            self._painted[held] = None if planes is None else np.any(planes.data, axis=0)
        painted = self._painted[held]
        return painted is not None and bool(painted[near.intersect(key.rect).slices(key.rect)].any())
