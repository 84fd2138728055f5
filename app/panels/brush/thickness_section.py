"""How thick paint lies, and what a brush heaps on the layer of heights."""

from __future__ import annotations

from dataclasses import replace

from app.actions.actions import keyed
from app.desk.desk import Desk
from app.panels.controls import widgets as w
from engine.brush.settings import AUTO
from engine.light.light import BY_IMPASTO

_THICK, _HIGH = 16.0, 64.0  # px of the screen
_KINDS = (
    ("paint", "By lightness", "Light paint makes high land; in the view of the land it heaps, and dark paint carves"),
    (AUTO, "Heaps", "Heaps a height of its own, of the same shape at any depth; below 0 it carves"),
)


def draw_thickness(desk: Desk) -> None:
    """Draws what the brush has of it on the layer that is painted on."""
    row, brush = desk.known.active, desk.hand.brush
    if not desk.hand.stroke_mode().heaps:
        return
    if row is not None and row.height:
        kind = w.segments("kind of height", "paint" if brush.height is None else AUTO, _KINDS)
        if kind is not None:
            desk.hand.change(height=None if kind == "paint" else AUTO)
            _show(desk, kind != "paint")
        brush = desk.hand.brush
        if brush.heaps is not None and brush.row.lays_ink:
            hint = "How high the middle of the stroke lies, in pixels; below 0 it is carved"
            changed, value = w.slider("Height", brush.heaps, (-_HIGH, _HIGH), hint, form="%.1f px")
            if changed:
                desk.hand.change(height=round(value, 1))
                _show(desk, bool(value))
    elif brush.row.lays_ink:
        hint = keyed("How thick the paint lies: it shows in the light", "light")
        changed, value = w.slider("Impasto", brush.impasto, (0.0, _THICK), hint, form="%.1f px")
        if changed:
            desk.hand.change(impasto=round(value, 1))
            _show(desk, bool(value))


def _show(desk: Desk, thick: bool) -> None:
    """Turns a light on that shows how thick paint lies, where none is on."""
    state = desk.light
    if thick and not state.on:
        state.on, state.light = True, replace(state.light, height=BY_IMPASTO)
