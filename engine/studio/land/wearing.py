"""Erosion worked out between other things, and then done in one step."""

from __future__ import annotations

from collections.abc import Generator

from engine.canvas.node_checks import LayerError
from engine.checks.owned import Owned
from engine.painting.layering.erode_command import Erode
from engine.session.landforms.erosion import foreseen
from engine.studio.easel import Easel
from engine.studio.land.wear_records import StopWearing, WearDown, WornTold
from engine.studio.requests import Handlers
from engine.studio.results import Note


class Wearer(Owned):
    """Heights being worn down.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._work: Generator[float, None, None] | None = None
        self._wanted: Erode | None = None
        self.handlers: Handlers = {WearDown: self._ask, StopWearing: self._stop}

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        return 0 if self._work is None or self._easel.live is not None else 1

    def step(self) -> None:
        """Works out the next piece; carries the command out when that was the last, for which it is all known."""
        work, self._work = self._work, None  # what fails is not tried again
        assert work is not None
        try:
            part = next(work)
        except StopIteration:
            assert self._wanted is not None
            self._easel.carry_out(self._wanted)
            self._easel.send(WornTold())
        except LayerError as error:
            self._easel.send(WornTold())
            self._easel.send(Note(str(error), bad=True))
        else:
            self._work = work
            self._easel.send(WornTold(part))

    def _ask(self, request: WearDown) -> None:
        session = self._easel.session
        self._wanted = request.command
        self._work = foreseen(session.painting, request.command, session.cache)
        self._easel.send(WornTold(0.0))

    def _stop(self, request: StopWearing) -> None:
        self._work = None
        self._easel.send(WornTold())
