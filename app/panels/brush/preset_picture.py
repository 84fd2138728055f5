"""The picture of a preset: a stroke that the brush itself painted."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.presets import Preset

THUMB = (104, 44)  # points


def draw_picture(desk: Desk, preset: Preset, corner: ImVec2, end: ImVec2, *, lit: bool) -> None:
    """Draws it within a frame, which is lit for the brush that is chosen, or pointed at."""
    ground = theme.packed(theme.look.accent_soft if lit else theme.look.card)
    imgui.get_window_draw_list().add_rect_filled(corner, end, ground, 4 * desk.scale)
    draw_stroke(desk, preset, corner, end)


def draw_stroke(desk: Desk, preset: Preset, corner: ImVec2, end: ImVec2) -> None:
    """Draws its stroke, if that is painted."""
    painter, inset = imgui.get_window_draw_list(), 2 * desk.scale
    picture = desk.pictures.get(f"preset {preset.name}")
    if picture is not None:
        inner = ImVec2(corner.x + inset, corner.y + inset), ImVec2(end.x - inset, end.y - inset)
        white = theme.packed((1.0, 1.0, 1.0))
        painter.add_image_rounded(picture, *inner, ImVec2(0, 0), ImVec2(1, 1), white, 3 * desk.scale)
