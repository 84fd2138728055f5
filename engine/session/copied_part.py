"""What is selected of a layer, copied or cut, held by the painting or on a layer of its own; and pasted."""

from __future__ import annotations

from dataclasses import replace

from engine.canvas import layers
from engine.canvas.attenuate import fold
from engine.canvas.flatten import flattened
from engine.canvas.heaps.heaps import own_lines
from engine.canvas.heaps.joined_heaps import selected_of
from engine.canvas.layers import Group, Layer
from engine.canvas.merging.cleared import without
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.placement import Placement
from engine.canvas.store import Pyramid
from engine.checks.roles import COPIED
from engine.painting.commands import DuplicateLayer
from engine.painting.layer_commands import CUT
from engine.painting.value import Painting, Refusal, with_node
from engine.session.masking import made_paint
from engine.session.merging import cleared


def lifted(painting: Painting, command: DuplicateLayer) -> Painting:
    """Returns the painting with what is selected of a layer, all of it where nothing is, on a layer of its own.

    What a cut leaves and what it takes add up to what was there, at the selection's level and coarser ones.
    """
    node = _paint(painting, command.name)
    part = selected_paint(painting, node)
    number, role = layers.next_id(painting.root), COPIED if command.aside else ""
    made = replace(
        node, id=number, name=command.to, locked=False, role=role, visible=not role, pyramid=part.branched(), growth=(),
        heaps=selected_of(node, painting.selection),
    )  # fmt: skip
    if command.selected == CUT:
        painting = cleared(painting, command.name)
    group, position = layers.place(painting.root, command.name)
    if command.aside:
        root = layers.insert(_without_copied(painting.root), replace(made, clip=False), None, 0)
        return replace(painting, root=root)
    root = layers.insert(painting.root, made, group, position + 1)
    return replace(painting, root=root, active=command.to)


def with_copy(painting: Painting, name: str) -> Painting:
    """Returns the painting with what is selected of a layer, all of it where nothing is, held to be pasted; of what a
    placement shows likewise: exact, or as pixels of the finest level of its source."""
    shown = layers.find(painting.root, name)
    node = made_paint(painting, shown) if isinstance(shown, Placement) else _paint(painting, name)
    part = selected_paint(painting, node).branched()
    held = replace(node, locked=False, role="", clip=False, pyramid=part, growth=())
    return replace(painting, copied=replace(held, heaps=selected_of(node, painting.selection)))


def with_cut(painting: Painting, name: str) -> Painting:
    """Returns the painting with that held, and taken off the layer: the two add up to what was there."""
    _paint(painting, name)
    return cleared(with_copy(painting, name), name)


def _paint(painting: Painting, name: str) -> Layer:
    node = layers.find(painting.root, name)
    if not isinstance(node, Layer):
        raise LayerError(f"layer {name!r}: found no layer of paint, expected one to copy from")
    return node


def selected_paint(painting: Painting, node: Layer) -> Pyramid:
    """Returns what is selected of a layer's paint, all of it where nothing is.  LayerError if there is none."""
    paint = (flattened(node) if node.growth else node).pyramid
    part = paint if painting.selection is None else without(paint, painting.selection.inverted())
    if paint.coarsest is not None and fold(part).coarsest is None:
        raise LayerError(f"layer {node.name!r}: found no paint where it is selected, expected some to copy")
    return part


def pasted(painting: Painting, node: Layer | None, to: str) -> Painting:
    """Returns the painting with what was copied or set aside seen on a layer above the active one."""
    if node is None:
        raise Refusal(f"layer {to!r}: nothing was copied or cut in this painting, expected something to paste")
    number = layers.next_id(painting.root)
    made = replace(node, id=number, name=to, visible=True, role="", pyramid=node.pyramid.branched())
    made = replace(made, heaps=own_lines(node.heaps))
    return with_node(painting, made)


def _without_copied(root: Group) -> Group:
    for node in root.children:
        if isinstance(node, Layer) and node.role == COPIED:
            root = layers.remove(root, node.name)
    return root
