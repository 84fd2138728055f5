"""The numbers of a guide, in pixels of the level that is seen: what they are, and what typing another one does."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import NamedTuple

from app.desk.guides.reshaping import Points, across, beyond, shifted_by, similar, way, width

Origin = tuple[int, int]
_LARGEST = 1 << 40  # px: of lengths


class GuideNumber(NamedTuple):
    """A row of the numbers: its sign, its width in ems, its hint; `read`: its text; `write`: the points that it makes
    of them, None where that cannot be."""

    sign: str
    ems: float
    hint: str
    read: Callable[[Points, Origin], str]
    write: Callable[[Points, Origin, Fraction], Points | None]


def _place(number: int, axis: int, alone: bool) -> GuideNumber:
    """Returns the row of one coordinate of a point; `alone`: the others stay where they are."""

    def read(points: Points, origin: Origin) -> str:
        return str(math.floor(points[number][axis]) + origin[axis])

    def write(points: Points, origin: Origin, value: Fraction) -> Points | None:
        by = value - origin[axis] - points[number][axis]
        whole = shifted_by(points, (by, Fraction(0)) if axis == 0 else (Fraction(0), by))
        return [a if n == number or not alone else b for n, (a, b) in enumerate(zip(whole, points, strict=True))]

    where = "left to right" if axis == 0 else "top to bottom"
    hint = f"Where {'this point' if alone else 'it'} lies, {where}, in pixels of the level that you see"
    return GuideNumber("xy"[axis] + ("" if not alone else str(number + 1)), 5.0, hint, read, write)


def _text(value: float) -> str:
    return f"{value:.6g}".replace("-", "−")


def _read_angle(points: Points, _origin: Origin) -> str:
    x, y = way(points, 1)
    return f"{_text(round(math.degrees(math.atan2(y, x)), 2) + 0.0)}°"


def _write_angle(points: Points, _origin: Origin, value: Fraction) -> Points | None:
    angle, length = math.radians(float(value % 360)), math.hypot(*way(points, 1))
    along = length * math.cos(angle), length * math.sin(angle)
    return similar(points, along) if len(points) == 3 else [points[0], beyond(points[0], along)]


def _read_length(points: Points, _origin: Origin) -> str:
    return _text(math.hypot(*way(points, 1)))


def _write_length(points: Points, _origin: Origin, value: Fraction) -> Points | None:
    return _lengthened(points, 1, float(value)) if 0 < value < _LARGEST else None


def _lengthened(points: Points, number: int, length: float) -> Points:
    x, y = way(points, number)
    part = length / (math.hypot(x, y) or 1.0)
    place = beyond(points[0], (x * part, y * part))
    return [place if n == number else point for n, point in enumerate(points)]


def _read_down(points: Points, _origin: Origin) -> str:
    return _text(math.hypot(*way(points, 2)))


def _write_down(points: Points, _origin: Origin, value: Fraction) -> Points | None:
    return _lengthened(points, 2, float(value)) if 0 < value < _LARGEST else None


def _read_long(points: Points, _origin: Origin) -> str:
    return _text(2 * math.hypot(*way(points, 1)))


def _write_long(points: Points, origin: Origin, value: Fraction) -> Points | None:
    if not 0 < value < _LARGEST:
        return None
    longer = _lengthened(points, 1, float(value) / 2)
    return [*longer[:2], beyond(points[0], across(way(longer, 1), width(points)))]


def _read_wide(points: Points, _origin: Origin) -> str:
    return _text(2 * abs(width(points)))


def _write_wide(points: Points, _origin: Origin, value: Fraction) -> Points | None:
    if not 0 < value < _LARGEST:
        return None
    return [*points[:2], beyond(points[0], across(way(points, 1), math.copysign(float(value) / 2, width(points))))]


_WHOLE = (_place(0, 0, False), _place(0, 1, False))
_ANGLE = GuideNumber("angle", 4.2, "How far it is turned, in degrees clockwise", _read_angle, _write_angle)
_LENGTH = GuideNumber("long", 4.2, "How long it is, in pixels of the level that you see", _read_length, _write_length)
_SIDES = (
    GuideNumber("w", 4.2, "How wide a cell is, in pixels of the level that you see", _read_length, _write_length),
    GuideNumber("h", 4.2, "How tall a cell is, in pixels of the level that you see", _read_down, _write_down),
)
_AXES = (
    GuideNumber("w", 4.2, "One axis from end to end, in pixels of the level that you see", _read_long, _write_long),
    GuideNumber(
        "h", 4.2, "The other axis from end to end, in pixels of the level that you see", _read_wide, _write_wide
    ),
)
NUMBERS: dict[str, tuple[GuideNumber, ...]] = {
    "ruler": (*_WHOLE, _LENGTH, _ANGLE),
    "parallel": (*_WHOLE, _ANGLE),
    "ellipse": (*_WHOLE, *_AXES, _ANGLE),
    "grid": (*_WHOLE, *_SIDES, _ANGLE),
    "perspective-1": (*_WHOLE, _ANGLE),
    "perspective-2": tuple(_place(n, axis, True) for n in range(2) for axis in range(2)),
    "perspective-3": tuple(_place(n, axis, True) for n in range(3) for axis in range(2)),
}
