"""The command that selects: by which shape, layer or saved selection, and how that joins what is selected already."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from immutables import Map

from engine.brush import settings
from engine.brush.checks import thawed
from engine.brush.copies import NO_COPIES, Copies
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting.fill_command import Like, read_like, write_like
from engine.painting.layer_commands import Extra
from engine.painting.layering.placing_members import Members
from engine.painting.places import LEVEL_LIMIT, PLACE_LIMIT
from engine.painting.points import plain, points_array, points_json
from engine.painting.stroke_copies import read_copies, write_copies

JOIN_OPS = ("replace", "add", "subtract", "intersect")
WIDEST_RIM = 4096.0  # px of feather, and of growing and shrinking
_NOTHING: Extra = Map()


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle, or the ellipse within it; pixels of a level."""

    level: int
    rect: Rect
    round: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class Line:
    """A line of float64 points (n, 6), read-only, columns as POINT_COLUMNS, in pixels of `level` from `origin`.

    `brush`: of the stroke along it that covers what is selected, as do its `copies`; None: the line is the outline of
    it, closed.
    """

    level: int
    origin: tuple[int, int]
    points: np.ndarray
    brush: Brush | None = None
    copies: Copies = NO_COPIES

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Line):
            return NotImplemented
        same = self._about == other._about
        return same and np.array_equal(self.points, other.points)

    def __hash__(self) -> int:
        return hash((self.level, self.origin, self.points.tobytes()))

    @property
    def _about(self) -> tuple[object, ...]:
        return self.level, self.origin, self.brush, self.copies


@dataclass(frozen=True, slots=True)
class Named:
    """What a layer covers, or what was selected and kept under a name (`saved`)."""

    name: str
    saved: bool = False


@dataclass(frozen=True, slots=True)
class MaskOf:
    """What the mask of a layer or group shows."""

    name: str


@dataclass(frozen=True, slots=True)
class Whole:
    """`what` is "all", "none", or "invert": all that was not selected."""

    what: str


Source = Box | Line | Named | MaskOf | Whole | Like


@dataclass(frozen=True, slots=True)
class Select:
    """Joins what `source` tells to what is selected, by `op`; without a source changes what is selected already.

    `grow` (negative: shrink) and `feather` are done with the source before it joins, in pixels of its `level`; the
    result is stored under the name `keep`, too.
    """

    source: Source | None = None
    op: str = "replace"
    level: int = 0
    grow: float = 0.0
    feather: float = 0.0
    keep: str | None = None
    extra: Extra = _NOTHING


class SourceForm(NamedTuple):
    """A member that tells a source: which record, how it is read from the command's members and written to them."""

    record: type
    read: Callable[[Fields, str], Source]
    write: Callable[..., Members]


def _read_box(members: Fields, name: str) -> Box:
    level, x, y, width, height = members.integers(name, 5, limit=PLACE_LIMIT)
    if abs(level) > LEVEL_LIMIT or width < 1 or height < 1:
        raise members.fault(name, f"[L, X, Y, W, H], L from -{LEVEL_LIMIT} to {LEVEL_LIMIT}, W and H at least 1")
    return Box(level, Rect.at(x, y, width, height), name == "ellipse")


def _write_box(box: Box) -> Members:
    rect = box.rect
    return {"ellipse" if box.round else "rect": [box.level, rect.x0, rect.y0, rect.width, rect.height]}


def _read_outline(members: Fields, name: str) -> Line:
    points = points_array(members.take(name), members.at(name))
    if len(points) < 3:
        raise members.fault(name, "a list of 3 points or more")
    return Line(_level(members), members.integers("origin", 2, (0, 0), limit=PLACE_LIMIT), points)


def _read_stroke(members: Fields, name: str) -> Line:
    inner = Fields(members.take(name), members.at(name))
    points = points_array(inner.take("points", expected="a list of points"), inner.at("points"))
    brush = settings.from_json(inner.take("brush", {}), inner.at("brush"))
    line = Line(
        _level(inner), inner.integers("origin", 2, (0, 0), limit=PLACE_LIMIT), points, brush, read_copies(inner)
    )
    if inner.rest():
        expected = "level, origin, points, brush, and copies or symmetry"
        raise FieldError(inner.place, ", ".join(inner.rest()), expected)
    return line


def _write_line(line: Line) -> Members:
    place = {"level": line.level, "origin": list(line.origin)}
    if line.brush is None:
        return {**place, "outline": points_json(line.points)}
    told = {**place, "brush": settings.to_json(line.brush), "points": points_json(line.points)}
    return {"stroke": told | ({"copies": write_copies(line.copies)} if line.copies else {})}


def _read_whole(members: Fields, name: str) -> Whole:
    if members.take(name) is not True:
        raise members.fault(name, "true")
    return Whole(name)


SOURCES: dict[str, SourceForm] = {
    "rect": SourceForm(Box, _read_box, _write_box),
    "ellipse": SourceForm(Box, _read_box, _write_box),
    "outline": SourceForm(Line, _read_outline, _write_line),
    "stroke": SourceForm(Line, _read_stroke, _write_line),
    "layer": SourceForm(Named, lambda members, name: Named(members.text(name)), lambda named: {"layer": named.name}),
    "saved": SourceForm(
        Named, lambda members, name: Named(members.text(name), True), lambda named: {"saved": named.name}
    ),
    "mask": SourceForm(MaskOf, lambda members, name: MaskOf(members.text(name)), lambda mask: {"mask": mask.name}),
    "like": SourceForm(Like, read_like, lambda like: {"like": write_like(like)}),
    "all": SourceForm(Whole, _read_whole, lambda whole: {whole.what: True}),
    "none": SourceForm(Whole, _read_whole, lambda whole: {whole.what: True}),
    "invert": SourceForm(Whole, _read_whole, lambda whole: {whole.what: True}),
}


def _level(members: Fields) -> int:
    level: int = members.integer("level", 0, lo=-LEVEL_LIMIT, hi=LEVEL_LIMIT)
    return level


def read_select(members: Fields) -> Select:
    """Reads a command; FieldError names the member that is wrong."""
    given = [name for name in SOURCES if name in members]
    if len(given) > 1:
        raise FieldError(members.place, " and ".join(given), f"at most one of {', '.join(SOURCES)}")
    source = SOURCES[given[0]].read(members, given[0]) if given else None
    op = members.take("op", "replace")
    if op not in JOIN_OPS:
        raise members.fault("op", ", ".join(f'"{known}"' for known in JOIN_OPS))
    level = getattr(source, "level", None)
    out = Select(
        source,
        op,
        _level(members) if level is None else level,
        members.number("grow", 0.0, lo=-WIDEST_RIM, hi=WIDEST_RIM),
        members.number("feather", 0.0, lo=0.0, hi=WIDEST_RIM),
        None if members.take("keep", None) is None else members.text("keep"),
        members.rest(),
    )
    if source is None and not (out.grow or out.feather or out.keep):
        raise FieldError(members.place, "nothing to select", f"one of {', '.join(SOURCES)}, grow, feather or keep")
    return out


def write_select(command: Select) -> Members:
    """Tells its members; `read_select` is the inverse."""
    out: Members = {"op": command.op} if command.op != "replace" else {}
    source = command.source
    if isinstance(source, Whole):
        out |= SOURCES[source.what].write(source)
    elif isinstance(source, Named):
        out |= SOURCES["saved" if source.saved else "layer"].write(source)
    elif source is not None:
        out |= next(form.write for form in SOURCES.values() if form.record is type(source))(source)
    if command.level and getattr(source, "level", None) is None:
        out["level"] = command.level
    for name in ("grow", "feather"):
        if getattr(command, name):
            out[name] = plain(float(getattr(command, name)))
    if command.keep is not None:
        out["keep"] = command.keep
    return {**out, **thawed(command.extra)}
