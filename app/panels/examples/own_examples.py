"""Renaming and deleting the artist's own examples: a menu, two buttons, and the small windows that they open."""

from __future__ import annotations

from imgui_bundle import imgui

from app import icons
from app.desk.desk import Desk
from app.desk.examples import example_state, example_work
from app.desk.examples.example_state import Entry
from app.language import said
from app.panels.controls import widgets as w


class OwnExamples:
    """Remembers which one it is about, and the name as it is typed."""

    def __init__(self) -> None:
        self._entry: Entry | None = None
        self._name, self._opens = "", ""

    def rename(self, entry: Entry) -> None:
        """Asks for another name."""
        self._entry, self._name, self._opens = entry, entry.title, "rename example"

    def delete(self, desk: Desk, entry: Entry) -> None:
        """Takes it away, after asking if something is painted with it."""
        if example_work.users(desk, entry):
            self._entry, self._opens = entry, "delete example"
        else:
            example_work.delete_example(desk, entry)

    def menu(self, desk: Desk, entry: Entry) -> None:
        """Draws what a right click on its thumbnail opens, and a double click."""
        if imgui.is_item_hovered() and imgui.is_mouse_double_clicked(0):
            self.rename(entry)
        if not imgui.begin_popup_context_item(f"own {entry.name}"):
            return
        if said.selectable("Rename…", False)[0]:
            self.rename(entry)
        if said.selectable("Delete", False)[0]:
            self.delete(desk, entry)
        imgui.end_popup()

    def buttons(self, desk: Desk, entry: Entry) -> None:
        """At the right end of the line."""
        side, gap = imgui.get_frame_height(), 2 * desk.scale
        imgui.same_line(imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x - 2 * side - gap)
        if w.icon_button("rename", icons.PENCIL, "Rename this example of your own", size=side):
            self.rename(entry)
        imgui.same_line(0, gap)
        if w.icon_button("delete", icons.DELETE, "Delete this example of your own", size=side):
            self.delete(desk, entry)

    def draw(self, desk: Desk) -> None:
        """Draws the small window that is open, if there is one."""
        if self._opens:
            imgui.open_popup(self._opens)
            self._opens = ""
        entry = self._entry
        if entry is not None and imgui.begin_popup("rename example"):
            self._ask_name(desk, entry)
            imgui.end_popup()
        if entry is not None and imgui.begin_popup("delete example"):
            self._ask_delete(desk, entry)
            imgui.end_popup()

    def _ask_name(self, desk: Desk, entry: Entry) -> None:
        em = imgui.get_font_size()
        said.text_disabled("Rename this example")
        if imgui.is_window_appearing():
            imgui.set_keyboard_focus_here()
        imgui.set_next_item_width(em * 14)
        flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
        entered, self._name = imgui.input_text("##name", self._name, flags)
        w.tooltip("What it is called in the palette")
        name = example_state.renamed(self._name, entry, desk.examples.entries)
        if name and name != " ".join(self._name.split()):
            said.text_disabled(f"It will be called “{name}”")
        done = w.text_button("Rename", "Call it so from now on", enabled=bool(name), width=em * 6)
        imgui.same_line()
        if done or entered:
            example_work.rename(desk, entry, self._name)
        if w.text_button("Cancel", "Leave its name", width=em * 6) or done or entered:
            imgui.close_current_popup()

    def _ask_delete(self, desk: Desk, entry: Entry) -> None:
        em = imgui.get_font_size()
        said.text_unformatted(f"Delete “{entry.title}”? It is used by {example_work.users(desk, entry)}.")
        said.text_disabled("What is painted with it stays.")
        done = w.text_button("Delete", "Delete it; this cannot be taken back", width=em * 6)
        imgui.same_line()
        if done:
            example_work.delete_example(desk, entry)
        if w.text_button("Cancel", "Keep it", width=em * 6) or done:
            imgui.close_current_popup()
