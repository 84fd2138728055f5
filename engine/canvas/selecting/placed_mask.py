"""A placement's mask while the placement is moved, scaled and turned: it goes along, and nothing of it is lost."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing.bake import TooFine, baked
from engine.canvas.placing.baking import paint_of
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose
from engine.canvas.selecting.layer_mask import moved_of
from engine.canvas.selecting.selection import Selection
from engine.numeric.address import Rect
from engine.numeric.similarity import IDENTITY

_NOWHERE = Rect(0, 0, 1, 1)  # the frame of what is not repeated


def reposed(node: Placement, pose: Pose) -> Placement:
    """Returns a placement elsewhere, made at once: its mask is seen through the move."""
    if node.mask is None or pose == node.pose:
        return replace(node, pose=pose)
    return replace(node, pose=pose, mask=replace(node.mask, pose=node.mask.pose or node.pose))


def laid_again(node: Placement) -> Placement:
    """Returns a placement whose mask lies where it is seen, if that is exact: it went along by quarter turns and powers
    of two; else the placement itself."""
    mask = node.mask
    if mask is None or mask.pose is None:
        return node
    by = moved_of(node).similarity
    if by == IDENTITY:
        return replace(node, mask=replace(mask, pose=None))
    if by.quarter is not None:
        with suppress(TooFine):
            return replace(node, mask=replace(mask, pyramid=baked(mask.pyramid, by), pose=None))
    return node


def mask_here(node: Node) -> Selection | None:
    """Returns the mask of a node in the places where it is seen: of a placement that was turned since it was made, by
    pixels of the level of its finest detail.  LayerError if they are too many."""
    mask = node.mask
    if mask is None or mask.pose is None:
        return mask
    sheet = Layer(1, "mask", visible=False, pyramid=mask.pyramid)
    shown = Placement(2, "seen", of=1, pose=Pose.of(moved_of(node).similarity))
    made = paint_of(Group(0, "root", children=(sheet, shown)), shown, _NOWHERE, mask.pyramid.grid)
    return replace(mask, pyramid=made, pose=None)
