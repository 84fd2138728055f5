"""The tree of layers as a list that a panel shows."""

from __future__ import annotations

from engine.canvas.layers import Group, Layer
from engine.studio import results


def rows(group: Group, depth: int = 0, parent: str | None = None) -> list[results.LayerRow]:
    """Returns the tree as the panel lists it, top-most first."""
    out = []
    for position in reversed(range(len(group.children))):
        node = group.children[position]
        is_group = isinstance(node, Group)
        alpha_locked = isinstance(node, Layer) and node.alpha_locked
        out.append(
            results.LayerRow(
                node.name,
                is_group,
                depth,
                parent,
                position,
                node.opacity,
                node.visible,
                node.blend,
                node.locked,
                alpha_locked,
            )
        )
        if isinstance(node, Group):
            out += rows(node, depth + 1, node.name)
    return out
