"""Gestures that draw shapes with the brush: seen as a thin line while they are dragged, painted as one stroke."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from app.canvas.view import View
from app.desk.desk import Desk
from app.desk.guides import shape_paths
from app.desk.guides.shape_paths import Corner, Knot, Path
from app.input.events import PenEvent
from app.tools.gesture import Gesture
from app.tools.mask_strokes import MaskBegun
from app.tools.painting_gestures import begin_stroke, refused
from engine.painting.points import REACH

_DOUBLE = 0.4  # seconds between the presses that end a polyline
_SAME, _CLOSING = 6.0, 10.0  # points of the screen within which a press is on the last corner, or on the first


def dragged(path: Path) -> Callable[[Desk, PenEvent], Gesture]:
    """Returns the gesture of a shape that is dragged from one point to another: even with Shift, from its middle with
    Alt."""

    def draw(desk: Desk, first: PenEvent) -> Gesture:
        if refused(desk):
            return
        level = desk.view.shown_level
        start, event = desk.view.to_canvas(first.x, first.y), first
        origin = start.pixel(level)
        try:
            while True:
                end = desk.view.to_canvas(event.x, event.y).offset(level, *origin)
                found = path(start.offset(level, *origin), end, desk.pointer.shift, desk.pointer.alt)
                desk.guides.path = on_screen(desk.view, level, origin, found)
                if event.kind in ("up", "lost"):
                    break
                event = yield
        finally:
            desk.guides.path = ()
        if event.kind == "up":
            _painted(desk, first, found)

    return draw


def polyline(desk: Desk, first: PenEvent) -> Gesture:
    """Corners by clicks; a double click or Enter ends it, a click on the first corner closes it, Escape gives it up."""
    if refused(desk):
        return
    view, level = desk.view, desk.view.shown_level
    origin = view.to_canvas(first.x, first.y).pixel(level)
    corners, last, at = [_placed(view, level, origin, first)], first, (first.x, first.y)
    begin = at
    try:
        while True:
            event = yield
            if event.kind == "lost":
                return
            if event.kind == "done":
                break
            near = math.dist((event.x, event.y), at) <= _SAME * desk.scale
            if event.kind == "down":
                if near and event.time - last.time <= _DOUBLE:
                    break
                last, at = event, (event.x, event.y)
                if len(corners) > 2 and math.dist(at, begin) <= _CLOSING * desk.scale:
                    corners.append(corners[0])
                    break
                corners.append(_placed(view, level, origin, event))
            elif event.kind == "up" and not near:  # a side that was dragged
                at = event.x, event.y
                corners.append(_placed(view, level, origin, event))
            desk.guides.path = on_screen(desk.view, level, origin, [*corners, _placed(desk.view, level, origin, event)])
    finally:
        desk.guides.path = ()
    _painted(desk, first, corners)


def curve(desk: Desk, first: PenEvent) -> Gesture:
    """Knots by clicks, each dragged to bend the curve there; a double click or Enter ends it, a click on the first knot
    closes it, Backspace takes the last one back, Escape gives it up."""
    if refused(desk):
        return
    level = desk.view.shown_level
    origin = desk.view.to_canvas(first.x, first.y).pixel(level)
    knots, event, pulling, before = [_knot(desk.view, level, origin, first)], first, True, first
    try:
        while True:
            here = _knot(desk.view, level, origin, event)
            if pulling:
                knots[-1] = _pulled(knots[-1], here, _SAME * desk.scale / desk.view.scale(level))
                pulling = event.kind != "up"
            _show_curve(desk, (level, origin), knots if pulling else [*knots, here], knots[-1])
            event = yield
            if event.kind == "back":
                knots.pop()
                pulling = False
            if event.kind == "lost" or not knots:
                return
            if event.kind == "done":
                break
            if event.kind == "down":
                if _again(desk, before, event):
                    break
                before, pulling = event, True
                if len(knots) > 2 and math.dist(_seen(desk.view, level, origin, knots[0]), (event.x, event.y)) <= (
                    _CLOSING * desk.scale
                ):
                    knots.append(knots[0])
                    break
                knots.append(_knot(desk.view, level, origin, event))
    finally:
        desk.guides.path = desk.guides.bar = ()
    rows = shape_paths.bezier(knots)
    _painted(desk, first, [(x, y) for x, y, _ in rows], [pressure for *_, pressure in rows])


def _again(desk: Desk, before: PenEvent, event: PenEvent) -> bool:
    """Tells whether a press is the second one of a double click."""
    near = math.dist((event.x, event.y), (before.x, before.y)) <= _SAME * desk.scale
    return near and event.time - before.time <= _DOUBLE


def _knot(view: View, level: int, origin: tuple[int, int], event: PenEvent) -> Knot:
    x, y = _placed(view, level, origin, event)
    return Knot(x, y, pressure=event.pressure if event.pen and event.pressure > 0.0 else 1.0)


def _pulled(knot: Knot, here: Knot, least: float) -> Knot:
    """Returns a knot whose handle is pulled to a place, and which is pressed as hard as ever."""
    dx, dy = here.x - knot.x, here.y - knot.y
    bent = math.hypot(dx, dy) > least
    pressure = max(knot.pressure, here.pressure) if knot.pressure < 1.0 and here.pressure < 1.0 else knot.pressure
    return Knot(knot.x, knot.y, dx if bent else 0.0, dy if bent else 0.0, pressure)


def _show_curve(desk: Desk, place: tuple[int, tuple[int, int]], knots: Sequence[Knot], last: Knot) -> None:
    """Shows the curve as a thin line, with the handles of its last knot."""
    corners = [(x, y) for x, y, _ in shape_paths.bezier(knots)]
    desk.guides.path = on_screen(desk.view, *place, corners)
    ends = [(last.x - last.dx, last.y - last.dy), (last.x + last.dx, last.y + last.dy)]
    desk.guides.bar = on_screen(desk.view, *place, ends) if last.dx or last.dy else ()


def _seen(view: View, level: int, origin: tuple[int, int], knot: Knot) -> Corner:
    return on_screen(view, level, origin, [(knot.x, knot.y)])[0]


def on_screen(view: View, level: int, origin: tuple[int, int], path: Sequence[Corner]) -> tuple[Corner, ...]:
    """Returns where points from an origin are seen."""
    x, y = view.pixel_to_screen(level, *origin)
    a, b, c, d = view.matrix()
    s = view.scale(level)
    return tuple((x + (a * dx + b * dy) * s, y + (c * dx + d * dy) * s) for dx, dy in path)


def _placed(view: View, level: int, origin: tuple[int, int], event: PenEvent) -> Corner:
    return view.to_canvas(event.x, event.y).offset(level, *origin)


def _painted(desk: Desk, first: PenEvent, path: Sequence[Corner], pressures: Sequence[float] = ()) -> None:
    """Posts the stroke along a path, from the pixel that was pressed first; pressed full where that is not told."""
    rows = np.array([(x, y, 1.0, 0.0, 0.0, 0.0) for x, y in path])
    if len(pressures):
        rows[:, 2] = pressures
    if len(set(path)) < 2 or np.abs(rows[:, :2]).max() > REACH:
        return
    begun = begin_stroke(desk, first)
    if begun is not None:
        begun.post(desk, rows)
        begun.end(desk, True)
        if begun.brush.row.lays_ink and not isinstance(begun, MaskBegun):
            desk.hand.remember()


DRAWN: dict[str, Callable[[Desk, PenEvent], Gesture]] = {
    "draw_line": dragged(shape_paths.line),
    "draw_rectangle": dragged(shape_paths.rectangle),
    "draw_ellipse": dragged(shape_paths.ellipse),
    "draw_polyline": polyline,
    "draw_curve": curve,
}
