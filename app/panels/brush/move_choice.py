"""The button of the tools that drag what is there: layers, the frame, guides; and the list that it opens."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.actions import actions
from app.desk.desk import Desk
from app.desk.framing.frame_state import FRAME_TOOL
from app.language import said
from app.panels.controls import widgets as w
from app.tools.tools import TOOLS

MOVING_TOOLS = "move", FRAME_TOOL, "guides"
_HELD = 0.4  # seconds that it is held down, until the list opens
_SIGN = 0.28  # of the button's side: the corner that tells of the list


def draw(desk: Desk, side: float) -> None:
    """Draws the button of the one in hand, else of the first, `side` pixels wide; a right click, or holding it, opens
    the list."""
    name = desk.hand.tool if desk.hand.tool in MOVING_TOOLS else MOVING_TOOLS[0]
    action, hint = actions.ACTIONS[name], f"{actions.tip(name)}.  Hold, or right click: the frame and guides"
    if w.icon_button(name, TOOLS[name].icon, hint, on=desk.hand.tool == name, size=side):
        actions.perform(desk, action)
    end = imgui.get_item_rect_max()
    held = imgui.is_item_active() and imgui.get_io().mouse_down_duration[0] > _HELD
    if held or (imgui.is_item_hovered() and imgui.is_mouse_clicked(imgui.MouseButton_.right)):
        imgui.open_popup("moving tools")
    long, painter = _SIGN * side, imgui.get_window_draw_list()
    corners = ImVec2(end.x, end.y - long), end, ImVec2(end.x - long, end.y)
    painter.add_triangle_filled(*corners, theme.packed(theme.look.quiet))
    if imgui.begin_popup("moving tools"):
        _list(desk)
        imgui.end_popup()


def _list(desk: Desk) -> None:
    for name in MOVING_TOOLS:
        action, tool = actions.ACTIONS[name], TOOLS[name]
        keys = action.keys[0] if action.keys else ""
        if said.menu_item(f"{tool.icon}  {tool.title}", keys, desk.hand.tool == name)[0]:
            actions.perform(desk, action)
        w.named(f"tool {name}")
        w.tooltip(action.hint)
