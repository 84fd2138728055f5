"""The gesture that moves layers, groups and placements."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.known import moved_by
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from engine.painting.layer_commands import SetLayer
from engine.studio.moving.move_requests import Try
from engine.studio.requests import Do


def move(desk: Desk, first: PenEvent) -> Gesture:
    """The layer, group or placement that is chosen follows the pointer, by whole pixels of the level that is shown."""
    row = desk.known.active
    if row is None or desk.past.looking is not None:
        desk.say("There is no layer to move" if row is None else "This is an earlier step", bad=True)
        return
    if row.locked:
        desk.say(f"Layer “{row.name}” is locked", bad=True)
        return
    level = desk.view.shown_level
    start, event, placing = desk.view.to_canvas(first.x, first.y).pixel(level), first, None
    done = False
    try:
        while event.kind not in ENDS:
            x, y = desk.view.to_canvas(event.x, event.y).pixel(level)
            way = moved_by(row, level, x - start[0], y - start[1])
            if way != placing:
                placing = way
                desk.post(Try(row.name, way))
            event = yield
        done = event.kind == "up"
    finally:
        if done and placing is not None:
            desk.post(Do(SetLayer(row.name, placing=placing)))
        else:
            desk.post(Try(row.name, None))
