"""The settings of the quick mask, in the bar above the canvas while it is painted on."""

from __future__ import annotations

from imgui_bundle import imgui

from app.actions.actions import ACTIONS, perform, tip
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import colour_popup
from app.panels.options.fill_options import slid, spaced

_POPUP = "mask colour"


def draw_mask(desk: Desk) -> None:
    """Fills the present window, one line high."""
    state, side = desk.selecting, imgui.get_frame_height()
    imgui.align_text_to_frame_padding()
    said.text_unformatted("Quick mask")
    spaced()
    said.text_disabled("any colour selects, the eraser takes away")
    spaced()
    if w.swatch("mask tint", state.mask_colour, "The colour over what is not selected", (1.6 * side, side)):
        imgui.open_popup(_POPUP)
    state.mask_colour = colour_popup(_POPUP, state.mask_colour) or state.mask_colour
    spaced()
    state.mask_part = round(slid("Tint", state.mask_part * 100, 100.0, "%.0f%%", "How strong that colour is") / 100, 3)
    for name in ("select_invert", "quick_mask"):
        spaced()
        label = "Done" if name == "quick_mask" else ACTIONS[name].title
        if w.text_button(label, tip(name), enabled=ACTIONS[name].when(desk)):
            perform(desk, ACTIONS[name])
