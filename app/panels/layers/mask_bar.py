"""The bar above the canvas that tells that a mask is painted on."""

from __future__ import annotations

from imgui_bundle import imgui

from app import icons, theme
from app.actions import actions
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.fitting import ended

MASK_BAR_WIDTH = 46.0  # ems
_NAMED = 11.0  # ems for a name
_ONCE = "white shows, black hides: here, not in each repeat"


def wanted(desk: Desk) -> bool:
    """Tells whether it is to be seen."""
    return desk.panels and desk.masks.on(desk.known.active)


def draw(desk: Desk) -> None:
    """Fills the present window, one line high."""
    row, em = desk.known.active, imgui.get_font_size()
    if row is None:
        return
    imgui.align_text_to_frame_padding()
    said.text_colored(theme.vec(theme.look.accent), f"{icons.MASK}  Mask of {ended(row.name, _NAMED * em)}")
    w.named("mask bar")
    w.tooltip("Brush, fills and gradients go to the mask: white shows, black hides, the eraser hides")
    imgui.same_line(0, em)
    said.text_disabled("white shows, black hides" if row.wrap is None else _ONCE)
    imgui.same_line(0, em)
    for name, label in (("mask_alone", "Painting" if desk.masks.alone else "Alone"), ("mask_invert", "Invert")):
        if w.text_button(label, actions.tip(name)):
            actions.perform(desk, actions.ACTIONS[name])
        imgui.same_line()
    if w.text_button("Done", "Paint on the layer again"):
        desk.masks.end(desk.post)
