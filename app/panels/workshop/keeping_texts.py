"""Keeping a written texture: a button asks for a name under which it is among one's own, or for a file to share."""

from __future__ import annotations

from imgui_bundle import imgui

from app import icons
from app.desk.desk import Desk
from app.desk.workshop.workshop_work import keep_text, own_path, text_stem
from app.language import said
from app.panels.controls import widgets as w


class KeepText:
    """Remembers the name as it is typed."""

    def __init__(self) -> None:
        self._name = ""

    def draw(self, desk: Desk) -> None:
        """Draws the button, and what it opens."""
        state = desk.workshop
        hint = "Keep it among yours, in the list of examples, or share it as a file"
        if w.icon_button("keep text", icons.DISK, hint, enabled=state.right):
            self._name = text_stem(state.name)
            imgui.open_popup("keep text")
        if not imgui.begin_popup("keep text"):
            return
        em = imgui.get_font_size()
        said.text_disabled("Keep this texture")
        if imgui.is_window_appearing():
            imgui.set_keyboard_focus_here()
        imgui.set_next_item_width(em * 14)
        entered, self._name = imgui.input_text("##name", self._name, imgui.InputTextFlags_.enter_returns_true)
        w.named("name")
        w.tooltip("Its name among your own textures")
        path = own_path(self._name)
        name, there = path.stem, str(path) in (state.files or ())
        said.text_disabled("Replaces your texture of this name" if there else f"Saved as “{name}”")
        if (w.text_button("Save", "Keep it: it is listed under Yours", width=em * 6) or entered) and state.right:
            keep_text(desk, path)
            imgui.close_current_popup()
        imgui.same_line()
        if w.text_button("Share…", "Write it as a small file, which others can open", width=em * 6):
            imgui.close_current_popup()
            desk.asked.show("texture text to")
        imgui.end_popup()
