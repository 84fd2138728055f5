"""Where panels lie, in one list that the keyboard reaches, and arrangements of them under names."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons
from app.desk.arranging.arrangement import (
    COLUMNS,
    DOCKS,
    NARROWEST_COLUMN,
    WIDEST_COLUMN,
    Arrangement,
    docked,
    floated,
    shown_or_hidden,
    sides_swapped,
    widened,
)
from app.desk.arranging.kept_arrangement import LONGEST_NAME, MOST_WORKSPACES
from app.desk.desk import Desk
from app.language import said
from app.panels.arranging.dock_menu import float_box, neighbour, stepped
from app.panels.controls import widgets as w

_PLACES = (
    ("left", "Left", "In the column on the left"),
    ("right", "Right", "In the column on the right"),
    ("floating", "Floating", "Over the canvas"),
)
_WIDE = 30.0  # ems


class WorkspacesDialog:
    """Arranges the panels behind it at once; in a corner, so that they are seen."""

    title = "Panels and workspaces"
    aside = True  # the panels are to be seen

    def __init__(self) -> None:
        self._name = ""

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em = imgui.get_font_size()
        for name in (*desk.arranged.now.left, *desk.arranged.now.right, *sorted(desk.arranged.now.floating)):
            _panel_row(desk, name)
        if w.text_button("Swap the sides", "The left column to the right, for left-handers", width=em * 9):
            desk.arranged.now = sides_swapped(desk.arranged.now)
        imgui.same_line()
        if w.text_button("As at first", "All panels where they come, as wide and high", width=em * 9):
            desk.arranged.now = Arrangement()
        for n, side in enumerate(COLUMNS):
            told, ends = desk.arranged.now, (NARROWEST_COLUMN, WIDEST_COLUMN)
            hint = f"How wide the column on the {side} is"
            changed, wide = w.slider(f"Width on the {side}", told.widths[n], ends, hint, form="%.0f points")
            if changed:
                desk.arranged.now = widened(told, side, wide)
        imgui.spacing()
        imgui.separator()
        said.text_disabled("Workspaces")
        self._workspaces(desk)
        imgui.spacing()
        return not w.accent_button("Close", "All of it is kept", width=em * 7)

    def _workspaces(self, desk: Desk) -> None:
        arranged, em, side = desk.arranged, imgui.get_font_size(), imgui.get_frame_height()
        if not arranged.workspaces:
            said.text_disabled("None yet: arrange the panels, and give that a name.")
        high = min(len(arranged.workspaces), 6) * imgui.get_frame_height_with_spacing()
        if arranged.workspaces:
            imgui.begin_child("kept workspaces", ImVec2(_WIDE * em, high))
        for name in sorted(arranged.workspaces):
            imgui.push_id(name)
            hint = "Arrange the panels so"
            if w.lit_button(name, hint, arranged.workspaces[name] == arranged.now, (_WIDE - 1) * em - 3 * side):
                arranged.now = arranged.workspaces[name]
            imgui.same_line()
            if w.icon_button("keep workspace", icons.DISK, "Keep the panels under this name as they are now"):
                arranged.workspaces = arranged.workspaces.set(name, arranged.now)
            imgui.same_line()
            if w.icon_button("drop workspace", icons.DELETE, "Forget this workspace; the panels stay as they are"):
                arranged.workspaces = arranged.workspaces.delete(name)
            imgui.pop_id()
        if arranged.workspaces:
            imgui.end_child()
        imgui.set_next_item_width(14 * em)
        flags = imgui.InputTextFlags_.enter_returns_true
        entered, self._name = said.input_text_with_hint("##workspace", "Name", self._name[:LONGEST_NAME], flags)
        w.named("workspace name")
        w.tooltip("What this arrangement is to be called")
        imgui.same_line()
        name = " ".join(self._name.split())[:LONGEST_NAME]
        free = bool(name) and (name in arranged.workspaces or len(arranged.workspaces) < MOST_WORKSPACES)
        if (w.text_button("Keep as workspace", "Keep the panels as they are now", enabled=free) or entered) and free:
            arranged.workspaces, self._name = arranged.workspaces.set(name, arranged.now), ""


def _panel_row(desk: Desk, name: str) -> None:
    """Draws where a panel is, and what it can be done with."""
    told, em = desk.arranged.now, imgui.get_font_size()
    imgui.push_id(name)
    changed, _ = w.tick(f"Show {DOCKS[name].title.lower()}", name not in told.hidden, DOCKS[name].hint)
    if changed:
        desk.arranged.now = shown_or_hidden(told, name)
    imgui.same_line(11 * em)
    place = w.segments(f"place of {name}", told.side(name), _PLACES, 15 * em)
    if place == "floating":
        desk.arranged.now = floated(told, name, float_box(desk, name))
    elif place in COLUMNS:
        desk.arranged.now = docked(told, name, place)
    for label, icon, by in (("up", icons.UP, -1), ("down", icons.DOWN, 1)):
        imgui.same_line()
        there = bool(neighbour(told, name, by))
        if w.icon_button(f"{label} {name}", icon, f"Further {label} in its column", enabled=there):
            desk.arranged.now = stepped(told, name, by)
    imgui.pop_id()


def draw_workspaces(desk: Desk) -> None:
    """Draws the menu of the workspaces into the present menu."""
    opened = said.begin_menu("Workspaces", bool(desk.arranged.workspaces))
    w.named("Workspaces")
    w.tooltip("Arrangements of panels under names: View > Panels and workspaces keeps them")
    if not opened:
        return
    for name, told in sorted(desk.arranged.workspaces.items()):
        if said.menu_item(f"{name}##workspace", "", told == desk.arranged.now)[0]:
            desk.arranged.now, desk.panels = told, True
        w.named(name)
        w.tooltip("Arrange the panels so")
    imgui.end_menu()
