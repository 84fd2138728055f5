"""The menu bar: the table of actions by menu, and the painting's name."""

from __future__ import annotations

from imgui_bundle import imgui

from app.actions.action import Action
from app.actions.actions import ACTIONS, MENUS, perform
from app.desk.desk import Desk
from app.language import said
from app.language.words import say
from app.panels import recent_menu
from app.panels.arranging.workspaces_dialog import draw_workspaces
from app.panels.controls import widgets as w


def draw(desk: Desk) -> float:
    """Draws it over the whole width; returns its height, pixels."""
    if not imgui.begin_main_menu_bar():
        return 0.0
    for menu in MENUS:
        if not said.begin_menu(menu):
            w.named(f"{menu} menu")
            continue
        _rows(desk, menu)
        imgui.end_menu()
    _title(desk)
    height = imgui.get_window_height()
    imgui.end_main_menu_bar()
    return height


def _rows(desk: Desk, menu: str) -> None:
    """Draws the rows of a menu, those of each within it at the place of its first."""
    drawn: set[str] = set()
    for action in ACTIONS.values():
        if action.menu == menu:
            _item(desk, action)
            if action is ACTIONS["open"]:
                recent_menu.draw(desk)
            elif action is ACTIONS["workspaces"]:
                draw_workspaces(desk)
        elif action.menu.startswith(f"{menu}/") and action.menu not in drawn:
            drawn.add(action.menu)
            title = action.menu.partition("/")[2]
            opened = said.begin_menu(title)
            w.named(f"{title} menu")
            if opened:
                _rows(desk, action.menu)
                imgui.end_menu()


def _item(desk: Desk, action: Action) -> None:
    keys = action.keys[0] if action.keys else ""
    on = bool(action.checked and action.checked(desk))
    if said.menu_item(action.title, keys, on, action.when(desk))[0]:
        perform(desk, action)
    w.named(action.title)
    w.tooltip(action.hint)


def _title(desk: Desk) -> None:
    title = desk.known.title if desk.known.path is not None else say(desk.known.title)
    text = f"{title}{' *' if desk.known.modified else ''}"
    middle = (desk.view.width - imgui.calc_text_size(text).x) / 2
    imgui.same_line(max(middle, imgui.get_cursor_pos_x() + imgui.get_font_size()))  # beside the menus of a small window
    imgui.text_disabled(text)
