"""The map's measures: where what is on it lies on the screen, and the colours of levels."""

from __future__ import annotations

import colorsys

from imgui_bundle import ImVec2

from app.canvas.view import Place, place_of_pixel
from engine.studio.results import PaintMap, Spot

Point = tuple[float, float]


class Chart:
    """Where what is on the map lies on the screen.  `tiles`: of paint, by level; `room`: width and height, pixels."""

    def __init__(self, found: PaintMap, corner: ImVec2, room: Point) -> None:
        self.found, self.corner, self.room = found, corner, room
        self.end = ImVec2(corner.x + room[0], corner.y + room[1])
        area = found.area
        self.scale = min(room[0] / area.width, room[1] / area.height)
        x = corner.x + (room[0] - area.width * self.scale) / 2
        y = corner.y + (room[1] - area.height * self.scale) / 2
        self.left_top = x, y
        self.right_bottom = x + area.width * self.scale, y + area.height * self.scale
        self.tiles: dict[int, int] = {}
        for spot in found.spots:
            self.tiles[spot.level] = self.tiles.get(spot.level, 0) + spot.tiles

    def place(self, place: Place) -> Point:
        """Returns where a place of the canvas lies."""
        x, y = place.offset(self.found.level, self.found.area.x0, self.found.area.y0)
        return self.left_top[0] + x * self.scale, self.left_top[1] + y * self.scale

    def at(self, spot: Spot) -> Point:
        """Returns where the middle of a spot lies; at the edge of the map where it is outside."""
        rect = spot.rect
        x, y = self.place(place_of_pixel(spot.level + 1, rect.x0 + rect.x1, rect.y0 + rect.y1))
        return min(max(x, self.corner.x + 6), self.end.x - 6), min(max(y, self.corner.y + 6), self.end.y - 6)

    def colour(self, level: int) -> tuple[float, ...]:
        """Returns the colour of a level: from yellow, the coarsest, over green to violet."""
        first, last = min(self.tiles), max(self.tiles)
        part = (level - first) / max(1, last - first)
        return colorsys.hsv_to_rgb(0.13 + 0.65 * part, 0.62, 0.95)
