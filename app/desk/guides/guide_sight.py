"""Guides as the screen shows them: where their points, lines and handles lie, exact at any depth."""

from __future__ import annotations

import math
from typing import NamedTuple

from app.canvas.view import View
from app.desk.desk import Desk
from app.desk.guides.snap_curves import CURVES, PERSPECTIVES, Line, Oval, Pair, exact, near, oval_of, side
from engine.painting.guiding.guides import Guide

RIM = 20.0  # points of the screen from its rim to the handles of what lies beyond
ARM = 160.0  # points of the screen from a vanishing point to the handle that turns its horizon
_BODIES = ("ruler", "ellipse")  # kinds that are moved by their line


class Sight(NamedTuple):
    """A view, with the level that it shows and the pixel of it that lies in the middle."""

    view: View
    level: int
    origin: tuple[int, int]

    def to_screen(self, place: Pair) -> Pair:
        """Returns where a place is seen that is told in pixels of the level from the pixel in the middle."""
        x, y = self.view.pixel_to_screen(self.level, *self.origin)
        dx, dy = self.way(place)
        scale = self.view.scale(self.level)
        return x + dx * scale, y + dy * scale

    def way(self, way: Pair) -> Pair:
        """Returns a direction as it is seen."""
        a, b, c, d = self.view.matrix()
        return a * way[0] + b * way[1], c * way[0] + d * way[1]

    def to_level(self, x: float, y: float) -> Pair:
        """Returns the place under a point of the screen."""
        return self.view.to_canvas(x, y).offset(self.level, *self.origin)


def sight_of(view: View) -> Sight:
    """Returns how a view sees guides."""
    level = view.shown_level
    return Sight(view, level, view.centre.pixel(level))


def seen_point(sight: Sight, guide: Guide, number: int) -> Pair:
    """Returns where a point of a guide is seen; one that is too far away in its direction."""
    return sight.to_screen(near(exact(guide, number, sight.level, sight.origin)))


def handles(desk: Desk, guide: Guide) -> list[Pair]:
    """Returns where the handles of a guide are on the screen, one for each of its points; those of vanishing points out
    of sight at the rim of what no panel covers."""
    sight = sight_of(desk.view)
    found = [seen_point(sight, guide, n) for n in range(len(guide.points))]
    if guide.kind == "perspective-1":
        dx, dy = sight.way(side(guide, 1))
        arm = ARM * desk.scale / math.hypot(dx, dy)
        found[1] = found[0][0] + dx * arm, found[0][1] + dy * arm
    return [_kept_in_sight(desk, at) for at in found] if guide.kind in PERSPECTIVES else found


def _kept_in_sight(desk: Desk, at: Pair) -> Pair:
    """Returns the place nearest to a point of the screen that no panel covers: on a level horizon it stays there."""
    x0, y0, x1, y1 = desk.free_area()
    rim = RIM * desk.scale
    return max(x0 + rim, min(x1 - rim, at[0])), max(y0 + rim, min(y1 - rim, at[1]))


def distance_to(desk: Desk, guide: Guide, x: float, y: float) -> float:
    """Returns how far a point of the screen is from the line by which a guide is moved, framebuffer pixels."""
    if guide.kind not in _BODIES:
        return math.inf
    sight = sight_of(desk.view)
    curve = CURVES[guide.kind](guide, sight.level, sight.origin, (0.0, 0.0))[0]
    foot = sight.to_screen(curve.nearest(*sight.to_level(x, y)))
    if isinstance(curve, Line) and guide.kind == "ruler":
        start, end = handles(desk, guide)
        if math.dist(start, foot) + math.dist(foot, end) > math.dist(start, end) + 1.0:
            return math.inf
    return math.dist(foot, (x, y))


def oval_on_screen(sight: Sight, guide: Guide) -> list[Pair] | Line:
    """Returns an ellipse as points of the screen, or the line that it is here."""
    curve = oval_of(guide, sight.level, sight.origin)
    if not isinstance(curve, Oval):
        return curve
    scale = sight.view.scale(sight.level)
    radius = max(curve.long, curve.wide) * scale
    if radius > 4.0 * max(sight.view.width, sight.view.height):  # its part near the middle alone
        return _arc(sight, curve)
    count = max(32, min(512, math.ceil(math.pi * math.sqrt(radius * 4.0))))
    return [sight.to_screen(curve.at(math.tau * k / count)) for k in range(count + 1)]


def _arc(sight: Sight, curve: Oval) -> list[Pair]:
    """Returns the part of an ellipse around its point that is nearest to the middle."""
    reach = 1.5 * max(sight.view.width, sight.view.height) / sight.view.scale(sight.level)
    x, y = curve.nearest(*sight.to_level(sight.view.width / 2, sight.view.height / 2))
    dx, dy = curve.direction(x, y)
    ways = (reach * k / 128 for k in range(-128, 129))
    return [sight.to_screen(curve.nearest(x + dx * by, y + dy * by)) for by in ways]


def clipped(ray: tuple[Pair, Pair], size: Pair, low: float = -math.inf) -> tuple[Pair, Pair] | None:
    """Returns the part on a screen of `size` of a line from a point in a direction, from `low` on; None where there is
    none."""
    high = math.inf
    (x, y), (dx, dy) = ray
    for at, step, edge in ((x, dx, size[0]), (y, dy, size[1])):
        if abs(step) < 1e-12:
            if not 0.0 <= at <= edge:
                return None
            continue
        first, last = sorted((-at / step, (edge - at) / step))
        low, high = max(low, first), min(high, last)
    if low >= high or math.isinf(high) or math.isinf(low):
        return None
    return (x + low * dx, y + low * dy), (x + high * dx, y + high * dy)
