"""The pop-up palette under the pointer: favourites, a wheel, colours painted with, mirror and zoom."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions import actions
from app.desk.desk import Desk
from app.desk.hand import HISTORY
from app.desk.holding.favourites import favourites
from app.desk.holding.taking import take_preset
from app.desk.presets import Preset
from app.language import said
from app.panels.brush.preset_picture import THUMB, draw_picture
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import PICKER_FLAGS

_ACROSS, _COLOURS_ACROSS = 5, 12
_WHEEL, _TALL = 13.0, 11.1  # of the wheel, in ems: its width as it is told, and what it takes of it
_FLAGS = imgui.WindowFlags_.no_title_bar | imgui.WindowFlags_.no_saved_settings | imgui.WindowFlags_.no_resize
_PART = 0.8  # of a picture of the list of brushes that one here is
_VIEWS = (
    ("in", icons.ZOOM),
    ("out", icons.ZOOM_OUT),
    ("one", "1:1"),
    ("fit", icons.FIT),
    ("mirror", icons.MIRROR_ACROSS),
)


class PopUp:
    """Opens where the hand asks for it; closes by what is chosen, by Escape, and by a press beside it."""

    def draw(self, desk: Desk) -> None:
        """Draws it while it is open."""
        gap, em, padding = 5 * desk.scale, imgui.get_font_size(), imgui.get_style().window_padding
        wide = _ACROSS * _PART * THUMB[0] * desk.scale + (_ACROSS - 1) * gap
        above = padding.y + _rows(len(favourites(desk)), _ACROSS) * (_PART * THUMB[1] * desk.scale + gap)
        below = _rows(len(desk.hand.colours), _COLOURS_ACROSS) * (_side(wide, desk) + gap) + padding.y
        size = ImVec2(wide + 2 * padding.x, above + _TALL * em + below)
        at, desk.hand_sight.palette_at = desk.hand_sight.palette_at, None
        if at is not None:
            x = max(0.0, min(at[0] - size.x / 2, desk.view.width - size.x))
            y = max(0.0, min(at[1] - above - _TALL * em / 2, desk.view.height - size.y))
            imgui.set_next_window_pos(ImVec2(round(x), round(y)))
            imgui.open_popup("palette")
        imgui.set_next_window_size(size)  # told, as it would be hidden for a frame otherwise, to be measured
        if not imgui.internal.begin_popup_ex(imgui.get_id("palette"), _FLAGS):
            return
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(gap, gap))
        self._favourites(desk)
        _middle(desk, wide, em)
        _colours(desk, wide)
        imgui.pop_style_var()
        imgui.end_popup()

    def _favourites(self, desk: Desk) -> None:
        found = favourites(desk)
        if not found:
            said.text_disabled("Stars in the list of brushes put them here")
        for i, (digit, preset) in enumerate(found):
            if i % _ACROSS:
                imgui.same_line()
            if _favourite(desk, digit, preset):
                take_preset(desk, preset, keep_size=imgui.get_io().key_shift)
                imgui.close_current_popup()


def _favourite(desk: Desk, digit: int, preset: Preset) -> bool:
    """Draws one with its digit; tells whether it was pressed."""
    corner, size = imgui.get_cursor_screen_pos(), [_PART * side * desk.scale for side in THUMB]
    pressed = imgui.invisible_button(f"favourite {digit}", ImVec2(*size), imgui.ButtonFlags_.enable_nav)
    w.named(f"favourite {digit}")
    w.tooltip(f"{actions.keyed(preset.name, f'favourite_{digit}')}\nShift keeps the present size")
    chosen, end = preset.name == desk.hand.preset, ImVec2(corner.x + size[0], corner.y + size[1])
    draw_picture(desk, preset, corner, end, lit=chosen or imgui.is_item_hovered())
    painter, painted = imgui.get_window_draw_list(), f"preset {preset.name}" in desk.pictures
    at = ImVec2(corner.x + 4 * desk.scale, corner.y + 1 * desk.scale)
    painter.push_clip_rect(corner, end, True)
    grey = theme.packed((0.35,) * 3 if painted else theme.look.soft)
    said.add_text(painter, at, grey, str(digit) if painted else f"{digit}\n{preset.name}")
    painter.pop_clip_rect()
    return pressed


def _middle(desk: Desk, wide: float, em: float) -> None:
    """Draws the wheel in the middle, with the view on its left and the two colours on its right."""
    side, top = imgui.get_font_size() * 2.1, imgui.get_cursor_pos_y()
    left, tall = imgui.get_cursor_pos_x(), _TALL * em
    for i, (name, icon) in enumerate(_VIEWS):
        imgui.set_cursor_pos(ImVec2(left, top + i * (tall - side) / (len(_VIEWS) - 1)))
        action = actions.ACTIONS[name]
        on = bool(action.checked and action.checked(desk))
        if w.icon_button(f"view {name}", icon, actions.tip(name), on=on, size=side):
            actions.perform(desk, action)
    inner = _WHEEL * em - imgui.get_style().item_inner_spacing.x  # of this the wheel is in the middle
    imgui.set_cursor_pos(ImVec2(left + (wide - inner) / 2, top))
    imgui.set_next_item_width(_WHEEL * em)
    changed, value = imgui.color_picker3("##pop-up wheel", list(desk.hand.colour), PICKER_FLAGS)
    w.named("pop-up wheel")
    if changed:
        desk.hand.colour = (value[0], value[1], value[2])
    patch = (wide - tall) / 2 - 4 * desk.scale
    for i, (name, rgb, hint) in enumerate(
        (
            ("pop-up now", desk.hand.colour, "The colour you paint with"),
            ("pop-up other", desk.hand.other_colour, actions.keyed("The other colour; click to swap", "swap")),
        )
    ):
        imgui.set_cursor_pos(ImVec2(left + wide - patch * 0.62, top + i * (patch * 0.62 + 5 * desk.scale)))
        if w.swatch(name, rgb, hint, (patch * 0.62, patch * 0.62)) and i:
            desk.hand.swap()
    imgui.set_cursor_pos(ImVec2(left, top + tall + imgui.get_style().item_spacing.y))


def _rows(count: int, across: int) -> int:
    return -(-max(1, count) // across)


def _side(wide: float, desk: Desk) -> float:
    return (wide - (_COLOURS_ACROSS - 1) * 3 * desk.scale) / _COLOURS_ACROSS


def _colours(desk: Desk, wide: float) -> None:
    side = _side(wide, desk)
    if not desk.hand.colours:
        imgui.dummy(ImVec2(side, side))
    for i, colour in enumerate(desk.hand.colours[:HISTORY]):
        if i % _COLOURS_ACROSS:
            imgui.same_line(0, 3 * desk.scale)
        if w.swatch(f"pop-up past {i + 1}", colour, "Painted with before", (side, side)):
            desk.hand.colour = colour
            imgui.close_current_popup()
