"""All that the layers of a painting store in pyramids: their paint, what is heaped beside it, their masks."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.store import Pyramid

_PAINT, _MASK = "paint", "mask"
Sheet = tuple[int, str | int]  # the id of a node, and which of its pyramids: a number is that of the heap's unit


def pyramids(root: Group) -> dict[Sheet, Pyramid]:
    """Returns the pyramids of all nodes, those of each beside one another."""
    return pyramids_of(layers.walk(root))


def pyramids_of(nodes: Iterable[Node]) -> dict[Sheet, Pyramid]:
    """Returns the pyramids of some nodes, those of each beside one another."""
    found: dict[Sheet, Pyramid] = {}
    for node in nodes:
        if isinstance(node, Layer):
            found[node.id, _PAINT] = node.pyramid
            for unit, heap in node.heaps.items():
                found[node.id, unit] = heap
        if node.mask is not None:
            found[node.id, _MASK] = node.mask.pyramid
    return found


def changed_nodes(old: Group, new: Group) -> tuple[list[Node], list[Node]]:
    """Returns the nodes of one tree, and those of another, that the other tree has not just so; but for the roots."""
    one, other = old.children, new.children
    if len(one) != len(other) or any(a.id != b.id for a, b in zip(one, other, strict=True) if a is not b):
        before, after = ({id(node): node for node in layers.walk(root)} for root in (old, new))
        lost = [node for at, node in before.items() if at not in after]
        return lost, [node for at, node in after.items() if at not in before]
    lost, found = list[Node](), list[Node]()
    for a, b in zip(one, other, strict=True):
        if a is not b:
            inside = changed_nodes(*(node if isinstance(node, Group) else layers.EMPTY for node in (a, b)))
            lost += (a, *inside[0])
            found += (b, *inside[1])
    return lost, found


def related(root: Group, families: Collection[int]) -> list[Pyramid]:
    """Returns the pyramids of all nodes that are of some families."""
    found: list[Pyramid] = []
    for node in layers.walk(root):
        if isinstance(node, Layer):
            if node.pyramid.family in families:
                found.append(node.pyramid)
            if node.heaps:
                found += (heap for heap in node.heaps.values() if heap.family in families)
        if node.mask is not None and node.mask.pyramid.family in families:
            found.append(node.mask.pyramid)
    return found
