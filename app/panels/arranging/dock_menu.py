"""The menu of a panel: to the other column, over the canvas, up, down, away."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.arranging.arrangement import COLUMNS, DOCKS, Arrangement, PanelBox, docked, floated, shown_or_hidden
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w


def draw_dock_menu(desk: Desk, name: str, asked: bool) -> None:
    """Draws it into the panel's window while it is open; `asked`: it opens now."""
    if asked:
        imgui.open_popup("panel menu")
    if not imgui.begin_popup("panel menu"):
        return
    told = desk.arranged.now
    said.text_disabled(DOCKS[name].title)
    for side in COLUMNS:
        if told.side(name) != side and _row(f"To the {side}", f"Into the column on the {side}"):
            desk.arranged.now = docked(told, name, side)
    if told.side(name) != "floating" and _row("Float", "Over the canvas; drag its header back into a column"):
        desk.arranged.now = floated(told, name, float_box(desk, name))
    for label, by in (("Up", -1), ("Down", 1)):
        other = neighbour(told, name, by)
        if other and _row(label, f"{'Above' if by < 0 else 'Below'} {DOCKS[other].title}"):
            desk.arranged.now = stepped(told, name, by)
    if _row("Hide", "View > Each panel shows it again"):
        desk.arranged.now = shown_or_hidden(told, name)
    imgui.separator()
    if _row("Panels and workspaces…", "All panels in one list; arrangements under names"):
        desk.asked.show("workspaces")
    imgui.end_popup()


def _row(label: str, hint: str) -> bool:
    pressed = said.menu_item(label, "", False)[0]
    w.named(label)
    w.tooltip(hint)
    return bool(pressed)


def neighbour(told: Arrangement, name: str, by: int) -> str:
    """Returns the panel above (-1) or below (1) it in its column; "" for none."""
    names = told.column(told.side(name)) if told.side(name) in COLUMNS else ()
    place = names.index(name) + by if name in names else -1
    return names[place] if 0 <= place < len(names) else ""


def stepped(told: Arrangement, name: str, by: int) -> Arrangement:
    """Returns it with a panel on the other side of its neighbour above (-1) or below (1), if there is one."""
    other = neighbour(told, name, by)
    if not other:
        return told
    side, names = told.side(name), told.column(told.side(name))
    if by < 0:
        return docked(told, name, side, other)
    after = names.index(other) + 1
    return docked(told, name, side, names[after] if after < len(names) else "")


def float_box(desk: Desk, name: str) -> PanelBox:
    """Returns where a panel floats at first, points: in the corner of the canvas on its side."""
    unit, told = desk.scale * max(1.0, imgui.get_style().font_scale_main), desk.arranged.now
    wide = told.widths[told.side(name) == "right"] * unit
    left, top, right, _ = desk.free_area()
    x = left + 12 * desk.scale if desk.arranged.now.side(name) == "left" else right - wide - 12 * desk.scale
    return x / unit, (top + 12 * desk.scale) / unit, wide / unit, DOCKS[name].high
