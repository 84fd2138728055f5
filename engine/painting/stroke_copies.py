"""The copies of a stroke as recordings tell them: a list, or a symmetry in short."""

from __future__ import annotations

from engine.brush.copies import NO_COPIES, Copies, Copy, symmetric
from engine.checks.field_error import FieldError
from engine.checks.values import described, is_number
from engine.files.strict_json import Fields
from engine.painting.points import plain

COPIES_CAP = 255
COUNT_CAP = 64  # parts of a full turn
FURTHEST = float(1 << 30)  # px from the stroke's origin to where a copy shows it
_LARGEST, _SMALLEST = 1024.0, 1.0 / 1024.0  # |c|


def read_copies(members: Fields) -> Copies:
    """Returns what the member `copies` or `symmetry` of a stroke tells."""
    if "symmetry" in members and "copies" in members:
        raise members.fault("symmetry", "copies or symmetry, not both")
    if "symmetry" in members:
        return _symmetry(Fields(members.take("symmetry"), members.at("symmetry")))
    rows, place = members.take("copies", []), members.at("copies")
    if not isinstance(rows, list) or len(rows) > COPIES_CAP:
        found = f"{len(rows)} copies" if isinstance(rows, list) else described(rows)
        raise FieldError(place, found, f"a list of at most {COPIES_CAP} copies")
    return tuple(_copy(row, f"{place}[{i}]") for i, row in enumerate(rows)) if rows else NO_COPIES


def write_copies(copies: Copies) -> list[list[float | bool]]:
    """Tells copies; `read_copies` is the inverse."""
    return [[*map(plain, copy[:4]), True] if copy.mirror else list(map(plain, copy[:4])) for copy in copies]


def fits(copy: Copy) -> bool:
    """Tells whether a stroke may have such a copy."""
    near = max(abs(copy.x), abs(copy.y)) <= FURTHEST
    return near and _SMALLEST <= copy.scale <= _LARGEST


def _copy(row: object, place: str) -> Copy:
    expected = "[re, im, x, y, mirror], four numbers and true or false"
    if not isinstance(row, list) or len(row) not in (4, 5) or not all(map(is_number, row[:4])):
        raise FieldError(place, described(row), expected)
    mirror = row[4] if len(row) == 5 else False
    if not isinstance(mirror, bool):
        raise FieldError(place, described(row), expected)
    try:
        re, im, x, y = (float(value) + 0.0 for value in row[:4])
    except OverflowError:
        raise FieldError(place, described(row), "numbers near the origin") from None
    copy = Copy(re, im, x, y, mirror)
    if max(abs(re), abs(im)) > _LARGEST or not fits(copy):
        raise FieldError(place, described(row), "a scale from 2^-10 to 2^10, and x and y within 2^30")
    return copy


def _symmetry(members: Fields) -> Copies:
    centre = _pair(members, "centre", FURTHEST / 4)
    count: int = members.integer("count", 1, lo=1, hi=COUNT_CAP)
    mirror = members.take("mirror", False)
    axis = None
    if isinstance(mirror, list):
        axis = _pair(members, "mirror", FURTHEST)
        if max(abs(axis[0]), abs(axis[1])) < 1.0 / FURTHEST:
            raise members.fault("mirror", "the direction of an axis, not [0, 0]")
    elif members.flag("mirror", False):
        axis = 0.0, 1.0
    return symmetric(centre, count, axis)


def _pair(members: Fields, name: str, furthest: float) -> tuple[float, float]:
    value = members.take(name, expected="[x, y], two numbers")
    good = isinstance(value, list) and len(value) == 2 and all(map(is_number, value))
    if not good or max(map(abs, value)) > furthest:
        raise members.fault(name, f"[x, y], two numbers within {furthest:g}")
    return float(value[0]), float(value[1])
