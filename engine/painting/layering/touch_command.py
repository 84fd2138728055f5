"""The command that paints on a solid: a stroke in three dimensions, which touches up every slice of it and every object
that is made of it (Heeger & Bergen 1995, section 6).

No layer changes: the strokes of each solid are kept with the painting by its name.
"""

from __future__ import annotations

from dataclasses import dataclass

from immutables import Map

from engine.brush import settings
from engine.brush.checks import thawed
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.checks.values import is_number
from engine.files.strict_json import Fields
from engine.painting.points import plain

VOXELS = 256  # of a unit, along each axis: what points and radius of a stroke are told in
WIDEST_TOUCH = 96.0  # voxels of a radius: a stroke never meets itself around the solid
TOUCHES_CAP, TOUCH_POINTS_CAP = 20_000, 20_000  # strokes of a solid, points of one of them
SOLIDS_CAP = 256  # names
_REACH = 1e6
_NOTHING: Map[str, object] = Map()
TouchPlace = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Touch:
    """Paint on the solid of a name along `points`: x, y, z in voxels, and the pen's pressure; `breaks`: the points, by
    their number, to which no line leads from the one before.

    Of the brush its colour, `radius` in voxels, `hardness` and `opacity` count, how these follow the pressure, and the
    mode "erase", which brings back the bare solid.
    """

    solid: str
    points: tuple[TouchPlace, ...]
    brush: Brush
    breaks: tuple[int, ...] = ()
    extra: Map[str, object] = _NOTHING


@dataclass(frozen=True, slots=True)
class CleanSolid:
    """Takes all paint off a solid."""

    solid: str
    extra: Map[str, object] = _NOTHING


TouchCommand = Touch | CleanSolid
Touches = Map[str, tuple[Touch, ...]]  # by the name of the solid
NO_TOUCHES: Touches = Map()


def touches_after(touches: Touches, command: TouchCommand) -> Touches:
    """Returns what is painted on solids after a command.  FieldError if it cannot be done."""
    held = touches.get(command.solid, ())
    if isinstance(command, CleanSolid):
        if not held:
            raise FieldError("touch", f"no paint on {command.solid!r}", "the name of a solid that was painted on")
        return touches.delete(command.solid)
    if len(held) >= TOUCHES_CAP or (not held and len(touches) >= SOLIDS_CAP):
        raise FieldError("touch", "too many strokes", f"{TOUCHES_CAP} on each of {SOLIDS_CAP} solids at most")
    return touches.set(command.solid, (*held, command))


def read_touch(members: Fields) -> TouchCommand:
    """Reads the command; `write_touch` is the inverse."""
    solid = members.text("solid")
    if members.flag("clear", False):
        return CleanSolid(solid, members.rest())
    brush = settings.from_json(members.take("brush", {}), members.at("brush"))
    if brush.radius > WIDEST_TOUCH:
        raise FieldError(members.at("brush.radius"), f"{brush.radius:g}", f"at most {WIDEST_TOUCH:g} voxels")
    points = _read_points(members)
    return Touch(solid, points, brush, _read_breaks(members, len(points)), members.rest())


def _read_points(members: Fields) -> tuple[TouchPlace, ...]:
    told = members.take("points", expected="a list of points [x, y, z, pressure]")
    if not isinstance(told, list) or not 1 <= len(told) <= TOUCH_POINTS_CAP:
        raise members.fault("points", f"a list of 1 to {TOUCH_POINTS_CAP} points [x, y, z, pressure]")
    out: list[TouchPlace] = []
    for row in told:
        if not isinstance(row, list) or len(row) not in (3, 4) or not all(map(is_number, row)):
            raise members.fault("points", "[x, y, z] or [x, y, z, pressure] each")
        x, y, z, pressure = (*map(float, row), 1.0)[:4]
        if max(abs(x), abs(y), abs(z)) > _REACH or not 0.0 <= pressure <= 1.0:
            raise members.fault("points", f"places within {_REACH:g} voxels, pressures from 0 to 1")
        out.append((x + 0.0, y + 0.0, z + 0.0, pressure))
    return tuple(out)


def _read_breaks(members: Fields, count: int) -> tuple[int, ...]:
    told = members.take("breaks", [])
    sound = isinstance(told, list) and all(type(one) is int and 0 < one < count for one in told)
    if not sound or sorted(set(told)) != told:
        raise members.fault("breaks", f"numbers of points from 1 to {count - 1}, each greater than the one before")
    return tuple(told)


def write_touch(command: TouchCommand) -> dict[str, object]:
    """Tells its members; defaults are left out."""
    if isinstance(command, CleanSolid):
        return {"solid": command.solid, "clear": True, **thawed(command.extra)}
    points = [[plain(value) for value in (row[:3] if row[3] == 1.0 else row)] for row in command.points]
    brush = settings.to_json(command.brush)
    breaks = {"breaks": list(command.breaks)} if command.breaks else {}
    return {"solid": command.solid, "brush": brush, "points": points, **breaks, **thawed(command.extra)}


def write_touches(touches: Touches) -> list[dict[str, object]]:
    """Tells all of them, for a painting's file."""
    return [write_touch(touch) for _, paint in sorted(touches.items()) for touch in paint]


def read_touches(value: object) -> tuple[Touches, list[str]]:
    """Returns the strokes of a file that can be read, and a line for each that cannot: no layer depends on them."""
    found, notes = dict[str, list[Touch]](), list[str]()
    for i, told in enumerate(value if isinstance(value, list) else [value]):
        try:
            command = read_touch(Fields(told, f"touches[{i}]"))
            if not isinstance(command, Touch):
                raise FieldError(f"touches[{i}]", "no stroke", "one")
            found.setdefault(command.solid, []).append(command)
        except FieldError as error:
            notes.append(f"a stroke on a solid is left out: {error}")
    return Map({name: tuple(paint) for name, paint in found.items()}), notes
