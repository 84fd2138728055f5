"""The action by which the frame becomes a tile that the layer is painted on, and shown repeated."""

from __future__ import annotations

from app.actions.action import Action as A
from app.actions.action import chosen
from app.desk.desk import Desk
from app.desk.guides.tile_seams import tell_seams
from engine.canvas.placing.pose import SourcePart
from engine.painting import commands as c
from engine.studio.requests import Do


def _wrap(desk: Desk) -> None:
    row = desk.known.active
    if row is None:
        return
    wrap = SourcePart(0, desk.known.frame) if row.wrap is None else None
    desk.post(Do(c.SetLayer(row.name, wrap=wrap)))
    if wrap is not None:
        tell_seams(desk, wrap, *desk.stroke_brush(False))


def _can_wrap(desk: Desk) -> bool:
    row = desk.known.active
    return chosen(desk) and row is not None and not row.group and row.shows is None


def _wraps(desk: Desk) -> bool:
    return desk.known.active is not None and desk.known.active.wrap is not None


WRAPPING_ACTIONS: dict[str, A] = {
    "wrap": A(
        "Wrap around", "View", ("Ctrl+Alt+W",),
        "Repeat the layer’s frame without end: strokes over its rim come in on the other side",
        _wrap, _can_wrap, _wraps,
    ),
}  # fmt: skip
