"""The stroke in progress as placements of its layer show it: elsewhere, and at coarser levels."""

from __future__ import annotations

from functools import cache

import numpy as np

from engine.canvas.layers import Layer
from engine.canvas.placing import loops
from engine.canvas.placing.cells import Repeats, SeenAreas
from engine.canvas.placing.views import Views
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.mask_sheet import MaskSheet
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.pyramid import reduce
from engine.strokes.example_stroke import Live
from engine.strokes.paint_stroke import LiveStroke

_COARSER = 4  # levels at which a stroke is seen, besides its own


def areas_of(live: Live | None, level: int, parts: list[Rect]) -> SeenAreas:
    """Returns where parts of a stroke's level is seen: where it is, again in each cell where its layer is repeated, and
    through placements; anywhere, where there are both."""
    views = None if live is None else Views(live.root)
    if live is not None and live.layer.wrap is not None:
        if views is None or views.any:
            return lambda n: None
        cell = live.layer.wrap.rect.zoomed(level - live.layer.wrap.level)
        return lambda n: [Repeats(part, cell) for part in parts] if n == level else []
    if live is not None and isinstance(live.layer, MaskSheet):
        elsewhere = loops.seen_elsewhere(live.root, live.layer.name)
        return lambda n: None if elsewhere else parts if n == level else []
    if live is None or views is None or not views.any:
        return lambda n: parts if n == level else []
    layer = live.layer.id

    @cache
    def where(n: int) -> list[Rect] | None:
        found = list(parts) if n == level else []
        for part in parts:
            placed = views.shown(layer, level, part, n)
            if placed is None:
                return None
            found += placed
        return found

    return where


def reaches(live: LiveStroke, level: int, rect: Rect) -> bool:
    """Tells whether the stroke is seen in a rectangle of a level coarser than its own."""
    by = live.level - level
    return 0 < by <= _COARSER and not live.empty and rect.zoomed(by).meets(live.rect)


def from_afar(live: LiveStroke, layer: Layer, level: int, rect: Rect, cache: TileCache | None) -> np.ndarray:
    """Returns a rectangle of the stroke's layer at a coarser level, with the mean of what the stroke changes."""
    by = live.level - level
    part = live.rect.zoomed(-by).intersect(rect)
    fine = part.zoomed(by)
    known, before = layer_planes(layer, level, rect, cache), layer_planes(layer, live.level, fine, cache)
    change = live.preview(fine).rgba - (np.float32(0) if before is None else before)
    for _ in range(by):
        change = reduce(change)
    out = np.zeros((4, rect.height, rect.width), np.float32) if known is None else known.copy()
    out[:, *part.slices(rect)] += change
    return out
