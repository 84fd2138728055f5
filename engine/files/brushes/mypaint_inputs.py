"""What MyPaint's settings follow, in terms of what brushes follow here.

After libmypaint's "brushsettings.json" and what its engine makes of speed, stroke and tilt.  A curve there adds to a
setting; here it multiplies.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

from engine.numeric.curves import KNOTS_CAP

AddedCurve = list[tuple[float, float]]  # the place, the value
_SPEED_AT, _SPEED_VALUE, _SPEED_RISE = 45.0, 0.5, 0.015  # radii a second; the input there; how steeply it rises
_FASTEST = 4.0
_MOST = 16.0  # by what a curve multiplies
_FARTHEST = 1e9
_PARTS = 8  # of a way between knots that may be bent here
_OFF = 2e-3  # by which a curve may be off what it stands for
_SEAM = 0.01  # degrees between the end of a turn and the beginning of the next
_NEXT = 1e-6  # of the place of a knot, to that of the next at least


@dataclass(frozen=True, slots=True)
class Scale:
    """What MyPaint's inputs are measured by: px; e^gamma of both speeds; radii of a stroke."""

    radius: float
    gammas: tuple[float, float]
    stroke: float


class Followed(NamedTuple):
    """A row: the input's name here, from where to where it goes there, where it rests, and the places here of one
    there."""

    name: str
    lo: float
    hi: float
    rest: float
    places: Callable[[float, Scale], tuple[float, ...]]


def _speed(value: float, scale: Scale, gamma: float) -> tuple[float, ...]:
    rise = _SPEED_RISE * (_SPEED_AT + gamma)
    far = math.exp((value - _SPEED_VALUE) / rise) * (_SPEED_AT + gamma) - gamma
    return (min(far * scale.radius, _FARTHEST),)


def _both_ways(value: float, _: Scale) -> tuple[float, ...]:
    """A direction there is that of a line."""
    return (min(value, 180.0 - _SEAM), value + 180.0)


def _leaning(value: float, _: Scale) -> tuple[float, ...]:
    """Where the pen leans to: there 0 is towards the artist, and where it ends and begins is on the left."""
    first = (min(value + 90.0, 270.0 - _SEAM),) if value >= -90.0 else ()
    return first + ((value + 450.0,) if value <= -90.0 else ())


INPUTS_THERE: dict[str, Followed] = {
    "pressure": Followed("pressure", 0.0, 1.0, 1.0, lambda x, _: (x,)),
    "random": Followed("random_dab", 0.0, 1.0, 0.5, lambda x, _: (x,)),
    "speed1": Followed("speed", -1.0, _FASTEST, 0.5, lambda x, s: _speed(x, s, s.gammas[0])),
    "speed2": Followed("speed", -1.0, _FASTEST, 0.5, lambda x, s: _speed(x, s, s.gammas[1])),
    "stroke": Followed("distance", 0.0, 1.0, 0.5, lambda x, s: (x * s.stroke * s.radius,)),
    "direction": Followed("direction", 0.0, 180.0, 90.0, _both_ways),
    "direction_angle": Followed("direction", 0.0, 360.0, 180.0, lambda x, _: (x,)),
    "tilt_declination": Followed("tilt", 0.0, 90.0, 60.0, lambda x, _: (90.0 - x,)),
    "tilt_ascension": Followed("tilt_direction", -180.0, 180.0, 0.0, _leaning),
    "barrel_rotation": Followed("rotation", 0.0, 360.0, 180.0, lambda x, _: (x,)),
}


def added_at(points: AddedCurve, x: float) -> float:
    """Returns what a curve of MyPaint's has at a place: straight between its points, and on beyond them."""
    if len(points) == 1:
        return points[0][1]
    k = 1
    while k < len(points) - 1 and points[k][0] < x:
        k += 1
    (x0, y0), (x1, y1) = points[k - 1], points[k]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


def resting(curves: Mapping[str, AddedCurve], but: str = "") -> float:
    """Returns what all curves but one add where their inputs rest."""
    return sum(added_at(points, INPUTS_THERE[name].rest) for name, points in curves.items() if name != but)


def multiplying(
    base: float, curves: Mapping[str, AddedCurve], scale: Scale, form: Callable[[float], float]
) -> tuple[float, dict[str, AddedCurve]]:
    """Returns a setting's value, and the curves by which it is multiplied: those of each input while the others rest.

    `form`: what MyPaint makes of the sum of the base and of what is added.
    """
    spread = {name: _places(name, points) for name, points in curves.items()}
    usual = form(base + resting(curves))
    most = max([usual, *(form(base + resting(curves, n) + y) for n, points in spread.items() for _, y in points)])
    value = usual if usual > most / _MOST else most
    found: dict[str, AddedCurve] = {}
    for name, points in spread.items():
        if value > 0.0:
            rest = base + resting(curves, name)
            here = [(place, form(rest + y) / value) for x, y in points for place in INPUTS_THERE[name].places(x, scale)]
            found.setdefault(INPUTS_THERE[name].name, knots_of_curve(here))
    return value, {name: knots for name, knots in found.items() if not _is_level(knots)}


def _is_level(knots: AddedCurve) -> bool:
    return all(abs(y - 1.0) < 1e-3 for _, y in knots)


def _places(name: str, points: AddedCurve) -> AddedCurve:
    """Returns a curve's points within the range of its input, with both ends of that, and more between: what is
    straight there may be bent here."""
    row = INPUTS_THERE[name]
    seam = {-90.0} if row.places is _leaning else set()
    ends = sorted({row.lo, row.hi, *seam, *(x for x, _ in points if row.lo < x < row.hi)})
    parts = max(1, min(_PARTS, KNOTS_CAP // len(ends)))
    places = [a + (b - a) * k / parts for a, b in pairwise(ends) for k in range(parts)]
    return [(x, added_at(points, x)) for x in (*places, ends[-1])]


def knots_of_curve(points: AddedCurve) -> AddedCurve:
    """Returns knots as a brush may have them: places rising, within the numbers that are let, without those that lie
    on the line between others."""
    out: AddedCurve = []
    for x, y in sorted(points):
        knot = max(x, 0.0), min(max(y, 0.0), _MOST)
        if not out or knot[0] > out[-1][0] * (1.0 + _NEXT):
            out.append(knot)
        elif knot[0] == 0.0:
            out[-1] = knot
    out = _bends(out)
    keep = -(-len(out) // KNOTS_CAP)
    return out if keep == 1 else [*out[:-1:keep][: KNOTS_CAP - 1], out[-1]]


def _bends(points: AddedCurve) -> AddedCurve:
    """Returns the points between which lines run no farther from the others than is let."""
    kept, first = points[:1], 0
    for last in range(2, len(points) + 1):
        if last == len(points) or any(
            abs(added_at([points[first], points[last]], x) - y) > _OFF for x, y in points[first + 1 : last]
        ):
            first = last - 1
            kept.append(points[first])
    return kept


def multiplied(one: dict[str, AddedCurve], other: dict[str, AddedCurve]) -> dict[str, AddedCurve]:
    """Returns the curves of two settings of which only the product is here."""
    out = dict(one)
    for name, knots in other.items():
        mine = out.get(name)
        if mine is None:
            out[name] = knots
        else:
            places = sorted({x for x, _ in (*mine, *knots)})
            out[name] = knots_of_curve([(x, _level_at(mine, x) * _level_at(knots, x)) for x in places])
    return out


def _level_at(points: AddedCurve, x: float) -> float:
    """As `at`, but level before the first knot and after the last."""
    return added_at(points, min(max(x, points[0][0]), points[-1][0]))
