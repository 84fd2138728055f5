"""The tree of layers: frozen records and the functions that make a changed tree from one.

A painting's layers hang under one root `Group`, which is never shown by name.  `children[0]` is the bottom-most.  Names
are unique in the whole tree, because commands refer to layers by name.  Every function returns a new root that shares
all untouched parts with the old one; errors are `LayerError`, one line with what was found and what was expected.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from engine.canvas.heaps.heaps import NO_HEAPS, Heaps, own_lines
from engine.canvas.node_checks import (
    LayerError,
    allowed,
    check_common,
    check_flags,
    check_name,
    check_role,
    find_wrong,
    insist,
    nesting,
)
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import SourcePart
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid
from engine.checks.roles import ASIDE, MAX_NAME

if TYPE_CHECKING:
    from engine.canvas.growth import Growth

MAX_DEPTH = 32  # groups inside one another, the root not counted


@dataclass(frozen=True, slots=True)
class Layer:
    """One sheet of paint.

    `id`: a number that stays when the layer is renamed, unique in its painting, used in files.  `opacity`: 0..1.
    `blend`: a row of `BLENDS`.  `clip`: shown only where the nearest one below that is not clipped has paint.
    `locked`: cannot be painted on.  `alpha_locked`: paint keeps its transparency.
    `pyramid`: the paint; `growth`: what was painted with examples, over it.  `role`: "" for a part of the picture, or
    one of the ROLES; `scale`, `sea`: of the heights that it is, None for the usual ones.  `wrap`: the cell of which
    the layer shows repeats without end, and on which strokes are laid as on a torus; None: it is shown as it is.
    `heaps`: heights that brushes laid beside the paint.
    """

    id: int
    name: str
    opacity: float = 1.0
    visible: bool = True
    blend: str = "src-over"
    locked: bool = False
    alpha_locked: bool = False
    pyramid: Pyramid = field(default_factory=Pyramid)
    growth: Growth = ()
    role: str = ""
    clip: bool = False
    wrap: SourcePart | None = None
    mask: Selection | None = None
    scale: float | None = None
    sea: float | None = None
    heaps: Heaps = NO_HEAPS

    def __post_init__(self) -> None:
        check_common(self)
        check_flags(self, ("visible", "locked", "alpha_locked", "clip"))
        check_role(self, self.role)


@dataclass(frozen=True, slots=True)
class Group:
    """Layers and groups composited as one.  `isolated`: see `passes_through`.  `locked` locks all that is inside.

    `paper`: of a root alone, the colour "#rrggbb" of the ground under all layers; None: there is none."""

    id: int
    name: str
    opacity: float = 1.0
    visible: bool = True
    blend: str = "src-over"
    locked: bool = False
    isolated: bool = True
    children: tuple[Node, ...] = ()
    paper: str | None = None
    clip: bool = False
    mask: Selection | None = None

    def __post_init__(self) -> None:
        check_common(self)
        check_flags(self, ("visible", "locked", "isolated", "clip"))


@dataclass(frozen=True, slots=True)
class Alone(Group):
    """A root that shows but one node of a `tree`, in which lies what its placements show."""

    tree: Group | None = None


Node = Layer | Group | Placement
Trail = tuple[int, ...]  # positions from the root down to a node
EMPTY = Group(0, "root")
_SETTABLE = {
    Layer: ("opacity", "visible", "blend", "locked", "clip", "mask", "alpha_locked", "role", "wrap", "scale", "sea"),
    Group: ("opacity", "visible", "blend", "locked", "clip", "mask", "isolated"),
    Placement: ("opacity", "visible", "blend", "locked", "clip", "mask", "of", "pose", "part", "repeat", "role"),
}


def passes_through(group: Group) -> bool:
    """Tells whether the group's layers are composited directly onto what lies below the group.

    OpenRaster's `isolation="auto"`: a group is isolated as soon as its opacity or operator need it as one picture.
    """
    return (
        not group.isolated
        and group.opacity == 1
        and group.blend == "src-over"
        and (group.mask is None or group.mask.off)
    )


def isolation(group: Group) -> str:
    """Returns the attribute `isolation` to write for the group: 'isolate' or 'auto'.

    MyPaint 2 reads 'auto' by the rule of `passes_through`.  Krita 5 makes every group but `isolation="isolate"` a
    pass-through one, whatever its opacity and operator, so 'auto' may be written only where the group passes through.
    """
    return "auto" if passes_through(group) else "isolate"


def walk(root: Group) -> Iterator[Node]:
    """Yields every layer and group but the root, bottom first, a group before what it holds."""
    stack = [iter(root.children)]
    while stack:
        for node in stack[-1]:
            yield node
            if isinstance(node, Group):
                stack.append(iter(node.children))
                break
        else:
            stack.pop()


def layers(root: Group) -> Iterator[Layer]:
    """Yields every layer, bottom first."""
    return (node for node in walk(root) if isinstance(node, Layer))


def _locate(root: Group, name: str) -> tuple[Trail, Node]:
    todo: list[tuple[Trail, Group]] = [((), root)]
    while todo:
        trail, group = todo.pop()
        for i, child in enumerate(group.children):
            if child.name == name:
                return (*trail, i), child
            if isinstance(child, Group):
                todo.append(((*trail, i), child))
    known = [repr(node.name) for node in walk(root)]
    listed = ", ".join(known[:12]) + (", ..." if len(known) > 12 else "")
    raise LayerError(
        f"layer: found {name!r}, expected " + (f"one of {listed}" if known else "no name: there are no layers")
    )


def _at(root: Group, trail: Trail) -> Group:
    """Returns the group at a trail that is known to lead to one."""
    node: Node = root
    for i in trail:
        assert isinstance(node, Group)
        node = node.children[i]
    assert isinstance(node, Group)
    return node


def find(root: Group, name: str) -> Node:
    """Returns the layer or group of that name."""
    return _locate(root, name)[1]


def has(root: Group, name: str) -> bool:
    """Tells whether a layer or group of that name is in the tree."""
    return any(node.name == name for node in walk(root))


def place(root: Group, name: str) -> tuple[str | None, int]:
    """(name of the group that holds it, None for the root; its position there, 0 = bottom)."""
    trail, _ = _locate(root, name)
    return (_at(root, trail[:-1]).name if len(trail) > 1 else None), trail[-1]


def ancestors(root: Group, name: str) -> tuple[Group, ...]:
    """Returns the groups around a node, outermost first, without the root."""
    trail, _ = _locate(root, name)
    return tuple(_at(root, trail[:depth]) for depth in range(1, len(trail)))


def is_locked(root: Group, name: str) -> bool:
    """Tells whether the node or a group around it is locked."""
    return find(root, name).locked or any(group.locked for group in ancestors(root, name))


def next_id(root: Group) -> int:
    """Gives a number that no layer or group of the tree has."""
    return 1 + max((node.id for node in walk(root)), default=0)


def unique_name(root: Group, stem: str = "Layer") -> str:
    """'Layer 1', 'Layer 2', ...: the first that is free."""
    taken = {node.name for node in walk(root)}
    stem = stem[: MAX_NAME - 12].strip()
    return next(name for i in range(1, len(taken) + 2) if (name := f"{stem} {i}") not in taken)


def free_name(root: Group, wanted: str) -> str:
    """Returns the allowed and free name nearest to `wanted`, which may be any text: for what comes from other
    programs."""
    name = "".join(filter(allowed, wanted[: 4 * MAX_NAME])).strip()[:MAX_NAME].strip()
    return name if name and not has(root, name) else unique_name(root, name or "Layer")


def alone(node: Node, root: Group) -> Group:
    """Returns a root that shows just this node of a tree, as if it were visible, opaque and normal: thumbnails,
    exports."""
    shown = replace(node, visible=True, opacity=1.0, blend="src-over", clip=False)
    return Alone(EMPTY.id, EMPTY.name, children=(shown,), tree=root)


def together(nodes: Iterable[Node], root: Group) -> Group:
    """Returns a root that shows just these nodes of a tree, bottom first."""
    return Alone(EMPTY.id, EMPTY.name, children=tuple(nodes), tree=root)


def stacks(nodes: Sequence[Node]) -> list[tuple[Node, list[Node]]]:
    """Returns the nodes of a group that lie on nothing, bottom first, each with those that are clipped to it."""
    out: list[tuple[Node, list[Node]]] = []
    for node in nodes:
        if node.clip and out:
            out[-1][1].append(node)
        else:
            out.append((node, []))
    return out


Siblings = tuple[Node, ...]


def _edited(group: Group, trail: Trail, edit: Callable[[Siblings], Siblings]) -> Group:
    """Returns the tree with the children of the group at `trail` replaced by `edit` of them."""
    if not trail:
        return replace(group, children=edit(group.children))
    i = trail[0]
    child = group.children[i]
    assert isinstance(child, Group)
    return replace(group, children=(*group.children[:i], _edited(child, trail[1:], edit), *group.children[i + 1 :]))


def _group_trail(root: Group, group: str | None) -> Trail:
    if group is None:
        return ()
    trail, node = _locate(root, group)
    if not isinstance(node, Group):
        raise LayerError(f"group: found {group!r}, which is a layer, expected a group")
    return trail


def _put(root: Group, node: Node, group: str | None, to: int | None) -> Group:
    trail = _group_trail(root, group)
    count = len(_at(root, trail).children)
    to = count if to is None else to
    right = isinstance(to, int) and not isinstance(to, bool) and 0 <= to <= count
    insist(node.name, "position", to, right, f"an integer from 0 (bottom) to {count}")
    return checked(_edited(root, trail, lambda siblings: (*siblings[:to], node, *siblings[to:])))


def insert(root: Group, node: Node, group: str | None = None, to: int | None = None) -> Group:
    """With `node` added to a group (None: the root) at position `to` among its children (0 = bottom; None: on top)."""
    return _put(root, node, group, to)


def remove(root: Group, name: str) -> Group:
    """Without the node and all that it holds."""
    trail, _ = _locate(root, name)
    return _edited(root, trail[:-1], lambda siblings: (*siblings[: trail[-1]], *siblings[trail[-1] + 1 :]))


def substitute(root: Group, name: str, node: Node) -> Group:
    """With `node` in the place of the node of that name."""
    trail, _ = _locate(root, name)
    i = trail[-1]
    return checked(_edited(root, trail[:-1], lambda siblings: (*siblings[:i], node, *siblings[i + 1 :])))


def set_fields(root: Group, name: str, /, **fields: Any) -> Group:
    """With properties changed: opacity, visible, blend, locked; alpha_locked of a layer, isolated of a group."""
    node = find(root, name)
    settable = _SETTABLE[type(node)]
    for key in fields:
        insist(name, "property", key, key in settable, "one of " + ", ".join(settable))
    return substitute(root, name, replace(node, **fields))


def rename(root: Group, name: str, to: str) -> Group:
    """Returns the tree with a layer or group renamed.  LayerError if there is none of that name."""
    return substitute(root, name, replace(find(root, name), name=to))


def with_pyramid(root: Group, name: str, pyramid: Pyramid) -> Group:
    """With a layer's paint replaced: what a stroke does."""
    return _repainted(root, name, pyramid=pyramid)


def with_growth(root: Group, name: str, growth: Growth) -> Group:
    """With what was painted on a layer with examples replaced."""
    return _repainted(root, name, growth=growth)


def with_heaps(root: Group, name: str, heaps: Heaps) -> Group:
    """With what was heaped on a layer replaced."""
    return _repainted(root, name, heaps=heaps)


def _repainted(root: Group, name: str, **paint: Any) -> Group:
    """Only the path down to the layer is rebuilt."""
    trail, node = _locate(root, name)
    if not isinstance(node, Layer):
        raise LayerError(f"layer: found {name!r}, which is a group, expected a layer")
    i = trail[-1]
    painted = replace(node, **paint)
    return _edited(root, trail[:-1], lambda siblings: (*siblings[:i], painted, *siblings[i + 1 :]))


def pictured(root: Group) -> Group:
    """Returns the tree as the picture has it: references and heights hidden; the tree itself if it shows none."""
    shown = (node for node in walk(root) if not isinstance(node, Group) and node.visible)
    for name in [node.name for node in shown if not isinstance(node, Group) and node.role in ASIDE]:
        root = set_fields(root, name, visible=False)
    return root


def move(root: Group, name: str, group: str | None, to: int) -> Group:
    """With the node at position `to` (0 = bottom, counted without the node itself) of a group (None: the root)."""
    node = find(root, name)
    if group is not None and isinstance(node, Group) and (group == name or has(node, group)):
        raise LayerError(
            f"group {name!r}: found itself or a part of it ({group!r}) as the target, expected another group"
        )
    return _put(remove(root, name), node, group, to)


def duplicate(root: Group, name: str, to: str) -> Group:
    """With a copy named `to` right above the original; inside a copied group names become "NAME copy", ...

    The copies share all paint with the originals; placements that are copied with what they show, show the copy.
    """
    group, position = place(root, name)
    check_name(to)
    taken = {node.name for node in walk(root)} | {to}
    original = find(root, name)
    within = [original, *walk(original)] if isinstance(original, Group) else [original]
    ids = dict(zip((node.id for node in within), range(next_id(root), 1 << 62), strict=False))

    def free(stem: str) -> str:
        names = (f"{stem[: MAX_NAME - 12]} copy" + (f" {i}" if i > 1 else "") for i in range(1, len(taken) + 2))
        found = next(name for name in names if name not in taken)
        taken.add(found)
        return found

    def copy(node: Node, called: str) -> Node:
        number = ids[node.id]
        if isinstance(node, Layer):
            # Its own line of history from here on, so that caches keep both.
            own = replace(node, pyramid=node.pyramid.branched(), heaps=own_lines(node.heaps))
            return replace(own, id=number, name=called, mask=_branched(node.mask))
        if isinstance(node, Placement):
            of = None if node.of is None else ids.get(node.of, node.of)
            return replace(node, id=number, name=called, of=of, mask=_branched(node.mask))
        inside = tuple(copy(child, free(child.name)) for child in node.children)
        return replace(node, id=number, name=called, children=inside, mask=_branched(node.mask))

    return insert(root, copy(original, to), group, position + 1)


def _branched(mask: Selection | None) -> Selection | None:
    return None if mask is None else replace(mask, pyramid=mask.pyramid.branched())


def checked(root: Group) -> Group:
    """Returns the root itself, if names and ids are unique and groups not nested too deeply; else LayerError."""
    nodes = list(walk(root))
    names, ids = {node.name for node in nodes}, {node.id for node in nodes}
    if len(names) < len(nodes) or len(ids) < len(nodes) or min(ids, default=1) < 1 or nesting(root) > MAX_DEPTH + 1:
        find_wrong(root, MAX_DEPTH)
    return root
