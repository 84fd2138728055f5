"""What the tool Move does now: with what is chosen, selected and painted."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.moving import floating

_STEPS = "its handles scale and turn it, with Shift by steps"


def move_hint(desk: Desk) -> str:
    """Returns it in a line."""
    row = desk.known.active
    if row is None:
        return "There is no layer to move"
    if row.locked:
        return f"“{row.name}” is locked"
    if desk.moving.floating is not None:
        return "Drag it, paint on, or press Enter: it is set down; Escape takes it back"
    part = floating.takes_part(desk, row)
    if desk.moving.empty(desk.known, row, part):
        return nothing_there(row.name, part)
    if part:
        return f"Drag what is selected of “{row.name}”; {_STEPS}; Alt drags a copy"
    kind = "group" if row.group else "placement" if row.shows is not None else "layer"
    return f"Drag the {kind}; {_STEPS}; Alt drags a copy.  Nothing is lost"


def nothing_there(name: str, part: bool) -> str:
    """Returns a line that tells that nothing can be moved of a layer."""
    return f"Nothing is painted on “{name}”" + (" where it is selected" if part else "")
