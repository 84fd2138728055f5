"""The canvas as it is seen from above what the land shows: where tools paint, and what is seen after it."""

from __future__ import annotations

import math
from fractions import Fraction

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.land.land_state import LandState


def follow_canvas(desk: Desk) -> None:
    """Keeps the canvas' view over what lies in the middle of the picture: what is left to when the land is closed, and
    whose level and place the status line tells."""
    state = desk.land
    left, top, width, height = state.room
    found = state.hit(left + width / 2, top + height / 2) if state.eye is not None else None
    if found is None or state.eye is None:
        return
    desk.view = view_above(state, desk.view, found.x, found.y, found.away, desk.middle())


def view_above(state: LandState, view: View, x: Fraction, y: Fraction, away: float, at: tuple[float, float]) -> View:
    """Returns the canvas as seen from above a place that is so far away, which shows at a point of the window."""
    assert state.eye is not None
    level = state.level_at(away)
    place = canvas_place(x, y, level)
    turn = -state.eye.azimuth * math.pi / 180
    return View(place, level, 0.0, view.width, view.height, turn, view.mirrored).held(place, *at)


def canvas_place(x: Fraction, y: Fraction, level: int) -> Place:
    """Returns a place as the canvas tells it, as finely as strokes of a level need."""
    exponent = max(0, level + 24)
    return Place(round(x * (1 << exponent)), round(y * (1 << exponent)), exponent)
