"""Arrangements of panels as objects of a file, and as the desk has them: the present one, and those under names."""

from __future__ import annotations

from dataclasses import dataclass, field

from immutables import Map

from app.desk.arranging.arrangement import (
    COLUMNS,
    DOCKS,
    HIGHEST_DOCK,
    LOWEST_DOCK,
    NARROWEST_COLUMN,
    USUAL_WIDTHS,
    WIDEST_COLUMN,
    Arrangement,
    PanelBox,
)
from engine.checks.field_error import FieldError
from engine.checks.values import described, is_within

MOST_WORKSPACES, LONGEST_NAME = 50, 60
_FAR = 32768.0  # points, of a panel that floats


@dataclass(slots=True)
class Arranged:
    """`now`: where panels lie; `workspaces`: arrangements under names, in their order."""

    now: Arrangement = field(default_factory=Arrangement)
    workspaces: Map[str, Arrangement] = field(default_factory=Map)


def arrangement_json(told: Arrangement) -> dict[str, object]:
    """Returns the object that a file holds; what is as it comes is not told."""
    usual, out = Arrangement(), dict[str, object]()
    if (told.left, told.right) != (usual.left, usual.right):
        out |= {"left": list(told.left), "right": list(told.right)}
    out |= {"floating": {name: list(box) for name, box in sorted(told.floating.items())}} if told.floating else {}
    out |= {"hidden": sorted(told.hidden)} if told.hidden else {}
    out |= {"widths": list(told.widths)} if told.widths != usual.widths else {}
    out |= {"heights": dict(sorted(told.heights.items()))} if told.heights else {}
    return out | ({"strip": told.strip} if told.strip else {})


def arrangement_of(told: object, place: str) -> Arrangement:
    """Returns what an object tells.  FieldError where a member is not what it should be; panels that there are not, of
    a newer program perhaps, are left out, and those that it does not name are where they are at first."""
    if not isinstance(told, dict):
        raise FieldError(place, described(told), "an object")
    usual = Arrangement()
    floating = {
        name: _box(box, f"{place}.floating.{name}") for name, box in _members(told, "floating", place) if name in DOCKS
    }
    heights = {
        name: _length(high, f"{place}.heights.{name}", LOWEST_DOCK, HIGHEST_DOCK)
        for name, high in _members(told, "heights", place)
        if name in DOCKS
    }
    seen, columns = set(floating), dict[str, list[str]]()
    for side in COLUMNS:
        named = _names(told.get(side, list(usual.column(side))), f"{place}.{side}")
        columns[side] = [name for name in dict.fromkeys(named) if name in DOCKS and name not in seen]
        seen.update(columns[side])
    for name, dock in DOCKS.items():
        if name not in seen:
            columns[dock.home].append(name)
    widths = told.get("widths", list(USUAL_WIDTHS))
    if not isinstance(widths, list) or len(widths) != 2:
        raise FieldError(f"{place}.widths", described(widths), "two widths")
    left, right = (_length(width, f"{place}.widths", NARROWEST_COLUMN, WIDEST_COLUMN) for width in widths)
    hidden = frozenset(name for name in _names(told.get("hidden", []), f"{place}.hidden") if name in DOCKS)
    strip = _length(told.get("strip", 0.0), f"{place}.strip", 0.0, HIGHEST_DOCK)
    columns_of = tuple(columns["left"]), tuple(columns["right"])
    return Arrangement(*columns_of, Map(floating), hidden, (left, right), Map(heights), strip)


def workspaces_of(told: object) -> Map[str, Arrangement]:
    """Returns the arrangements under names that an object tells."""
    if not isinstance(told, dict) or len(told) > MOST_WORKSPACES:
        raise FieldError("workspaces", described(told), f"an object of at most {MOST_WORKSPACES} members")
    for name in told:
        if not 0 < len(name) <= LONGEST_NAME:
            raise FieldError("workspaces", described(name), f"a name of at most {LONGEST_NAME} characters")
    return Map({name: arrangement_of(one, f"workspaces.{name}") for name, one in told.items()})


def _members(told: dict[str, object], name: str, place: str) -> list[tuple[str, object]]:
    found = told.get(name, {})
    if not isinstance(found, dict):
        raise FieldError(f"{place}.{name}", described(found), "an object")
    return list(found.items())


def _names(found: object, place: str) -> list[str]:
    if not isinstance(found, list) or not all(isinstance(name, str) for name in found):
        raise FieldError(place, described(found), "names of panels")
    return found


def _length(found: object, place: str, least: float, most: float) -> float:
    if not (isinstance(found, float | int) and is_within(found, least, most)):
        raise FieldError(place, described(found), f"a number from {least:g} to {most:g}")
    return float(found)


def _box(found: object, place: str) -> PanelBox:
    if not isinstance(found, list) or len(found) != 4:
        raise FieldError(place, described(found), "left, top, width and height")
    x, y = (_length(number, place, -_FAR, _FAR) for number in found[:2])
    wide, high = (_length(number, place, LOWEST_DOCK, HIGHEST_DOCK) for number in found[2:])
    return x, y, wide, high
