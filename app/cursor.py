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
from app.desk.land.land_ring import ring_on_land
from app.desk.moving import held_box
from app.desk.moving.box import SCALES, TURN
from app.desk.moving.move_state import TOOL
from app.language import said
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
_OVER_PANELS = {
    int(imgui.MouseCursor_.resize_ew): glfw.RESIZE_EW_CURSOR,
    int(imgui.MouseCursor_.resize_ns): glfw.RESIZE_NS_CURSOR,
    int(imgui.MouseCursor_.resize_nwse): glfw.RESIZE_NWSE_CURSOR,
}
_RINGS, _GHOST = 32, 0.8  # circles that show a dab, and how opaque it is
_AROUND = 0.6  # how dark paper is around the frame


def shape(desk: Desk, panning: bool) -> int:
    """GLFW's cursor for where the pointer is."""
    if not desk.pointer.over_canvas:
        return int(_OVER_PANELS.get(imgui.get_mouse_cursor(), glfw.ARROW_CURSOR))
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
    if desk.hand_sight.ghost is not None:
        return
    at, radius = _brush_at(desk), max(1.5, radius_of(desk.hand, desk.pointer.eraser))
    if desk.land.on:
        level = desk.view.shown_level if desk.painting else None  # a stroke keeps the one at which it began
        ring = [ImVec2(*one) for one in ring_on_land(desk.land, desk.pointer.x, desk.pointer.y, radius, level)]
        for width, grey, alpha in ((2.6, 0.0, 0.55), (1.2, 1.0, 0.9)) if ring else ():
            colour = theme.packed((grey,) * 3, alpha)
            painter.add_polyline([*ring], colour, width * desk.scale, int(imgui.ImDrawFlags_.closed))
        return
    painter.add_circle(at, radius + 0.5, theme.packed((0.0, 0.0, 0.0), 0.55), 0, 1.6 * desk.scale)
    painter.add_circle(at, radius - 0.5, theme.packed((1.0, 1.0, 1.0), 0.75), 0, 1.0 * desk.scale)


def _brush_at(desk: Desk) -> ImVec2:
    """Returns where the brush is on the screen; draws the rope by which the pen draws it, if there is one."""
    pen = ImVec2(desk.pointer.x, desk.pointer.y)
    if desk.hand_sight.brush_at is None:
        return pen
    at, painter = ImVec2(*desk.view.to_screen(desk.hand_sight.brush_at)), imgui.get_background_draw_list()
    for width, grey, alpha in ((2.6, 0.0, 0.45), (1.2, 1.0, 0.85)):
        painter.add_line(at, pen, theme.packed((grey,) * 3, alpha), width * desk.scale)
    return at


def draw_ghost(desk: Desk) -> None:
    """Draws the dab of a brush whose size is dragged, with what that is."""
    ghost = desk.hand_sight.ghost
    if ghost is None:
        return
    brush, painter, at = desk.hand.brush, imgui.get_foreground_draw_list(), ImVec2(*ghost)
    colour = (0.5,) * 3 if not brush.row.lays_ink or desk.hand.erasing else desk.hand.colour
    left = 1.0
    for radius, alpha in dab_rings(brush.radius, brush.hardness):
        painter.add_circle_filled(at, radius, theme.packed(colour, 1.0 - (1.0 - _GHOST * alpha) / left), 0)
        left = 1.0 - _GHOST * alpha
    for radius, alpha in ((brush.radius, 0.9), (brush.radius * brush.hardness, 0.5)):
        painter.add_circle(at, radius + 0.5, theme.packed((0.0,) * 3, 0.55 * alpha), 0, 1.6 * desk.scale)
        painter.add_circle(at, radius - 0.5, theme.packed((1.0,) * 3, alpha), 0, 1.0 * desk.scale)
    text = f"{brush.radius:.1f} px   {brush.hardness:.0%} hard"
    size, pad = said.calc_text_size(text), 5 * desk.scale
    x = at.x - size.x / 2
    y = min(at.y + brush.radius + 2 * pad, desk.view.height - size.y - 3 * pad)
    painter.add_rect_filled(
        (x - pad, y - pad), (x + size.x + pad, y + size.y + pad), theme.packed(theme.look.panel), pad
    )
    said.add_text(painter, ImVec2(x, y), theme.packed(theme.look.text), text)


def dab_rings(radius: float, hardness: float) -> list[tuple[float, float]]:
    """Returns circles within one another that show a dab, from the outer: (radius, alpha there), as
    `engine.brush.discs` has its profile."""
    outer, inner = radius + 0.5, max(0.0, min(hardness * radius, radius - 0.5))
    rings = []
    for i in range(_RINGS):
        r = outer + (inner - outer) * (i + 0.5) / _RINGS
        u = (r * r - inner * inner) / (outer * outer - inner * inner)
        rings.append((r, (1 - u) ** 2 * (1 + 2 * u)))
    return rings


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
