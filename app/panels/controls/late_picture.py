"""What lies over a picture that is of something else as long as the one that was asked for is awaited."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.desk import Desk
from app.language import said
from app.language.words import say

_VEIL = 0.75  # how much of the old picture it hides


def draw_late(desk: Desk, ident: str, corner: ImVec2, end: ImVec2) -> None:
    """Draws it, if the picture is late: over what lies between two corners of the present window."""
    if not desk.awaited.late(ident):
        return
    painter, text = imgui.get_window_draw_list(), f"{icons.WAIT} {say('Being prepared')}"
    painter.add_rect_filled(corner, end, theme.packed(theme.look.field, _VEIL), 4 * desk.scale)
    size = said.calc_text_size(text)
    at = ImVec2((corner.x + end.x - size.x) / 2, (corner.y + end.y - size.y) / 2)
    said.add_text(painter, at, theme.packed(theme.look.text), text)
