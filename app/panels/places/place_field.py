"""The small field above the status line in which level and place are typed and copied."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.places import going
from app.panels.controls import widgets as w

_NAME = "go to place"
_HINT = "Level, x, y: 12, 4096, 2048.  A level alone stays here; with width and height, all of that is shown"
_FLAGS = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all


def draw(desk: Desk) -> None:
    """Draws it while it is open."""
    places = desk.places
    if places.typed is None:
        return
    fresh = not imgui.is_popup_open(_NAME)
    if fresh:
        imgui.open_popup(_NAME)
    above = imgui.get_font_size() + 17 * desk.scale  # the status line
    at = ImVec2(desk.view.width - 10 * desk.scale, desk.view.height - above)
    imgui.set_next_window_pos(at, imgui.Cond_.always, ImVec2(1, 1))
    if not imgui.begin_popup(_NAME):
        places.typed = None
        return
    imgui.text_disabled("Level, x, y of the middle")
    if fresh:
        imgui.set_keyboard_focus_here()
    imgui.set_next_item_width(20 * imgui.get_font_size())
    entered, places.typed = imgui.input_text("##place", places.typed, _FLAGS)
    w.named("place")
    w.tooltip(_HINT)
    imgui.same_line()
    copied = w.text_button("Copy", "Copy this place; it can be pasted here")
    imgui.same_line()
    if w.text_button("Go", "Go to this place  (Return)") or entered:
        places.fault = going.go_to_typed(desk, places.typed)
        if not places.fault:
            places.typed = None
            imgui.close_current_popup()
    if copied:
        imgui.set_clipboard_text(places.typed or "")
    if places.fault:
        imgui.text_colored(theme.vec(theme.WARN), places.fault)
        w.named("place fault")
    imgui.end_popup()
