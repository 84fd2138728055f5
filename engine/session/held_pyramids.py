"""All that the layers of a painting store in pyramids: their paint, what is heaped beside it, their masks."""

from __future__ import annotations

from engine.canvas import layers
from engine.canvas.layers import Group, Layer
from engine.canvas.store import Pyramid

_PAINT, _MASK = "paint", "mask"
Sheet = tuple[int, str | int]  # the id of a node, and which of its pyramids: a number is that of the heap's unit


def pyramids(root: Group) -> dict[Sheet, Pyramid]:
    """Returns the pyramids of all nodes, those of each beside one another."""
    found: dict[Sheet, Pyramid] = {}
    for node in layers.walk(root):
        if isinstance(node, Layer):
            found[node.id, _PAINT] = node.pyramid
            for unit, heap in node.heaps.items():
                found[node.id, unit] = heap
        if node.mask is not None:
            found[node.id, _MASK] = node.mask.pyramid
    return found
