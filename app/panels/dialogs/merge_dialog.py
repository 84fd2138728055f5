"""The dialog before layers are merged whose texture cannot stay texture."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.studio.requests import Do

_MOST = 60  # levels: beyond, the number would be too long to read


class MergeDialog:
    """Tells how near the detail of textures stays, and merges if that is wanted."""

    title = "Merge"

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em, level = imgui.get_font_size(), desk.asked.merge_level
        imgui.push_text_wrap_pos(em * 25)
        near = f"{1 << min(level, _MOST)} times or closer" if level > 0 else "beyond its own pixels"
        said.text_unformatted(f"Textures in this paint end here: magnified {near}, they look soft.")
        said.text_disabled("As you see it now, and from farther away, the picture stays as it is.")
        imgui.pop_text_wrap_pos()
        imgui.spacing()
        if w.default_button("Merge", "Make one layer", width=em * 7):
            if desk.asked.merge is not None:
                desk.post(Do(desk.asked.merge))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Leave the layers as they are", width=em * 7)
