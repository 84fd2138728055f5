"""The tree of layers as a list that a panel shows; what was copied last is not in it."""

from __future__ import annotations

from collections.abc import Mapping

from engine.canvas import layers
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.placement import Placement
from engine.canvas.selecting.mask_sheet import mask_of
from engine.checks.roles import AS_HEIGHT, COPIED, REFERENCE
from engine.studio import results


def rows(root: Group) -> list[results.LayerRow]:
    """Returns the tree as the panel lists it, top-most first."""
    return _rows(root, {node.id: node.name for node in layers.walk(root)}, 0, None)


def _rows(group: Group, names: Mapping[int, str], depth: int, parent: str | None) -> list[results.LayerRow]:
    out = []
    for position in reversed(range(len(group.children))):
        node = group.children[position]
        if isinstance(node, Layer) and node.role == COPIED:
            continue
        is_group, mask = isinstance(node, Group), mask_of(node)
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
                _shows(node, names) if isinstance(node, Placement) else None,
                node.pyramid.finest if isinstance(node, Layer) else None,
                not isinstance(node, Group) and node.role == REFERENCE,
                node.clip,
                node.wrap if isinstance(node, Layer) else None,
                mask is not None,
                mask is not None and mask.off,
                not isinstance(node, Group) and node.role == AS_HEIGHT,
                node.scale if isinstance(node, Layer) else None,
                node.sea if isinstance(node, Layer) else None,
                mask is not None and mask.pose is not None,
            )
        )
        if isinstance(node, Group):
            out += _rows(node, names, depth + 1, node.name)
    return out


def _shows(node: Placement, names: Mapping[int, str]) -> results.Shows:
    return results.Shows(names[node.of] if node.of else None, node.pose, node.part)
