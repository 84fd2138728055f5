"""Layers and groups moved, turned and scaled: what lies on whole pixels exactly, anything else without a pixel lost."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.placing import loops
from engine.canvas.placing.bake import TooFine, baked
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import UNMOVED, Pose
from engine.canvas.selecting.placed_mask import reposed
from engine.numeric.similarity import Similarity
from engine.painting.layering.placing_members import Placing, Same
from engine.painting.value import Painting
from engine.session.lifting.moved_group import group_moved, layer_moved, moves_exactly


def elsewhere(painting: Painting, node: Layer | Group, placing: Placing) -> Painting:
    """Returns the painting with a layer or group elsewhere, as a placement would show it.

    A layer that is moved by quarter turns and powers of two stays one, with its paint in other places, and so does a
    group of such, unless it shows what holds it or is shown elsewhere, or that took too many tiles.  Any other node
    stays where it is, hidden, as "NAME (source)", and a placement shows it under its name.
    """
    given = placing.fields() or placing.of is not Same.SAME
    if given:
        raise LayerError(f"layer {node.name!r}: found no placement, expected one to set what it shows")
    pose = placing.posed(UNMOVED)
    if isinstance(node, Layer) and node.wrap is not None:
        raise LayerError(f"layer {node.name!r}: found it wrapped around, expected wrap-around off before it is moved")
    if pose.similarity.quarter is not None:
        with suppress(TooFine):
            here = _moved(painting.root, node, pose.similarity)
            if here is not None:
                return replace(painting, root=layers.substitute(painting.root, node.name, here))
    return replace(painting, root=shown_from_beside(painting.root, node, pose))


def _moved(root: Group, node: Layer | Group, by: Similarity) -> Layer | Group | None:
    """Returns a node with its paint elsewhere, None for a group that cannot be moved so."""
    if isinstance(node, Group):
        return group_moved(node, by) if moves_exactly(root, node) else None
    mask = None if node.mask is None else replace(node.mask, pyramid=baked(node.mask.pyramid, by))
    return layer_moved(replace(node, mask=mask), by)


def tried(painting: Painting, name: str, placing: Placing, copy: bool = False) -> Painting:
    """Returns how a painting looks with a node, or a copy of it, elsewhere, made at once: no paint is touched.
    LayerError if it cannot be."""
    node = layers.find(painting.root, name)
    if copy:
        root = _shown_besides(painting.root, node, placing)
    elif isinstance(node, Placement):
        root = layers.substitute(painting.root, name, reposed(node, placing.posed(node.pose)))
    else:
        root = shown_from_beside(painting.root, node, placing.posed(UNMOVED))
    return replace(painting, root=loops.checked(root))


def _shown_besides(root: Group, node: Node, placing: Placing) -> Group:
    """Returns the tree with a placement of a node, or of what that shows, right above it."""
    number, name = layers.next_id(root), layers.free_name(root, f"{node.name} copy")
    if isinstance(node, Placement):
        shown = replace(reposed(node, placing.posed(node.pose)), id=number, name=name)
    else:
        pose = placing.posed(UNMOVED)
        shown = Placement(
            number, name, node.opacity, node.visible, node.blend, node.locked, node.id, pose, clip=node.clip
        )
    group, position = layers.place(root, node.name)
    return layers.insert(root, shown, group, position + 1)


def shown_from_beside(root: Group, node: Layer | Group, pose: Pose) -> Group:
    """Returns the tree with a placement in a node's place, right above the node, which is hidden."""
    source = replace(node, name=layers.free_name(root, f"{node.name} (source)"), visible=False)
    shown = Placement(
        layers.next_id(root),
        node.name,
        node.opacity,
        node.visible,
        node.blend,
        node.locked,
        node.id,
        pose,
        role=node.role if isinstance(node, Layer) else "",
        clip=node.clip,
    )
    group, position = layers.place(root, node.name)
    return layers.insert(layers.substitute(root, node.name, source), shown, group, position + 1)
