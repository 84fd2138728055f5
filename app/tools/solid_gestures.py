"""Painting on an object made of a solid: the ray of the pen meets it, and the stroke is kept with the painting."""

from __future__ import annotations

from dataclasses import replace

from app.desk import palette
from app.desk.desk import Desk
from app.desk.hand import radius_of
from app.desk.solids.touching_up import ObjectSeen, TouchUp, brush_on_solid
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from engine.studio.requests import Do


def touch_up(desk: Desk, first: PenEvent) -> Gesture:
    """Paints on the object; where the pen leaves it, the stroke goes on when it is back."""
    state = desk.solid
    seen = state.aspect
    if seen is None:
        return
    sight, corner = ObjectSeen(seen), state.corner
    met = sight.hit(first.x - corner[0], first.y - corner[1])
    if met is None:
        return
    palette.provide(desk)
    brush = replace(desk.hand.dipped(), mode=desk.hand.stroke_mode(first.eraser).name)
    radius = radius_of(desk.hand, first.eraser) * met.voxels
    stroke = TouchUp(state.solid_name, brush_on_solid(brush, radius), seen.carved)
    state.stroke = stroke
    done = False
    try:
        event = first
        while True:
            x, y = event.x - corner[0], event.y - corner[1]
            if event.kind in ("down", "move"):
                carved = stroke.go(sight.hit(x, y), x, y, event.pressure)
                state.carved = state.carved if carved is None else carved
            if event.kind in ENDS:
                done = True
                return
            event = yield
    finally:
        state.stroke = None
        if done:
            desk.post(Do(stroke.told()))
        else:
            state.carved = seen.carved
