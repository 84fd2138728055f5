"""Gestures in the picture of the land: turning around what is touched, looking around, and every tool, whose events
come to lie where the rays through them meet the ground."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from app.desk.desk import Desk
from app.desk.land.land_above import canvas_place, view_above
from app.input.events import PenEvent
from app.tools.gesture import Gesture

_TURN = 0.28  # degrees for a point of the window
_LOOK = 0.09


def orbit(desk: Desk, first: PenEvent) -> Gesture:
    """Turns the land around the place touched; where that is the sky, looks around."""
    about = desk.land.hit(first.x, first.y)
    desk.land.goal, desk.land.left = None, 0.0
    if about is None:
        yield from look_around(desk, first)
        return
    last = first
    while True:
        event = yield
        by = _TURN / desk.scale
        if event.kind == "move":
            desk.land.orbit(about, by * (event.x - last.x), -by * (event.y - last.y), event.time)
            last = event
        if event.kind == "up":
            return


def look_around(desk: Desk, first: PenEvent) -> Gesture:
    """Turns the head."""
    last = first
    while True:
        event = yield
        by = _LOOK / desk.scale
        if event.kind == "move" and desk.land.eye is not None:
            turned = desk.land.eye.turned(-by * (event.x - last.x), by * (event.y - last.y))
            desk.land.look(turned, event.time)
            last = event
        if event.kind == "up":
            return


def on_the_land(tool: Callable[[Desk, PenEvent], Gesture]) -> Callable[[Desk, PenEvent], Gesture]:
    """Returns a gesture of the canvas, made on the land: at the level that is seen where it begins."""

    def begin(desk: Desk, first: PenEvent) -> Gesture:
        found = desk.land.hit(first.x, first.y)
        if found is None:
            desk.say("There is no ground here")
            return
        desk.view = view_above(desk.land, desk.view, found.x, found.y, found.away, (first.x, first.y))
        inner, at = tool(desk, first), (first.x, first.y)
        try:
            next(inner)
            while True:
                event = yield
                met = desk.land.hit(event.x, event.y)
                if met is not None:  # in the sky the pen stays where it was
                    at = desk.view.to_screen(canvas_place(met.x, met.y, desk.view.level))
                inner.send(replace(event, x=at[0], y=at[1]))
        except StopIteration:
            return
        finally:
            inner.close()

    return begin
