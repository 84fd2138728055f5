"""Layers, groups and placements made one layer, and layers made empty."""

from __future__ import annotations

from dataclasses import replace

from engine.canvas import layers
from engine.canvas.flatten import flattened
from engine.canvas.heaps.heaps import NO_HEAPS
from engine.canvas.heaps.joined_heaps import heaps_joined, joined_of
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.merging.cleared import framing, without
from engine.canvas.merging.merged import merged_paint
from engine.canvas.node_checks import LayerError
from engine.canvas.placing import loops
from engine.canvas.store import Pyramid
from engine.checks.roles import ASIDE
from engine.painting.grown import settled_root
from engine.painting.value import Painting

PLAIN_BLEND = "src-over"


def merged_down(painting: Painting, name: str) -> Painting:
    """Returns the painting with a node and the one below it as one layer, which keeps the name of the lower.

    Two of one blend mode mix on in that mode; otherwise the layer is a usual one, opaque.
    """
    root = painting.root
    group, position = layers.place(root, name)
    upper, siblings = layers.find(root, name), _children(root, group)
    if position == 0:
        raise LayerError(f"layer {name!r}: found nothing below it in its group, expected what to merge it onto")
    lower = siblings[position - 1]
    for node in (lower, upper):
        _check(root, node, lower if node is lower else None)
    if _aside(lower) != _aside(upper):
        name, found = (lower.name, _aside(lower)) if _aside(lower) else (upper.name, _aside(upper))
        raise LayerError(f"layer {name!r}: found it a {found}, expected part of the picture, as the other is")
    onto = upper.clip and not lower.clip  # what is clipped to the lower one: that stays as it is otherwise
    same = onto or lower.blend == upper.blend
    blend = lower.blend if same and not isinstance(lower, Group) else PLAIN_BLEND
    below = replace(lower, blend=PLAIN_BLEND, clip=False, opacity=1.0 if onto else lower.opacity)
    above = upper if onto else replace(upper, clip=False)
    paint = merged_paint(settled_root(root), (below, above), painting.grid)
    role = lower.role if not isinstance(lower, Group) else ""
    heaps = joined_of((lower, upper))
    made = replace(_made(lower, paint, blend), opacity=lower.opacity if onto else 1.0, role=role)
    made = replace(made, heaps=heaps_joined([(heaps, 1.0 / made.opacity if made.opacity else 1.0)]))
    if isinstance(lower, Layer):
        made = replace(made, scale=lower.scale, sea=lower.sea)
    root = layers.substitute(layers.remove(root, name), lower.name, made)
    return _with_active(painting, root, {upper.name, lower.name, *_inner(upper), *_inner(lower)}, made.name)


def flattened_group(painting: Painting, name: str) -> Painting:
    """Returns the painting with all that is seen of a group as a layer in its place."""
    root = painting.root
    group = layers.find(root, name)
    if not isinstance(group, Group):
        raise LayerError(f"layer {name!r}: found no group, expected one to flatten")
    _check(root, group, group)
    shown = layers.pictured(settled_root(root))
    settled = layers.find(shown, name)
    assert isinstance(settled, Group)
    paint = merged_paint(shown, settled.children, painting.grid)
    made = replace(_made(group, paint, group.blend), opacity=group.opacity, visible=group.visible, mask=group.mask)
    made = replace(made, heaps=joined_of(settled.children))
    return _with_active(painting, layers.substitute(root, name, made), _inner(group), name)


def flattened_whole(painting: Painting) -> Painting:
    """Returns the painting with all that is seen as one layer, in the place of the lowest; what is hidden stays, and so
    do references."""
    root = painting.root
    seen = tuple(node for node in layers.pictured(root).children if node.visible)
    if not seen:
        raise LayerError("layer: found no layer that is seen, expected one to merge")
    for node in seen:
        _check(root, node, None)
        _check_unshown(root, node, {inner.id for one in seen for inner in _with_inner(one)})
    settled = layers.pictured(settled_root(root))
    paint = merged_paint(settled, tuple(node for node in settled.children if node.visible), painting.grid)
    made = replace(_made(seen[0], paint, PLAIN_BLEND), opacity=1.0, heaps=joined_of(settled.children))
    gone = {inner.name for node in seen for inner in _with_inner(node)}
    merged = {node.id for node in seen} - {made.id}
    children = tuple(made if node.id == made.id else node for node in root.children if node.id not in merged)
    return _with_active(painting, layers.checked(replace(root, children=children)), gone, made.name)


def cleared(painting: Painting, name: str | None, outside: bool = False) -> Painting:
    """Returns the painting without what is selected of a layer, or all where nothing is; `outside`: without what lies
    outside the frame on it, or on any layer that is not locked (None)."""
    root = painting.root
    if name is None:
        free = [layer for layer in layers.layers(root) if not layers.is_locked(root, layer.name)]
        for layer in free:
            root = layers.substitute(root, layer.name, _emptied(painting, layer, outside))
        return replace(painting, root=root)
    node = layers.find(root, name)
    if not isinstance(node, Layer):
        raise LayerError(f"layer {name!r}: found no layer of paint, expected one to clear")
    if layers.is_locked(root, name):
        raise LayerError(f"layer {name!r}: found it locked, expected one that is not")
    return replace(painting, root=layers.substitute(root, name, _emptied(painting, node, outside)))


def _emptied(painting: Painting, layer: Layer, outside: bool) -> Layer:
    limit = framing(painting.frame) if outside else painting.selection
    if limit is None:
        bare = Pyramid(grid=painting.grid, commits=layer.pyramid.commits)
        return replace(layer, pyramid=bare, growth=(), heaps=NO_HEAPS)
    paint = flattened(layer).pyramid if layer.growth else layer.pyramid
    left, heaps = without(paint, limit), layer.heaps
    for unit, heap in layer.heaps.items():
        heaps = heaps.set(unit, without(heap, limit))
    if left is layer.pyramid and not heaps:
        return layer
    return replace(layer, pyramid=left, growth=(), heaps=heaps)


def _made(node: Node, paint: Pyramid, blend: str) -> Layer:
    alpha_locked = isinstance(node, Layer) and node.alpha_locked
    return Layer(node.id, node.name, blend=blend, alpha_locked=alpha_locked, pyramid=paint, clip=node.clip)


def _aside(node: Node) -> str:
    """Returns the role of what is no part of the picture."""
    return node.role if not isinstance(node, Group) and node.role in ASIDE else ""


def _children(root: Group, name: str | None) -> tuple[Node, ...]:
    holder = root if name is None else layers.find(root, name)
    assert isinstance(holder, Group)
    return holder.children


def _with_inner(node: Node) -> list[Node]:
    return [node, *(layers.walk(node) if isinstance(node, Group) else ())]


def _inner(node: Node) -> set[str]:
    return {inner.name for inner in _with_inner(node)[1:]}


def _check(root: Group, node: Node, stays: Node | None) -> None:
    """Raises LayerError unless a node may be merged; `stays`: one whose number goes on to what is made."""
    if layers.is_locked(root, node.name) or any(inner.locked for inner in _with_inner(node)):
        raise LayerError(f"layer {node.name!r}: found it locked, expected one that is not")
    if not node.visible:
        raise LayerError(f"layer {node.name!r}: found it hidden, expected one that is seen")
    for inner in _with_inner(node)[1:]:
        if isinstance(inner, Layer) and inner.heaps and _aside(inner):
            raise LayerError(f"layer {inner.name!r}: found it a {inner.role}, expected it outside of what is merged")
    if stays is None or stays is node:
        own = {inner.id for inner in _with_inner(node)}
        _check_unshown(root, node, own, None if stays is None else node.id)


def _check_unshown(root: Group, node: Node, within: set[int], but: int | None = None) -> None:
    """Raises LayerError if a placement outside shows a node, or one in it, that will be there no more."""
    gone = {inner.id for inner in _with_inner(node)} - {but}
    showing = [one.name for one in loops.placements(root) if one.of in gone and one.id not in within]
    if showing:
        names = ", ".join(map(repr, showing[:3])) + (", ..." if len(showing) > 3 else "")
        raise LayerError(f"layer {node.name!r}: found {names} showing it, expected no placement that does")


def _with_active(painting: Painting, root: Group, gone: set[str], made: str) -> Painting:
    active = made if painting.active in gone else painting.active
    return replace(painting, root=loops.checked(root), active=active)
