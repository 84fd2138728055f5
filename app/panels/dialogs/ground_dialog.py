"""The dialog for a height map that becomes ground of the land: how high it is, and how it goes on."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.desk.desk import Desk
from app.desk.outside.ground_maps import lay_map
from app.language import said
from app.panels.controls import widgets as w
from engine.painting.layering.ground_command import ROCK

_MOST_ROCK = 2.0
_HIGHEST = 4.0  # times as high as it is at first


class GroundDialog:
    """Asks how high a map's highest lies above its lowest, how rough the ground below its pixels is, and how far its
    rim runs out."""

    title = "Ground"
    aside = True

    def __init__(self, desk: Desk) -> None:
        assert desk.asked.ground is not None
        self._found = desk.asked.ground
        low, high = self._found.ends
        self._usual = max(high - low, 1e-3)
        self._height, self._rock, self._rim = self._usual, ROCK, 0.0

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is answered."""
        em, found = imgui.get_font_size(), self._found
        imgui.dummy(ImVec2(22 * em, 0))
        imgui.push_text_wrap_pos(22 * em)
        said.text_unformatted(found.told)
        imgui.pop_text_wrap_pos()
        usual = "; at first true to scale, as the file tells it" if found.scaled else ""
        hint = f"Pixels from its lowest to its highest{usual}"
        self._height = w.slider("Height", self._height, (0.0, _HIGHEST * self._usual), hint)[1]
        hint = "Finer ground below its pixels: 1 for as rough as it is itself, 0 for none"
        self._rock = w.slider("Finer rock", self._rock, (0.0, _MOST_ROCK), hint)[1]
        most = min(found.size) / 2
        self._rim = w.slider("Soft rim", self._rim, (0.0, most), "Pixels over which it grows from what is there")[1]
        imgui.spacing()
        if w.default_button("Lay", "Lay it as ground of the land, in one step", width=em * 7):
            low = found.ends[0] * self._height / self._usual
            lay_map(desk, found, (low, low + self._height), self._rock, self._rim)
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Leave the land as it is", width=em * 7)
