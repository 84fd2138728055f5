"""The dialog before a placement becomes paint that is coarser than what it shows, or flat."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.studio.requests import Do


class BakeDialog:
    """Tells at which level its detail ends, and makes it independent if that is wanted."""

    title = "Make independent"

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        command, width = desk.asked.bake, imgui.get_font_size() * 10
        if command is None:
            return False
        fine, flat = desk.asked.bake_loses
        if fine:
            said.text_unformatted(f"Detail finer than level {command.level} is lost in this layer.")
        if flat:
            said.text_unformatted("Its paint is flat: how thick it lies stays in its source.")
        said.text_disabled("What it shows stays in its source, every level of it.")
        imgui.spacing()
        if w.default_button("Make independent", "Make pixels of that level", width=width):
            desk.post(Do(command))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Leave it as it is", width=width)
