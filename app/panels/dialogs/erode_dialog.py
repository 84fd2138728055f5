"""The dialog for erosion of what is in view."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.numeric.address import Rect
from engine.painting.layering.erode_command import (
    MOST_ERODED,
    MOST_RAIN,
    RAIN,
    SHORTEST_ERODED,
    STRENGTH,
    TALUS,
    Erode,
)
from engine.studio.land.wear_records import WearDown

_STEEPEST = 3.0


def in_view(desk: Desk) -> tuple[int, Rect]:
    """Returns the level that is seen, and its pixels that the screen shows, no more than can be worn down at once."""
    level = desk.view.shown_level
    rect = desk.view.visible(level)
    while rect.area > MOST_ERODED:
        level, rect = level - 1, rect.zoomed(-1)
    x1, y1 = max(rect.x1, rect.x0 + SHORTEST_ERODED), max(rect.y1, rect.y0 + SHORTEST_ERODED)
    return level, Rect(rect.x0, rect.y0, x1, y1)


class ErodeDialog:
    """Asks for the weather, then shows how far it is; the canvas beside it stays in sight."""

    title = "Erode"
    aside = True

    def __init__(self) -> None:
        self._rain, self._strength, self._talus = RAIN, STRENGTH, TALUS
        self._begun = False

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em, part = imgui.get_font_size(), desk.known.wearing
        if part is not None:
            self._begun = True
            imgui.progress_bar(part, ImVec2(20 * em, 0), f"{part:.0%}")
            return not w.text_button("Stop", "Leave the land as it was", width=em * 7)  # what closes it ends it
        if self._begun:
            return False
        imgui.dummy(ImVec2(20 * em, 0))
        self._rain = w.slider("Rain", self._rain, (0.0, MOST_RAIN), "How much rain cuts gullies")[1]
        self._strength = w.slider("Strength", self._strength, (0.0, 1.0), "How much of the ground it takes")[1]
        hint = "How steep loose ground stays, in pixels a pixel; 0 for rock that never slides"
        self._talus = w.slider("Steepest", self._talus, (0.0, _STEEPEST), hint)[1]
        said.text_disabled("What is in view, as fine as you see it")
        imgui.spacing()
        if w.default_button("Erode", "Wear the land down, in one step", width=em * 7):
            level, rect = in_view(desk)
            desk.post(WearDown(Erode(rect, level, None, self._rain, self._strength, self._talus)))
            return True
        imgui.same_line()
        return not w.text_button("Cancel", "Leave the land as it is", width=em * 7)
