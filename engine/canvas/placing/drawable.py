"""How much a tree comes to once all placements show what they show, and how far they lie in one another: both bounded.

Groups of two placements of the group before double what is drawn each time; nobody could wait for forty of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from engine.canvas.layers import Group, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.placement import Placement

MOST_DRAWN = 1 << 13  # layers and placements, each as often as it is shown
MOST_NESTED = 128  # groups and placements in one another


def checked_drawable(root: Group, nodes: Mapping[int, Node]) -> bool:
    """Tells whether something in the tree shows itself; LayerError if there is too much to draw, or too deep.
    `nodes`: all of them, the root too, by their ids.  Each turn of what shows itself counts once."""
    known: dict[int, tuple[int, int]] = {}  # how much there is to draw, and how many lie in one another
    inside: set[int] = set()  # what is being looked at: met again, it shows itself
    goes_round = False
    todo = [root.id]
    while todo:
        number = todo[-1]
        shown = _shown(nodes[number], root)
        if number not in inside and number not in known:
            inside.add(number)
            goes_round |= any(one in inside for one in shown)
            todo += [one for one in shown if one not in inside and one not in known]
        else:
            todo.pop()
            if number in inside:
                inside.discard(number)
                known[number] = _counted(nodes[number], [known[one] for one in shown if one in known])
    return goes_round


def _shown(node: Node, root: Group) -> list[int]:
    if isinstance(node, Group):
        return [child.id for child in node.children]
    return [root.id if node.of is None else node.of] if isinstance(node, Placement) else []


def _counted(node: Node, shown: Iterable[tuple[int, int]]) -> tuple[int, int]:
    """Returns what a node comes to, from what it shows."""
    found = list(shown)
    drawn = sum(count for count, _ in found) + (not isinstance(node, Group))
    nested = max((deep for _, deep in found), default=0) + isinstance(node, Group | Placement)
    if drawn > MOST_DRAWN:
        told = "layers and placements to draw"
        raise LayerError(f"layer {node.name!r}: found {drawn:,} {told} in it, expected at most {MOST_DRAWN:,}")
    if nested > MOST_NESTED:
        told = "placements and groups in one another"
        raise LayerError(f"layer {node.name!r}: found {nested} {told}, expected at most {MOST_NESTED}")
    return drawn, nested
