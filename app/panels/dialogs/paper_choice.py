"""What a painting is painted on: a row of a dialog, and the dialog that changes it."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import colour_popup
from engine.painting import commands as c
from engine.studio.requests import Do

_WHITE = "#ffffff"


class PaperChoice:
    """A tick, and a colour beside it.  `colour`: "#rrggbb", None for no paper."""

    def __init__(self, colour: str | None) -> None:
        self._there = colour is not None
        told = colour or _WHITE
        red, green, blue = (int(told[1 + 2 * i : 3 + 2 * i], 16) / 255 for i in range(3))
        self._paper = red, green, blue

    @property
    def colour(self) -> str | None:
        """Gives what is chosen now."""
        return "#" + "".join(f"{round(255 * part):02x}" for part in self._paper) if self._there else None

    def draw(self, column: float) -> None:
        """Draws it into the present window, the colour from a column on, as wide as that."""
        hint = "A ground of one colour under all layers; without it, what is not painted is clear"
        _, self._there = w.tick("Paper", self._there, hint)
        imgui.same_line(column + imgui.get_style().item_spacing.x + imgui.get_cursor_start_pos().x)
        imgui.begin_disabled(not self._there)
        if w.swatch("paper", self._paper, "The colour of the paper", (column, imgui.get_frame_height())):
            imgui.open_popup("paper colour")
        imgui.end_disabled()
        self._paper = colour_popup("paper colour", self._paper) or self._paper


class PaperDialog:
    """Asks for the paper.  Nothing that was painted changes."""

    title = "Paper"

    def __init__(self, colour: str | None) -> None:
        self._choice = PaperChoice(colour)

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em = imgui.get_font_size()
        self._choice.draw(em * 7)
        imgui.spacing()
        if w.default_button("Set paper", "Give the painting this paper", width=em * 7):
            if self._choice.colour != desk.known.paper:
                desk.post(Do(c.SetPaper(self._choice.colour)))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Keep the paper", width=em * 7)
