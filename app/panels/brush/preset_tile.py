"""A brush in the list: its picture, its name, its star."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.desk import Desk
from app.desk.holding.favourites import digit_of, star
from app.desk.presets import Preset
from app.language.words import say
from app.panels.brush.preset_menu import draw_menu
from app.panels.brush.preset_picture import THUMB, draw_stroke
from app.panels.controls import widgets as w

_NAMED = 90.0  # points: brushes that are narrower show their pictures alone


def tall_of(desk: Desk, wide: float) -> float:
    """Returns the height of a brush `wide` across: its picture, and its name where there is room for one."""
    named = wide >= _NAMED * desk.scale
    return wide * THUMB[1] / THUMB[0] + (imgui.get_font_size() + 4 * desk.scale if named else 2 * desk.scale)


def draw_tile(desk: Desk, preset: Preset, wide: float) -> tuple[bool, bool]:
    """Draws one; tells whether it was taken, and whether it is in sight."""
    corner, tall = imgui.get_cursor_screen_pos(), tall_of(desk, wide)
    taken = imgui.invisible_button(preset.name, ImVec2(wide, tall), imgui.ButtonFlags_.enable_nav)
    w.named(preset.name)
    if not imgui.is_item_visible():  # most are scrolled away
        return taken, False
    hovered, chosen = imgui.is_item_hovered(), desk.hand.preset == preset.name
    digit, spot = digit_of(desk, preset), _star_spot(desk, corner, wide)
    if taken and _within(spot):
        star(desk, preset)
        taken = False
    keys = f"  (Ctrl+{digit})" if digit else ""
    w.tooltip(f"{preset.name}{keys}\nShift keeps the present size; the star makes it a favourite\nRight click for more")
    draw_menu(desk, preset)
    painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + wide, corner.y + tall)
    grey = theme.look.accent_soft if chosen else theme.look.card_lit if hovered else theme.look.card
    painter.add_rect_filled(corner, end, theme.packed(grey), 4 * desk.scale)
    bottom = corner.y + wide * THUMB[1] / THUMB[0]
    draw_stroke(desk, preset, corner, ImVec2(end.x, bottom + 2 * desk.scale))
    if digit or hovered:
        _star(desk, spot, digit)
    if wide >= _NAMED * desk.scale:
        tone = theme.look.text if chosen else theme.look.soft
        _name(preset.name, ImVec2(corner.x, bottom + 1.5 * desk.scale), end, tone)
    elif chosen:
        painter.add_rect(corner, end, theme.packed(theme.look.accent), 4 * desk.scale, thickness=2 * desk.scale)
    return taken, True


def _star_spot(desk: Desk, corner: ImVec2, wide: float) -> tuple[float, float, float]:
    """Returns where the star of a preset lies, and how large it is: left, top, side."""
    side = min(imgui.get_font_size() * 1.25, 0.27 * wide)
    return corner.x + wide - side - 2 * desk.scale, corner.y + 2 * desk.scale, side


def _within(spot: tuple[float, float, float]) -> bool:
    at, (left, top, side) = imgui.get_io().mouse_pos, spot
    return left <= at.x < left + side and top <= at.y < top + side


_FAVOURITE = 0.22, 0.42, 0.66  # on the white of pictures, whatever the look


def _star(desk: Desk, spot: tuple[float, float, float], digit: int) -> None:
    """Draws the star of a favourite, with its digit; that of another brush, which is pointed at, faintly."""
    (left, top, side), painter, size = spot, imgui.get_window_draw_list(), spot[2] / 1.25
    grey, inset = _FAVOURITE if digit else (0.45,) * 3 if _within(spot) else (0.57,) * 3, (side - size) / 2
    painter.add_text(imgui.get_font(), size, ImVec2(left + inset, top + inset), theme.packed(grey), icons.STAR)
    if digit:
        wide = imgui.calc_text_size(str(digit)).x * 0.7 * size / imgui.get_font_size()
        at = ImVec2(left + (side - wide) / 2, top + 0.3 * size)
        painter.add_text(imgui.get_font(), size * 0.7, at, theme.packed((1.0, 1.0, 1.0)), str(digit))


def _name(name: str, corner: ImVec2, end: ImVec2, grey: tuple[float, float, float]) -> None:
    """Draws a brush's name below its picture; a long one a little smaller."""
    painter, size = imgui.get_window_draw_list(), imgui.get_font_size()
    inset = 0.35 * size
    name = say(name)
    wide = imgui.calc_text_size(name).x
    fits = max(0.8, min(1.0, (end.x - corner.x - 1.2 * inset) / max(wide, 1.0)))
    at = ImVec2(corner.x + (inset if fits == 1.0 else 0.6 * inset), corner.y + size * (1 - fits) / 2)
    painter.push_clip_rect(corner, end, True)
    painter.add_text(imgui.get_font(), size * fits, at, theme.packed(grey), name)
    painter.pop_clip_rect()
