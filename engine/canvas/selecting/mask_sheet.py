"""A node's mask as a sheet of its own: compositing reads it as it reads a layer, and strokes are laid on it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid


@dataclass(frozen=True, slots=True)
class MaskSheet(Layer):
    """The pyramid of a node's mask under the node's name, `inverse` as the mask has it.  Its `id` is no node's."""

    inverse: bool = False


def mask_of(node: Node) -> Selection | None:
    """Returns the mask of a node, if it has one."""
    return node.mask


def sheet_of(node: Node) -> MaskSheet:
    """Returns the mask of a node as a sheet.  LayerError if it has none."""
    mask = mask_of(node)
    if mask is None:
        raise LayerError(f"layer {node.name!r}: found no mask, expected one")
    return MaskSheet(-node.id, node.name, pyramid=mask.pyramid, inverse=mask.inverse)


def repainted(root: Group, sheet: Layer, pyramid: Pyramid) -> Group:
    """Returns the tree with other paint on a layer, or on the mask that a sheet is of."""
    if not isinstance(sheet, MaskSheet):
        return layers.with_pyramid(root, sheet.name, pyramid)
    mask = mask_of(layers.find(root, sheet.name))
    assert mask is not None
    return layers.set_fields(root, sheet.name, mask=replace(mask, pyramid=pyramid))
