"""What is selected of a layer, moved: laid into the layer again, or shown above it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from engine.canvas import layers
from engine.canvas.flatten import flattened
from engine.canvas.heaps.heaps import NO_HEAPS, Heaps
from engine.canvas.heaps.joined_heaps import heaps_joined, heaps_moved, selected_of
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.merging.laid import laid_over
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.bake import baked
from engine.canvas.placing.baking import paint_of, shown_over
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import UNMOVED, Pose
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.painting.layer_commands import CUT, SetLayer
from engine.painting.value import Painting
from engine.session.copied_part import selected_paint
from engine.session.merging import cleared
from engine.session.moving import shown_from_beside


@dataclass(frozen=True, eq=False, slots=True)
class LiftedPart:
    """`layer`: as it is left; `part`: what of it was selected, and `heaps` on it; `selection`: which that was."""

    layer: Layer
    part: Pyramid
    selection: Selection
    heaps: Heaps = NO_HEAPS


def lifted_part(painting: Painting, node: Node, way: str) -> LiftedPart:
    """Returns what is selected of a layer taken out of it, or "copy": of it as it stays.  LayerError if it cannot be,
    or there is none."""
    if not isinstance(node, Layer):
        raise LayerError(f"layer {node.name!r}: found no layer of paint, expected one to move a part of")
    if layers.is_locked(painting.root, node.name):
        raise LayerError(f"layer {node.name!r}: found it locked, expected one that is not")
    if node.wrap is not None:
        raise LayerError(f"layer {node.name!r}: found it wrapped around, expected wrap-around off before it is moved")
    if painting.selection is None:
        raise LayerError(f"layer {node.name!r}: found nothing selected, expected a part of it to move")
    part = selected_paint(painting, node)
    left = layers.find((cleared(painting, node.name) if way == CUT else painting).root, node.name)
    assert isinstance(left, Layer)
    left = flattened(left) if left.growth else left
    return LiftedPart(left, part.branched(), painting.selection, selected_of(node, painting.selection))


def part_moved(painting: Painting, node: Node, command: SetLayer) -> Painting:
    """Returns the painting with what is selected of a layer elsewhere, and selected there.

    By quarter turns and powers of two it is laid into the layer, its very pixels; else as pixels of the level that the
    command tells.  Where it tells none it becomes a layer above it, hidden, and a placement shows that.
    """
    assert command.placing is not None
    assert command.selected is not None
    lifted, pose = lifted_part(painting, node, command.selected), command.placing.posed(UNMOVED)
    chosen = selection_at(lifted.selection, pose, painting.frame, painting.grid)
    if pose.similarity.quarter is None and command.baked is None:
        return replace(_with_part_above(painting, lifted, pose), selection=chosen)
    paint = _laid(painting, lifted, pose, command.baked)
    heaps = _heaped(node, lifted, pose)
    root = layers.substitute(painting.root, node.name, replace(lifted.layer, pyramid=paint, heaps=heaps))
    return replace(painting, root=root, selection=chosen)


def _heaped(node: Node, lifted: LiftedPart, pose: Pose) -> Heaps:
    """Returns what is heaped on the layer then; what cannot go along stays where it was, so that it is not lost."""
    assert isinstance(node, Layer)
    if not lifted.heaps or pose.similarity.quarter is None:
        return node.heaps
    return heaps_joined([(lifted.layer.heaps, 1.0), (heaps_moved(lifted.heaps, pose.similarity), 1.0)])


def _laid(painting: Painting, lifted: LiftedPart, pose: Pose, level: int | None) -> Pyramid:
    """Returns the paint of a layer with what was taken out of it in its new place; `level`: of the pixels that it
    becomes where it is sampled."""
    rest = lifted.layer.pyramid
    if pose.similarity.quarter is not None:
        return laid_over(rest, baked(lifted.part, pose.similarity))
    assert level is not None
    root, shown = _shown_alone(lifted.part, pose)
    return shown_over(rest, root, shown, painting.frame, level)


def _shown_alone(paint: Pyramid, pose: Pose) -> tuple[Group, Placement]:
    """Returns a tree in which a placement shows some paint by a pose, and the placement."""
    shown = Placement(2, "shown", of=1, pose=pose)
    return Group(0, "root", children=(Layer(1, "held", pyramid=paint), shown)), shown


def _with_part_above(painting: Painting, lifted: LiftedPart, pose: Pose) -> Painting:
    """Returns the painting with what was taken out of a layer on one above it, which a placement shows."""
    root, name = painting.root, layers.free_name(painting.root, f"{lifted.layer.name} part")
    made = replace(lifted.layer, id=layers.next_id(root), name=name, pyramid=lifted.part, heaps=lifted.heaps)
    group, position = _place_above(root, lifted.layer)
    root = layers.insert(layers.substitute(root, lifted.layer.name, lifted.layer), made, group, position)
    return replace(painting, root=shown_from_beside(root, made, pose), active=name)


def _place_above(root: Group, layer: Layer) -> tuple[str | None, int]:
    """Returns the group and the position right above a layer, and above what is clipped to it: that stays so."""
    group, position = layers.place(root, layer.name)
    holder = root if group is None else layers.find(root, group)
    assert isinstance(holder, Group)
    position += 1
    while not layer.clip and position < len(holder.children) and holder.children[position].clip:
        position += 1
    return group, position


def part_tried(painting: Painting, lifted: LiftedPart, pose: Pose) -> Painting:
    """Returns how a painting looks with what was taken out of a layer elsewhere, made at once: no paint is touched."""
    node, number = lifted.layer, layers.next_id(painting.root)
    names = [layers.free_name(painting.root, f"{node.name} {word}") for word in ("left", "taken", "seen")]
    left = Layer(number, names[0], pyramid=node.pyramid)
    taken = Layer(number + 1, names[1], visible=False, pyramid=lifted.part)
    seen = Placement(number + 2, names[2], of=taken.id, pose=pose)
    shown = Group(
        node.id, node.name, node.opacity, node.visible, node.blend, node.locked,
        children=(left, taken, seen), clip=node.clip, mask=node.mask,
    )  # fmt: skip
    return replace(painting, root=layers.substitute(painting.root, node.name, shown))


def selection_at(selection: Selection, pose: Pose, frame: Rect, grid: int) -> Selection:
    """Returns a selection as a pose shows it."""
    if pose.similarity.quarter is not None:
        return replace(selection, pyramid=baked(selection.pyramid, pose.similarity))
    root, shown = _shown_alone(selection.pyramid, pose)
    return replace(selection, pyramid=paint_of(root, shown, frame, grid))
