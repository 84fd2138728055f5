"""The guides drawn over the canvas: thin lines, light and dark, and handles while the tool for guides is chosen."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.desk.guides.guide_sight import clipped
from app.desk.hand import radius_of
from app.tools.tools import TOOLS

_SIDES = 24  # of a handle's circle


def draw_guides(desk: Desk) -> None:
    """Draws the symmetry's lines from its centre to the edges of the screen."""
    guide = symmetry.guide_of(desk)
    if guide is None or guide.off or not (desk.guides.shown or desk.hand.tool == "guides"):
        return
    x, y = desk.view.to_screen(symmetry.centre_of(guide))
    a, b, c, d = desk.view.matrix()
    strong = 1.0 if desk.hand.tool == "guides" else 0.6
    for dx, dy in symmetry.axes(guide):
        ray = (x, y), (a * dx + b * dy, c * dx + d * dy)
        ends = clipped(ray, (desk.view.width, desk.view.height), 0.0)
        if ends is not None:
            _line(desk, *ends, strong)
    if desk.hand.tool == "guides":
        for at in symmetry.handles(desk, guide):
            _handle(desk, at)


def draw_path(desk: Desk) -> None:
    """Draws the shape in hand, and its copies, as thin lines."""
    path, guide = desk.guides.path, symmetry.guide_of(desk)
    if desk.guides.bar:
        _path(desk, desk.guides.bar, 0.6)
        for at in desk.guides.bar:
            _handle(desk, at)
    if len(path) < 2:
        return
    _path(desk, path, 1.0)
    if guide is None or guide.off or not TOOLS[desk.hand.tool].outline:
        return
    x, y = desk.view.to_screen(symmetry.centre_of(guide))
    for copy in symmetry.on_screen(desk.view, guide):
        places = (copy.moved(px - x, py - y) for px, py in path)
        _path(desk, tuple((x + right, y + down) for right, down in places), 0.5)


def _path(desk: Desk, path: tuple[tuple[float, float], ...], strong: float) -> None:
    painter, points = imgui.get_background_draw_list(), [ImVec2(*place) for place in path]
    for width, grey, alpha in ((2.4 * desk.scale, 0.0, 0.4), (1.2 * desk.scale, 1.0, 0.9)):
        painter.add_polyline([*points], theme.packed((grey,) * 3, alpha * strong), width, 0)


def draw_copies(desk: Desk) -> None:
    """Draws a faint circle where each copy of the brush is."""
    guide = symmetry.guide_of(desk)
    shown = TOOLS[desk.hand.tool].outline and (desk.pointer.over_canvas or desk.painting)
    if guide is None or guide.off or not shown:
        return
    x, y = desk.view.to_screen(symmetry.centre_of(guide))
    painter, radius = imgui.get_background_draw_list(), max(1.5, radius_of(desk.hand, desk.pointer.eraser))
    dx, dy = desk.pointer.x - x, desk.pointer.y - y
    for copy in symmetry.on_screen(desk.view, guide):
        right, down = copy.moved(dx, dy)
        at = ImVec2(x + right, y + down)
        painter.add_circle(at, radius + 0.5, theme.packed((0.0, 0.0, 0.0), 0.3), 0, 1.2 * desk.scale)
        painter.add_circle(at, radius - 0.5, theme.packed((1.0, 1.0, 1.0), 0.4), 0, 1.0 * desk.scale)


def _line(desk: Desk, start: tuple[float, float], end: tuple[float, float], strong: float) -> None:
    painter = imgui.get_background_draw_list()
    for width, grey, alpha in ((2.0 * desk.scale, 0.0, 0.25 * strong), (1.0, 1.0, 0.6 * strong)):
        painter.add_line(ImVec2(*start), ImVec2(*end), theme.packed((grey,) * 3, alpha), width)


def _handle(desk: Desk, at: tuple[float, float]) -> None:
    painter, radius = imgui.get_background_draw_list(), 6.0 * desk.scale
    painter.add_circle_filled(ImVec2(*at), radius, theme.packed((0.0, 0.0, 0.0), 0.5), _SIDES)
    painter.add_circle(ImVec2(*at), radius, theme.packed((1.0, 1.0, 1.0), 0.95), _SIDES, 1.6 * desk.scale)
