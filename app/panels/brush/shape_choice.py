"""The button of the shapes that the brush draws, and the list that it opens."""

from __future__ import annotations

from imgui_bundle import imgui

from app import icons
from app.actions import actions
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from app.tools.shape_gestures import DRAWN
from app.tools.tools import TOOLS


def draw(desk: Desk, side: float) -> None:
    """Draws the button, `side` pixels wide, lit while a shape is chosen."""
    chosen = desk.hand.tool in DRAWN
    icon = TOOLS[desk.hand.tool].icon if chosen else icons.SHAPES
    if w.icon_button("shapes", icon, "Lines, curves, rectangles, ellipses, drawn by the brush", on=chosen, size=side):
        imgui.open_popup("shapes")
    if not imgui.begin_popup("shapes"):
        return
    for name in DRAWN:
        action, tool = actions.ACTIONS[name], TOOLS[name]
        if said.menu_item(f"{tool.icon}  {tool.title}", (*action.keys, "")[0], desk.hand.tool == name)[0]:
            actions.perform(desk, action)
        w.named(f"shape {name}")
        w.tooltip(tool.hint)
    imgui.end_popup()
