"""Shapes that are drawn by the brush: the path of each, from where the pen went down to where it is."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

Corner = tuple[float, float]
_STEP = math.pi / 12  # of the angles of a line that is held to some
_FLAT = 0.1  # px that an ellipse's sides may lie inside it
_LEAST, _SIDES = 24, 720
_PIECES = 512  # of one curve


def line(start: Corner, end: Corner, even: bool, central: bool) -> list[Corner]:
    """Returns a line; `even`: at a multiple of 15°; `central`: as far to the other side of its start."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    if even:
        angle, length = round(math.atan2(dy, dx) / _STEP) * _STEP, math.hypot(dx, dy)
        dx, dy = length * math.cos(angle), length * math.sin(angle)
    begin = (start[0] - dx, start[1] - dy) if central else start
    return [begin, (start[0] + dx, start[1] + dy)]


def rectangle(start: Corner, end: Corner, even: bool, central: bool) -> list[Corner]:
    """Returns a rectangle from corner to corner; `even`: a square; `central`: its middle is the start."""
    (x0, y0), (x1, y1) = _box(start, end, even, central)
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]


def ellipse(start: Corner, end: Corner, even: bool, central: bool) -> list[Corner]:
    """Returns the ellipse in a rectangle; `even`: a circle; `central`: its middle is the start."""
    (x0, y0), (x1, y1) = _box(start, end, even, central)
    x, y, a, b = (x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 2, (y1 - y0) / 2
    widest = max(abs(a), abs(b), 1e-6)
    count = math.ceil(math.pi / math.sqrt(2 * _FLAT / widest))
    count = max(_LEAST, min(_SIDES, count + -count % 4))
    turns = (math.tau * k / count for k in range(count))
    around = [(x + a * math.cos(turn), y + b * math.sin(turn)) for turn in turns]
    return [*around, around[0]]


def _box(start: Corner, end: Corner, even: bool, central: bool) -> tuple[Corner, Corner]:
    dx, dy = end[0] - start[0], end[1] - start[1]
    if even:
        side = max(abs(dx), abs(dy))
        dx, dy = math.copysign(side, dx), math.copysign(side, dy)
    begin = (start[0] - dx, start[1] - dy) if central else start
    return begin, (start[0] + dx, start[1] + dy)


class Knot(NamedTuple):
    """A point that a curve goes through: its place, the way from it to the handle before it leads on, and how hard the
    pen was pressed."""

    x: float
    y: float
    dx: float = 0.0
    dy: float = 0.0
    pressure: float = 1.0


def bezier(knots: Sequence[Knot]) -> list[tuple[float, float, float]]:
    """Returns the cubic curves from knot to knot, as near as is seen: places, and the pressure there.

    A curve's chords are at most |B''| / (8 n^2) away from it when it is cut into n parts evenly.
    """
    out = [(knots[0].x, knots[0].y, knots[0].pressure)]
    for one, other in pairwise(knots):
        x = one.x, one.x + one.dx, other.x - other.dx, other.x
        y = one.y, one.y + one.dy, other.y - other.dy, other.y
        bends = (math.hypot(x[k] - 2 * x[k + 1] + x[k + 2], y[k] - 2 * y[k + 1] + y[k + 2]) for k in (0, 1))
        count = max(1, min(_PIECES, math.ceil(math.sqrt(6 * max(bends) / (8 * _FLAT)))))
        for k in range(1, count + 1):
            t = k / count
            pressure = one.pressure + (other.pressure - one.pressure) * t
            out.append((_cubic(x, t), _cubic(y, t), pressure))
    return out


def _cubic(ends: tuple[float, float, float, float], t: float) -> float:
    u = 1.0 - t
    return u * u * u * ends[0] + 3 * u * u * t * ends[1] + 3 * u * t * t * ends[2] + t * t * t * ends[3]


Path = Callable[[Corner, Corner, bool, bool], list[Corner]]
