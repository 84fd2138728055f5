"""A tree parted into what lies below a node, the node, and what lies above it."""

from __future__ import annotations

from collections.abc import Sequence

from engine.canvas import layers
from engine.canvas.layers import Group, Node
from engine.canvas.placing import loops

Stacks = tuple[Group, Group, Group]
_PLAIN = "src-over"


def stacks_around(root: Group, name: str) -> Stacks | None:
    """Returns roots of what is seen below a node, of the node alone and above it, which laid over one another show what
    the tree does, wherever the node lies; None where they do not, or the node is not seen.  LayerError if there is no
    such node."""
    node, around = layers.find(root, name), layers.ancestors(root, name)
    if loops.seen_elsewhere(root, name) or not _seen(node) or not all(map(_passes, around)):
        return None
    below: list[Node] = []
    above: list[Node] = []
    for group, inner in zip((root, *around), (*around, node), strict=True):
        at = next(n for n, child in enumerate(group.children) if child is inner)
        below += group.children[:at]
        above = [*group.children[at + 1 :], *above]
        clips = inner.clip or any(one.clip for one in group.children[at + 1 : at + 2])
        if clips or not (group is root or layers.passes_through(group) or _lies_over(group.children[:at])):
            return None
    if not _lies_over(above):
        return None
    return layers.together(below, root), layers.together((node,), root), layers.together(above, root)


def _seen(node: Node) -> bool:
    return node.visible and node.blend == _PLAIN


def _passes(group: Group) -> bool:
    """Tells whether a group shows what it holds as it is."""
    return _seen(group) and group.opacity == 1 and (group.mask is None or group.mask.off)


def _lies_over(nodes: Sequence[Node]) -> bool:
    """Tells whether nodes lie on whatever is below them without mixing with it."""
    return all(
        not node.visible
        or (
            node.blend == _PLAIN
            and (not isinstance(node, Group) or not layers.passes_through(node) or _lies_over(node.children))
        )
        for node in nodes
    )
