"""How thick paint lies, as it is seen at a level: all that is heaped on the layers that show."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.heaps.heaps import lies, of_scale
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.through import UNPLACED
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.layer_mask import Mask, ReadSheet
from engine.canvas.tile_cache import TileCache
from engine.checks.roles import REFERENCE
from engine.numeric.address import Rect

_ALPHA = 3
HeapsOf = Callable[[Layer, int, Rect], np.ndarray | float]  # in pixels of the level


Masks = tuple[Mask, ...]


def heaped_layers(root: Group) -> Iterator[tuple[Layer, float, Masks]]:
    """Yields the layers that show and on which anything may be heaped, the one of heights among them, each with its
    opacity within the groups that hold it, and the masks of these and its own."""
    for node in root.children:
        if not node.visible or not node.opacity or isinstance(node, Placement):
            continue
        mask = Mask.of(node)
        own: Masks = () if mask is None else (mask,)
        if isinstance(node, Group):
            for layer, opacity, masks in heaped_layers(node):
                yield layer, opacity * node.opacity, own + masks
        elif node.role != REFERENCE:
            yield node, node.opacity, own


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


def thickness(
    root: Group, level: int, rect: Rect, heaps_of: HeapsOf | None = None, read: ReadSheet | None = None
) -> np.ndarray:
    """Returns how thick paint lies in a rectangle of a level, in its pixels: float32 (h, w); as far as masks show it.
    `read` gives their pixels."""
    out = np.zeros((rect.height, rect.width), np.float32)
    heaps = partial(heaped_on, cache=None) if heaps_of is None else heaps_of
    for layer, opacity, masks in heaped_layers(root):
        seen = heaps(layer, level, rect)
        for mask in () if isinstance(seen, float) else masks:
            shows = mask.planes(layer_planes if read is None else read, level, rect, UNPLACED)
            seen = 0.0 if shows is None else seen * np.clip(shows[_ALPHA], 0, 1)
        if not isinstance(seen, float):
            out += np.float32(opacity) * seen
    return out
