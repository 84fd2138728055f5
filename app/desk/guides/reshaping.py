"""What a guide becomes while one of its points is dragged, or a number of it is typed: exact places in, places out."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction

from app.desk.guides.snap_curves import Exact, Pair, exact
from engine.painting.guiding.guides import GUIDE_KINDS, POINT_REACH, Guide, on_a_line
from engine.painting.places import LEVEL_LIMIT

Points = list[Exact]
_STEP = math.pi / 12  # of angles that are held to some
_ROOM = POINT_REACH / 2
_OUT = 0.9  # parts of the screen from its middle to vanishing points: nearer, boxes look twisted
CELL = 64  # px: a new grid's


def places_of(guide: Guide, level: int, origin: tuple[int, int]) -> Points:
    """Returns where its points lie, in pixels of a level from an origin."""
    return [exact(guide, n, level, origin) for n in range(len(guide.points))]


def guide_at(guide: Guide, points: Points, level: int, origin: tuple[int, int]) -> Guide | None:
    """Returns a guide with its points elsewhere, told at that level, or at a coarser one if they are far apart; None
    where they would be no guide of its kind."""
    x, y = points[0]
    reach = max(max(abs(a - x), abs(b - y)) for a, b in points)
    coarser = 0
    while reach > _ROOM:
        reach, coarser = reach / 2, coarser + 1
    if not -LEVEL_LIMIT <= level - coarser <= LEVEL_LIMIT:
        return None
    part = Fraction(1, 1 << coarser)
    places = [((a + origin[0]) * part, (b + origin[1]) * part) for a, b in points]
    left, top = math.floor(places[0][0]), math.floor(places[0][1])
    told = tuple((float(a - left) + 0.0, float(b - top) + 0.0) for a, b in places)
    if len(set(told)) < len(told) or (GUIDE_KINDS[guide.kind].wide and on_a_line(told)):
        return None
    return replace(guide, level=level - coarser, at=(left, top), points=told)


def shifted_by(points: Points, by: Exact) -> Points:
    """Returns all points moved."""
    return [(x + by[0], y + by[1]) for x, y in points]


def way(points: Points, number: int) -> Pair:
    """Returns the way from the first point to another; that of two that lie too far apart for it is shortened."""
    (x0, y0), (x1, y1) = points[0], points[number]
    x, y = x1 - x0, y1 - y0
    far = max(abs(x), abs(y), Fraction(1))
    part = min(Fraction(1), (1 << 60) / far)
    return float(x * part), float(y * part)


def beyond(place: Exact, by: Pair) -> Exact:
    """Returns a place moved by floats."""
    return place[0] + Fraction(by[0]), place[1] + Fraction(by[1])


def even_turn(by: Pair, even: bool, begin: float = 0.0) -> Pair:
    """Returns a vector; `even`: turned to the next multiple of 15° from an angle, as long as before."""
    if not even:
        return by
    angle, length = math.atan2(by[1], by[0]), math.hypot(*by)
    angle = begin + round((angle - begin) / _STEP) * _STEP
    return length * math.cos(angle), length * math.sin(angle)


def width(points: Points) -> float:
    """Returns how far the third point lies from the line through the first two; positive to the right of it."""
    (ax, ay), (bx, by) = way(points, 1), way(points, 2)
    return (ax * by - ay * bx) / (math.hypot(ax, ay) or 1.0)


def across(along: Pair, wide: float) -> Pair:
    """Returns what is as long as `wide`, at right angles to a vector."""
    length = math.hypot(*along) or 1.0
    return -along[1] / length * wide, along[0] / length * wide


def similar(points: Points, along: Pair) -> Points:
    """Returns three points, turned and scaled about the first so that the second lies along a vector from it."""
    (ax, ay), (bx, by) = way(points, 1), way(points, 2)
    square = ax * ax + ay * ay or 1.0
    re, im = (along[0] * ax + along[1] * ay) / square, (along[1] * ax - along[0] * ay) / square
    return [points[0], beyond(points[0], along), beyond(points[0], (re * bx - im * by, re * by + im * bx))]


Drag = Callable[[Points, int, Exact, bool], Points]


def _to(points: Points, number: int, there: Exact) -> Pair:
    return way([points[0], there], 1)


def _whole(points: Points, number: int, there: Exact) -> Points:
    x, y = points[number]
    return shifted_by(points, (there[0] - x, there[1] - y))


def _ends(points: Points, number: int, there: Exact, even: bool) -> Points:
    """Each end alone; `even`: at steps of angle about the other."""
    other = points[1 - number]
    place = beyond(other, even_turn(way([other, there], 1), even))
    return [place if n == number else point for n, point in enumerate(points)]


def _ellipse(points: Points, number: int, there: Exact, even: bool) -> Points:
    if number == 0:
        return _whole(points, 0, there)
    if number == 1:
        along = even_turn(_to(points, 1, there), even)
        return [points[0], beyond(points[0], along), beyond(points[0], across(along, width(points)))]
    along, wide = way(points, 1), width([*points[:2], there])
    return [*points[:2], beyond(points[0], across(along, math.copysign(math.hypot(*along), wide) if even else wide))]


def _grid(points: Points, number: int, there: Exact, even: bool) -> Points:
    if number == 0:
        return _whole(points, 0, there)
    if number == 1:
        return similar(points, even_turn(_to(points, 1, there), even))
    along = way(points, 1)
    return [*points[:2], beyond(points[0], even_turn(_to(points, 2, there), even, math.atan2(along[1], along[0])))]


def _horizon(points: Points, number: int, there: Exact, even: bool) -> Points:
    """The vanishing point takes the horizon along, whose handle turns it."""
    if number == 0:
        return _whole(points, 0, there)
    x, y = even_turn(_to(points, 1, there), even)
    part = math.hypot(*way(points, 1)) / (math.hypot(x, y) or 1.0)
    return [points[0], beyond(points[0], (x * part, y * part))]


def _each(points: Points, number: int, there: Exact, _even: bool) -> Points:
    return [there if n == number else point for n, point in enumerate(points)]


DRAGS: dict[str, Drag] = {
    "ruler": _ends,
    "parallel": _ends,
    "ellipse": _ellipse,
    "grid": _grid,
    "perspective-1": _horizon,
    "perspective-2": _ends,
    "perspective-3": _each,
}


def fresh(kind: str, size: Pair) -> list[Pair]:
    """Returns the points of a new guide about (0, 0), for a screen of a size."""
    wide, tall = size
    short = min(size)
    made: dict[str, Sequence[Pair]] = {
        "ruler": ((-0.25 * wide, 0.0), (0.25 * wide, 0.0)),
        "parallel": ((-0.12 * wide, 0.12 * wide), (0.12 * wide, -0.12 * wide)),
        "ellipse": ((0.0, 0.0), (0.32 * short, 0.0), (0.0, 0.22 * short)),
        "grid": ((0.0, 0.0), (CELL, 0.0), (0.0, CELL)),
        "perspective-1": ((0.0, 0.0), (0.2 * wide, 0.0)),
        "perspective-2": ((-_OUT * wide, 0.0), (_OUT * wide, 0.0)),
        "perspective-3": ((-_OUT * wide, -0.3 * tall), (_OUT * wide, -0.3 * tall), (0.0, 1.2 * _OUT * wide)),
    }
    return list(made[kind])
