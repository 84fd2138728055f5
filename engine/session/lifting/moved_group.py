"""A group moved by quarter turns and powers of two: it stays one, of layers whose very pixels lie elsewhere."""

from __future__ import annotations

from dataclasses import replace

from engine.canvas import layers
from engine.canvas.flatten import flattened
from engine.canvas.heaps.joined_heaps import heaps_moved
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing import loops
from engine.canvas.placing.bake import baked
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose, SourcePart
from engine.numeric.similarity import Similarity


def moves_exactly(root: Group, group: Group) -> bool:
    """Tells whether all that a group holds can be moved so: no layer of it wraps around, no placement of it shows what
    holds the group, and none outside shows any of it."""
    around = {None, root.id, *(one.id for one in layers.ancestors(root, group.name))}
    for one in layers.walk(group):
        wraps = isinstance(one, Layer) and one.wrap is not None
        if wraps or (isinstance(one, Placement) and one.of in around):
            return False
    return not loops.showing(root, group.name)


def group_moved(group: Group, by: Similarity) -> Group:
    """Returns a group with all that it holds elsewhere."""
    own = {group.id, *(one.id for one in layers.walk(group))}
    out = _moved_node(group, by, own)
    assert isinstance(out, Group)
    return out


def _moved_node(node: Node, by: Similarity, own: set[int]) -> Node:
    if isinstance(node, Placement):
        return _moved_placement(node, by, node.of in own)
    mask = None if node.mask is None else replace(node.mask, pyramid=baked(node.mask.pyramid, by))
    if isinstance(node, Group):
        return replace(node, children=tuple(_moved_node(child, by, own) for child in node.children), mask=mask)
    return layer_moved(replace(node, mask=mask), by)


def layer_moved(layer: Layer, by: Similarity) -> Layer:
    """Returns a layer with its paint elsewhere, its mask where it was."""
    paint = (flattened(layer) if layer.growth else layer).pyramid
    return replace(layer, pyramid=baked(paint, by), growth=(), heaps=heaps_moved(layer.heaps, by))


def _moved_placement(node: Placement, by: Similarity, own: bool) -> Placement:
    """Returns a placement as it is seen by a similarity; `own`: its source is moved as well."""
    mask = None if node.mask is None else replace(node.mask, pyramid=baked(node.mask.pyramid, by))
    if mask is not None and mask.pose is not None:
        mask = replace(mask, pose=_posed(mask.pose, by, own))
    pose = _posed(node.pose, by, own)
    if not own:
        return replace(node, pose=pose, mask=mask)
    part, levels = node.part, (by.quarter or (0, 0))[0]
    if part is not None:
        at = part.level - levels
        at = at if by.aligned_from is None else max(at, by.aligned_from)
        part = SourcePart(at, by.shown(part.rect, part.level, at))
    return replace(node, pose=pose, part=part, mask=mask)


def _posed(pose: Pose, by: Similarity, own: bool) -> Pose:
    return Pose.of(by.inverse().then(pose.similarity).then(by)) if own else pose.followed(by)
