"""Where one stands: what lies in the middle, how near, how turned, whatever the screen; and as a rectangle of a level.

A rectangle is told as bookmarks tell it (`engine.painting.places`): a real level, origin and size in pixels of it.
Places are kept to 2^-16 pixels at any depth: so from a standpoint to its rectangle and back is the identity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from app.canvas.view import SUBPIXEL, Place, View, distance
from engine.numeric.scaling import scaled
from engine.painting.places import LEVEL_LIMIT, Bookmark, middle_of

Size = tuple[float, float]  # width, height
_EXACT = 1 << 52  # units that a float holds without loss
_NEAR, _ALIKE, _TURNED = 0.3, 0.6, 0.1  # of a screen; levels; radians: what is nearer is the same place to the artist


@dataclass(frozen=True, slots=True)
class Standpoint:
    """`place` lies in the middle; the zoom and the turn are those of `View`."""

    place: Place
    level: int
    fraction: float
    angle: float = 0.0
    mirrored: bool = False

    @classmethod
    def of(cls, view: View, x: float, y: float) -> Standpoint:
        """Makes that of a view whose middle is the screen point (x, y)."""
        return cls(view.to_canvas(x, y), view.level, view.fraction, view.angle, view.mirrored)

    def seen_from(self, view: View, x: float, y: float) -> View:
        """Returns what is seen from here on the screen of a view whose middle is (x, y); the inverse of `of`."""
        there = replace(
            view, level=self.level, fraction=self.fraction, angle=self.angle, mirrored=self.mirrored
        )  # fmt: skip
        return there.held(self.place, x, y)

    def near(self, other: Standpoint, side: float) -> bool:
        """Tells whether both show about the same on a screen of `side` pixels."""
        if self.mirrored != other.mirrored or abs(math.remainder(self.angle - other.angle, math.tau)) > _TURNED:
            return False
        view = View(self.place, self.level, self.fraction, 0, 0)
        return abs(distance(view, other.level, other.fraction)) < _ALIKE and (
            math.hypot(*view.to_screen(other.place)) < _NEAR * side
        )

    def bookmark(self, name: str, size: Size) -> Bookmark:
        """Returns it as a bookmark of what a screen of `size` shows.

        Where floats cannot hold the origin, it is told in pixels of a level that is 16 deeper, of which it has whole
        ones.
        """
        level = self.level + self.fraction
        fraction, whole = math.modf(level)
        wide, tall = (max(1, round(side)) for side in size)
        middle = (scaled(units, fraction) for units in _units(self.place, int(whole)))
        fine = [units - (side << SUBPIXEL - 1) for units, side in zip(middle, (wide, tall), strict=True)]
        angle = math.degrees(self.angle)
        if max(map(abs, fine)) < _EXACT:
            x, y = (_plain(units) for units in fine)
            return Bookmark(name, level, (x, y), (wide, tall), angle, self.mirrored)
        if level + SUBPIXEL <= LEVEL_LIMIT:
            size = (wide << SUBPIXEL, tall << SUBPIXEL)
            return Bookmark(name, level + SUBPIXEL, (fine[0], fine[1]), size, angle, self.mirrored)
        x, y = (units >> SUBPIXEL for units in fine)
        return Bookmark(name, level, (x, y), (wide, tall), angle, self.mirrored)


def standpoint_at(bookmark: Bookmark, size: Size) -> Standpoint:
    """Returns where one stands to see a bookmark's rectangle as large as a screen of `size` shows it."""
    wide, tall = (max(1, round(side)) for side in size)
    zoom = bookmark.level + math.log2(min(wide / bookmark.size[0], tall / bookmark.size[1]))
    level = math.floor(zoom)
    place = Place(*_units(Place(*middle_of(bookmark)), level), level + SUBPIXEL)
    return Standpoint(place, level, zoom - level, math.radians(bookmark.angle), bookmark.mirrored)


def _plain(units: int) -> float:
    """2^-16 pixels as pixels: an int where they are whole."""
    return units >> SUBPIXEL if not units & ((1 << SUBPIXEL) - 1) else units / (1 << SUBPIXEL)


def _units(place: Place, level: int) -> tuple[int, int]:
    """Returns a place in 2^-16 pixels of a level, rounded."""
    n = place.exponent - level - SUBPIXEL
    if n <= 0:
        return place.x << -n, place.y << -n
    half = 1 << n - 1
    return place.x + half >> n, place.y + half >> n
