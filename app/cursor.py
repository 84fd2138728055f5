"""What is drawn over the canvas: the edge of the frame, and the brush's circle at its true size.

Both are drawn light and dark, to show on any colour.
"""

from __future__ import annotations

import math
import time

import glfw
from imgui_bundle import ImVec2, imgui

from app import theme
from app.canvas.view import place_of_pixel
from app.desk.desk import Desk
from app.desk.hand import radius_of
from app.desk.moving import held_box
from app.desk.moving.box import SCALES, TURN
from app.desk.moving.move_state import TOOL
from app.tools.tools import TOOLS

_PATIENCE = 0.35  # seconds that something grows before that is shown
MARKS = 16  # at most
_SHAPES = {
    "pan": glfw.RESIZE_ALL_CURSOR,
    "turn": glfw.RESIZE_ALL_CURSOR,
    "zoom": glfw.CROSSHAIR_CURSOR,
}
# By eighths of a turn from the right, clockwise, of which every other half is the same.
_WAYS = glfw.RESIZE_EW_CURSOR, glfw.RESIZE_NWSE_CURSOR, glfw.RESIZE_NS_CURSOR, glfw.RESIZE_NESW_CURSOR
_AROUND = 0.6  # how dark paper is around the frame


def shape(desk: Desk, panning: bool) -> int:
    """GLFW's cursor for where the pointer is."""
    if not desk.pointer.over_canvas:
        return int(glfw.ARROW_CURSOR)
    if panning:
        return int(glfw.RESIZE_ALL_CURSOR)
    if desk.hand.tool == TOOL:
        return _over_box(desk)
    return int(_SHAPES.get(desk.hand.tool, glfw.CROSSHAIR_CURSOR))


def _over_box(desk: Desk) -> int:
    """Returns the cursor for what of the box around a layer the pointer is over."""
    grip, box = desk.moving.grip, held_box.seen_box(desk)
    if grip == TURN:
        return int(glfw.POINTING_HAND_CURSOR)
    if grip not in SCALES or box is None:
        return int(glfw.RESIZE_ALL_CURSOR)
    (x, y), (mx, my) = box.at(*SCALES[grip]), box.middle
    return int(_WAYS[round(math.atan2(y - my, x - mx) / (math.pi / 4)) % 4])


def draw_frame(desk: Desk) -> None:
    """Draws the frame's edge, so that it shows under paint that goes beyond it."""
    r, view = desk.framing.shown(desk.known), desk.view
    places = ((r.x0, r.y0), (r.x1, r.y0), (r.x1, r.y1), (r.x0, r.y1))
    corners = [view.to_screen(place_of_pixel(0, x, y)) for x, y in places]  # exact at any depth
    painter = imgui.get_background_draw_list()
    far = 4.0 * (view.width + view.height)
    a, b, c, d = (ImVec2(max(-far, min(far, x)), max(-far, min(far, y))) for x, y in corners)
    if desk.known.paper is not None and not desk.known.wrapping:
        _draw_desk(a, b, c, d, far)
    for width, colour in ((1.8 * desk.scale, theme.packed((0.0,) * 3, 0.25)), (1.0, theme.packed((1.0,) * 3, 0.35))):
        painter.add_quad(a, b, c, d, colour, width)


def _draw_desk(a: ImVec2, b: ImVec2, c: ImVec2, d: ImVec2, far: float) -> None:
    """Darkens the paper around the frame, which goes on without end: `a` to `d` are the frame's corners, in order."""
    painter, shade = imgui.get_background_draw_list(), theme.packed((0.0,) * 3, _AROUND)
    wide, tall = math.hypot(b.x - a.x, b.y - a.y), math.hypot(d.x - a.x, d.y - a.y)
    if wide == 0 or tall == 0:
        return
    u, v = (b - a) * (far / wide), (d - a) * (far / tall)
    outer, inner = (a - u - v, b + u - v, c + u + v, d - u + v), (a, b, c, d)
    flags, painter.flags = painter.flags, 0  # smoothed, the parts would show seams
    for i in range(4):
        j = (i + 1) % 4
        painter.add_quad_filled(outer[i], outer[j], inner[j], inner[i], shade)
    painter.flags = flags


def draw_outline(desk: Desk) -> None:
    """Draws the brush's circle, above the canvas and below the panels; or the rectangle that is being marked."""
    if desk.match.marked is not None:
        _draw_marked(desk.match.marked)
    if desk.match.marking is not None or desk.examples.swapping:
        return
    if not (desk.pointer.over_canvas or desk.painting) or not TOOLS[desk.hand.tool].outline:
        return
    painter = imgui.get_background_draw_list()
    at, radius = ImVec2(desk.pointer.x, desk.pointer.y), max(1.5, radius_of(desk.hand, desk.pointer.eraser))
    painter.add_circle(at, radius + 0.5, theme.packed((0.0, 0.0, 0.0), 0.55), 0, 1.6 * desk.scale)
    painter.add_circle(at, radius - 0.5, theme.packed((1.0, 1.0, 1.0), 0.75), 0, 1.0 * desk.scale)


def draw_growing(desk: Desk) -> None:
    """Draws a small ring over what still grows, filled as far as it is done; not at once, so that little work shows
    none."""
    growing, radius = desk.known.growing, 7.0 * desk.scale
    if growing is None or time.monotonic() - desk.known.grows < _PATIENCE:
        return
    painter, (x0, y0, x1, y1) = imgui.get_background_draw_list(), desk.free_area()
    middles: list[tuple[float, float]] = []
    for level, rect in growing.rects[:MARKS]:
        ends = [desk.view.pixel_to_screen(level, x, y) for x in (rect.x0, rect.x1) for y in (rect.y0, rect.y1)]
        xs, ys = zip(*ends, strict=True)
        left, top, right, bottom = max(min(xs), x0), max(min(ys), y0), min(max(xs), x1), min(max(ys), y1)
        if left >= right or top >= bottom:
            continue
        middles.append(((left + right) / 2, (top + bottom) / 2))
    for x, y in apart(middles, 4 * radius):
        at = ImVec2(x, y)
        painter.add_circle_filled(at, 1.7 * radius, theme.packed((0.0, 0.0, 0.0), 0.45), 32)
        painter.add_circle(at, radius, theme.packed((1.0, 1.0, 1.0), 0.3), 32, 2.5 * desk.scale)
        painter.path_arc_to(at, radius, -math.pi / 2, (2 * growing.done - 0.5) * math.pi, 32)
        painter.path_stroke(theme.packed((1.0, 1.0, 1.0), 0.95), 2.5 * desk.scale)


def draw_shape(desk: Desk) -> None:
    """Draws what is about to be selected."""
    shape, far = desk.selecting.shape, 4.0 * (desk.view.width + desk.view.height)
    if len(shape) < 2:
        return
    ends = (desk.view.to_screen(place) for place in shape)
    points: list[ImVec2 | tuple[int | float, int | float] | list[int | float]] = [
        ImVec2(max(-far, min(far, x)), max(-far, min(far, y))) for x, y in ends
    ]
    closed = int(imgui.ImDrawFlags_.closed if desk.selecting.closed else imgui.ImDrawFlags_.none)
    painter = imgui.get_background_draw_list()
    for width, grey, alpha in ((2.6, 0.0, 0.55), (1.2, 1.0, 0.9)):
        painter.add_polyline(points, theme.packed((grey,) * 3, alpha), width * desk.scale, closed)


def apart(places: list[tuple[float, float]], least: float) -> list[tuple[float, float]]:
    """Returns those that no place before them is nearer to than that: as marks they would lie on one another."""
    found: list[tuple[float, float]] = []
    for place in places:
        if all(math.dist(place, other) >= least for other in found):
            found.append(place)
    return found


def _draw_marked(corners: tuple[float, float, float, float]) -> None:
    x0, y0, x1, y1 = corners
    painter = imgui.get_background_draw_list()
    a, b = ImVec2(min(x0, x1), min(y0, y1)), ImVec2(max(x0, x1), max(y0, y1))
    painter.add_rect(a, b, theme.packed((0.0, 0.0, 0.0), 0.6), 0.0, thickness=3.0)
    painter.add_rect(a, b, theme.packed((1.0, 1.0, 1.0), 0.9), 0.0, thickness=1.2)
