"""The heights that brushes heaped on layers, in float64: as a layer's brightness is carried down, so is each heap."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from engine.canvas.heaps.heaps import lies
from engine.canvas.layers import Layer
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.terrain.land_bound import Remainder, layer_bound
from engine.terrain.layer_heights import Pixel, layer_brightness, zeros_of


def heaped_heights(
    layer: Layer, level: int, rect: Rect, about: Pixel | None, steps: Iterable[int], cache: TileCache | None
) -> np.ndarray | float:
    """Returns what is heaped on a layer, relative to the pixel `about` if there is one, in pixels of level 0: float64
    (h, w), or 0.  `steps`: the levels, coarsest first, from which on heights are told relative to that pixel."""
    out: np.ndarray | float = 0.0
    for unit, heap in sorted(layer.heaps.items()):
        there = lies(heap, level, rect) or (about is not None and lies(heap, about.level, about.rect))
        if there:
            out = out + np.ldexp(_told(_sheet(heap), level, rect, about, list(steps), cache), unit)
    return out


def heap_told(heap: Pyramid, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray:
    """Returns what lies in a heap down to level 32, in its unit, as the land has it, which does not round on the way
    down as the canvas does: float64 (h, w)."""
    seen = layer_brightness(_sheet(heap), level, rect, (), cache)
    return seen.fine + seen.still


def _told(
    sheet: Layer, level: int, rect: Rect, about: Pixel | None, steps: list[int], cache: TileCache | None
) -> np.ndarray:
    if about is None:
        seen = layer_brightness(sheet, level, rect, (), cache)
        return seen.fine + seen.still
    zeros = zeros_of(sheet, about, steps, cache)
    one = layer_brightness(sheet, about.level, about.rect, zeros, cache)
    taken = float((one.fine + one.still)[0, 0])
    seen = layer_brightness(sheet, level, rect, zeros, cache)
    out: np.ndarray = seen.fine + (seen.still - taken)
    return out


def heaped_bound(layer: Layer, level: int, rect: Rect, cache: TileCache | None) -> Remainder | None:
    """Returns how far what is heaped on a layer may go below a level, in pixels of level 0; None if that is not
    known."""
    hard = rms = 0.0
    for unit, heap in sorted(layer.heaps.items()):
        found = layer_bound(_sheet(heap), 0.0, level, rect, cache)
        if found is None:
            return None
        hard, rms = hard + float(np.ldexp(found.hard, unit)), rms + float(np.ldexp(found.rms, unit))
    return Remainder(hard, rms)


def _sheet(heap: Pyramid) -> Layer:
    return Layer(1, "heap", pyramid=heap)
