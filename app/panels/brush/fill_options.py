"""The settings of the tools Fill, Gradient and Wand: shown with the brush while one of them is in hand."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.desk.filling.fill_state import WIDEST_SHOWN
from app.desk.filling.gradients import GRADIENT_SHAPES
from app.panels.controls import widgets as w

OF_TOOLS = {
    "fill": ("Fill", "A click fills a region with the brush, whatever that does"),
    "gradient": ("Fill", "A drag fills with a gradient"),
    "wand": ("Wand", "A click selects a region"),
}  # the section's title and hint, by tool
_FILLS = (
    ("fill", "Region", "Click a region: the brush fills it  (G)"),
    ("gradient", "Gradient", "Drag: one colour turns into another  (Shift+G)"),
)
_ENDS = (("other", "Other colour", "It ends in the other colour"), ("nothing", "Transparent", "It fades to nothing"))


def draw(desk: Desk) -> None:
    """Draws the section."""
    if not w.section(*OF_TOOLS[desk.hand.tool]):
        return
    if desk.hand.tool != "wand":
        tool = w.segments("fills", desk.hand.tool, _FILLS)
        if tool is not None:
            desk.hand.use(tool)
    if desk.hand.tool == "gradient":
        _gradient(desk)
    else:
        _likeness(desk)


def _gradient(desk: Desk) -> None:
    state = desk.filling
    state.shape = w.segments("shape", state.shape, GRADIENT_SHAPES) or state.shape
    end = w.segments("end", "nothing" if state.fades else "other", _ENDS)
    if end is not None:
        state.fades = end == "nothing"


def _likeness(desk: Desk) -> None:
    state = desk.filling
    hint = "How far colours may differ from the one you click"
    changed, value = w.slider("Tolerance", state.tolerance * 100, (0.0, 100.0), hint, form="%.0f%%")
    if changed:
        state.tolerance = round(value / 100, 4)
    hint = "Gaps in lines up to this width count as closed"
    changed, value = w.slider("Close gaps", state.gap, (0.0, WIDEST_SHOWN), hint, form="%.0f px")
    if changed:
        state.gap = round(value)
    _, state.seen = w.tick("All layers", state.seen, "Look at all that is seen, not at the layer alone")
    imgui.same_line(0, imgui.get_font_size())
    _, state.contiguous = w.tick("One region", state.contiguous, "Off: everything in sight that is of that colour")
