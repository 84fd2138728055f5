"""The subbands of a pyramid as a field of small sliders: levels down, fine to coarse, orientations across."""

from __future__ import annotations

import math

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.match_state import MatchState, Spot
from app.language import said
from app.panels.controls import widgets as w

_MOST = 4.0  # gain at the right end; 1 is in the middle
_LABEL = 2.6  # width of the column of labels, in heights of the font
_STILL = 1.0, None


def draw(match: MatchState, levels: int, orientations: int) -> None:
    """Drag a cell to change its gain, Shift for the whole level, double click to reset it."""
    rows: list[tuple[str, str, list[Spot]]] = [("grain", "The finest grain, of no direction", [(-1, None)])]
    for level in range(levels):
        hint = f"Features of about {2 << level} to {4 << level} pixels"
        rows.append((f"{2 << level} px", hint, [(level, k) for k in range(orientations)]))
    rows.append(("base", "What is left: soft blotches and the mean", [(levels, None)]))
    em, gap = imgui.get_font_size(), 2.0
    room = imgui.get_content_region_avail().x - _LABEL * em
    tall = round(em * 1.22)
    for label, hint, spots in rows:
        corner = imgui.get_cursor_screen_pos()
        painter = imgui.get_window_draw_list()
        said.add_text(painter, ImVec2(corner.x, corner.y + (tall - em) / 2), theme.packed(theme.look.quiet), label)
        wide = (room - gap * (len(spots) - 1)) / len(spots)
        for k, spot in enumerate(spots):
            at = ImVec2(corner.x + _LABEL * em + k * (wide + gap), corner.y)
            imgui.set_cursor_screen_pos(at)
            _cell(match, spot, spots, (wide, tall), hint, math.pi * k / orientations if len(spots) > 1 else None)
        imgui.set_cursor_screen_pos(ImVec2(corner.x, corner.y + tall + gap))
    imgui.dummy(ImVec2(0, 0))


def part_of(gain: float) -> float:
    """Tells how far a cell is filled: half at gain 1, all at 4, which an octave of gain takes a quarter of it."""
    return 0.5 * gain if gain <= 1.0 else min(0.5 + 0.25 * math.log2(gain), 1.0)


def gain_of(part: float) -> float:
    """Gives the gain at a part, 0..1, of a slider's way: 1 in the middle and close to it."""
    part = min(max(part, 0.0), 1.0)
    gain = 2.0 * part if part <= 0.5 else 2.0 ** (4.0 * part - 2.0)
    return 1.0 if abs(gain - 1.0) < 0.04 else round(gain, 2)


def _cell(
    match: MatchState, spot: Spot, row: list[Spot], size: tuple[float, float], hint: str, angle: float | None
) -> None:
    corner, (wide, tall) = imgui.get_cursor_screen_pos(), size
    end = ImVec2(corner.x + wide, corner.y + tall)
    imgui.invisible_button(f"band {spot}", ImVec2(wide, tall))
    if imgui.is_item_active() and imgui.is_mouse_dragging(imgui.MouseButton_.left, 2.0):
        part = (imgui.get_io().mouse_pos.x - corner.x) / max(wide, 1.0)
        for one in row if imgui.get_io().key_shift else [spot]:
            match.bands[one] = gain_of(part), match.bands.get(one, _STILL)[1]
    if imgui.is_item_clicked():
        match.chosen = spot
    if imgui.is_item_hovered() and imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
        for one in row if imgui.get_io().key_shift else [spot]:
            match.bands.pop(one, None)
    gain, curve = match.bands.get(spot, _STILL)
    hovered = imgui.is_item_hovered()
    w.tooltip(
        f"{hint}: {gain:.2f} times as strong\nDrag to change it, with Shift all of the row; double click to reset"
    )
    painter, rounding = imgui.get_window_draw_list(), 3.0
    painter.add_rect_filled(corner, end, theme.packed(theme.look.field), rounding)
    fill = ImVec2(corner.x + wide * part_of(gain), end.y)
    shade = (
        theme.look.accent_soft if (gain, curve) != _STILL else theme.look.filled_lit if hovered else theme.look.filled
    )
    if fill.x > corner.x + 1:
        painter.add_rect_filled(corner, fill, theme.packed(shade), rounding)
    if angle is not None:
        _sign(ImVec2(corner.x + wide / 2, corner.y + tall / 2), tall * 0.34, angle)
    if curve is not None:
        painter.add_circle_filled(ImVec2(end.x - 5, corner.y + 5), 2.2, theme.packed(theme.look.accent))
    if match.chosen == spot:
        painter.add_rect(corner, end, theme.packed(theme.look.accent), rounding)


def _sign(middle: ImVec2, radius: float, angle: float) -> None:
    """Crests of waves that run along `angle`, y downwards."""
    painter, colour = imgui.get_window_draw_list(), theme.packed(theme.look.text, 0.45)
    along, across = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
    for shift in (-0.6, 0.0, 0.6):
        x, y = middle.x + shift * radius * along[0], middle.y + shift * radius * along[1]
        a = ImVec2(x - radius * across[0], y - radius * across[1])
        b = ImVec2(x + radius * across[0], y + radius * across[1])
        painter.add_line(a, b, colour, 1.2)
