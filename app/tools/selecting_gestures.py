"""Gestures that select: a rectangle, an ellipse, what a line goes round, what is like a place.

Shift adds to what is selected, Alt takes away, both leave what both have.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from app.canvas.view import Place
from app.desk.desk import Desk
from app.input.events import PenEvent
from app.tools.filling_gestures import like_at
from app.tools.gesture import Gesture
from engine.numeric.address import Rect
from engine.painting.commands import Select
from engine.painting.points import DEFAULTS, REACH, rounded
from engine.painting.select_commands import Box, Line, Whole

_CLICK = 4.0  # points of the screen: a drag that stays within them is a click
_APART = 1.5  # screen pixels from one point of a lasso to the next
_AGAIN = 0.35  # seconds from one click to the next that are a double click
_ROUND = 48  # corners of an ellipse as it is previewed
_OPS = {(False, False): "replace", (True, False): "add", (False, True): "subtract", (True, True): "intersect"}


def _op(desk: Desk) -> str:
    return _OPS[desk.pointer.shift, desk.pointer.alt]


def _may(desk: Desk) -> bool:
    if not desk.known.ready or desk.past.looking is not None:
        desk.say("This is an earlier step" if desk.known.ready else "The paint engine is still loading", bad=True)
        return False
    return True


def _clicked(desk: Desk, first: PenEvent, last: PenEvent) -> bool:
    return math.hypot(last.x - first.x, last.y - first.y) < _CLICK * desk.scale


def _none(desk: Desk, op: str) -> None:
    """A click beside everything selects nothing in particular."""
    if op == "replace" and desk.selecting.selected:
        desk.selecting.choose(desk.post, Select(Whole("none")))


def _boxed(desk: Desk, first: PenEvent, oval: bool) -> Gesture:
    if not _may(desk):
        return
    op, event, state = _op(desk), first, desk.selecting
    try:
        while event.kind != "up":
            state.shape, state.closed = _corners(desk, first, event, oval), True
            event = yield
    finally:
        state.shape = []
    if _clicked(desk, first, event):
        _none(desk, op)
        return
    level, view = desk.view.shown_level, desk.view
    corners = [view.to_canvas(x, y).pixel(level) for x in (first.x, event.x) for y in (first.y, event.y)]
    xs, ys = zip(*corners, strict=True)
    box = Box(level, Rect(min(xs), min(ys), max(xs) + 1, max(ys) + 1), oval)
    desk.selecting.choose(desk.post, Select(box, op, level))


def _corners(desk: Desk, first: PenEvent, last: PenEvent, oval: bool) -> list[Place]:
    """Returns the corners of the shape between two points, upright on the canvas, to be drawn."""
    level, view = desk.view.shown_level, desk.view
    ends = [view.to_canvas(event.x, event.y) for event in (first, last)]
    x, y = ends[0].pixel(level)
    dx, dy = ends[1].offset(level, x, y)
    if not oval:
        return [ends[0].moved(a, b, level) for a, b in ((0, 0), (dx, 0), (dx, dy), (0, dy))]
    turns = [2 * math.pi * n / _ROUND for n in range(_ROUND)]
    return [ends[0].moved(dx / 2 * (1 + math.cos(t)), dy / 2 * (1 + math.sin(t)), level) for t in turns]


rectangle: Callable[[Desk, PenEvent], Gesture] = partial(_boxed, oval=False)
ellipse: Callable[[Desk, PenEvent], Gesture] = partial(_boxed, oval=True)


def lasso(desk: Desk, first: PenEvent) -> Gesture:
    """Selects what the pointer goes round."""
    if not _may(desk):
        return
    op, event, state = _op(desk), first, desk.selecting
    state.shape, state.closed, last = [], True, (math.inf, math.inf)
    try:
        while event.kind != "up":
            if math.hypot(event.x - last[0], event.y - last[1]) >= _APART:
                state.shape.append(desk.view.to_canvas(event.x, event.y))
                last = event.x, event.y
            event = yield
        _outline(desk, op)
    finally:
        state.shape = []


def polygon(desk: Desk, first: PenEvent) -> Gesture:
    """Selects what straight lines from click to click go round; a double click, one on the first corner, or Enter
    closes it."""
    if not _may(desk):
        return
    op, event, state = _op(desk), first, desk.selecting
    state.shape, state.closed, last = [], False, first
    try:
        while True:
            place = desk.view.to_canvas(event.x, event.y)
            if event.kind == "down":
                again = bool(state.shape) and event.time - last.time < _AGAIN and _clicked(desk, last, event)
                if again or _on_first(desk, event):
                    break
                state.shape[-1:] = [place, place]
                last = event
            elif event.kind == "move" and state.shape:
                state.shape[-1] = place
            elif event.kind == "done":
                break
            event = yield
        del state.shape[-1:]
        _outline(desk, op)
    finally:
        state.shape = []


def wand(desk: Desk, first: PenEvent) -> Gesture:
    """A click selects what is like the place touched, as the panel says, as far as it is looked for."""
    if not _may(desk):
        return
    op, event = _op(desk), first
    while event.kind != "up":
        event = yield
    like = like_at(desk, first.x, first.y)
    grown = round(desk.filling.grown / desk.view.scale(like.level), 2)
    desk.selecting.choose(desk.post, Select(like, op, like.level, grown))


def _on_first(desk: Desk, event: PenEvent) -> bool:
    shape = desk.selecting.shape
    if len(shape) < 4:
        return False
    x, y = desk.view.to_screen(shape[0])
    return math.hypot(event.x - x, event.y - y) < 2 * _CLICK * desk.scale


def _outline(desk: Desk, op: str) -> None:
    """Selects what the shape goes round, at the level that is shown."""
    shape, level = desk.selecting.shape, desk.view.shown_level
    if len(shape) < 3:
        _none(desk, op)
        return
    origin = shape[0].pixel(level)
    points = np.tile(DEFAULTS, (len(shape), 1))
    points[:, :2] = np.clip([place.offset(level, *origin) for place in shape], -REACH, REACH)
    table = rounded(points)
    table.flags.writeable = False
    desk.selecting.choose(desk.post, Select(Line(level, origin, table), op, level))
