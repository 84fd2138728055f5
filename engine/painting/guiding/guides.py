"""Guides: what lies on the canvas to draw by, and is no paint: axes of symmetry, rulers, vanishing points, grids.

A guide lies at a level, from a pixel on; it is saved with the painting, and making, changing and removing one are
steps.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from immutables import Map

from engine.brush.checks import thawed
from engine.checks.field_error import FieldError
from engine.checks.values import is_number
from engine.files.strict_json import Fields
from engine.painting.layering.paper_command import read_colour
from engine.painting.places import LEVEL_LIMIT, PLACE_LIMIT, Extra
from engine.painting.points import plain
from engine.painting.stroke_copies import COUNT_CAP

GUIDES_CAP = 256  # of one painting
POINT_REACH = float(1 << 24)  # pixels of its level from where a guide lies to its points

_NOTHING: Extra = Map()


class GuideKind(NamedTuple):
    """A row of the table: how many points a guide of a kind has, and which; `wide`: they lie on no line."""

    points: int
    what: str
    wide: bool = False


GUIDE_KINDS: dict[str, GuideKind] = {
    "symmetry": GuideKind(2, "its centre, and a point on its axis"),
    "ruler": GuideKind(2, "two points on its edge"),
    "parallel": GuideKind(2, "two points in whose direction all its lines run"),
    "ellipse": GuideKind(
        3, "its centre, the end of one axis, and a point as far from that axis as the other is long", True
    ),
    "grid": GuideKind(3, "its origin, and the ends of two sides of a cell", True),
    "perspective-1": GuideKind(2, "its vanishing point, and a point on the horizon"),
    "perspective-2": GuideKind(2, "both vanishing points"),
    "perspective-3": GuideKind(3, "its three vanishing points", True),
}
_FLAT = 1e-9  # of the sides' product: a triangle with less area is a line


@dataclass(frozen=True, slots=True)
class Guide:
    """A guide under a name; one of this name that there is becomes this one.

    `points`: pixels of `level` from the pixel `at`.  A symmetry has `count` parts of a full turn; where it has a
    `mirror`, each is mirrored, too.  One that is `off` stays where it is and does nothing.  `snap`: how much it draws
    strokes onto it, 0..1.  `colour`: of its lines, None for the usual one.
    """

    name: str
    kind: str
    level: int
    at: tuple[int, int]
    points: tuple[tuple[float, float], ...]
    count: int = 1
    mirror: bool = False
    off: bool = False
    snap: float = 1.0
    colour: str | None = None
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class RemoveGuide:
    """Takes a guide away."""

    name: str
    extra: Extra = _NOTHING


GuideCommand = Guide | RemoveGuide
Guides = Mapping[str, Guide]  # by name, in the order in which they were made; it never changes
NO_GUIDES: Guides = MappingProxyType({})


def guides_after(guides: Guides, command: GuideCommand) -> Guides:
    """Returns a painting's guides after a command.  FieldError if it cannot be done."""
    if isinstance(command, Guide):
        if command.name not in guides and len(guides) >= GUIDES_CAP:
            raise FieldError("guide", f"{GUIDES_CAP} guides already", "fewer")
        return MappingProxyType({**guides, command.name: command})
    if command.name not in guides:
        raise FieldError("guide", f"none of the name {command.name!r}", "the name of a guide")
    return MappingProxyType({name: guide for name, guide in guides.items() if name != command.name})


def read_guide(members: Fields) -> GuideCommand:
    """Reads a guide command: a guide, or the name of one and `remove`."""
    name = members.text("name")
    if members.flag("remove", False):
        return RemoveGuide(name, members.rest())
    kind = members.take("kind", expected=f"one of {', '.join(GUIDE_KINDS)}")
    if not isinstance(kind, str) or kind not in GUIDE_KINDS:
        raise members.fault("kind", f"one of {', '.join(GUIDE_KINDS)}")
    x, y = members.integers("at", 2, (0, 0), limit=PLACE_LIMIT)
    return Guide(
        name,
        kind,
        members.integer("level", 0, lo=-LEVEL_LIMIT, hi=LEVEL_LIMIT),
        (x, y),
        _points(members, GUIDE_KINDS[kind]),
        members.integer("count", 1, lo=1, hi=COUNT_CAP),
        members.flag("mirror", False),
        members.flag("off", False),
        members.number("snap", 1.0, lo=0.0, hi=1.0),
        read_colour(members, "colour"),
        members.rest(),
    )


def write_guide(command: GuideCommand) -> dict[str, object]:
    """Tells its members; `read_guide` is the inverse."""
    if isinstance(command, RemoveGuide):
        return {"name": command.name, "remove": True, **thawed(command.extra)}
    out: dict[str, object] = {"name": command.name, "kind": command.kind, "level": command.level}
    out |= {"at": list(command.at), "points": [list(map(plain, point)) for point in command.points]}
    out |= {"count": command.count} if command.count != 1 else {}
    out |= {name: True for name in ("mirror", "off") if getattr(command, name)}
    out |= {"snap": plain(command.snap)} if command.snap != 1.0 else {}
    out |= {"colour": command.colour} if command.colour is not None else {}
    return {**out, **thawed(command.extra)}


def _points(members: Fields, row: GuideKind) -> tuple[tuple[float, float], ...]:
    told = members.take("points", expected=f"a list of points: {row.what}")
    if not isinstance(told, list) or len(told) != row.points:
        raise members.fault("points", f"a list of {row.points} points: {row.what}")
    for place in told:
        if not (isinstance(place, list) and len(place) == 2 and all(map(is_number, place))):
            raise members.fault("points", "[x, y] each, two numbers")
        if max(map(abs, place)) > POINT_REACH:
            raise members.fault("points", "numbers within 2^24")
    points = tuple((float(x) + 0.0, float(y) + 0.0) for x, y in told)
    if len(set(points)) < len(points):
        raise members.fault("points", "points that do not coincide")
    if row.wide and on_a_line(points):
        raise members.fault("points", "points that lie on no line")
    return points


def on_a_line(points: tuple[tuple[float, float], ...]) -> bool:
    """Tells whether three points lie on a line, or as good as that."""
    (x, y), (x1, y1), (x2, y2) = points
    across = (x1 - x) * (y2 - y) - (y1 - y) * (x2 - x)
    square = ((x1 - x) * (x1 - x) + (y1 - y) * (y1 - y)) * ((x2 - x) * (x2 - x) + (y2 - y) * (y2 - y))
    return across * across <= _FLAT * _FLAT * square


def read_guides(value: object) -> tuple[Guides, list[str]]:
    """Returns the guides of a file that can be read, and a line for each that cannot: no paint depends on them."""
    guides, notes = NO_GUIDES, list[str]()
    for i, told in enumerate(value if isinstance(value, list) else [value]):
        try:
            command = read_guide(Fields(told, f"guides[{i}]"))
            if not isinstance(command, Guide) or command.name in guides:
                raise FieldError(f"guides[{i}]", "no guide or a name that is taken", "a guide with a name of its own")
            guides = guides_after(guides, command)
        except FieldError as error:
            notes.append(f"a guide is left out: {error}")
    return guides, notes
