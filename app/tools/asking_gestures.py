"""Gestures that take something from a place: a colour, an example, the strokes that show there."""

from __future__ import annotations

import math

from app.desk.desk import Desk
from app.desk.examples import example_use
from app.desk.holding.picking_up import pick_at
from app.desk.match_state import SMALLEST
from app.input.events import PenEvent
from app.tools.gesture import Gesture
from engine.numeric.address import Rect

_CLICK = 6.0  # points that a hand moves as it clicks, at most


def pick(desk: Desk, first: PenEvent) -> Gesture:
    """Takes the colour under the pointer."""
    event = first
    while True:
        pick_at(desk, event.x, event.y, event.kind == "up")
        if event.kind == "up":
            return
        event = yield


def pick_or_pop_up(desk: Desk, first: PenEvent) -> Gesture:
    """Takes the colour under the pointer where it is dragged; a click opens the palette there."""
    event = first
    while math.hypot(event.x - first.x, event.y - first.y) < _CLICK * desk.scale:
        if event.kind == "up":
            desk.hand_sight.palette_at = first.x, first.y
            return
        event = yield
    yield from pick(desk, event)


def mark(desk: Desk, first: PenEvent) -> Gesture:
    """A rectangle of the canvas becomes an example to match."""
    match, index = desk.match, desk.match.marking or 0
    event = first
    try:
        while event.kind != "up":
            match.marked = first.x, first.y, event.x, event.y
            event = yield
    finally:
        match.marked = None
    level, view = desk.view.shown_level, desk.view
    corners = [view.to_canvas(x, y).pixel(level) for x in (first.x, event.x) for y in (first.y, event.y)]
    xs, ys = zip(*corners, strict=True)
    rect = Rect(min(xs), min(ys), max(xs), max(ys))
    if min(rect.width, rect.height) < SMALLEST:
        desk.say(f"An example has at least {SMALLEST} pixels along each side", bad=True)
        return
    match.show_area(index, level, rect)


def swap(desk: Desk, first: PenEvent) -> Gesture:
    """Returns what was painted with an example, at the place touched, becomes like the chosen one."""
    event = first
    while event.kind != "up":
        event = yield
    example_use.swap(desk, event.x, event.y)


def ask_here(desk: Desk, first: PenEvent) -> Gesture:
    """Asks for the strokes that show at the place touched."""
    event = first
    while event.kind != "up":
        event = yield
    level = desk.view.shown_level
    desk.past.ask(desk.post, level, *desk.view.to_canvas(event.x, event.y).pixel(level))
