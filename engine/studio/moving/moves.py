"""Something on the canvas while it is dragged: seen elsewhere, and nothing is changed until it is let go."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from engine.canvas import layers
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.baking import bake_levels, leaves_heaps
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import UNMOVED
from engine.checks.owned import Owned
from engine.painting.grown import settled_root
from engine.painting.layer_commands import CUT, BakePlacement
from engine.painting.layering.placing_members import Placing
from engine.painting.value import Painting
from engine.session.lifting.moved_part import LiftedPart, lifted_part, part_tried
from engine.session.moving import tried
from engine.studio.easel import Easel
from engine.studio.moving.deviations import Deviation, Deviations
from engine.studio.moving.move_requests import AskBake, AskExtent, BakeTold, Extent, Try
from engine.studio.moving.reaching import Reach, reach_of
from engine.studio.results import Note


class Moves(Owned):
    """What is dragged is shown as another state of the painting; how far it reaches is found while nothing more urgent
    waits.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._asked: tuple[Painting, str, int | None, Reach] | None = None  # `Extent.finest` of what is selected
        self._deviations = Deviations()
        self._lifted: tuple[Painting, str, str, LiftedPart] | None = None  # the last one, and of what
        self.handlers: dict[type, Callable[[Any], None]] = {
            Try: self._try,
            AskExtent: self._ask,
            AskBake: self._ask_bake,
        }

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        return int(self._asked is not None)

    def step(self) -> None:
        """Looks at the next piece of what is asked for; tells it when that was the last."""
        assert self._asked is not None
        asked, self._asked = self._asked, None  # what fails is not tried again
        painting, name, finest, reach = asked
        selected = finest is not None
        try:
            next(reach)
        except StopIteration as told:
            self._deviations.reached(painting, name, selected, told.value)
            self._easel.send(Extent(name, None if told.value.rect.empty else told.value, selected, finest))
        except LayerError:  # it is gone meanwhile
            self._easel.send(Extent(name, None, selected))
        else:
            self._asked = asked

    def _ask(self, request: AskExtent) -> None:
        session = self._easel.session
        painting = alone = session.painting
        name, finest = request.name, None
        try:
            if request.selected:
                lifted = self._part(painting, name, CUT)
                part = replace(lifted.layer, pyramid=lifted.part, mask=None)
                finest = lifted.part.finest or 0
                alone = replace(painting, root=layers.substitute(painting.root, name, part))
            self._asked = painting, name, finest, reach_of(alone, name, request.level, session.cache)
        except LayerError:
            self._asked = None
            self._easel.send(Extent(name, None, request.selected))

    def _ask_bake(self, request: AskBake) -> None:
        painting = self._easel.session.painting
        try:
            node = layers.find(painting.root, request.name)
            if not isinstance(node, Placement):
                return
            found = bake_levels(settled_root(painting.root), node, painting.frame)
            flat = leaves_heaps(painting.root, replace(node, mask=None))
        except LayerError as error:
            self._easel.send(Note(str(error), bad=True))
            return
        level = None if found is None else found.level
        loses = found is not None and found.loses
        self._easel.send(BakeTold(BakePlacement(request.name, level), loses, flat))

    def _part(self, painting: Painting, name: str, way: str) -> LiftedPart:
        """Returns what is selected of a layer, taken out of it: it is asked for again with each move of the hand."""
        if self._lifted is None or self._lifted[0] is not painting or self._lifted[1:3] != (name, way):
            self._lifted = painting, name, way, lifted_part(painting, layers.find(painting.root, name), way)
        return self._lifted[3]

    def _try(self, request: Try) -> None:
        painting, viewer = self._easel.session.painting, self._easel.viewer
        try:
            new = None if request.placing is None else self._tried(painting, request, request.placing)
        except LayerError:  # it is gone meanwhile
            new = None
        if self._easel.live is None:
            where = self._deviations.change(viewer.looking, painting, new)
            viewer.look_back(None if new is None else new.seen, where)

    def _tried(self, painting: Painting, request: Try, placing: Placing) -> Deviation:
        if request.selected is None:
            part, seen = None, tried(painting, request.name, placing, request.copy)
        else:
            part = self._part(painting, request.name, request.selected)
            seen = part_tried(painting, part, placing.posed(UNMOVED))
        return self._deviations.of(painting, request, placing, seen, part)
