"""Analysis of the picture: spectrum, autocorrelation, all-pole model, regions (Lewis 1984, figures 1, 4)."""

from __future__ import annotations

import math

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.desk import Desk
from app.desk.outside import pictured
from app.language import said
from app.panels.controls import widgets as w
from app.panels.panel import Panel
from engine.numeric.address import Rect
from engine.studio.requests import Analyse
from engine.studio.textures.texture_results import Found

_PICTURES = (
    ("analysis power", "Power spectrum", "How strong each frequency is; zero in the middle, strongest is light"),
    (
        "analysis correlation",
        "Autocorrelation",
        "How alike the picture is to itself displaced; no displacement in the middle",
    ),
    ("analysis poles", "All-pole model", "The spectrum of the linear prediction (AR) fitted to the picture"),
    ("analysis regions", "Regions", "Each colour in a random one: how many regions there really are"),
)


class AnalysisPanel(Panel):
    """Draws the strip; the engine finds the facts one after the other, at first of what is in view."""

    def __init__(self) -> None:
        self._asked = False
        self._found: Found | None = None  # so far
        self.hears = {Found: self._heard}

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing
        facts = min(14.5 * imgui.get_font_size(), room.x * 0.3)
        imgui.begin_child("facts", ImVec2(facts, 0))
        self._ask(desk)
        self._facts(desk)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("pictures", ImVec2(0, 0))
        line = imgui.get_text_line_height_with_spacing()
        side = min((room.x - facts - 4 * gap.x) / 4, room.y - line)
        for i, (name, title, hint) in enumerate(_PICTURES):
            if i:
                imgui.same_line()
            imgui.begin_group()
            w.picture(self._picture(desk, name), (side, side), hint, name=title)
            said.text_disabled(title)
            imgui.end_group()
        tall = imgui.get_content_region_avail().y
        if tall > 2 * line:
            self._rings(desk, imgui.get_content_region_avail().x, tall)
        imgui.end_child()

    def _heard(self, _desk: Desk, found: Found, _now: float) -> None:
        self._found = found

    def _picture(self, desk: Desk, name: str) -> object | None:
        return desk.pictures.get(name) if self._found is not None and name in self._found.pictures else None

    def _ask(self, desk: Desk) -> None:
        wide = (imgui.get_content_region_avail().x - 2 * desk.scale) / 2
        if w.text_button("What is in view", "Looks at what the canvas shows, at the level shown", width=wide):
            self._look(desk, desk.view.shown_level, pictured.seen(desk))
        imgui.same_line(0, 2 * desk.scale)
        if w.text_button("The frame", "Looks at the whole frame at level 0", width=wide):
            self._look(desk, 0, desk.known.frame)
        if not self._asked:
            self._look(desk, desk.view.shown_level, pictured.seen(desk))

    def _look(self, desk: Desk, level: int, area: Rect) -> None:
        self._asked, self._found = True, None
        desk.post(Analyse(level, area))

    def _facts(self, desk: Desk) -> None:
        imgui.spacing()
        if self._found is None:
            said.text_disabled(f"{icons.WAIT} looking…")
            return
        for name, value in sorted(self._found.lines.items(), key=lambda line: _ORDER.index(line[0])):
            said.text_disabled(name)
            imgui.same_line(6.5 * imgui.get_font_size())
            said.text_unformatted(value)
        if not self._found.done:
            said.text_disabled(f"{icons.WAIT} looking…")

    def _rings(self, desk: Desk, wide: float, tall: float) -> None:
        """Power by frequency, both logarithmic; over it the model's."""
        rows = self._found.rings if self._found is not None else ()
        corner = w.picture(None, (wide, tall), "Power by frequency, coarse to fine: the picture, and the model over it")
        strongest = max((power for _, power, _ in rows), default=0.0)
        if strongest <= 0.0 or len(rows) < 2:
            return
        painter, low = imgui.get_window_draw_list(), math.log(rows[0][0])
        across = math.log(rows[-1][0]) - low

        def at(frequency: float, power: float) -> ImVec2:
            down = min(1.0, -math.log10(max(power / strongest, 1e-7)) / 6.0)
            return ImVec2(
                corner.x + wide * (math.log(frequency) - low) / across, corner.y + 4 + (tall - 8) * max(0.0, down)
            )

        for column, colour in ((1, theme.look.text), (2, theme.look.accent)):
            painter.add_polyline([at(row[0], row[column]) for row in rows], theme.packed(colour), 1.5, 0)


_ORDER = ("Size", "Level", "Colours", "Regions", "Falls as", "Model")
