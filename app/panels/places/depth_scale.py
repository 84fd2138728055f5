"""The scale beside the map: how much paint there is at each level, and at which the view is."""

from __future__ import annotations

import math

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.places import going
from app.language import said
from app.panels.controls import widgets as w
from app.panels.places.chart import Chart, Point

_HINT = "How deep there is paint.  Click to go to the nearest of a level"
_BEYOND = 2  # levels that the scale goes on, at most, where the view is beyond all paint


class DepthScale:
    """`lit`: the level under the pointer."""

    def __init__(self) -> None:
        self.lit: int | None = None

    def draw(self, desk: Desk, chart: Chart, size: Point) -> None:
        """Draws it into the present window, `size` pixels large, and takes clicks on it."""
        corner = imgui.get_cursor_screen_pos()
        clicked = imgui.invisible_button("depths", ImVec2(*size))
        w.named("depths")
        end = ImVec2(corner.x + size[0], corner.y + size[1])
        imgui.get_window_draw_list().add_rect_filled(corner, end, theme.packed(theme.look.field), 4)
        ruler = _Ruler(desk, chart, corner, size)
        mouse = imgui.get_io().mouse_pos.y
        hovered = imgui.is_item_hovered()
        self.lit = min(chart.tiles, key=lambda level: abs(ruler.height(level) - mouse)) if hovered else None
        ruler.bars(self.lit)
        ruler.labels(self.lit)
        ruler.view()
        if self.lit is None:
            w.tooltip(_HINT)
            return
        spots = [spot for spot in chart.found.spots if spot.level == self.lit]
        w.tooltip(f"Level {self.lit}" + (f", {len(spots)} places" if len(spots) > 1 else ""))
        if clicked:
            middle = chart.place(going.here(desk).place)
            going.go_to_spot(desk, min(spots, key=lambda spot: math.dist(chart.at(spot), middle)))


class _Ruler:
    """One frame of it: levels downward, from the coarsest."""

    def __init__(self, desk: Desk, chart: Chart, corner: ImVec2, size: Point) -> None:
        self._chart, self._scale, self._line = chart, desk.scale, imgui.get_text_line_height()
        least, most = min(chart.tiles), max(chart.tiles)
        self._now = min(max(desk.view.level + desk.view.fraction, least - _BEYOND), most + _BEYOND)
        self._first, last = min(least, math.floor(self._now)), max(most, math.ceil(self._now))
        self._span = max(1, last - self._first)
        self._top, self._tall = corner.y + self._line, size[1] - 2 * self._line
        self._left, self._right = corner.x + 2.3 * imgui.get_font_size(), corner.x + size[0] - 6 * desk.scale
        self._painter = imgui.get_window_draw_list()

    def height(self, level: float) -> float:
        """Returns where a level lies on the screen."""
        return self._top + self._tall * (level - self._first) / self._span

    def bars(self, lit: int | None) -> None:
        """Draws how much paint there is."""
        tiles = self._chart.tiles
        half = max(1.0, min(4.5 * self._scale, 0.35 * self._tall / (self._span + 1)))
        most = math.log2(1 + max(tiles.values()))
        for level, count in tiles.items():
            y, part = self.height(level), 0.15 + 0.85 * math.log2(1 + count) / most
            colour = theme.packed(self._chart.colour(level), 1.0 if lit in (None, level) else 0.4)
            end = ImVec2(self._left + (self._right - self._left) * part, y + half)
            self._painter.add_rect_filled(ImVec2(self._left, y - half), end, colour, 1.5)

    def labels(self, lit: int | None) -> None:
        """Draws the numbers for which there is room."""
        told: list[float] = []
        ends = min(self._chart.tiles), max(self._chart.tiles)
        for level in ([] if lit is None else [lit]) + [*ends, *sorted(self._chart.tiles)]:
            y = self.height(level)
            if any(abs(y - other) < self._line for other in told):
                continue
            told.append(y)
            text = str(level).replace("-", "−")
            at = ImVec2(self._left - said.calc_text_size(text).x - 8 * self._scale, y - self._line / 2)
            said.add_text(self._painter, at, theme.packed(theme.look.text if level == lit else theme.look.quiet), text)

    def view(self) -> None:
        """Draws where the view is."""
        y, tip, white = self.height(self._now), 5 * self._scale, theme.packed(theme.look.text)
        self._painter.add_line(ImVec2(self._left - 2, y), ImVec2(self._right, y), white, 1.5)
        a, b = ImVec2(self._left - 2 - tip, y - tip), ImVec2(self._left - 2 - tip, y + tip)
        self._painter.add_triangle_filled(ImVec2(self._left - 2, y), a, b, white)
