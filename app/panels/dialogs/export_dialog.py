"""The dialog for exporting a picture: what of the painting, how fine, in which format."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.exporting.export_areas import AREAS, export_bytes, export_place
from app.desk.exporting.export_state import EXPORT_FORMATS, FINER, FRAME_AREA, PAINTED_AREA
from app.desk.folders import size_text
from app.language import said
from app.language.words import say
from app.panels.controls import widgets as w
from engine.checks.picture_sides import PICTURE_SIDE
from engine.studio.moving.move_requests import AskPainted

_WIDE = 24  # ems


class ExportDialog:
    """Asks for all of it; then where it goes."""

    title = "Export picture"

    def __init__(self, desk: Desk) -> None:
        desk.export.lit = desk.export.lit or desk.light.on
        desk.export.painted = None
        desk.post(AskPainted())
        if desk.export.area != PAINTED_AREA and AREAS[desk.export.area].of(desk) is None:
            desk.export.area = FRAME_AREA

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window."""
        em, state = imgui.get_font_size(), desk.export
        imgui.dummy(ImVec2(_WIDE * em, 0))
        self._areas(desk)
        imgui.set_next_item_width(em * _WIDE)
        flags = imgui.SliderFlags_.always_clamp
        shown = "as fine as it is" if state.finer == 0 else f"{state.finer:+d} levels"
        state.finer = imgui.slider_int("##Finer", state.finer, *FINER, say(shown), flags)[1]
        low = imgui.get_item_rect_min()
        w.placed("Finer", low, ImVec2(low.x + em * _WIDE, imgui.get_item_rect_max().y))
        w.tooltip("Each level finer doubles the picture, with new detail; each coarser halves it")
        level, rect = export_place(desk)
        fits = min(rect.width, rect.height) > 0 and max(rect.width, rect.height) <= PICTURE_SIDE
        imgui.push_style_color(imgui.Col_.text, theme.vec(theme.look.quiet if fits else theme.look.warn))
        told = f"{rect.width:,} × {rect.height:,} pixels of level {level}, at most {size_text(export_bytes(desk))}"
        said.text_unformatted(told if fits else f"{rect.width:,} × {rect.height:,} pixels: more than a file can have")
        w.named("size")
        imgui.pop_style_color()
        imgui.spacing()
        titles = [(name, row.title) for name, row in EXPORT_FORMATS.items()]
        chosen = w.choice("format", state.format, titles, EXPORT_FORMATS[state.format].hint, em * _WIDE)
        state.format = chosen or state.format
        self._ticks(desk)
        imgui.spacing()
        going = w.default_button("Choose file…", "Choose where to write it", enabled=fits, width=em * 8)
        if going:
            desk.light.keep_to(desk.known.scene)
            state.light = desk.light.light if state.lit else None
            desk.asked.show("export to")
        imgui.same_line()
        return not (w.text_button("Cancel", "Go back", width=em * 7) or going)

    def _areas(self, desk: Desk) -> None:
        for number, (name, row) in enumerate(AREAS.items()):
            if number:
                imgui.same_line()
            there = row.of(desk) is not None
            imgui.begin_disabled(not there)
            pressed = w.dot(row.title, desk.export.area == name)
            imgui.end_disabled()
            w.named(f"export {name}")
            w.tooltip(row.hint if there else row.lacking)
            if pressed and there:
                desk.export.area, desk.export.finer = name, 0

    def _ticks(self, desk: Desk) -> None:
        state = desk.export
        if desk.known.paper is not None:
            hint = "Leave the paper out: nothing lies where nobody painted"
            state.transparent = w.tick("Without paper", state.transparent, hint)[1]
        hint = "Each layer by itself, as a file of its own: its name stands behind the picture's"
        state.apart = w.tick("A file for each layer", state.apart, hint)[1]
        state.lit = w.tick("As lit", state.lit, "In the light of View > Light, with its sun, depth and gloss")[1]
