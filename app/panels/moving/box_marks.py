"""The box around what the tool Move holds, its handles, and what a drag has come to.

All lines are drawn light on dark, to show on any colour.
"""

from __future__ import annotations

from itertools import pairwise

from imgui_bundle import ImVec2, imgui

from app import theme, trace
from app.desk.desk import Desk
from app.desk.moving import held_box
from app.desk.moving.box import CORNERS, TURN, Box, Point
from app.language import said

_DARK, _LIGHT = ((0.0, 0.0, 0.0), 0.6), ((1.0, 1.0, 1.0), 0.95)
_HANDLE, _SIDE, _TURNER = 4.0, 3.2, 4.4  # half as wide as handles are, points
_MARK = 5.0  # half as wide as the mark is that tells that the very pixels are shown, points
_ASIDE = (16.0, 18.0)  # points from the pointer to what is told beside it


def draw(desk: Desk) -> None:
    """Draws it above the canvas and below the panels."""
    box = held_box.seen_box(desk)
    if box is None:
        return
    painter = imgui.get_background_draw_list()
    lines = [[*box.corners, box.corners[0]], [box.handles.get("top", box.at(0, -1)), box.turner]]
    for (rgb, alpha), width in ((_DARK, 2.6), (_LIGHT, 1.2)):
        for line in lines:
            for a, b in pairwise(line):
                painter.add_line(ImVec2(*a), ImVec2(*b), theme.packed(rgb, alpha), width * desk.scale)
    for name, at in box.handles.items():
        _square(painter, at, (_HANDLE if name in CORNERS else _SIDE) * desk.scale, desk, name)
    _turner(painter, box, desk)
    if desk.moving.label is not None:
        _label(painter, desk)


def _square(painter: imgui.ImDrawList, at: Point, half: float, desk: Desk, name: str) -> None:
    x, y = at
    a, b = ImVec2(x - half, y - half), ImVec2(x + half, y + half)
    lit = desk.moving.grip == name
    painter.add_rect_filled(a, b, theme.packed(theme.look.accent if lit else (1.0, 1.0, 1.0)), 1.0)
    painter.add_rect(a, b, theme.packed((0.0, 0.0, 0.0), 0.85), 1.0, thickness=1.2 * desk.scale)
    _noted(name, at, half)


def _turner(painter: imgui.ImDrawList, box: Box, desk: Desk) -> None:
    at, half = ImVec2(*box.turner), _TURNER * desk.scale
    lit = desk.moving.grip == TURN
    painter.add_circle_filled(at, half, theme.packed(theme.look.accent if lit else (1.0, 1.0, 1.0)), 24)
    painter.add_circle(at, half, theme.packed((0.0, 0.0, 0.0), 0.85), 24, 1.2 * desk.scale)
    _noted(TURN, box.turner, half)


def _noted(name: str, at: Point, half: float) -> None:
    """Tells tests where a handle lies."""
    x, y = at
    trace.note_place("canvas", f"{name} handle", (round(x - half), round(y - half), round(x + half), round(y + half)))


def _label(painter: imgui.ImDrawList, desk: Desk) -> None:
    """Draws what the drag has come to beside the pointer, with a diamond before it where the very pixels are shown."""
    label, scale = desk.moving.label, desk.scale
    assert label is not None
    at = ImVec2(desk.pointer.x + _ASIDE[0] * scale, desk.pointer.y + _ASIDE[1] * scale)
    size, pad, mark = said.calc_text_size(label.text), 6 * scale, _MARK * scale
    room = 2 * mark + pad
    end = ImVec2(at.x + room + size.x + 2 * pad, at.y + size.y + pad)
    painter.add_rect_filled(at, end, theme.packed((0.0, 0.0, 0.0), 0.72), 4 * scale)
    told = f"{'exactly ' if label.exact else ''}{label.text}"
    trace.note_place("canvas", told, (round(at.x), round(at.y), round(end.x), round(end.y)))
    middle = ImVec2(at.x + pad + mark, (at.y + end.y) / 2)
    a, b = ImVec2(middle.x, middle.y - mark), ImVec2(middle.x + mark, middle.y)
    c, d = ImVec2(middle.x, middle.y + mark), ImVec2(middle.x - mark, middle.y)
    if label.exact:
        painter.add_quad_filled(a, b, c, d, theme.packed(theme.look.accent))
    else:
        painter.add_quad(a, b, c, d, theme.packed((1.0, 1.0, 1.0), 0.4), 1.2 * scale)
    said.add_text(painter, ImVec2(at.x + pad + room, at.y + pad / 2), theme.packed((1.0, 1.0, 1.0)), label.text)
