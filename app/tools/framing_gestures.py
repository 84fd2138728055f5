"""The gesture that moves and sizes the frame by its handles."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.framing.frame_box import frame_box
from app.desk.framing.frame_state import dragged
from app.desk.moving.box import TURN
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from engine.painting import commands as c
from engine.studio.requests import Do


def drag_frame(desk: Desk, first: PenEvent) -> Gesture:
    """A handle of the frame follows the pointer by whole pixels, or all of the frame; with Shift its sides keep their
    ratio.  No paint changes."""
    box = frame_box(desk)
    grip = "" if box is None else box.grip(first.x, first.y)
    if grip in ("", TURN) or desk.past.looking is not None:
        desk.say("Drag a handle of the frame, or the frame itself")
        return
    state, start = desk.framing, desk.framing.shown(desk.known)
    x, y = desk.view.to_canvas(first.x, first.y).pixel(0)
    event, found, done = first, start, False
    state.grip, state.dragging = grip, True
    try:
        while event.kind not in ENDS:
            now = desk.view.to_canvas(event.x, event.y).pixel(0)
            found = dragged(start, grip, now[0] - x, now[1] - y, desk.pointer.shift)
            state.trial = desk.known.scene, found
            event = yield
        done = event.kind == "up"
    finally:
        state.grip, state.dragging = "", False
        if done and found != start:
            desk.post(Do(c.SetFrame(found)))
        else:
            state.trial = None
