"""The frame made as large as what is painted."""

from __future__ import annotations

from engine.canvas.placing.pose import SourcePart
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.layering.frame_command import LONGEST_SIDE
from engine.painting.value import Painting
from engine.studio.easel import Easel
from engine.studio.moving.move_requests import AskPainted, FitFrame, PaintedTold
from engine.studio.moving.reaching import Reach, picture_reach
from engine.studio.requests import Handlers
from engine.studio.results import Note


class FrameFitter(Owned):
    """Finds how far the picture reaches, piece by piece, and gives the painting a frame around that, or tells it.  It
    belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._of: Painting | None = None
        self._reach: Reach | None = None
        self._fits = False  # or it is told alone
        self.handlers: Handlers = {FitFrame: self._ask, AskPainted: self._ask}

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        return 0 if self._reach is None else 1

    def step(self) -> None:
        """Looks at the next piece; sets the frame, or tells, when that was the last.  Where something was painted
        meanwhile, it looks anew."""
        reach, self._reach = self._reach, None  # what fails is not tried again
        assert reach is not None
        if self._of is not self._easel.session.painting:
            self._ask(FitFrame() if self._fits else AskPainted())
            return
        try:
            next(reach)
            self._reach = reach
        except StopIteration as told:
            rect = _level_0(told.value)
            if self._fits:
                self._fit(rect)
            else:
                self._easel.send(PaintedTold(rect))

    def _ask(self, request: FitFrame | AskPainted) -> None:
        session = self._easel.session
        self._fits = isinstance(request, FitFrame)
        self._of, self._reach = session.painting, picture_reach(session.painting, session.cache)

    def _fit(self, rect: Rect) -> None:
        if rect.empty:
            self._easel.send(Note("There is no paint to fit the frame to", bad=True))
        elif max(rect.width, rect.height) > LONGEST_SIDE:
            self._easel.send(Note("The paint reaches too far for a frame", bad=True))
        elif rect == self._easel.session.painting.frame:
            self._easel.send(Note("The frame fits the paint already"))
        else:
            self._easel.carry_out(c.SetFrame(rect))


def _level_0(part: SourcePart) -> Rect:
    """Returns the pixels of level 0 that a part meets."""
    return part.rect if part.rect.empty else part.rect.zoomed(-part.level)
