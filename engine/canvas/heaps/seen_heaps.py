"""How thick paint lies, as it is seen at a level: all that is heaped on the layers that show."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.heaps.heaps import lies, of_scale
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.placement import Placement
from engine.canvas.tile_cache import TileCache
from engine.checks.roles import REFERENCE
from engine.numeric.address import Rect

HeapsOf = Callable[[Layer, int, Rect], np.ndarray | float]  # in pixels of the level


def heaped_layers(root: Group) -> Iterator[tuple[Layer, float]]:
    """Yields the layers that show and on which anything may be heaped, the one of heights among them, each with its
    opacity within the groups that hold it."""
    for node in root.children:
        if not node.visible or not node.opacity or isinstance(node, Placement):
            continue
        if isinstance(node, Group):
            yield from ((layer, opacity * node.opacity) for layer, opacity in heaped_layers(node))
        elif node.role != REFERENCE:
            yield node, node.opacity


def heaped_on(layer: Layer, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray | float:
    """Returns what is heaped on a layer in a rectangle of a level, on a scale like that of the level or a finer one, in
    pixels of the level: float32 (h, w), or 0 where nothing is."""
    out: np.ndarray | float = 0.0
    for unit in of_scale(layer.heaps, level):
        heap = layer.heaps[unit]
        seen = evaluate_sparse(heap, level, rect, cache, lent=True) if lies(heap, level, rect) else None
        if seen is not None:
            out = out + np.ldexp(seen.data[0], unit + level)
    return out


def thickness(root: Group, level: int, rect: Rect, heaps_of: HeapsOf | None = None) -> np.ndarray:
    """Returns how thick paint lies in a rectangle of a level, in its pixels: float32 (h, w)."""
    out = np.zeros((rect.height, rect.width), np.float32)
    read = partial(heaped_on, cache=None) if heaps_of is None else heaps_of
    for layer, opacity in heaped_layers(root):
        seen = read(layer, level, rect)
        if not isinstance(seen, float):
            out += np.float32(opacity) * seen
    return out
