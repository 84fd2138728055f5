"""The gesture that fills a region of like colour."""

from __future__ import annotations

from app.desk import palette
from app.desk.desk import Desk
from app.desk.examples import example_use
from app.desk.filling.fill_state import looked_at
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from app.tools.painting_gestures import refused
from engine.painting.fill_command import Fill, Like
from engine.painting.layering.placing_members import Same
from engine.studio.requests import Do


def fill(desk: Desk, first: PenEvent) -> Gesture:
    """A click fills what is like the place touched, with the brush in hand; the pen's other end erases it."""
    layer = desk.known.active
    if refused(desk):
        return
    if layer is not None and layer.shows is not None:
        desk.say(f"“{layer.name}” shows “{layer.shows.name or 'the painting'}”: fill that", bad=True)
        return
    if desk.known.hiding:
        desk.say(f"“{desk.known.hiding[-1]}” is hidden: what you fill does not show", bad=True, offer="show_layer")
    event = first
    while event.kind not in ENDS:
        event = yield
    if event.kind != "up":
        return
    like = like_at(desk, first.x, first.y)
    example_use.fit_within_reach(desk)
    palette.provide(desk)
    _, brush = desk.stroke_brush(first.eraser)
    desk.filling.last = Fill(brush, like, open=not like.contiguous)
    desk.notices.settle("fill")
    desk.post(Do(desk.filling.last))
    if brush.row.lays_ink:
        desk.hand.remember()


def like_at(desk: Desk, x: float, y: float) -> Like:
    """Returns what is like a place on the screen, as the panel says."""
    state, view = desk.filling, desk.view
    level = view.shown_level
    gap = round(state.gap / view.scale(level))
    of = None if state.seen else Same.SAME
    place = view.to_canvas(x, y).pixel(level)
    return Like(place, level, looked_at(view, level), round(state.tolerance, 4), gap, state.contiguous, of)
