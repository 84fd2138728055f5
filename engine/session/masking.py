"""What a command makes of a layer's mask."""

from __future__ import annotations

from dataclasses import replace

from engine.canvas import layers
from engine.canvas.flatten import flattened
from engine.canvas.layers import Group, Layer
from engine.canvas.merging.cleared import without
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.baking import bake_levels, heaps_of, paint_of
from engine.canvas.placing.placement import Placement
from engine.canvas.selecting.mask_sheet import sheet_of
from engine.canvas.selecting.placed_mask import mask_here
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid
from engine.painting import commands as c
from engine.painting.grown import settled_root
from engine.painting.layering.mask_member import (
    MASK_APPLY,
    MASK_EMPTY,
    MASK_FULL,
    MASK_INVERT,
    MASK_LAY,
    MASK_OFF,
    MaskOp,
)
from engine.painting.value import Painting


def mask_for(painting: Painting, command: c.SetLayer) -> Selection | None:
    """Returns the value of the mask that a command sets; None where it takes it away.  LayerError if there is none."""
    name, wanted = command.name, command.mask
    if isinstance(wanted, MaskOp):
        return _changed(painting, name, wanted.op)
    if wanted is False:
        return None
    if wanted is True:
        if painting.selection is None:
            raise LayerError(f"layer {name!r}: mask: found nothing selected, expected a selection")
        return _own(painting.selection)
    if wanted is None or wanted not in painting.selections:
        raise LayerError(f"layer {name!r}: mask: found {wanted!r}, expected the name of a selection that is kept")
    return _own(painting.selections[wanted])


def with_mask_applied(painting: Painting, command: c.SetLayer) -> Painting:
    """Returns the painting without the paint that a layer's mask hides, if a command asks for that; else itself.

    At the level of the mask's finest detail that is exact; coarser levels follow, finer ones as under an eraser.
    """
    if command.mask != MaskOp(MASK_APPLY):
        return painting
    node = layers.find(painting.root, command.name)
    sheet_of(node)
    if isinstance(node, Group):
        raise LayerError(
            f"layer {node.name!r}: found a group, expected a layer of paint to take off what its mask hides"
        )
    if layers.is_locked(painting.root, node.name):
        raise LayerError(f"layer {node.name!r}: found it locked, expected one that is not")
    if isinstance(node, Placement):
        fitting = bake_levels(settled_root(painting.root), replace(node, mask=None), painting.frame)
        node = made_paint(painting, node, None if fitting is None else fitting.level)
    assert node.mask is not None
    paint = flattened(node).pyramid if node.growth else node.pyramid
    left = without(paint, node.mask.inverted())
    made = node if left is node.pyramid else replace(node, pyramid=left, growth=())
    return replace(painting, root=layers.substitute(painting.root, node.name, made))


def made_paint(painting: Painting, node: Placement, level: int | None = None) -> Layer:
    """Returns a layer of what a placement shows, within the same mask; `level`: of its pixels, where it cannot be
    exact."""
    paint = paint_of(settled_root(painting.root), replace(node, mask=None), painting.frame, painting.grid, level)
    kept = node.opacity, node.visible, node.blend
    made = Layer(node.id, node.name, *kept, pyramid=paint, role=node.role, clip=node.clip, mask=mask_here(node))
    return replace(made, heaps=heaps_of(painting.root, replace(node, mask=None)))


def _own(selection: Selection) -> Selection:
    """Returns the same on a line of history of its own: it is painted on, and the selection is not."""
    return replace(selection, pyramid=selection.pyramid.branched())


def _changed(painting: Painting, name: str, op: str) -> Selection | None:
    if op in (MASK_FULL, MASK_EMPTY):
        return Selection(Pyramid(grid=painting.grid), inverse=op == MASK_FULL)
    node = layers.find(painting.root, name)
    sheet_of(node)
    assert node.mask is not None
    if op == MASK_LAY:
        return mask_here(node)
    if op == MASK_INVERT:
        return node.mask.inverted()
    return None if op == MASK_APPLY else replace(node.mask, off=op == MASK_OFF)
