"""Keeping a brush: a button that asks for a name and writes a preset of the artist's own."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons
from app.desk import palette, presets
from app.desk.desk import Desk
from app.desk.hand import mixed_now
from app.desk.presets import Preset
from app.desk.sharing.preset_work import AddPreset, is_changed, keep_changes, take_back
from app.language import said
from app.panels.controls import widgets as w


class SaveBrush:
    """Remembers the name as it is typed, and whether the colour belongs to the brush."""

    def __init__(self) -> None:
        self._name, self._coloured = "", False

    def draw(self, desk: Desk) -> None:
        """Draws the button, on the right end of the header just drawn, and what it opens."""
        side = imgui.get_text_line_height() * 1.25
        right = imgui.get_content_region_avail().x
        imgui.same_line(0, 0)
        imgui.set_cursor_pos_x(imgui.get_style().window_padding.x + right - side)
        if w.icon_button("save brush", icons.DISK, "Save this brush under a name", size=side):
            self._name = presets.free_brush_name(desk.hand.preset or "My brush", desk.known.presets)
            self._coloured = any(p.name == desk.hand.preset and p.coloured for p in desk.known.presets)
            imgui.open_popup("save brush")
        if not imgui.begin_popup("save brush"):
            return
        em = imgui.get_font_size()
        said.text_disabled("Save this brush")
        if imgui.is_window_appearing():
            imgui.set_keyboard_focus_here()
        imgui.set_next_item_width(em * 14)
        entered, self._name = imgui.input_text("##name", self._name, imgui.InputTextFlags_.enter_returns_true)
        w.named("name")
        w.tooltip("Its name among your own brushes")
        name = presets.free_brush_name(self._name, desk.known.presets)
        if any(p.name == name and presets.is_own(p) for p in desk.known.presets):
            said.text_disabled("Replaces your brush of this name")
        elif name != " ".join(self._name.split()):
            said.text_disabled(f"Saved as “{name}”")
        _, self._coloured = w.tick("With its colour", self._coloured, "Whoever chooses it paints in this colour then")
        if w.text_button("Save", "Write it into the folder of your brushes", width=em * 6) or entered:
            _save(desk, name, self._coloured)
            imgui.close_current_popup()
        imgui.same_line()
        if w.text_button("Cancel", "Go back", width=em * 6):
            imgui.close_current_popup()
        imgui.end_popup()


def _save(desk: Desk, name: str, coloured: bool) -> None:
    textures, stay = palette.belonging(desk)
    desk.work(AddPreset(Preset(name, mixed_now(desk.hand), textures=textures, coloured=coloured), stay))


def draw_changed(desk: Desk) -> None:
    """Draws, on the right end of the header just drawn, that the brush is no longer its preset, with the ways back and
    on."""
    imgui.same_line(0, 0)
    imgui.dummy(ImVec2(0, imgui.get_text_line_height() * 1.25))  # as high with the buttons as without: nothing moves
    if not is_changed(desk):
        return
    side, gap = imgui.get_text_line_height() * 1.25, 4 * desk.scale
    right = imgui.get_style().window_padding.x + imgui.get_content_region_avail().x
    word = "changed"
    title = imgui.get_tree_node_to_label_spacing() + said.calc_text_size("Brush settings").x
    imgui.same_line(0, 0)
    left = right - 2 * (side + gap) - said.calc_text_size(word).x
    if left > imgui.get_style().window_padding.x + title:  # in some languages there is no room for the word
        imgui.set_cursor_pos_x(left)
        said.text_disabled(word)
        w.tooltip(f"It is no longer “{desk.hand.preset}” as it was chosen")
        imgui.same_line(0, gap)
    else:
        imgui.set_cursor_pos_x(right - 2 * side - gap)
    if w.icon_button("brush back", icons.UNDO, f"Back to “{desk.hand.preset}”", size=side):
        take_back(desk)
    imgui.same_line(0, gap)
    if w.icon_button("brush keep", icons.DISK, "Keep it so; of a brush that came along, as one of your own", size=side):
        keep_changes(desk)
