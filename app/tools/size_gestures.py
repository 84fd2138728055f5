"""Dragging the size of the brush on the canvas."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.hand import LARGEST, SMALLEST
from app.input.events import PenEvent
from app.tools.gesture import Gesture

_HARD = 200.0  # points from the softest to the hardest
_STILL = 8.0  # points that each way has to go before it counts: a hand never moves quite straight


def drag_size(desk: Desk, first: PenEvent) -> Gesture:
    """Changes the radius sideways and the hardness up and down; a ghost of the dab shows where it was begun."""
    before, still, done = desk.hand.brush, _STILL * desk.scale, False
    desk.hand_sight.ghost = first.x, first.y
    try:
        event = first
        while event.kind != "up":
            radius = before.radius + _beyond(event.x - first.x, still)
            hardness = before.hardness + _beyond(first.y - event.y, still) / (_HARD * desk.scale)
            desk.hand.change(
                radius=round(max(SMALLEST, min(LARGEST, radius)), 1), hardness=round(max(0.0, min(1.0, hardness)), 2)
            )
            event = yield
        done = True
    finally:
        desk.hand_sight.ghost = None
        if not done:
            desk.hand.change(radius=before.radius, hardness=before.hardness)


def _beyond(way: float, still: float) -> float:
    return way - still if way > still else way + still if way < -still else 0.0
