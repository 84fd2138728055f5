"""The bar of the tool for guides: adds one, and shows the numbers of the one that is chosen, to be read and typed."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from app import icons
from app.actions import actions
from app.desk.colours import from_hex, to_hex
from app.desk.desk import Desk
from app.desk.guides import assistants
from app.desk.guides.guide_numbers import NUMBERS, GuideNumber
from app.desk.guides.reshaping import guide_at, places_of
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import colour_popup
from app.panels.controls.number_field import NumberFields, typed_number
from app.panels.guides.assistant_marks import GUIDE_COLOURS
from app.panels.options.options_bar import Options
from engine.painting.guiding.guides import Guide

_ADD, _SNAP, _REST, _FIELD = 10.0, 9.0, 9.0, 2.8  # parts of the bar, ems; _FIELD: besides its width


class GuideBar:
    """`_snap`, `_colour`: what is set while it is dragged."""

    def __init__(self) -> None:
        self._fields = NumberFields()
        self._snap: float | None = None
        self._colour: tuple[float, float, float] | None = None

    def options(self, desk: Desk) -> Options | None:
        """Returns what is to be seen; None for nothing."""
        if not desk.panels or desk.hand.tool != "guides":
            return None
        guide = _numbered(desk)
        if guide is None:
            return Options(_ADD + 10.0, self.draw)
        wide = 1.0 + sum(number.ems + _FIELD for number in NUMBERS[guide.kind])
        return Options(max(_ADD + _SNAP + _REST, wide), self.draw, 2)

    def draw(self, desk: Desk) -> None:
        """Fills the present window."""
        options = [(name, kind.title) for name, kind in assistants.ASSISTANTS.items()]
        hints = [kind.hint for kind in assistants.ASSISTANTS.values()]
        width = _ADD * imgui.get_font_size()
        picked = w.choice("Add a guide", "Add a guide", options, "A guide that strokes are drawn onto", width, hints)
        if picked is not None:
            assistants.add_guide(desk, picked)
        guide = _numbered(desk)
        imgui.same_line()
        if guide is None:
            changed, _ = w.tick("Snap to guides", desk.guides.snaps, actions.tip("snap_guides"))
            if changed:
                assistants.toggle_snaps(desk)
            return
        self._strength(desk, guide)
        self._look(desk, guide)
        for name, icon in (("hide_guide", icons.EYE_OFF), ("delete_guide", icons.DELETE)):
            imgui.same_line()
            if w.icon_button(name, icon, actions.tip(name)):
                actions.perform(desk, actions.ACTIONS[name])
        self._numbers(desk, guide)

    def _numbers(self, desk: Desk, guide: Guide) -> None:
        level = desk.view.shown_level
        origin = desk.view.centre.pixel(level)
        points = places_of(guide, level, origin)
        for row in NUMBERS[guide.kind]:
            text = self._fields.draw(f"{row.sign} of the guide", row.sign, row.read(points, origin), row.ems, row.hint)
            if text is not None:
                _typed(desk, guide, row, text)
            imgui.same_line(0, 0.6 * imgui.get_font_size())

    def _strength(self, desk: Desk, guide: Guide) -> None:
        """How much strokes are drawn onto it; one step when it is let go."""
        shown = guide.snap if self._snap is None else self._snap
        imgui.begin_child("snap", ImVec2(_SNAP * imgui.get_font_size(), imgui.get_frame_height()))
        changed, snap = w.slider("Snap", shown, (0.0, 1.0), "How much strokes are drawn onto it")
        if changed:
            self._snap = round(snap, 2)
        if self._snap is not None and not imgui.is_item_active():
            assistants.set_guide(desk, replace(guide, snap=self._snap))
            self._snap = None
        imgui.end_child()

    def _look(self, desk: Desk, guide: Guide) -> None:
        """The colour of its lines; one step when the picker closes."""
        imgui.same_line()
        side = imgui.get_frame_height()
        shown = self._colour or (GUIDE_COLOURS[0] if guide.colour is None else from_hex(guide.colour))
        if w.swatch("Colour of the guide", shown, "The colour of its lines", (side, side)):
            imgui.open_popup("guide colour")
        picked = colour_popup("guide colour", shown)
        if picked is not None:
            self._colour = picked
        if self._colour is not None and not imgui.is_popup_open("guide colour"):
            assistants.set_guide(desk, replace(guide, colour=to_hex(self._colour)))
            self._colour = None


def _numbered(desk: Desk) -> Guide | None:
    """Returns the guide that is chosen, if it has numbers."""
    guide = assistants.chosen_guide(desk)
    return guide if guide is not None and guide.kind in NUMBERS and not guide.off else None


def _typed(desk: Desk, guide: Guide, row: GuideNumber, text: str) -> None:
    """Does what a number that was typed says, as one step."""
    level = desk.view.shown_level
    origin = desk.view.centre.pixel(level)
    value = typed_number(text)
    points = None if value is None else row.write(places_of(guide, level, origin), origin, value)
    made = None if points is None else guide_at(guide, points, level, origin)
    if made is None:
        desk.say(f"“{text}” is no number that can be used here", bad=True)
    else:
        assistants.set_guide(desk, made)
