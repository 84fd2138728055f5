"""The pixels of a layer: its paint, and over it what was painted with examples."""

from __future__ import annotations

import numpy as np

from engine.canvas.evaluate import evaluate, evaluate_sparse, shown
from engine.canvas.growth import Growth, meets, over
from engine.canvas.layers import Layer
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.texture.planes import Planes


def layer_planes(layer: Layer, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray | None:
    """Returns colour and alpha of `rect` of a level: premultiplied float32 (4, h, w) on the grid, None where a layer
    is empty.

    Not to be written to.  Without a cache, ink that adds nothing down to this level is left out on the way.
    """
    if cache is None:
        paint = shown(layer.pyramid, level, rect)
    else:
        found = evaluate_sparse(layer.pyramid, level, rect, cache, lent=True)
        paint = None if found is None else found.rgba
    return covered(paint, layer.growth, level, rect)


def covered(paint: np.ndarray | None, growth: Growth, level: int, rect: Rect) -> np.ndarray | None:
    """Returns a layer's paint, (4, h, w) or None, with a growth over it; the same array where that shows nothing."""
    if not growth or not meets(growth, level, rect):
        return paint
    out = np.zeros((4, rect.height, rect.width), np.float32) if paint is None else np.array(paint, order="C")
    over(out, growth, level, rect)
    return out


def layer_ink(layer: Layer, level: int, rect: Rect, cache: TileCache | None = None) -> Planes:
    """As `layer_planes`, with the ink that lies in the paint, as far as it is not covered."""
    found = evaluate(layer.pyramid, level, rect, cache)
    if not layer.growth:
        return found
    data = np.array(found.data, order="C")
    over(data, layer.growth, level, rect)
    return Planes(data, found.inks)
