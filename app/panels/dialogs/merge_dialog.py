"""The dialog before layers are merged whose texture cannot stay texture."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.panels.controls import widgets as w
from engine.studio.requests import Do


class MergeDialog:
    """Tells to which level the detail stays, and merges if that is wanted."""

    title = "Merge"

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em, level = imgui.get_font_size(), desk.asked.merge_level
        imgui.push_text_wrap_pos(em * 25)
        imgui.text_unformatted(f"Merge at level {level}: textured ink gets no finer than that.")
        imgui.text_disabled("What you see now stays as it is, at this level and all coarser ones.")
        imgui.pop_text_wrap_pos()
        imgui.spacing()
        if w.default_button("Merge", "Make one layer", width=em * 7):
            if desk.asked.merge is not None:
                desk.post(Do(desk.asked.merge))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Leave the layers as they are", width=em * 7)
