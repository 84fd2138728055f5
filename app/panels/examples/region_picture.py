"""The picture of an example, as large as there is room for, with the brush over it."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.examples.cutting_work import finding_of
from app.panels.controls import widgets as w

_KEEPING, _DROPPING = (0.45, 0.95, 0.55), (1.0, 0.42, 0.38)  # of marks; sRGB


def draw_picture(desk: Desk, names: tuple[str, ...], size: tuple[int, int], radius: float | None) -> None:
    """Draws the first of some pictures that is there, of width and height `size`; its place is remembered for the
    strokes.  `radius`: of the brush, in pixels of the picture; None without one."""
    state, room = desk.examples, imgui.get_content_region_avail()
    width, height = size
    scale = min(room.x / width, room.y / height)
    corner = imgui.get_cursor_screen_pos()
    at = ImVec2(round(corner.x + (room.x - width * scale) / 2), round(corner.y + (room.y - height * scale) / 2))
    end = ImVec2(at.x + width * scale, at.y + height * scale)
    painter = imgui.get_window_draw_list()
    painter.add_rect_filled(corner, ImVec2(corner.x + room.x, corner.y + room.y), theme.packed(theme.look.field), 4)
    w.placed("region", at, end)
    picture = next((desk.pictures[name] for name in names if name in desk.pictures), None)
    if picture is not None:
        painter.add_image(picture, at, end)
    free = not imgui.is_popup_open("", imgui.PopupFlags_.any_popup_id | imgui.PopupFlags_.any_popup_level)
    state.spot = (at.x, at.y, scale) if free else None
    painter.push_clip_rect(at, end, True)
    _marks(desk, at, scale)
    if radius is not None and state.over(desk.pointer.x, desk.pointer.y):
        middle, reach = ImVec2(desk.pointer.x, desk.pointer.y), max(1.5, radius * scale)
        painter.add_circle(middle, reach + 0.5, theme.packed((0.0, 0.0, 0.0), 0.6), 0, 1.6 * desk.scale)
        painter.add_circle(middle, reach - 0.5, theme.packed((1.0, 1.0, 1.0), 0.9), 0, desk.scale)
    painter.pop_clip_rect()


def _marks(desk: Desk, at: ImVec2, scale: float) -> None:
    """Draws what was marked as thin lines, and the stroke in progress as wide as it is."""
    finding = finding_of(desk)
    if finding is None:
        return
    lines = [(mark.keep, mark.points, 2.0 * desk.scale, 0.9) for mark in finding.marks if not finding.bare]
    if finding.live:
        lines.append((finding.live_keeps, tuple(finding.live), 2.0 * finding.radius * scale, 0.5))
    painter = imgui.get_window_draw_list()
    for keeps, points, wide, opacity in lines:
        colour = theme.packed(_KEEPING if keeps else _DROPPING, opacity)
        places = [ImVec2(at.x + x * scale, at.y + y * scale) for x, y in points]
        if len(set(points)) > 1:
            painter.add_polyline([*places], colour, wide, 0)
        else:
            painter.add_circle_filled(places[0], wide / 2, colour)
