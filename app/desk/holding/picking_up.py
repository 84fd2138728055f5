"""Taking colours and ink from the painting."""

from __future__ import annotations

from dataclasses import replace

from app.desk.colours import from_hex
from app.desk.desk import Desk
from app.desk.hand import Hand
from engine.brush.settings import Brush
from engine.studio.past.past_records import AskHere, Here
from engine.studio.requests import Pick


def pick_at(desk: Desk, x: float, y: float, last: bool) -> None:
    """Asks for what lies at a point of the screen; `last`: the pointer is lifted there."""
    state, level, layer = desk.picking, desk.view.shown_level, desk.known.active
    at = desk.view.to_canvas(x, y).pixel(level)
    desk.post(Pick(level, *at, state.radius, layer.name if state.layer and layer is not None else None))
    state.asked = None
    if last and state.ink:
        state.asked = level, *at
        desk.post(AskHere(level, *at))


def take_ink(desk: Desk, found: Here, _now: float) -> None:
    """Stirs into the brush what the newest stroke at the place that was picked has in its ink, and takes its colour."""
    if found.place != desk.picking.asked or not found.strokes:
        return
    desk.picking.asked = None
    brush = found.strokes[0].step.brush
    if brush is None or not brush.row.lays_ink:
        desk.say("Nothing was painted here with an ink", bad=True)
        return
    _stir(desk.hand, replace(desk.hand.brush, colour=brush.colour, ink=brush.ink, shaping=brush.shaping))
    textures = ", ".join(part.texture for part in brush.ink)
    desk.say(f"Took the ink: {textures}" if textures else "Took the ink: plain colour")


def _stir(hand: Hand, brush: Brush) -> None:
    hand.take(brush)
    hand.colour = from_hex(brush.colour)
