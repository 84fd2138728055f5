"""The command that brings in another painting as a group: its file is held by a texture, and its layers are named."""

from __future__ import annotations

from dataclasses import dataclass

from immutables import Map

from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.painting.layering.pictures_member import DEEPEST_TREE, MOST_NODES
from engine.painting.layering.placing_members import Same

# The member of a picture's definition that tells what the file holds: a picture, or its bytes are to be kept as such.
HOLDS, A_PICTURE, A_FILE = "holds", "picture", "file"


@dataclass(frozen=True, slots=True)
class NamedNode:
    """A layer or placement of the painting, or a group with what it holds, bottom first, under the name that it
    gets."""

    name: str
    children: tuple[NamedNode, ...] | None = None


@dataclass(frozen=True, slots=True)
class AddPainting:
    """A new group of all layers of the painting whose file a texture holds, bottom first, exactly as they are: pixel
    (0, 0) of its level 0 lies at pixel `at` of `level`, a pixel on a pixel.  In the tree as an `AddLayer` has it."""

    name: str
    texture: str
    children: tuple[NamedNode, ...]
    level: int = 0
    at: tuple[int, int] = (0, 0)
    group: str | Same | None = Same.SAME
    to: int | None = None
    extra: Map[str, object] = Map()  # noqa: RUF009  # it never changes


def read_named(members: Fields) -> tuple[NamedNode, ...]:
    """Reads the layers of the command; `write_named` is the inverse."""
    return _named(members, [MOST_NODES], 0)


def _named(members: Fields, room: list[int], depth: int) -> tuple[NamedNode, ...]:
    told, place = members.take("children", expected="a list of names and groups"), members.at("children")
    room[0] -= len(told) if isinstance(told, list | tuple) else MOST_NODES + 1
    if room[0] < 0 or depth > DEEPEST_TREE:
        raise members.fault(
            "children", f"a list of names and groups, at most {MOST_NODES} in all, {DEEPEST_TREE} in one another"
        )
    return tuple(_node(one, f"{place}[{i}]", room, depth) for i, one in enumerate(told))


def _node(told: object, place: str, room: list[int], depth: int) -> NamedNode:
    if isinstance(told, str):
        return NamedNode(Fields({"name": told}, place).text("name"))
    members = Fields(told, place)
    out = NamedNode(members.text("name"), _named(members, room, depth + 1))
    if more := list(members.rest()):
        raise FieldError(members.at(more[0]), "a member", "none that this version does not know")
    return out


def write_named(children: tuple[NamedNode, ...]) -> list[object]:
    """Tells them as they are read."""
    return [
        one.name if one.children is None else {"name": one.name, "children": write_named(one.children)}
        for one in children
    ]
