"""What is selected, in few words in the status line, with a cross that selects nothing."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.actions import ACTIONS, perform, tip
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.studio.selecting.ants_records import Ants


def chip_text(ants: Ants | None) -> str:
    """Returns what is told of a selection: its size at its level, and its feather; "" where nothing is selected."""
    if ants is None or not ants.selected:
        return ""
    found = ants.measure
    if found is None:
        return "Selected" if ants.bounded else "All selected"
    size = f"{found.bounds.width:,} × {found.bounds.height:,}"
    soft = f", feather {found.feather}" if found.feather else ""
    return f"{'' if ants.bounded else 'all but '}{size}{soft}"


def _hint(ants: Ants) -> str:
    found = ants.measure
    if found is None:
        return "What is selected"
    return f"What is {'selected' if ants.bounded else 'not selected'}, in pixels of level {found.level}"


def draw(desk: Desk, right: float) -> float:
    """Draws the chip so that it ends there; returns where it begins, or `right` where there is none."""
    ants = desk.selecting.ants
    text = chip_text(ants)
    if ants is None or not text:
        return right
    em, line = imgui.get_font_size(), imgui.get_text_line_height()
    label = f"{icons.SELECT_BOX}  {text}"
    left = right - said.calc_text_size(label).x - line - 0.9 * em
    imgui.same_line(left)
    corner, pad = imgui.get_cursor_screen_pos(), 0.35 * em
    end = ImVec2(corner.x + right - left, corner.y + line)
    painter = imgui.get_window_draw_list()
    low, high = ImVec2(corner.x - pad, corner.y - 2 * desk.scale), ImVec2(end.x, end.y + 2 * desk.scale)
    painter.add_rect_filled(low, high, theme.packed(theme.look.accent_soft), 4 * desk.scale)
    said.text_unformatted(label)
    w.named(text)
    w.tooltip(_hint(ants))
    imgui.same_line(right - line - 0.2 * em)
    if w.icon_button("deselect", icons.CLOSE, tip("select_none"), size=line):
        perform(desk, ACTIONS["select_none"])
    return left - pad
