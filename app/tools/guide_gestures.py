"""The gesture that moves guides by their handles."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.desk.guides.assistants import set_guide
from app.desk.guides.guide_sight import distance_to, handles
from app.desk.guides.guide_state import Held
from app.desk.guides.present import assistants
from app.desk.guides.reshaping import DRAGS, Points, guide_at, places_of, shifted_by
from app.desk.guides.snap_curves import Exact
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from engine.painting.guiding.guides import Guide

GRAB = 14.0  # points of the screen from a handle within which a press is on it
BODY = 8.0  # and from the line of a ruler
_STEP = math.pi / 12  # of turns while Shift is held


def move_guide(desk: Desk, first: PenEvent) -> Gesture:
    """The handle that is pressed follows the pointer, by 15° with Shift; a ruler is moved by its line.  Away from all
    of them, the centre of the symmetry comes to the pointer where there are no other guides."""
    desk.guides.shown = True
    axis = symmetry.guide_of(desk)
    on_axis = axis is not None and not axis.off
    pressed = None if on_axis and axis is not None and _on_handle(desk, axis, first) else _pressed(desk, first)
    if pressed is not None:
        yield from _reshape(desk, first, *pressed)
    elif on_axis and axis is not None and (_on_handle(desk, axis, first) or not assistants(desk)):
        yield from _move_axis(desk, first, axis)
    else:
        desk.guides.chosen = ""
        if not assistants(desk):
            desk.say("There is no guide to move: the menu Guides adds one")


def _on_handle(desk: Desk, guide: Guide, event: PenEvent) -> bool:
    return symmetry.pressed(desk, guide, event.x, event.y, GRAB * desk.scale) is not None


def _pressed(desk: Desk, event: PenEvent) -> tuple[Guide, int | None] | None:
    """Returns the guide that is pressed, the chosen one first, and which of its points; None where it is its line."""
    at = event.x, event.y
    guides = sorted(assistants(desk), key=lambda guide: guide.name != desk.guides.chosen)
    found = [(math.dist(place, at), guide, n) for guide in guides for n, place in enumerate(handles(desk, guide))]
    distance, guide, number = min(found, key=lambda one: one[0], default=(math.inf, None, 0))
    if guide is not None and distance <= GRAB * desk.scale:
        return guide, number
    return next(((guide, None) for guide in guides if distance_to(desk, guide, *at) <= BODY * desk.scale), None)


def _reshape(desk: Desk, first: PenEvent, guide: Guide, number: int | None) -> Gesture:
    """Drags a point of a guide, or all of it; one step."""
    desk.guides.chosen = guide.name
    serial = desk.known.scene.serial if desk.known.scene is not None else 0
    level = desk.view.shown_level
    origin = desk.view.to_canvas(first.x, first.y).pixel(level)
    points, start = places_of(guide, level, origin), _place(desk, first, level, origin)
    event, done = first, False
    try:
        while event.kind not in ENDS:
            there = _place(desk, event, level, origin)
            shift = desk.pointer.shift
            found = _dragged(guide, number, points, (start, there), shift) if there != start else points
            shown = guide if found is points else guide_at(guide, found, level, origin)
            if shown is not None:
                desk.guides.held = Held(shown, serial)
            event = yield
        done = event.kind == "up"
    finally:
        held, desk.guides.held = desk.guides.held, None
        if done and held is not None:
            set_guide(desk, held.guide)


def _dragged(guide: Guide, number: int | None, points: Points, way: tuple[Exact, Exact], even: bool) -> Points:
    start, there = way
    if number is not None and not (guide.kind == "perspective-1" and number == 1):  # whose handle lies elsewhere
        there = points[number][0] + there[0] - start[0], points[number][1] + there[1] - start[1]
    if number is None:
        return shifted_by(points, (there[0] - start[0], there[1] - start[1]))
    return DRAGS[guide.kind](points, number, there, even)


def _place(desk: Desk, event: PenEvent, level: int, origin: tuple[int, int]) -> Exact:
    x, y = desk.view.to_canvas(event.x, event.y).offset(level, *origin)
    return Fraction(x), Fraction(y)


def _move_axis(desk: Desk, first: PenEvent, guide: Guide) -> Gesture:
    """The centre of the symmetry follows the pointer, or the end of its axis."""
    serial = desk.known.scene.serial if desk.known.scene is not None else 0
    turning = symmetry.pressed(desk, guide, first.x, first.y, GRAB * desk.scale) == 1
    event, done = first, False
    try:
        while event.kind not in ENDS:
            desk.guides.held = Held(_turned(desk, guide, event) if turning else _moved(desk, guide, event), serial)
            event = yield
        done = event.kind == "up"
    finally:
        held = desk.guides.held
        if done and held is not None and held.guide != guide:
            symmetry.set_symmetry(desk, held.guide)
        else:
            desk.guides.held = None


def _moved(desk: Desk, guide: Guide, event: PenEvent) -> Guide:
    """Returns a symmetry with its centre under the pointer."""
    there = symmetry.lying(desk.view, desk.view.to_canvas(event.x, event.y), symmetry.direction(guide))
    return replace(guide, level=there.level, at=there.at, points=there.points)


def _turned(desk: Desk, guide: Guide, event: PenEvent) -> Guide:
    """Returns a symmetry whose axis points to the pointer."""
    centre = symmetry.centre_of(guide)
    level = desk.view.shown_level
    at = centre.pixel(level)
    x0, y0 = centre.offset(level, *at)
    x1, y1 = desk.view.to_canvas(event.x, event.y).offset(level, *at)
    angle = math.atan2(y1 - y0, x1 - x0)
    if desk.pointer.shift:
        angle = round(angle / _STEP) * _STEP
    there = symmetry.lying(desk.view, centre, (math.cos(angle), math.sin(angle)))
    return replace(guide, level=there.level, at=there.at, points=there.points)
