"""How much a tree comes to once all placements show what they show, and how far they lie in one another: both bounded.

Groups of two placements of the group before double what is drawn each time; nobody could wait for forty of them.
Exact placements in one another are drawn as one, and count as one; each part that is cut out of another counts.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.rounds import composed, rounds, shown_in

MOST_IN_LOOPS = 1 << 13  # layers and placements in what shows itself, each as often as it is shown
MOST_DRAWN = 1 << 16  # of others: what lies beside the view, or is seen by many, costs little
MOST_NESTED = 128  # groups and placements in one another


def checked_drawable(root: Group, nodes: Mapping[int, Node]) -> bool:
    """Tells whether something in the tree shows itself; LayerError if there is too much to draw, or too deep.
    `nodes`: all of them, the root too, by their ids.  Each turn of what shows itself counts once."""
    known = _of_paint(nodes)
    inside: set[int] = set()  # what is being looked at: met again, it shows itself
    goes_round, round_ = False, rounds(root, {number: node for number, node in nodes.items() if number not in known})
    todo = [root.id]
    while todo:
        number = todo[-1]
        node = nodes[number]
        shown = shown_in(node, root)
        if number not in inside and number not in known:
            inside.add(number)
            goes_round |= any(one in inside for one in shown)
            todo += [one for one in shown if one not in inside and one not in known]
        else:
            todo.pop()
            if number in inside:
                inside.discard(number)
                as_one = isinstance(node, Placement) and shown[0] not in round_ and composed(node, nodes[shown[0]])
                most = MOST_IN_LOOPS if number in round_ else MOST_DRAWN
                known[number] = _counted(node, [known[one] for one in shown if one in known], as_one, most)
    return goes_round


def _of_paint(nodes: Mapping[int, Node]) -> dict[int, tuple[int, int]]:
    """Returns of layers, and of placements of such, how much there is to draw, and how many lie in one another."""
    paint = {number for number, node in nodes.items() if isinstance(node, Layer)}
    shown = (number for number, node in nodes.items() if isinstance(node, Placement) and node.of in paint)
    return {**dict.fromkeys(paint, (1, 0)), **dict.fromkeys(shown, (2, 1))}


def _counted(node: Node, shown: Iterable[tuple[int, int]], as_one: bool, most: int) -> tuple[int, int]:
    """Returns what a node comes to, from what it shows, `most` of it; `as_one`: it is drawn as one with the placement
    it shows."""
    found = list(shown)
    deeper = isinstance(node, Group) or (isinstance(node, Placement) and (not as_one or node.part is not None))
    drawn = sum(count for count, _ in found) + (not isinstance(node, Group) and not as_one)
    nested = max((deep for _, deep in found), default=0) + deeper
    if drawn > most:
        told = "layers and placements to draw"
        raise LayerError(f"layer {node.name!r}: found {drawn:,} {told} in it, expected at most {most:,}")
    if nested > MOST_NESTED:
        told = "placements and groups in one another"
        raise LayerError(f"layer {node.name!r}: found {nested} {told}, expected at most {MOST_NESTED}")
    return drawn, nested
