"""The box around the frame, on the desk."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.framing.frame_state import FRAME_TOOL
from app.desk.moving.box import Box, box_of
from engine.canvas.placing.pose import UNMOVED, SourcePart


def frame_box(desk: Desk) -> Box | None:
    """Returns the box with the handles of the frame; None while the tool is not in hand, or the frame too far away."""
    if desk.hand.tool != FRAME_TOOL or desk.past.looking is not None:
        return None
    return box_of(desk.view, desk.scale, SourcePart(0, desk.framing.shown(desk.known)), UNMOVED)
