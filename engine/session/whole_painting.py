"""Another painting brought in as a group, exactly: its layers with their ink, masks, placements and what they grew."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import count, starmap
from typing import TypeGuard

from engine.archive.others import carried_painting
from engine.archive.others.carried_painting import brought_nodes
from engine.canvas import layers
from engine.canvas.flatten import flattened
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.placing import loops
from engine.canvas.placing.placement import Placement
from engine.canvas.store import Pyramid
from engine.checks.roles import AS_HEIGHT
from engine.painting.commands import AddPainting
from engine.painting.layering.painting_member import A_FILE, HOLDS, NamedNode
from engine.painting.layering.placing_members import Placing
from engine.painting.textures import Texture
from engine.painting.value import Painting, with_node
from engine.session.moving import elsewhere


def with_painting(painting: Painting, command: AddPainting) -> Painting:
    """Returns a painting with another one in it as a group, which is chosen.  LayerError if that cannot be."""
    texture = painting.textures.get(command.texture)
    if texture is None or texture.source is None or not texture.source.there:
        raise LayerError(f"layer {command.name!r}: found no texture {command.texture!r} that holds a painting's file")
    found = carried_painting.brought(texture.source).painting
    if found.grid != painting.grid:
        raise LayerError(f"layer {command.name!r}: found values on 2^-{found.grid}, expected 2^-{painting.grid}")
    same = found.arithmetic == painting.arithmetic
    group = _renamed(painting, command, found.root, same)
    made = with_node(painting, group, command.group, command.to)
    made = replace(made, root=loops.checked(layers.checked(made.root)), active=group.name)
    if same:
        made = _with_textures(made, found)
    if (command.level, command.at) == (0, (0, 0)):
        return made
    return elsewhere(made, group, Placing(at=command.at, level=command.level, levels=-command.level))


def without_paint(painting: Painting, command: AddPainting) -> Painting:
    """Returns the same with empty layers in the place of all but groups.  LayerError if it cannot be."""
    numbers = count(layers.next_id(painting.root))

    def node(told: NamedNode) -> Node:
        number = next(numbers)
        if told.children is None:
            return Layer(number, told.name, pyramid=Pyramid(grid=painting.grid))
        return Group(number, told.name, children=tuple(map(node, told.children)))

    group = node(NamedNode(command.name, command.children))
    made = with_node(painting, group, command.group, command.to)
    return replace(made, root=layers.checked(made.root), active=group.name)


def _renamed(painting: Painting, command: AddPainting, root: Group, same: bool) -> Group:
    """Returns the painting's layers as a group, under the names and numbers that they have here; `same`: in the same
    arithmetic, in which alone what grew of examples may grow on."""
    told = NamedNode(command.name, command.children)
    pairs = list(_pairs(root, told))
    high = any(_is_height(node) for node in layers.walk(painting.root))
    ids = dict(zip((node.id for node, _ in pairs), count(layers.next_id(painting.root)), strict=False))

    def copy(node: Node, told: NamedNode) -> Node:
        number = ids[node.id]
        if high and _is_height(node):  # there is one already, and one at most
            node = replace(node, role="", visible=False)
        if isinstance(node, Placement):
            of = root.id if node.of is None else node.of
            if of not in ids:
                raise LayerError(f"layer {told.name!r}: found a placement of what is not there")
            return replace(node, id=number, name=told.name, of=ids[of])
        if isinstance(node, Group):
            inside = zip(brought_nodes(node), told.children or (), strict=True)
            return replace(node, id=number, name=told.name, children=tuple(starmap(copy, inside)))
        paint = node if same or not node.growth else replace(flattened(node), growth=())
        return replace(paint, id=number, name=told.name)

    group = copy(root, told)
    assert isinstance(group, Group)
    return replace(group, paper=None)


def _is_height(node: Node) -> TypeGuard[Layer | Placement]:
    return not isinstance(node, Group) and node.role == AS_HEIGHT


def _pairs(node: Node, told: NamedNode) -> Iterator[tuple[Node, NamedNode]]:
    """Yields every node with what is told of it, a group before what it holds; LayerError if they do not fit."""
    yield node, told
    inside = brought_nodes(node) if isinstance(node, Group) else None
    if (inside is None) != (told.children is None) or len(inside or ()) != len(told.children or ()):
        raise LayerError(f"layer {told.name!r}: found other layers told than its painting has")
    for child, one in zip(inside or (), told.children or (), strict=True):
        yield from _pairs(child, one)


def _with_textures(painting: Painting, found: Painting) -> Painting:
    """Returns it with the textures of another, those whose names mean something else here under free ones."""
    here = painting.textures
    for name, texture in sorted(found.textures.items()):
        if texture.parameters.get(HOLDS) != A_FILE and not any(_is(texture, one) for one in here.values()):
            free = (name if i == 1 else f"{name} {i}" for i in range(1, len(here) + 2))
            here = here.set(next(one for one in free if one not in here), texture)
    return replace(painting, textures=here)


def _is(one: Texture, other: Texture) -> bool:
    pictures = all(
        (a.sha if a else None) == (b.sha if b else None)
        for a, b in (
            (one.source, other.source),
            (one.mask, other.mask),
            (one.maps, other.maps),
            (one.control, other.control),
        )
    )
    return pictures and (one.kind, one.parameters) == (other.kind, other.parameters)
