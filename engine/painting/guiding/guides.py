"""Guides: what lies on the canvas to draw by, and is no paint: axes of symmetry, and later rulers.

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
from engine.painting.places import LEVEL_LIMIT, PLACE_LIMIT, Extra
from engine.painting.points import plain
from engine.painting.stroke_copies import COUNT_CAP

GUIDES_CAP = 256  # of one painting
POINT_REACH = float(1 << 24)  # pixels of its level from where a guide lies to its points

_NOTHING: Extra = Map()


class GuideKind(NamedTuple):
    """A row of the table: how many points a guide of a kind has, and whether some of them may not coincide."""

    least: int
    most: int
    what: str


GUIDE_KINDS: dict[str, GuideKind] = {
    "symmetry": GuideKind(2, 2, "its centre, and a point on its axis"),
}


@dataclass(frozen=True, slots=True)
class Guide:
    """A guide under a name; one of this name that there is becomes this one.

    `points`: pixels of `level` from the pixel `at`.  A symmetry has `count` parts of a full turn; where it has a
    `mirror`, each is mirrored, too.  One that is `off` stays where it is and does nothing.
    """

    name: str
    kind: str
    level: int
    at: tuple[int, int]
    points: tuple[tuple[float, float], ...]
    count: int = 1
    mirror: bool = False
    off: bool = False
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
    return {**out, **thawed(command.extra)}


def _points(members: Fields, row: GuideKind) -> tuple[tuple[float, float], ...]:
    told = members.take("points", expected=f"a list of points: {row.what}")
    if not isinstance(told, list) or not row.least <= len(told) <= row.most:
        raise members.fault("points", f"a list of {row.least} to {row.most} points: {row.what}")
    for place in told:
        if not (isinstance(place, list) and len(place) == 2 and all(map(is_number, place))):
            raise members.fault("points", "[x, y] each, two numbers")
        if max(map(abs, place)) > POINT_REACH:
            raise members.fault("points", "numbers within 2^24")
    points = tuple((float(x) + 0.0, float(y) + 0.0) for x, y in told)
    if len(set(points)) < len(points):
        raise members.fault("points", "points that do not coincide")
    return points


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
