"""The dialog of a save that would replace what another program, or another window, has in the file."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.studio.results import Overtaken


class OvertakenSave:
    """Asks what is to become of a save: another name, over what is there, or that is opened instead."""

    def __init__(self, told: Overtaken) -> None:
        self._told = told
        self.title = "Open in another window" if told.elsewhere else "Changed on the disk"

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is answered."""
        path, elsewhere = self._told.path, self._told.elsewhere
        em = imgui.get_font_size()
        imgui.push_text_wrap_pos(imgui.get_cursor_pos_x() + em * 33)
        if elsewhere:
            said.text_unformatted(f"{path.name} is open in another window of Inkfall.")
            said.text_disabled("Each window saves over what the other has saved.")
        else:
            said.text_unformatted(f"Another program, or another window, has saved {path.name}.")
            said.text_disabled("Saving here would replace what is there now.")
        imgui.pop_text_wrap_pos()
        imgui.spacing()
        if w.default_button("Save as…", "Keep both: save this painting under another name", width=em * 8):
            desk.asked.show("save as")
            return False
        imgui.same_line()
        if w.text_button(
            "Overwrite", "Put this painting in its place; the other is kept as an earlier version", width=em * 8
        ):
            desk.save(path, sure=True)
            return False
        if not elsewhere:
            imgui.same_line()
            if w.text_button("Open the other", "Leave this painting, and open what is there now", width=em * 8):
                desk.asked.give_up()
                desk.guard(lambda: desk.open(path))
                return False
        imgui.same_line()
        if w.text_button("Cancel", "Go back to the painting; it is not saved", width=em * 7):
            desk.asked.give_up()
            return False
        return True
