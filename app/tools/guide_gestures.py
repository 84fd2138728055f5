"""The gesture that moves guides by their handles."""

from __future__ import annotations

import math
from dataclasses import replace

from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.desk.guides.guide_state import Held
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from engine.painting.guiding.guides import Guide
from engine.studio.requests import Do

GRAB = 14.0  # points of the screen from a handle within which a press is on it
_STEP = math.pi / 12  # of turns while Shift is held


def move_guide(desk: Desk, first: PenEvent) -> Gesture:
    """The handle that is pressed follows the pointer: the centre of the symmetry, or the end of its axis, by 15° with
    Shift.  Away from both, the centre comes to the pointer."""
    guide = symmetry.guide_of(desk)
    if guide is None or guide.off:
        desk.say("There is no symmetry to move: choose one in the brush panel", bad=True)
        return
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
            desk.post(Do(held.guide))
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
