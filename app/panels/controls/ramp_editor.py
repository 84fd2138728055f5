"""The editor of a colour ramp: a bar with a mark below for each stop."""

from __future__ import annotations

from itertools import pairwise

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk import ramps
from app.desk.colours import from_hex, to_hex
from app.desk.ramps import Stops
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import colour_popup


class RampEditor:
    """Remembers which stop is chosen and whether the pointer holds it."""

    def __init__(self) -> None:
        self._chosen = 0
        self._held = False

    def draw(self, stops: Stops, hint: str) -> Stops:
        """Returns the stops as they are now: a click on the bar adds one, a drag moves it, a right click takes it
        away."""
        width, height = imgui.get_content_region_avail().x, imgui.get_frame_height() * 1.6
        corner = imgui.get_cursor_screen_pos()
        buttons = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_right
        imgui.invisible_button("ramp", ImVec2(width, height), buttons)
        w.tooltip(f"{hint}\nClick adds a stop, drag moves it, right click takes it away")
        inset = height * 0.2
        span = width - 2 * inset
        place = (imgui.get_io().mouse_pos.x - corner.x - inset) / span
        stops = self._moved(stops, place, inset / span)
        self._chosen = min(self._chosen, len(stops) - 1)
        _bar(stops, ImVec2(corner.x + inset, corner.y), ImVec2(corner.x + width - inset, corner.y + height * 0.56))
        for i, (at, colour) in enumerate(stops):
            _mark(ImVec2(corner.x + inset + at * span, corner.y + height * 0.52), inset, colour, i == self._chosen)
        return self._colour(stops)

    def _moved(self, stops: Stops, place: float, reach: float) -> Stops:
        if imgui.is_item_hovered() and imgui.is_mouse_clicked(imgui.MouseButton_.right):
            near = _nearest(stops, place, reach)
            return stops if near is None else ramps.removed(stops, near)
        if imgui.is_item_activated() and imgui.is_mouse_clicked(imgui.MouseButton_.left):
            near = _nearest(stops, place, reach)
            if near is None:
                stops, near = ramps.added(stops, min(max(place, 0.0), 1.0))
            self._held = near is not None
            self._chosen = self._chosen if near is None else near
        if not imgui.is_item_active():
            self._held = False
        dragged = self._held and abs(imgui.get_mouse_drag_delta(imgui.MouseButton_.left).x) > 0
        return ramps.moved(stops, self._chosen, place) if dragged else stops

    def _colour(self, stops: Stops) -> Stops:
        """Returns the chosen stop's colour, and what can be done with the whole ramp."""
        side = imgui.get_frame_height()
        rgb = from_hex(stops[self._chosen][1])
        if w.swatch("stop", rgb, "The chosen stop's colour", (side * 2, side)):
            imgui.open_popup("stop colour")
        changed = colour_popup("stop colour", rgb)
        if changed is not None:
            stops = ramps.recoloured(stops, self._chosen, to_hex(changed))
        imgui.same_line()
        if w.icon_button("turn", icons.SWAP, "Turn the ramp round"):
            stops, self._chosen = ramps.turned(stops), len(stops) - 1 - self._chosen
        imgui.same_line()
        removable = len(stops) > ramps.FEWEST
        if w.icon_button("drop", icons.DELETE, "Take the chosen stop away", enabled=removable):
            stops = ramps.removed(stops, self._chosen)
            self._chosen = min(self._chosen, len(stops) - 1)
        return stops


def _nearest(stops: Stops, place: float, reach: float) -> int | None:
    distance, i = min((abs(at - place), i) for i, (at, _) in enumerate(stops))
    return i if distance <= reach else None


def _bar(stops: Stops, corner: ImVec2, end: ImVec2) -> None:
    painter, width = imgui.get_window_draw_list(), end.x - corner.x
    ends = ((0.0, stops[0][1]), *stops, (1.0, stops[-1][1]))
    for (p0, c0), (p1, c1) in pairwise(ends):
        a, b = theme.packed(from_hex(c0)), theme.packed(from_hex(c1))
        left, right = ImVec2(corner.x + width * p0, corner.y), ImVec2(corner.x + width * p1, end.y)
        painter.add_rect_filled_multi_color(left, right, a, b, b, a)


def _mark(at: ImVec2, radius: float, colour: str, chosen: bool) -> None:
    """Draws a drop that points up at its place."""
    painter = imgui.get_window_draw_list()
    rim = theme.packed(theme.look.text if chosen else theme.look.edge)
    middle = ImVec2(at.x, at.y + radius * 1.35)
    left, right = (
        ImVec2(at.x - radius * 0.7, middle.y - radius * 0.6),
        ImVec2(at.x + radius * 0.7, middle.y - radius * 0.6),
    )
    painter.add_triangle_filled(at, right, left, rim)
    painter.add_circle_filled(middle, radius, rim, 20)
    painter.add_circle_filled(middle, radius * 0.72, theme.packed(from_hex(colour)), 20)
