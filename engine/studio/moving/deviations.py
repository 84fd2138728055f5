"""In what a painting as it is seen while something is dragged differs from how it is, and from how it was seen."""

from __future__ import annotations

from dataclasses import dataclass, replace

from engine.canvas import layers
from engine.canvas.layers import Node
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import UNMOVED, SourcePart
from engine.checks.owned import Owned
from engine.painting.difference import Areas, areas
from engine.painting.layering.placing_members import Placing
from engine.painting.value import Painting
from engine.session.lifting.moved_part import LiftedPart
from engine.studio.moving.move_requests import Try
from engine.studio.moving.moved_areas import Paint, anywhere, both, nowhere, paint_of, place_of


@dataclass(frozen=True, eq=False, slots=True)
class Deviation:
    """`seen`: in place of the painting `base`; it differs where the moved thing is now, `place`, and in its `own`
    place, where all that is moved in the same `way` differs alike."""

    seen: Painting
    base: Painting
    way: tuple[object, ...]
    own: Areas
    place: Areas


class Deviations(Owned):
    """The last one that was seen, and how far what is moved reaches.  It belongs to the engine's thread."""

    def __init__(self) -> None:
        self._last: Deviation | None = None
        self._reach: tuple[Painting, str, bool, SourcePart] | None = None
        self._paint: Paint | None = None
        self._known = False  # whether `_paint` was looked for since

    def reached(self, painting: Painting, name: str, selected: bool, part: SourcePart) -> None:
        """Takes over how far a node, or what is selected of it, reaches."""
        self._reach, self._known = (painting, name, selected, part), False

    def of(
        self, painting: Painting, request: Try, placing: Placing, seen: Painting, part: LiftedPart | None
    ) -> Deviation:
        """Returns how a painting in which something is tried differs; `part`: what is lifted of it."""
        node = layers.find(painting.root, request.name)
        paint = self._paint_of(painting, node, part)
        here = node.pose if isinstance(node, Placement) else UNMOVED
        pose = placing.posed(here)
        way = request.name, request.selected, request.copy
        if paint is None:
            return Deviation(seen, painting, way, anywhere, anywhere)
        own = place_of(paint, node, here) if part is None else _taken(painting, part)
        return Deviation(seen, painting, way, own, place_of(paint, node, pose))

    def _paint_of(self, painting: Painting, node: Node, part: LiftedPart | None) -> Paint | None:
        """Returns how far what is moved reaches; None where that is not known, or does not tell what is changed."""
        if self._reach is None or self._reach[1:3] != (node.name, part is not None):
            return None
        of, reach = self._reach[0], self._reach[3]
        if of.root is not painting.root or (part is not None and of.selection is not painting.selection):
            return None
        if not self._known:
            moved = node if part is None else replace(part.layer, pyramid=part.part)
            self._paint, self._known = paint_of(painting.root, moved, reach), True
        return self._paint

    def change(self, looking: Painting | None, base: Painting, new: Deviation | None) -> Areas:
        """Returns where a painting with a deviation, or none, is seen otherwise than what was looked at until now."""
        last, self._last = self._last, new
        now = nowhere if new is None else both(new.own, new.place)
        if looking is None:
            return now
        if last is None or looking is not last.seen or last.base is not base:
            return anywhere
        if new is not None and new.way == last.way:
            return both(last.place, new.place)
        return both(both(last.own, last.place), now)


def _taken(painting: Painting, part: LiftedPart) -> Areas:
    """Returns where a painting from which a part was lifted is another one."""
    left = layers.substitute(painting.root, part.layer.name, part.layer)
    return areas(painting, replace(painting, root=left))
