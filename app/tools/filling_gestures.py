"""What fills a region of like colour: a click with the brush in hand, a colour or a texture dropped there."""

from __future__ import annotations

from collections.abc import Iterable

from app.desk.colours import RGB, to_hex
from app.desk.desk import Desk
from app.desk.filling.fill_state import looked_at
from app.desk.filling.pouring import grown_by, may_fill, outruns, post_fill, pour
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from app.tools.painting_gestures import refused
from engine.brush.parts import Component
from engine.brush.settings import Brush
from engine.painting.commands import DefineTexture
from engine.painting.fill_command import Fill, Like
from engine.painting.layering.placing_members import Same
from engine.studio.requests import Do


def fill(desk: Desk, first: PenEvent) -> Gesture:
    """A click fills what is like the place touched, with the brush in hand; the pen's other end erases it."""
    if refused(desk) or not may_fill(desk):
        return
    event = first
    while event.kind not in ENDS:
        event = yield
    if event.kind != "up":
        return
    pour(desk, like_at(desk, first.x, first.y), first.eraser)


def drop_colour(desk: Desk, rgb: RGB, x: float, y: float) -> None:
    """Fills what is like a place on the screen with a plain colour."""
    _dropped(desk, Brush(colour=to_hex(rgb)), x, y)


def drop_texture(desk: Desk, needs: Iterable[DefineTexture], part: Component, x: float, y: float) -> None:
    """Fills what is like a place on the screen with a texture over the colour in hand; `needs`: what the painting lacks
    for that."""
    if refused(desk) or not may_fill(desk):
        return
    for command in needs:
        desk.post(Do(command))
    _dropped(desk, Brush(colour=to_hex(desk.hand.colour), ink=(part,)), x, y)


def _dropped(desk: Desk, brush: Brush, x: float, y: float) -> None:
    if refused(desk) or not may_fill(desk):
        return
    like = like_at(desk, x, y)
    post_fill(desk, Fill(brush, like, outruns(desk, like), grow=grown_by(desk, like)))


def like_at(desk: Desk, x: float, y: float) -> Like:
    """Returns what is like a place on the screen, as the panel says."""
    state, view = desk.filling, desk.view
    level = view.shown_level
    gap = round(state.gap / view.scale(level))
    of = None if state.seen else Same.SAME
    place = view.to_canvas(x, y).pixel(level)
    return Like(place, level, looked_at(view, level), round(state.tolerance, 4), gap, state.contiguous, of)
