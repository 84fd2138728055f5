"""Edits of heaps: paint adds its height, A = 1 and B = M h, M being the stroke's coverage on the grid.

Erasers and smoothers do to heaps what they do to paint.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from engine.brush.covered import Covered, Read
from engine.brush.ink import Ink
from engine.brush.stamp import Stamp
from engine.canvas.commit import commit, preview
from engine.canvas.evaluate import evaluate
from engine.canvas.heaps.heaps import MOST_HEAPED, MOST_INK, NO_HEAP, Heaps, exponent, of_scale, share
from engine.canvas.heaps.seen_heaps import heaped_on
from engine.canvas.layers import Layer
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.texture.grey import LUMINANCE
from engine.texture.planes import COLOURS, Planes
from engine.texture.record import Instance

_ALL = np.ones((TILE, TILE), np.float32)
_ALPHA = 3

MadeEdit = Callable[[Read], Covered]
Edits = Mapping[int, Covered]


@dataclass(frozen=True, eq=False)
class Heaping(Covered):
    """Adds `part` of a heap's unit where the stroke covers, negative to carve, until the heap is full.

    With ink it is (1 + 2 a S) times as much, a being how bright the amplitude of a texture S is: rock of full contrast
    goes from 0 to twice the height, and on, level by level.  The brush's colour counts for nothing.
    """

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
        laid, loaded = (1.0 - keep) * np.float32(self.part), () if self.ink is None else self.ink.loaded
        add = np.zeros((COLOURS + 3 * len(loaded), TILE, TILE), np.float32)
        rough = np.ones((TILE, TILE), np.float32)
        for i, one in enumerate(loaded):
            bright = np.float32(2.0 * sum(w * a for w, a in zip(LUMINANCE, one.amplitude.tolist(), strict=True)))
            rough += bright * _grey(one.instance.appearance(key.level, key.rect))
            plane = COLOURS + 3 * i
            add[plane : plane + 3] = room_left(amplitude_of(old, one.instance), snapped(laid * bright), MOST_INK)
        add[:_ALPHA] = room_left(old.data[0], snapped(laid * rough), MOST_HEAPED)
        return Stamp(_ALL, add, () if self.ink is None else self.ink.inks)


def room_left(lies: np.ndarray, laid: np.ndarray, most: float) -> np.ndarray:
    """Returns what of it there is room for."""
    out: np.ndarray = np.clip(lies + laid, -most, most) - lies
    return out


def amplitude_of(old: Planes, ink: Instance) -> np.ndarray:
    """Returns the amplitude of an ink that lies there."""
    if ink not in old.inks:
        return np.zeros((TILE, TILE), np.float32)
    out: np.ndarray = old.data[COLOURS + 3 * old.inks.index(ink)]
    return out


def _grey(seen: np.ndarray) -> np.ndarray:
    """Returns how bright a texture is: float32 (h, w) of (1 or 3 or 4, h, w)."""
    red, green, blue = LUMINANCE
    out: np.ndarray = seen[0] if len(seen) < _ALPHA else seen[0] * red + seen[1] * green + seen[2] * blue
    return out


def edits_of(
    heaps: Heaps, level: int, laid: float | None, made: MadeEdit, ink: Ink | None, cache: TileCache | None
) -> Edits:
    """Returns how a stroke changes heaps, by their exponents.

    `laid`: the height that it lays, in pixels of its level, None where it takes or smooths what lies there; `made`: the
    edit of the stroke, given what reads the old values; `ink`: what makes the heap rough.
    """
    if laid is None:
        return {unit: made(_reader(heaps[unit], level, cache)) for unit in of_scale(heaps, level)}
    if laid == 0.0:
        return {}
    unit = exponent(laid, level)
    edit = made(_reader(heaps.get(unit, NO_HEAP), level, cache))
    return {unit: Heaping(edit.coverage, edit.brush, ink, False, None, part=share(laid, level, unit))}


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
