"""Edits of heaps: paint adds its height, A = 1 and B = M h, M being the stroke's coverage on the grid.

Erasers and smoothers do to heaps what they do to paint.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from engine.brush.covered import Covered, Read
from engine.brush.stamp import Stamp
from engine.canvas.commit import commit, preview
from engine.canvas.evaluate import evaluate
from engine.canvas.heaps.heaps import MOST_HEAPED, NO_HEAP, Heaps, exponent, of_scale, share
from engine.canvas.heaps.seen_heaps import heaped_on
from engine.canvas.layers import Layer
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.texture.planes import COLOURS, Planes

_ALL = np.ones((TILE, TILE), np.float32)
_ALPHA = 3

MadeEdit = Callable[[Read], Covered]
Edits = Mapping[int, Covered]


@dataclass(frozen=True, eq=False)
class Heaping(Covered):
    """Adds `part` of a heap's unit where the stroke covers, negative to carve, until the heap is full."""

    part: float = 0.0

    @property
    def spares_alpha(self) -> bool:
        """As `Edit.spares_alpha`: a heap has none."""
        return True

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns A and B of a tile, as `Edit.stamp`; None where nothing changes."""
        keep = self.keep(key)
        if keep is None:
            return None
        laid = snapped((1.0 - keep) * np.float32(self.part))
        lies = old.data[0]
        add = np.zeros((COLOURS, TILE, TILE), np.float32)
        add[:_ALPHA] = np.clip(lies + laid, -MOST_HEAPED, MOST_HEAPED) - lies
        return Stamp(_ALL, add)


def edits_of(heaps: Heaps, level: int, laid: float | None, made: MadeEdit, cache: TileCache | None) -> Edits:
    """Returns how a stroke changes heaps, by their exponents.

    `laid`: the height that it lays, in pixels of its level, None where it takes or smooths what lies there; `made`: the
    edit of the stroke, given what reads the old values.
    """
    if laid is None:
        return {unit: made(_reader(heaps[unit], level, cache)) for unit in of_scale(heaps, level)}
    if laid == 0.0:
        return {}
    unit = exponent(laid, level)
    edit = made(_reader(heaps.get(unit, NO_HEAP), level, cache))
    return {unit: Heaping(edit.coverage, edit.brush, None, False, None, part=share(laid, level, unit))}


def _reader(heap: Pyramid, level: int, cache: TileCache | None) -> Read:
    return lambda rect: evaluate(heap, level, rect, cache)


def heaped_by(layer: Layer, edits: Edits, level: int, rect: Rect, cache: TileCache | None) -> np.ndarray | float:
    """Returns what will be heaped on a layer in a rectangle of the edits' level, as `heaped_on`."""
    out = heaped_on(replace(layer, heaps=_without(layer.heaps, edits)), level, rect, cache)
    for unit, edit in edits.items():
        seen = preview(layer.heaps.get(unit, NO_HEAP), edit, rect, cache)
        out = out + np.ldexp(seen.data[0], unit + level)
    return out


def _without(heaps: Heaps, edits: Edits) -> Heaps:
    for unit in edits:
        heaps = heaps.delete(unit) if unit in heaps else heaps
    return heaps


def heaped(heaps: Heaps, edits: Edits, cache: TileCache | None = None) -> Heaps:
    """Returns heaps after edits; the same object if these change nothing."""
    for unit, edit in edits.items():
        old = heaps.get(unit, NO_HEAP)
        new = commit(old if unit in heaps else old.branched(), edit, cache)
        if new.last is not old.last:
            heaps = heaps.set(unit, new)
    return heaps
