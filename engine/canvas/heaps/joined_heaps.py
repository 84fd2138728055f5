"""Heaps of several layers as those of one, and heaps that lie elsewhere: what was heaped is kept, wherever paint goes.

Heaps of one unit are added up at every tile in which either has anything, no higher than a heap holds, as if strokes
had laid both; ink stays ink.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import immutables
import numpy as np

from engine.canvas.evaluate import evaluate
from engine.canvas.heaps.heaps import MOST_HEAPED, MOST_INK, NO_HEAPS, Heaps
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.merging.cleared import without
from engine.canvas.merging.merged import left_of
from engine.canvas.placing.bake import baked
from engine.canvas.placing.placement import Placement
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid, level_of
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TileKey
from engine.numeric.grid import snapped
from engine.numeric.similarity import Similarity
from engine.texture.planes import COLOURS, Planes, merged, widened

_KEPT_BYTES = 64 << 20  # bytes
_ALPHA = 3
Part = tuple[Pyramid, float]  # a heap, and how many times its heights are taken


def heaps_joined(parts: Iterable[tuple[Heaps, float]]) -> Heaps:
    """Returns heaps, each so many times as high, as one."""
    by_unit: dict[int, list[Part]] = {}
    for heaps, times in parts:
        for unit, heap in heaps.items():
            if heap.levels and times:
                by_unit.setdefault(unit, []).append((heap, times))
    return immutables.Map({unit: _sum(found) for unit, found in sorted(by_unit.items())})


def _sum(parts: list[Part]) -> Pyramid:
    """Returns heaps of one unit as one, on a line of history of its own."""
    (first, times), commits = parts[0], sum(heap.commits for heap, _ in parts)
    if len(parts) == 1 and times == 1.0:
        return first.branched()
    made, cache = Pyramid(grid=first.grid, commits=commits), TileCache(_KEPT_BYTES)
    for level in sorted({level for heap, _ in parts for level in heap.levels}):
        places = sorted({place for heap, _ in parts for place in heap.levels.get(level, ())})
        keys = [TileKey(level, *place) for place in places]
        records = {(key.x, key.y): left_of(made, key, _seen_together(parts, key, cache), cache) for key in keys}
        kept = {place: record for place, record in records.items() if record is not None}
        if kept:
            made = replace(made, levels=made.levels.set(level, level_of(kept)))
    return made


def _seen_together(parts: list[Part], key: TileKey, cache: TileCache) -> Planes:
    """Returns what heaps hold together in a tile, as far as one has room."""
    seen = [(evaluate(heap, key.level, key.rect, cache), times) for heap, times in parts]
    inks = merged(*(planes.inks for planes, _ in seen))
    out = np.zeros((COLOURS + 3 * len(inks), key.rect.height, key.rect.width), np.float32)
    for planes, times in seen:
        out += snapped(np.float32(times) * widened(planes, inks).data)
    np.clip(out[:_ALPHA], -MOST_HEAPED, MOST_HEAPED, out=out[:_ALPHA])
    np.clip(out[COLOURS:], -MOST_INK, MOST_INK, out=out[COLOURS:])
    return Planes(out, inks)


def joined_of(nodes: Iterable[Node]) -> Heaps:
    """Returns what is heaped on nodes that are merged, those that show, each as high as it is seen."""
    return heaps_joined((layer.heaps, opacity) for layer, opacity in _heaping_layers(nodes, 1.0))


def _heaping_layers(nodes: Iterable[Node], opacity: float) -> Iterator[tuple[Layer, float]]:
    for node in nodes:
        if not node.visible or isinstance(node, Placement):
            continue
        if isinstance(node, Group):
            yield from _heaping_layers(node.children, opacity * node.opacity)
        else:
            yield node, opacity * node.opacity


def heaps_moved(heaps: Heaps, by: Similarity) -> Heaps:
    """Returns heaps as they lie by quarter turns and powers of two: as high as they become wide."""
    assert by.quarter is not None
    return immutables.Map({unit + by.quarter[0]: baked(heap, by) for unit, heap in heaps.items()})


def selected_of(layer: Layer, selection: Selection | None) -> Heaps:
    """Returns what is selected of a layer's heaps, all of it where nothing is, on lines of history of its own."""
    out = NO_HEAPS
    for unit, heap in layer.heaps.items():
        part = heap if selection is None else without(heap, selection.inverted())
        if part.levels:
            out = out.set(unit, part.branched())
    return out
