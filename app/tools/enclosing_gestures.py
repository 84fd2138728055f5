"""The gesture that fills all regions that the pointer goes round, with the brush in hand."""

from __future__ import annotations

import math
from dataclasses import replace

from app.canvas.view import Place
from app.desk.desk import Desk
from app.desk.filling.pouring import may_fill, pour
from app.input.events import ENDS, PenEvent
from app.tools.filling_gestures import like_at
from app.tools.gesture import Gesture
from app.tools.painting_gestures import refused
from engine.painting.points import REACH

_BETWEEN = 1.5  # screen pixels from one corner of the line to the next


def enclose(desk: Desk, first: PenEvent) -> Gesture:
    """A drag goes round what is to be filled, or from one corner of a rectangle around it to the other; the pen's other
    end erases it."""
    if refused(desk) or not may_fill(desk):
        return
    event, state = first, desk.selecting
    state.shape, state.closed, last = [], True, (math.inf, math.inf)
    try:
        while event.kind not in ENDS:
            if desk.filling.boxed:
                state.shape = _box(desk, first, event)
            elif math.dist((event.x, event.y), last) >= _BETWEEN:
                state.shape.append(desk.view.to_canvas(event.x, event.y))
                last = event.x, event.y
            event = yield
        line = list(state.shape)
    finally:
        state.shape = []
    if event.kind == "up" and len(line) > 2:
        _fill_within(desk, first, line)


def _box(desk: Desk, first: PenEvent, last: PenEvent) -> list[Place]:
    """Returns the corners of the rectangle between two points, upright on the canvas."""
    level, view = desk.view.shown_level, desk.view
    start, end = (view.to_canvas(event.x, event.y) for event in (first, last))
    dx, dy = end.offset(level, *start.pixel(level))
    return [start.moved(a, b, level) for a, b in ((0, 0), (dx, 0), (dx, dy), (0, dy))]


def _fill_within(desk: Desk, first: PenEvent, line: list[Place]) -> None:
    like = like_at(desk, first.x, first.y)
    corners = [place.offset(like.level, *like.at) for place in line]
    if max(max(map(abs, corner)) for corner in corners) > REACH:
        return
    within = tuple((round(x, 3), round(y, 3)) for x, y in corners)
    pour(desk, replace(like, rect=None, contiguous=True, within=within, regions=desk.filling.regions), first.eraser)
