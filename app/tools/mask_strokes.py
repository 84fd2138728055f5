"""Strokes on the quick mask: what the brush covers is selected, what the eraser covers is not, one step each."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from app.desk import palette
from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.input.events import PenEvent
from engine.brush.copies import NO_COPIES, Copies
from engine.brush.settings import Brush
from engine.painting.points import REACH, like_first, rounded
from engine.painting.select_commands import Line, Select
from engine.studio.selecting.tint_records import MaskBegin, MaskEnd, MaskPoints


@dataclass(slots=True)
class MaskBegun:
    """A stroke on the mask that was begun: at a level, from an origin, with a brush; `takes`: what it covers is no
    longer selected; so with its `copies`."""

    level: int
    origin: tuple[int, int]
    brush: Brush
    takes: bool
    copies: Copies = NO_COPIES
    _points: list[np.ndarray] = field(default_factory=list)

    def post(self, desk: Desk, points: np.ndarray) -> None:
        """Posts more of its points, float64 (n, 6) from the origin."""
        if len(points):
            points = np.clip(points, -REACH, REACH)
            points.flags.writeable = False
            self._points.append(points)
            desk.post(MaskPoints(points))

    def end(self, desk: Desk, done: bool) -> None:
        """Ends it: what it covers is selected, or is not any more, if it is `done`."""
        if done and self._points:
            table = rounded(like_first(self._points))
            table.flags.writeable = False
            line = Line(self.level, self.origin, table, self.brush, self.copies)
            desk.selecting.choose(desk.post, Select(line, "subtract" if self.takes else "add", self.level))
        desk.post(MaskEnd())


def begin_on_mask(desk: Desk, first: PenEvent) -> MaskBegun | None:
    """Begins a stroke on the mask, at the level that is shown.  None where there is nothing to take away."""
    palette.provide(desk)
    level, brush = desk.stroke_brush(first.eraser)
    takes = brush.row.takes_away
    if takes and not desk.selecting.selected:
        desk.say("Nothing is selected yet: paint what is to be", bad=True)
        return None
    origin = desk.view.to_canvas(first.x, first.y).pixel(level)
    plain = replace(brush, mode="paint", ink=(), op="toward", example=None, extent=False)
    symmetry.restore(desk)
    copies = symmetry.copies_at(desk, level, origin)
    desk.post(MaskBegin(level, origin, plain, takes, copies))
    return MaskBegun(level, origin, plain, takes, copies)
