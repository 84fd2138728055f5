"""Which nodes may show themselves: all others can be drawn, and counted, without looking for it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from engine.canvas.layers import Group, Node, walk
from engine.canvas.placing.placement import Placement


def by_ids(root: Group) -> dict[int, Node]:
    """Returns all nodes of a tree, the root too, by their ids."""
    return {root.id: root, **{node.id: node for node in walk(root)}}


def shown_in(node: Node, root: Group) -> list[int]:
    """Returns the ids of the nodes that one shows at once."""
    if isinstance(node, Group):
        return [child.id for child in node.children]
    return [root.id if node.of is None else node.of] if isinstance(node, Placement) else []


def rounds(root: Group, nodes: Mapping[int, Node]) -> set[int]:
    """Returns the nodes that show themselves, and those that lie between two such.  `nodes`: all of them, the root too,
    by their ids; those that show none of the others may be left out."""
    ways = {number: [one for one in shown_in(node, root) if one in nodes] for number, node in nodes.items()}
    back: dict[int, list[int]] = {number: [] for number in nodes}
    for number, shown in ways.items():
        for one in shown:
            back[one].append(number)
    return set(nodes) - _ending(ways, back) - _ending(back, ways)


def _ending(ways: Mapping[int, Sequence[int]], back: Mapping[int, Iterable[int]]) -> set[int]:
    """Returns the nodes from which all ways come to an end."""
    left = {number: len(shown) for number, shown in ways.items()}
    ended = [number for number, count in left.items() if not count]
    for number in ended:  # it grows
        for one in back[number]:
            left[one] -= 1
            if not left[one]:
                ended.append(one)
    return set(ended)


def composed(outer: Placement, inner: Node) -> bool:
    """Tells whether two placements in one another, which do not show themselves, are drawn as one: both exact, neither
    repeated, and the inner one without a mask."""
    return (
        isinstance(inner, Placement)
        and not (outer.repeat or inner.repeat)
        and (inner.mask is None or inner.mask.off)
        and outer.pose.similarity.quarter is not None
        and inner.pose.similarity.quarter is not None
    )
