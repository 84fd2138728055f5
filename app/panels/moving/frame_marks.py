"""The handles of the frame, and how large it is."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme, trace
from app.desk.desk import Desk
from app.desk.framing.frame_box import frame_box
from app.desk.moving.box import CORNERS
from app.language import said

_HALF, _SMALLER = 4.0, 3.2  # half as wide as handles are, points
_ASIDE = 8.0  # points from the frame to what tells its size


def draw_frame_marks(desk: Desk) -> None:
    """Draws them above the canvas and below the panels, while the tool is in hand."""
    box = frame_box(desk)
    if box is None:
        return
    painter, scale = imgui.get_background_draw_list(), desk.scale
    first, second, third, last = (ImVec2(*at) for at in box.corners)
    for width, grey, alpha in ((2.6, 0.0, 0.6), (1.2, 1.0, 0.95)):
        painter.add_quad(first, second, third, last, theme.packed((grey,) * 3, alpha), width * scale)
    for name, (x, y) in box.handles.items():
        half = (_HALF if name in CORNERS else _SMALLER) * scale
        a, b = ImVec2(x - half, y - half), ImVec2(x + half, y + half)
        held = desk.framing.grip == name
        painter.add_rect_filled(a, b, theme.packed(theme.look.accent if held else (1.0, 1.0, 1.0)), 1.0)
        painter.add_rect(a, b, theme.packed((0.0, 0.0, 0.0), 0.85), 1.0, thickness=1.2 * scale)
        trace.note_place("canvas", f"frame {name}", (round(a.x), round(a.y), round(b.x), round(b.y)))
    if desk.framing.dragging:
        _size(desk)


def _size(desk: Desk) -> None:
    """Draws the frame's size beside the pointer."""
    frame, pad = desk.framing.shown(desk.known), 6 * desk.scale
    text = f"{frame.width} × {frame.height}"
    at = ImVec2(desk.pointer.x + 2 * _ASIDE * desk.scale, desk.pointer.y + 2 * _ASIDE * desk.scale)
    size, painter = said.calc_text_size(text), imgui.get_background_draw_list()
    end = ImVec2(at.x + size.x + 2 * pad, at.y + size.y + pad)
    painter.add_rect_filled(at, end, theme.packed((0.0, 0.0, 0.0), 0.72), 4 * desk.scale)
    said.add_text(painter, ImVec2(at.x + pad, at.y + pad / 2), theme.packed((1.0, 1.0, 1.0)), text)
