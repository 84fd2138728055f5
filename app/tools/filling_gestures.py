"""The gesture that fills a region of like colour."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.filling.fill_state import looked_at
from app.desk.filling.pouring import may_fill, pour
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from app.tools.painting_gestures import refused
from engine.painting.fill_command import Like
from engine.painting.layering.placing_members import Same


def fill(desk: Desk, first: PenEvent) -> Gesture:
    """A click fills what is like the place touched, with the brush in hand; the pen's other end erases it."""
    if refused(desk) or not may_fill(desk):
        return
    event = first
    while event.kind not in ENDS:
        event = yield
    if event.kind != "up":
        return
    pour(desk, like_at(desk, first.x, first.y), first.eraser)


def like_at(desk: Desk, x: float, y: float) -> Like:
    """Returns what is like a place on the screen, as the panel says."""
    state, view = desk.filling, desk.view
    level = view.shown_level
    gap = round(state.gap / view.scale(level))
    of = None if state.seen else Same.SAME
    place = view.to_canvas(x, y).pixel(level)
    return Like(place, level, looked_at(view, level), round(state.tolerance, 4), gap, state.contiguous, of)
