"""The box around what the tool Move holds, on the desk."""

from __future__ import annotations

import time

from app.desk.desk import Desk
from app.desk.moving import floating
from app.desk.moving.box import Box, box_of
from app.desk.moving.move_state import TOOL
from engine.canvas.placing.pose import SourcePart
from engine.studio.results import LayerRow


def part(desk: Desk, row: LayerRow) -> SourcePart | None:
    """Returns what of a layer's own places is painted, or painted and selected; of a placement, of its source's; None:
    nothing, or not known."""
    extent = desk.moving.extent
    known = extent is not None and (extent.name, extent.selected) == (row.name, floating.takes_part(desk, row))
    return extent.part if known and extent is not None else None


def seen_box(desk: Desk) -> Box | None:
    """Returns the box that is to be seen; None if there is none."""
    row = desk.known.active
    if desk.hand.tool != TOOL or row is None or desk.past.looking is not None:
        return None
    held = part(desk, row)
    return (
        None
        if held is None
        else box_of(desk.view, desk.scale, held, desk.moving.pose(desk.known, row), desk.free_area())
    )


def hover(desk: Desk) -> None:
    """Finds what of the box the pointer is over, if nothing is dragged."""
    if desk.moving.label is None:
        box = seen_box(desk) if desk.pointer.over_canvas else None
        desk.moving.grip = "" if box is None else box.grip(desk.pointer.x, desk.pointer.y)


def wants(desk: Desk) -> None:
    """Posts what the tool lacks, or an action that waits."""
    want_sheets(desk)
    floating.watch(desk)
    if not desk.behind():
        desk.moving.answered(desk.post, desk.known)
    if desk.hand.tool == TOOL or desk.moving.waits is not None:
        row = desk.known.active
        selected = row is not None and floating.takes_part(desk, row)
        desk.moving.wants(desk.post, desk.known, desk.view.shown_level, selected)


def want_sheets(desk: Desk) -> None:
    """Posts a question for the sheets of which a picture is made while something is dragged, if they may be wanted."""
    row, alone = desk.known.active, desk.masks.alone and desk.masks.on(desk.known.active)
    held = row is not None and desk.hand.tool == TOOL and not row.locked and not floating.takes_part(desk, row)
    wanted = row if held and not (alone or desk.light.shown) and desk.past.looking is None else None
    desk.moving.sheets.wants(desk.post, desk.known, wanted, desk.view, time.monotonic())
