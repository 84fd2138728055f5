"""The small field above the status line in which level and place are typed and copied."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.places import going
from app.language import said
from app.panels.controls import widgets as w

_NAME = "go to place"
_HINT = "Level, x, y: 12, 4096, 2048.  A level alone stays here; with width and height, all of that is shown"
_FLAGS = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all


class PlaceField:
    """Remembers whether it was opened: what closes it, a click elsewhere say, ends the typing."""

    def __init__(self) -> None:
        self._open = False

    def draw(self, desk: Desk) -> None:
        """Draws it while it is open."""
        if desk.places.typed is None:
            return
        fresh, self._open = not self._open, True
        if fresh:
            imgui.open_popup(_NAME)
        above = imgui.get_font_size() + 17 * desk.scale  # the status line
        at = ImVec2(desk.view.width - 10 * desk.scale, desk.view.height - above)
        imgui.set_next_window_pos(at, imgui.Cond_.always, ImVec2(1, 1))
        if imgui.begin_popup(_NAME):
            _fill(desk, fresh)
            imgui.end_popup()
        else:
            desk.places.typed = None
        self._open = desk.places.typed is not None


def _fill(desk: Desk, fresh: bool) -> None:
    places = desk.places
    said.text_disabled("Level, x, y of the middle")
    if fresh:
        imgui.set_keyboard_focus_here()
    imgui.set_next_item_width(20 * imgui.get_font_size())
    entered, text = imgui.input_text("##place", places.typed or "", _FLAGS)
    places.typed = text
    if imgui.is_item_active():  # what is typed goes there
        w.named("place")
    w.tooltip(_HINT)
    imgui.same_line()
    if w.text_button("Copy", "Copy this place; it can be pasted here"):
        imgui.set_clipboard_text(text)
    imgui.same_line()
    if w.text_button("Go", "Go to this place  (Return)") or entered:
        places.fault = going.go_to_typed(desk, text)
        if not places.fault:
            places.typed = None
            imgui.close_current_popup()
    if places.fault:
        said.text_colored(theme.vec(theme.look.warn), places.fault)
        w.named("place fault")
