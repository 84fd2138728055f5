"""Gestures that move the view."""

from __future__ import annotations

import math

from app.desk.desk import Desk
from app.input.events import PenEvent
from app.tools.gesture import Gesture


def pan(desk: Desk, first: PenEvent) -> Gesture:
    """The picture follows the pointer: the place that was touched stays under it."""
    desk.glide.stop()
    held = desk.view.to_canvas(first.x, first.y)
    while True:
        event = yield
        desk.view = desk.view.held(held, event.x, event.y)
        if event.kind == "up":
            return


def zoom(desk: Desk, first: PenEvent) -> Gesture:
    """Drag up or right to zoom in about the place touched; a click zooms in by one level."""
    desk.glide.stop()
    start = desk.view
    held = start.to_canvas(first.x, first.y)
    moved = 0.0
    while True:
        event = yield
        moved = max(moved, math.hypot(event.x - first.x, event.y - first.y))
        if event.kind == "up":
            break
        way = (event.x - first.x) - (event.y - first.y)
        desk.view = start.zoomed(way / (120 * desk.scale)).held(held, first.x, first.y)
    if moved < 4 * desk.scale:
        desk.view = start
        desk.glide.zoom(start, 1.0, first.x, first.y)


def turn(desk: Desk, first: PenEvent) -> Gesture:
    """Turns the picture about the middle of the free area."""
    desk.glide.stop()
    x, y = desk.middle()
    start, place = desk.view, desk.view.to_canvas(x, y)
    begin = math.atan2(first.y - y, first.x - x)
    while True:
        event = yield
        angle = start.angle + math.atan2(event.y - y, event.x - x) - begin
        quarter = round(angle / (math.pi / 2)) * (math.pi / 2)
        desk.view = desk.view.turned(quarter if abs(angle - quarter) < 0.04 else angle, x, y).held(place, x, y)
        if event.kind == "up":
            return
