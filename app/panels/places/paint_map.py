"""The map: the frame and the paint around it, marks where there is deeper paint, and beside it how deep that lies."""

from __future__ import annotations

import math

from imgui_bundle import ImVec2, imgui

from app import theme
from app.canvas.standpoint import Standpoint
from app.canvas.view import place_of_pixel
from app.desk.desk import Desk
from app.desk.places import going
from app.language import said
from app.panels.controls import widgets as w
from app.panels.places.chart import Chart, Point
from app.panels.places.depth_scale import DepthScale
from engine.numeric.address import Rect
from engine.studio.results import Spot

_PLAIN = 3  # levels deeper than the map, up to which paint is seen in its picture and needs no mark
_DOT, _NEAR = 4.5, 11.0  # points: a mark's radius; from how far it can be clicked
_DEPTHS = 74.0  # points: the width of the scale of levels
_HINT = "Where there is paint; the frame is what you see.  Click to go there"


class PaintMapView:
    """Remembers which level is under the pointer on the scale beside it."""

    def __init__(self) -> None:
        self._scale = DepthScale()

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window, and takes clicks on it."""
        found, room = desk.places.map, imgui.get_content_region_avail()
        gap = imgui.get_style().item_spacing.x
        depths = _DEPTHS * desk.scale
        wide = room.x - depths - gap
        if found is None or not found.spots:
            _empty(room, "Nothing is painted yet" if found is not None else "")
            return
        chart = Chart(found, imgui.get_cursor_screen_pos(), (wide, room.y))
        self._picture(desk, chart)
        imgui.same_line(0, gap)
        self._scale.draw(desk, chart, (depths, room.y))

    # --- the picture -------------------------------------------------------------------------------------------------

    def _picture(self, desk: Desk, chart: Chart) -> None:
        clicked = imgui.invisible_button("map", ImVec2(*chart.room))
        w.named("map")
        hovered, mouse = imgui.is_item_hovered(), imgui.get_io().mouse_pos
        painter, corner, end = imgui.get_window_draw_list(), chart.corner, chart.end
        painter.add_rect_filled(corner, end, theme.packed(theme.look.field), 4 * desk.scale)
        shown = desk.pictures.get("map")
        if shown is not None:
            painter.add_image(shown, ImVec2(*chart.left_top), ImVec2(*chart.right_bottom))
        painter.push_clip_rect(corner, end, True)
        _outline(painter, chart, desk.known.frame)
        marked = [(spot, chart.at(spot)) for spot in chart.found.spots if _needs_mark(chart, spot)]
        under = _under(marked, (mouse.x, mouse.y), _NEAR * desk.scale) if hovered else None
        for spot, at in marked:
            lit = spot is under or spot.level == self._scale.lit
            _mark(painter, chart, at, chart.colour(spot.level), (_DOT + 1.5 * lit) * desk.scale, lit)
            w.placed(f"spot {spot.level}", ImVec2(at[0] - 3, at[1] - 3), ImVec2(at[0] + 3, at[1] + 3))
        _draw_view(painter, desk, chart)
        painter.pop_clip_rect()
        if under is not None:
            w.tooltip(f"Level {under.level}" + (f", {under.tiles} tiles" if under.tiles > 1 else ""))
        else:
            w.tooltip(_HINT)
        if clicked and under is not None:
            going.go_to_spot(desk, under)
        elif clicked:
            _go(desk, chart, (mouse.x, mouse.y))


def _needs_mark(chart: Chart, spot: Spot) -> bool:
    """Tells whether paint is too deep, or too far away, to be seen in the map's picture."""
    found = chart.found
    return spot.level > found.level + _PLAIN or not spot.rect.meets(found.area.zoomed(spot.level - found.level))


def _empty(room: ImVec2, text: str) -> None:
    corner, painter = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    imgui.dummy(room)
    painter.add_rect_filled(corner, ImVec2(corner.x + room.x, corner.y + room.y), theme.packed(theme.look.field), 4)
    size = said.calc_text_size(text)
    at = ImVec2(corner.x + (room.x - size.x) / 2, corner.y + (room.y - size.y) / 2)
    said.add_text(painter, at, theme.packed(theme.look.quiet), text)


def _outline(painter: imgui.ImDrawList, chart: Chart, frame: Rect) -> None:
    """Draws the frame's edge."""
    a, b = chart.place(place_of_pixel(0, frame.x0, frame.y0)), chart.place(place_of_pixel(0, frame.x1, frame.y1))
    painter.add_rect(ImVec2(*a), ImVec2(*b), theme.packed((0.0,) * 3, 0.5), 0.0, thickness=1.0)


def _mark(
    painter: imgui.ImDrawList, chart: Chart, at: Point, colour: tuple[float, ...], radius: float, lit: bool
) -> None:
    painter.add_circle_filled(ImVec2(*at), radius + 1.5, theme.packed((0.0,) * 3, 0.75 if lit else 0.5), 20)
    painter.add_circle_filled(ImVec2(*at), radius, theme.packed(colour), 20)


def _under(marked: list[tuple[Spot, Point]], mouse: Point, near: float) -> Spot | None:
    """Returns the mark under the pointer; of several as near the deepest."""
    within = [(round(math.dist(at, mouse)), -spot.level, n) for n, (spot, at) in enumerate(marked)]
    distance, _, n = min(within, default=(math.inf, 0, 0))
    return marked[n][0] if distance <= near else None


def _draw_view(painter: imgui.ImDrawList, desk: Desk, chart: Chart) -> None:
    """Draws what is seen now: its outline, or a cross where that is small."""
    x0, y0, x1, y1 = desk.free_area()
    ends = [chart.place(desk.view.to_canvas(x, y)) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    a, b, c, d = (ImVec2(x, y) for x, y in ends)
    small = math.dist(ends[0], ends[2]) < 14 * desk.scale
    for thick, colour in ((3.0, theme.packed((0.0,) * 3, 0.6)), (1.4, theme.packed((1.0,) * 3))):
        if small:
            (x, y), arm = chart.place(going.here(desk).place), 8 * desk.scale
            for dx, dy in ((1, 0), (0, 1), (-1, 0), (0, -1)):
                start = ImVec2(x + 0.6 * arm * dx, y + 0.6 * arm * dy)
                painter.add_line(start, ImVec2(x + 1.5 * arm * dx, y + 1.5 * arm * dy), colour, thick * desk.scale)
        else:
            painter.add_quad(a, b, c, d, colour, thick * desk.scale)


def _go(desk: Desk, chart: Chart, mouse: Point) -> None:
    """Flies to a point of the map, no nearer than the map can tell it."""
    level, area = chart.found.level, chart.found.area
    x, y = ((at - start) / chart.scale for at, start in zip(mouse, chart.left_top, strict=True))
    place = place_of_pixel(level, area.x0, area.y0).moved(x, y, level)
    now = going.here(desk)
    deepest = max(level + _PLAIN, 0)
    zoom = (now.level, now.fraction) if now.level < deepest else (deepest, 0.0)
    going.go(desk, Standpoint(place, *zoom, now.angle, now.mirrored))
