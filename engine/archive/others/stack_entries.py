"""The tree of layers as other programs are told it; what is clipped is told so that they show it right.

No program reads from stack.xml what a layer is clipped to, so its picture has the clip applied, and a base that is not
opaque, usual and visible is told as a group with what is clipped to it.  Where the paint of the base is opaque, that is
the very picture; along its soft edges it is near to it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node, isolation, stacks
from engine.canvas.placing.placement import Placement
from engine.canvas.selecting.selection import Selection
from engine.files.stack_xml import SOURCE_OVER, LayerEntry, StackEntry
from engine.numeric import blend
from engine.numeric.address import Rect

# By the ids of layers and placements, what limits them and the groups around them, outermost first: bases, and masks.
Bases = Mapping[int, tuple[Node | Selection, ...]]


def png_name(node: Layer | Placement) -> str:
    """Returns the member that has a node's picture."""
    return f"data/L{node.id}.png"


def bases_of(root: Group) -> Bases:
    """Returns what limits the layers and placements of a tree; none of those that nothing does."""
    return dict(_within(root, ()))


def _within(group: Group, around: tuple[Node | Selection, ...]) -> Iterator[tuple[int, tuple[Node | Selection, ...]]]:
    for base, clipped in stacks(group.children):
        for node in (base, *clipped):
            bases = around if node is base else (*around, base)
            if isinstance(node, Group):
                yield from _within(node, bases if node.mask is None else (*bases, node.mask))
            elif bases or (isinstance(node, Layer) and node.mask is not None):
                yield node.id, bases


def pictured_alone(node: Layer | Placement, bases: Bases, root: Group) -> Group:
    """Returns a root that shows a node of a tree as its picture has it: alone, within what limits it."""
    alone = layers.alone(node, root)
    inner: tuple[Node, ...] = alone.children
    for one in reversed(bases.get(node.id, ())):
        if isinstance(one, Selection):
            inner = (Group(node.id, node.name, children=inner, mask=one),)
        else:
            inner = (*inner, replace(one, visible=True, opacity=1.0, blend="dst-in", clip=False))
    return replace(alone, children=inner)


@dataclass(frozen=True)
class Stack:
    """A tree as it is told: `places`, where the pictures lie, by id, in `frame`; `active`: the layer painted on."""

    root: Group
    places: Mapping[int, Rect]
    frame: Rect
    active: str | None

    def entry(self) -> StackEntry:
        """Returns the whole of it."""
        return self._group(self.root)

    def _group(self, group: Group) -> StackEntry:
        told = [entry for base, clipped in stacks(group.children) for entry in self._clipped(base, clipped)]
        return StackEntry(
            tuple(reversed(told)),
            group.name,
            group.opacity,
            group.visible,
            blend.BLENDS[group.blend].op,
            isolation(group) == "isolate",
            group.locked,
            {"id": str(group.id)},
        )

    def _clipped(self, base: Node, clipped: Sequence[Node]) -> list[StackEntry | LayerEntry]:
        """Returns a node and what is clipped to it, bottom first."""
        own, above = self._node(base), list(map(self._node, clipped))
        if not clipped or (own.visible and own.opacity == 1 and own.op == SOURCE_OVER):
            return [own, *above]
        inner = (replace(own, visible=True, opacity=1.0, op=SOURCE_OVER), *above)
        return [StackEntry(inner[::-1], own.name, own.opacity, own.visible, own.op, isolated=True)]

    def _node(self, node: Node) -> StackEntry | LayerEntry:
        if isinstance(node, Group):
            return self._group(node)
        place = self.places[node.id]
        return LayerEntry(
            png_name(node),
            node.name,
            place.x0 - self.frame.x0,
            place.y0 - self.frame.y0,
            node.opacity,
            node.visible and not node.role,
            blend.BLENDS[node.blend].op,
            node.locked,
            node.name == self.active,
            {"id": str(node.id)},
        )
