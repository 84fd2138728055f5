"""Something on the canvas while it is dragged: seen elsewhere, and nothing is changed until it is let go."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from engine.canvas.node_checks import LayerError
from engine.checks.owned import Owned
from engine.session.moving import tried
from engine.studio.easel import Easel
from engine.studio.moving.move_requests import Try


class Moves(Owned):
    """What is dragged is shown as another state of the painting.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self.handlers: dict[type, Callable[[Any], None]] = {Try: self._try}

    def _try(self, request: Try) -> None:
        painting = self._easel.session.painting
        try:
            seen = None if request.placing is None else tried(painting, request.name, request.placing)
        except LayerError:  # it is gone meanwhile
            seen = None
        if self._easel.live is None:
            self._easel.viewer.look_back(seen)
