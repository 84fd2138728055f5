"""The brushes to choose from: a picture of a stroke each, by group, found by a word, or all at once."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons
from app.desk import presets
from app.desk.desk import Desk
from app.desk.holding.taking import take_preset
from app.desk.presets import Preset
from app.language import said
from app.panels.brush.preset_picture import THUMB
from app.panels.brush.preset_tile import draw_tile, tall_of
from app.panels.controls import widgets as w
from engine.studio.requests import Prepare, Swatch

ACROSS, TILE_WIDE = 3, 100  # in the panel: at least, and the least width of each where there are more, points
ACROSS_ALL = 8  # of all at once, at most
LABELS = 94  # width of the names of groups beside all of them, points
EVERY = ""  # the group of all


class BrushList:
    """Remembers the group that is listed and the word that is looked for."""

    def __init__(self) -> None:
        self._group, self._find = EVERY, ""
        self._seen = ""  # the brush chosen when the list was last drawn
        self._asked: dict[str, Preset] = {}  # by name, those whose pictures were asked for
        self._prepared: tuple[Preset, ...] = ()  # those that were asked to be made ready
        self._reveal = 0  # frames in which the list still scrolls to it: how long a list is, is known a frame late

    def wants(self, desk: Desk) -> None:
        """Asks for the pictures of all brushes but those that grow examples, before they are in sight: an example
        would have to be analysed, and be held.  Before, all are to be made ready."""
        if desk.known.ready and self._prepared is not desk.known.presets:
            self._prepared = desk.known.presets
            desk.post(Prepare(tuple(_picture(desk, preset) for preset in self._prepared)))
        for preset in desk.known.presets:
            if not preset.brush.row.grows:
                self._ask(desk, preset)

    def _ask(self, desk: Desk, preset: Preset) -> None:
        """Has a stroke of a brush painted, once."""
        if desk.known.ready and self._asked.get(preset.name) is not preset:
            self._asked[preset.name] = preset
            desk.post(_picture(desk, preset))

    def draw(self, desk: Desk) -> None:
        """Fills the present window, as many across as have room."""
        self._bar(desk)
        gap = 5 * desk.scale
        found = presets.found(desk.known.presets, self._group, self._find)
        room = imgui.get_content_region_avail().x - 12 * desk.scale
        across = max(ACROSS, int((room + gap) / (TILE_WIDE * desk.scale + gap)))
        wide = (room - gap * (across - 1)) / across
        low = 2.2 * tall_of(desk, wide)  # where there is less room, all of it scrolls
        imgui.begin_child("presets", ImVec2(0, max(imgui.get_content_region_avail().y, low)))
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(gap, gap))
        for group, members in found:
            said.text_disabled(group)
            for i, preset in enumerate(members):
                if i % across:
                    imgui.same_line()
                if self._preset(desk, preset, wide):
                    self._seen = desk.hand.preset
                if self._reveal and preset.name == desk.hand.preset:
                    imgui.set_scroll_here_y(0.5)
        if not found:
            words = "No brush is called so" if desk.known.presets else "Loading brushes"
            said.text_disabled(words)
            w.named(words)
        imgui.pop_style_var()
        imgui.end_child()
        self._reveal = 2 if desk.hand.preset != self._seen else max(0, self._reveal - 1)
        self._seen = desk.hand.preset

    def _bar(self, desk: Desk) -> None:
        """Draws the group that is listed, a word to look for, and all at once."""
        gap, side = 3 * desk.scale, imgui.get_frame_height()
        room = imgui.get_content_region_avail().x - 2 * gap - side
        groups = [(EVERY, f"All {len(desk.known.presets) or ''}")]
        groups += [(group, group) for group, _ in presets.found(desk.known.presets, EVERY, "")]
        picked = w.choice("group", self._group, groups, "Which brushes are listed", 0.56 * room)
        if picked is not None:
            self._group, self._find = picked, ""
        imgui.same_line(0, gap)
        imgui.set_next_item_width(0.44 * room)
        flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.escape_clears_all
        entered, self._find = said.input_text_with_hint("##find", "Find", self._find, flags)
        w.named("Find")
        w.tooltip("Part of a brush’s name, or of its group’s; Enter takes the nearest")
        nearest = presets.nearest(desk.known.presets, self._find) if entered else None
        if nearest is not None:
            hold(desk, nearest)
            self._find = self._seen = ""  # the list is the whole one again, and scrolls to it
        imgui.same_line(0, gap)
        if w.icon_button("all brushes", icons.GRID, "All brushes at once", size=side):
            imgui.open_popup("all brushes")
        self._all(desk)

    def _all(self, desk: Desk) -> None:
        """Draws every brush, a line for each group, beside the panel."""
        gap, em = 5 * desk.scale, imgui.get_font_size()
        left = imgui.get_window_pos().x + imgui.get_window_width() + gap
        room, high = desk.view.width - left - 6 * gap, desk.view.height - imgui.get_window_pos().y - 3 * gap
        labels, wide = LABELS * desk.scale, THUMB[0] * desk.scale
        across = max(1, min(ACROSS_ALL, int((room - labels) / (wide + gap))))
        imgui.set_next_window_pos(ImVec2(left, imgui.get_window_pos().y + gap))
        imgui.set_next_window_size_constraints(ImVec2(0, 0), ImVec2(room + 5 * gap, high))
        if not imgui.begin_popup("all brushes"):
            return
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(gap, gap))
        for group, members in presets.found(desk.known.presets, EVERY, ""):
            top = imgui.get_cursor_pos().y
            imgui.set_cursor_pos_y(top + (tall_of(desk, wide) - em) / 2)
            said.text_disabled(group)
            imgui.set_cursor_pos_y(top)
            for i, preset in enumerate(members):
                if i % across:
                    imgui.same_line()
                else:
                    imgui.set_cursor_pos_x(imgui.get_style().window_padding.x + labels)
                if self._preset(desk, preset, wide):
                    imgui.close_current_popup()
        imgui.pop_style_var()
        imgui.end_popup()

    def _preset(self, desk: Desk, preset: Preset, wide: float) -> bool:
        """Returns one brush; whether it was taken."""
        taken, seen = draw_tile(desk, preset, wide)
        if taken:
            hold(desk, preset)
        if seen:
            self._ask(desk, preset)
        return taken


def _picture(desk: Desk, preset: Preset) -> Swatch:
    """Returns the request for a stroke of a brush."""
    size = (int(THUMB[0] * desk.scale), int(THUMB[1] * desk.scale))
    return Swatch(f"preset {preset.name}", preset.brush, size, textures=preset.textures, kept=True)


def hold(desk: Desk, preset: Preset) -> None:
    """Paints with a brush from now on; Shift keeps the size."""
    take_preset(desk, preset, imgui.get_io().key_shift)
