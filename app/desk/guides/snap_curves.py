"""Curves that strokes are drawn onto: lines and ellipses that guides lay near a place, at any depth.

A guide's points are exact, as fractions of a pixel; what is near an origin becomes floats only when the origin was
subtracted, so that a ruler laid at level 0 is as straight at level 900.  A place is told in pixels of one level.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import NamedTuple

from engine.painting.guiding.guides import Guide

Pair = tuple[float, float]
Exact = tuple[Fraction, Fraction]
PERSPECTIVES = ("perspective-1", "perspective-2", "perspective-3")
_FAR = 1 << 40  # px: what is farther lies there, in the same direction
_STRAIGHT = float(1 << 32)  # px: an ellipse that is longer is its tangent
_HALVINGS, _ON_AXIS = 200, 1e-30
_SAGITTA = 0.05  # px between a curve and what is drawn of it


class Line(NamedTuple):
    """A line through (x, y) along the unit vector (dx, dy)."""

    x: float
    y: float
    dx: float
    dy: float

    def nearest(self, x: float, y: float) -> Pair:
        """Returns the point on it that is nearest to (x, y)."""
        along = (x - self.x) * self.dx + (y - self.y) * self.dy
        return self.x + along * self.dx, self.y + along * self.dy

    def direction(self, _x: float, _y: float) -> Pair:
        """Returns a unit vector along it."""
        return self.dx, self.dy

    @property
    def step(self) -> float:
        """Gives how far apart points may be on it."""
        return math.inf


class Oval(NamedTuple):
    """An ellipse about (x, y); its half-axes are `long` along the unit vector (dx, dy), and `wide` across it."""

    x: float
    y: float
    dx: float
    dy: float
    long: float
    wide: float

    def nearest(self, x: float, y: float) -> Pair:
        """Returns the point on it that is nearest to (x, y)."""
        u, v = self._within(x, y)
        if self.long >= self.wide:
            u, v = _nearest(self.long, self.wide, u, v)
        else:
            v, u = _nearest(self.wide, self.long, v, u)
        return self.x + self.dx * u - self.dy * v, self.y + self.dy * u + self.dx * v

    def direction(self, x: float, y: float) -> Pair:
        """Returns a unit vector along it at a point of it."""
        u, v = self._within(x, y)
        along, across = -v / (self.wide * self.wide), u / (self.long * self.long)
        size = math.hypot(along, across) or 1.0
        along, across = along / size, across / size
        return self.dx * along - self.dy * across, self.dy * along + self.dx * across

    def at(self, turn: float) -> Pair:
        """Returns a point of it."""
        u, v = self.long * math.cos(turn), self.wide * math.sin(turn)
        return self.x + self.dx * u - self.dy * v, self.y + self.dy * u + self.dx * v

    @property
    def step(self) -> float:
        """Gives how far apart points may be on it, to be seen as a curve."""
        short, far = sorted((self.long, self.wide))
        return max(1.0, math.sqrt(8.0 * _SAGITTA * short * short / far))

    def _within(self, x: float, y: float) -> Pair:
        x, y = x - self.x, y - self.y
        return x * self.dx + y * self.dy, y * self.dx - x * self.dy


Edge = Line | Oval


def _nearest(long: float, wide: float, u: float, v: float) -> Pair:
    """Returns the nearest point of an ellipse along the axes, long >= wide > 0: the root of a falling function, halved
    down to the last bit (Eberly, "Distance from a point to an ellipse")."""
    x, y = abs(u) / long, abs(v) / wide
    ratio = (long / wide) * (long / wide)
    if y < _ON_AXIS:
        reach = long - wide * (wide / long)
        part = abs(u) / reach if reach > 0.0 else math.inf
        near = (long * part, wide * math.sqrt(1.0 - part * part)) if part < 1.0 else (long, 0.0)
    else:
        low, high = y, max(1.0, math.hypot(ratio * x, y))
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            if middle in (low, high):
                break
            a, b = ratio * x / (middle + (ratio - 1.0)), y / middle
            low, high = (middle, high) if a * a + b * b > 1.0 else (low, middle)
        a, b = ratio * x / (high + (ratio - 1.0)), y / high
        size = math.hypot(a, b) or 1.0
        near = (long * a / size, wide * b / size)
    return math.copysign(near[0], u), math.copysign(near[1], v)


# --- where guides lie ----------------------------------------------------------------------------------------------


def exact(guide: Guide, number: int, level: int, origin: tuple[int, int]) -> Exact:
    """Returns where a point of a guide lies, in pixels of a level from an origin."""
    scale = Fraction(2) ** (level - guide.level)
    x, y = guide.points[number]
    return (guide.at[0] + Fraction(x)) * scale - origin[0], (guide.at[1] + Fraction(y)) * scale - origin[1]


def near(place: Exact) -> Pair:
    """Returns a place as floats; one that is too far for them in the same direction."""
    x, y = place
    far = max(abs(x), abs(y))
    part = _FAR / far if far > _FAR else Fraction(1)
    return float(x * part), float(y * part)


def side(guide: Guide, number: int) -> Pair:
    """Returns the way from the first point of a guide to another, in pixels of its own level."""
    (x0, y0), (x1, y1) = guide.points[0], guide.points[number]
    return x1 - x0, y1 - y0


def line_along(at: Exact, way: Pair) -> Line:
    """Returns the line through a place, told by its point that is nearest to the origin."""
    x, y = Fraction(way[0]), Fraction(way[1])
    part = -(at[0] * x + at[1] * y) / (x * x + y * y)
    return through(near((at[0] + part * x, at[1] + part * y)), way)


def through(place: Pair, way: Pair) -> Line:
    """Returns the line through a place in a direction."""
    length = math.hypot(*way)
    return Line(*place, way[0] / length, way[1] / length)


def oval_of(guide: Guide, level: int, origin: tuple[int, int]) -> Edge:
    """Returns the ellipse of a guide; near the origin alone, if it is so large that it is straight there."""
    centre, (ax, ay), scale = exact(guide, 0, level, origin), side(guide, 1), _scale(level - guide.level)
    bx, by = side(guide, 2)
    length = math.hypot(ax, ay)
    wide = abs(ax * by - ay * bx) / length
    if max(length, wide) * scale <= _STRAIGHT:
        return Oval(*near(centre), ax / length, ay / length, length * scale, wide * scale)
    return _tangent(guide, centre, level)


def _tangent(guide: Guide, centre: Exact, level: int) -> Line:
    """Returns the tangent of an ellipse where it is nearest to the origin, from its equation there, exactly."""
    unit = Fraction(2) ** (level - guide.level)
    ax, ay = (Fraction(part) * unit for part in side(guide, 1))
    bx, by = (Fraction(part) * unit for part in side(guide, 2))
    square, area = ax * ax + ay * ay, ax * by - ay * bx
    x, y = -centre[0], -centre[1]
    along, across = (x * ax + y * ay) / (square * square), (y * ax - x * ay) / (area * area)
    over = (x * ax + y * ay) * along + (y * ax - x * ay) * across - 1
    gx, gy = 2 * (along * ax - across * ay), 2 * (along * ay + across * ax)
    steep = gx * gx + gy * gy
    if not steep:
        return Line(float(_FAR), 0.0, 0.0, 1.0)  # from its very centre it is out of reach
    foot = near((-over * gx / steep, -over * gy / steep))
    most = max(abs(gx), abs(gy))
    return through(foot, (-float(gy / most), float(gx / most)))


def _scale(levels: int) -> float:
    return math.ldexp(1.0, max(-1000, min(900, levels)))


def cell_place(guide: Guide, level: int, origin: tuple[int, int]) -> Exact:
    """Returns where an origin lies in a grid: in sides of its cells from where it begins."""
    x, y = (-part for part in exact(guide, 0, level, origin))
    unit = Fraction(2) ** (level - guide.level)
    (ux, uy), (vx, vy) = (tuple(Fraction(part) * unit for part in side(guide, n)) for n in (1, 2))
    area = ux * vy - uy * vx
    return (x * vy - y * vx) / area, (y * ux - x * uy) / area


# --- the lines of each kind near a place ---------------------------------------------------------------------------


def _ruler(guide: Guide, level: int, origin: tuple[int, int], _at: Pair) -> list[Edge]:
    return [line_along(exact(guide, 0, level, origin), side(guide, 1))]


def _parallel(guide: Guide, _level: int, _origin: tuple[int, int], at: Pair) -> list[Edge]:
    return [through(at, side(guide, 1))]


def _ellipse(guide: Guide, level: int, origin: tuple[int, int], _at: Pair) -> list[Edge]:
    return [oval_of(guide, level, origin)]


def _grid(guide: Guide, level: int, origin: tuple[int, int], at: Pair) -> list[Edge]:
    scale = _scale(level - guide.level)
    (ux, uy), (vx, vy) = ((x * scale, y * scale) for x, y in (side(guide, 1), side(guide, 2)))
    area = ux * vy - uy * vx
    if not area or not math.isfinite(area):
        return []
    a, b = cell_place(guide, level, origin)
    x, y = (at[0] * vy - at[1] * vx) / area, (at[1] * ux - at[0] * uy) / area
    right, down = float(round(a + Fraction(x)) - a), float(round(b + Fraction(y)) - b)
    return [through((vx * down, vy * down), (ux, uy)), through((ux * right, uy * right), (vx, vy))]


def _perspective(guide: Guide, level: int, origin: tuple[int, int], at: Pair) -> list[Edge]:
    points = 1 if guide.kind == "perspective-1" else len(guide.points)
    ways = [(x - at[0], y - at[1]) for x, y in (near(exact(guide, n, level, origin)) for n in range(points))]
    across = side(guide, 1)
    ways += [(-across[1], across[0])] if points < 3 else []
    ways += [across] if points == 1 else []
    return [through(at, way) for way in ways if math.hypot(*way) > 1e-6]


# By the kind of a guide, the curves that a stroke from a place may be drawn onto.
CURVES: dict[str, Callable[[Guide, int, tuple[int, int], Pair], list[Edge]]] = {
    "ruler": _ruler,
    "parallel": _parallel,
    "ellipse": _ellipse,
    "grid": _grid,
    **dict.fromkeys(PERSPECTIVES, _perspective),
}
