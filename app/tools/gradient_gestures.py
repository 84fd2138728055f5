"""The gesture that fills with a gradient: dragged from where one colour is to where it has become the other."""

from __future__ import annotations

import math

from app.desk.desk import Desk
from app.desk.filling import gradients
from app.desk.filling.pouring import may_fill
from app.desk.guides import shape_paths
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from app.tools.painting_gestures import refused
from app.tools.shape_gestures import on_screen

_DRAG = 4.0  # points of the screen that a drag goes at least


def gradient(desk: Desk, first: PenEvent) -> Gesture:
    """A drag fills, which is seen meanwhile; at steps of 15° with Shift, from its middle with Alt."""
    if refused(desk) or not may_fill(desk):
        return
    level, event = desk.view.shown_level, first
    start = desk.view.to_canvas(first.x, first.y)
    x, y = start.pixel(level)
    try:
        while True:
            end = desk.view.to_canvas(event.x, event.y).offset(level, x, y)
            path = shape_paths.line(start.offset(level, x, y), end, desk.pointer.shift, desk.pointer.alt)
            desk.guides.path = on_screen(desk.view, level, (x, y), path)
            (left, top), (right, bottom) = path
            ends = (x + left, y + top), (x + right, y + bottom)
            dragged = math.dist((event.x, event.y), (first.x, first.y)) >= _DRAG * desk.scale
            if event.kind in ENDS:
                break
            if dragged:
                gradients.look(desk, start, level, *ends)
            event = yield
        if event.kind == "up" and dragged:
            gradients.lay(desk, start, level, *ends)
    finally:
        desk.guides.path = ()
        gradients.leave(desk)
