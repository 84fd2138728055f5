"""Something on the canvas while it is dragged: seen elsewhere, and nothing is changed until it is let go."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from engine.canvas.node_checks import LayerError
from engine.checks.owned import Owned
from engine.session.moving import tried
from engine.studio.easel import Easel
from engine.studio.moving.move_requests import AskExtent, Extent, Try
from engine.studio.moving.reaching import Reach, reach_of


class Moves(Owned):
    """What is dragged is shown as another state of the painting; how far it reaches is found while nothing more urgent
    waits.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._asked: tuple[str, Reach] | None = None
        self.handlers: dict[type, Callable[[Any], None]] = {Try: self._try, AskExtent: self._ask}

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        return int(self._asked is not None)

    def step(self) -> None:
        """Looks at the next piece of what is asked for; tells it when that was the last."""
        assert self._asked is not None
        asked, self._asked = self._asked, None  # what fails is not tried again
        name, reach = asked
        try:
            next(reach)
        except StopIteration as told:
            self._easel.send(Extent(name, None if told.value.rect.empty else told.value))
        except LayerError:  # it is gone meanwhile
            self._easel.send(Extent(name, None))
        else:
            self._asked = asked

    def _ask(self, request: AskExtent) -> None:
        session = self._easel.session
        try:
            self._asked = request.name, reach_of(session.painting, request.name, request.level, session.cache)
        except LayerError:
            self._asked = None
            self._easel.send(Extent(request.name, None))

    def _try(self, request: Try) -> None:
        painting, placing = self._easel.session.painting, request.placing
        try:
            seen = None if placing is None else tried(painting, request.name, placing, request.copy)
        except LayerError:  # it is gone meanwhile
            seen = None
        if self._easel.live is None:
            self._easel.viewer.look_back(seen)
