"""Where what is moved is seen, before and after: nothing else is made anew while it is dragged."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose, SourcePart
from engine.canvas.placing.rounds import by_ids
from engine.canvas.placing.through import Seen, seen_first
from engine.canvas.placing.views import mapped
from engine.numeric.address import Rect
from engine.numeric.blend import BLENDS
from engine.painting.difference import Areas
from engine.studio.moving.reaching import stored

_SPREAD = 2  # pixels of a level into which what lies beside them spreads below it, at most
_NOWHERE = Rect(0, 0, 0, 0)
Bounds = Callable[[int], Rect]  # of a level: outside it there is no paint


def nowhere(level: int) -> list[Rect] | None:
    """Tells that nothing is another."""
    return []


def anywhere(level: int) -> list[Rect] | None:
    """Tells that anything may be another."""
    return None


def both(one: Areas, other: Areas) -> Areas:
    """Returns the areas that two tell."""

    @cache  # it is asked for every tile on the screen
    def where(level: int) -> list[Rect] | None:
        first, second = one(level), other(level)
        return None if first is None or second is None else first + second

    return where


@dataclass(frozen=True, slots=True)
class Paint:
    """How far paint reaches: `reach`, to a pixel of its level, and finer paint by its records, each with their level.
    It holds none of the paint."""

    reach: SourcePart
    finer: tuple[SourcePart, ...]

    def bounds(self, level: int) -> Rect:
        """Returns a rectangle of a level outside which there is no paint."""
        whole = _carried(self.reach, level)
        for part in self.finer:
            if part.level <= level:
                whole = whole.union(_carried(part, level))
        return whole


def paint_of(root: Group, node: Node, reach: SourcePart) -> Paint | None:
    """Returns what is known of a node's paint, a placement's source, that reaches so far; None where it changes more
    than the places where it lies: it is shown elsewhere, repeated, shows something itself, or clears what is beside
    it."""
    around = {None, root.id, node.id, *(group.id for group in layers.ancestors(root, node.name))}
    placements = [one for one in layers.walk(root) if isinstance(one, Placement) and one is not node]
    if any(one.of in around for one in placements) or BLENDS[node.blend].outside:
        return None
    source = node
    if isinstance(node, Placement):
        if node.of is None or node.repeat or node.of in around:
            return None
        source = by_ids(root)[node.of]
    within = list(layers.walk(source)) if isinstance(source, Group) else [source]
    if any(isinstance(one, Placement) or BLENDS[one.blend].outside for one in within):
        return None
    paint = [one for one in within if isinstance(one, Layer)]
    return None if any(one.wrap is not None for one in paint) else Paint(reach, tuple(_finer(paint, reach.level)))


def _finer(paint: list[Layer], from_: int) -> Iterator[SourcePart]:
    """Yields where there may be paint that is seen at levels finer than one alone."""
    for layer in paint:
        for level in layer.pyramid.levels:
            if level > from_:
                yield SourcePart(level, stored(layer, level))
        if layer.pyramid.ground is not None:
            yield SourcePart(from_, layer.pyramid.ground.rect.zoomed(from_))
        if layer.growth:
            yield SourcePart(from_, growths.bounds(layer.growth, from_))


def place_of(paint: Paint, node: Node, pose: Pose) -> Areas:
    """Returns where a node is seen in a pose."""
    shown = replace(node, pose=pose) if isinstance(node, Placement) else Placement(1, "seen", of=1, pose=pose)
    seen = seen_first(shown)

    @cache
    def where(level: int) -> list[Rect] | None:
        found = _seen_in(paint, seen, level)
        return [] if found.empty else [found]

    return where


def _seen_in(paint: Paint, seen: Seen, level: int) -> Rect:
    at = level + seen.levels + (seen.finer(level) or 0)
    whole = paint.bounds(at)
    return _NOWHERE if whole.empty else mapped(whole, at, seen, level)


def _carried(part: SourcePart, level: int) -> Rect:
    """Returns what a part can show at a level."""
    by = level - part.level
    if part.rect.empty:
        return _NOWHERE
    return part.rect.grown(_SPREAD).zoomed(by) if by > 0 else part.rect.zoomed(by)
