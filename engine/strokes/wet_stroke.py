"""What the dabs of a wet stroke see: the layer as it was before the stroke, where it is selected."""

from __future__ import annotations

from functools import partial

import numpy as np

from engine.brush.felt import is_placed, tints_of
from engine.brush.print_form import Print
from engine.brush.tinted_ink import TintedInk
from engine.brush.wetting import WET_COLUMNS, WetMask, Wetting
from engine.canvas.layers import Layer
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.strokes.live_stroke import Drawn
from engine.strokes.mask_painting import greys_of
from engine.strokes.wrapping import around, cell_at
from engine.texture.planes import Planes


def read_layer(layer: Layer, level: int, cache: TileCache | None, rect: Rect) -> Planes:
    """Returns a layer's paint in a rectangle of a level as a brush sees it."""
    return greys_of(around(layer, level, rect, cache), layer)


def _see(layer: Layer, cache: TileCache | None, level: int, rect: Rect) -> np.ndarray:
    return read_layer(layer, level, cache, rect).rgba


def wet_mask(stroke: Drawn, ink: TintedInk, tip: Print) -> WetMask:
    """Returns the coverage, of nothing yet, of a stroke of a wet brush on its layer as that is now."""
    layer, level, limit, cache = stroke.layer, stroke.level, stroke.limit, stroke.cache
    chosen = None if limit is None else lambda at, rect: limit.selection.part(at, rect, cache)
    rect = cell_at(layer, level, "stroke")
    cell = None if rect is None or layer.wrap is None else (rect, level - layer.wrap.whole_from)
    see = partial(_see, layer, cache)
    place, copies = (level, stroke.origin), stroke.copies
    wetting = Wetting(stroke.brush, ink, place, see, chosen, layer.alpha_locked, copies, cell)
    columns = tints_of(stroke.brush) + WET_COLUMNS if is_placed(stroke.brush) else None
    return WetMask(wetting, place, tip, copies, columns)
