"""How colours are taken, in the bar above the canvas while that tool is in hand."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.panels.controls import widgets as w
from app.panels.options.fill_options import slid, spaced

PICK_OPTIONS_WIDTH = 43.0  # of the bar, ems
_WIDEST = 64.0
_FROM = (
    ("seen", "What is seen", "The colour that shows, of all layers together"),
    ("layer", "The layer", "The colour that the chosen layer has there, whatever lies above it"),
)


def draw_pick(desk: Desk) -> None:
    """Fills the present window, one line high."""
    state, em = desk.picking, imgui.get_font_size()
    picked = w.segments("pick from", "layer" if state.layer else "seen", _FROM, 14 * em)
    if picked is not None:
        state.layer = picked == "layer"
    spaced()
    hint = "The mean of a disc this large; 0 is the pixel alone"
    state.radius = round(slid("Radius", state.radius, _WIDEST, "%.0f px", hint, 13))
    spaced()
    _, state.ink = w.tick("The ink, too", state.ink, "The brush gets the textures and the colour of the stroke there")
