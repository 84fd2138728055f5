"""The command that brings in a file of layers as a group: its layers are parts of one texture's picture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from immutables import Map

from engine.checks.field_error import FieldError
from engine.files.strict_json import REQUIRED, Fields
from engine.painting.layering.placing_members import Members, Same
from engine.painting.places import LEVEL_LIMIT, PLACE_LIMIT

PicturePart = tuple[int, int, int, int]  # x, y, width, height in pixels of the picture
_SIDE, MOST_NODES, DEEPEST_TREE = 1 << 26, 4000, 64  # pixels; layers and groups in one command; groups in one another


@dataclass(frozen=True, slots=True)
class AddPicture:
    """A new layer that begins with the picture of a texture, or a `part` of it, whose corner lies at pixel `at` of
    `level`, a pixel on a pixel; in the tree as an `AddLayer` has it."""

    name: str
    texture: str
    level: int = 0
    at: tuple[int, int] = (0, 0)
    role: str = ""
    group: str | Same | None = Same.SAME
    to: int | None = None
    extra: Map[str, object] = Map()  # noqa: RUF009  # it never changes
    part: PicturePart | None = None


@dataclass(frozen=True, slots=True)
class BroughtPicture:
    """A layer: `part` of the picture, whose corner lies at `at`, in pixels of the command's level from its corner."""

    name: str
    part: PicturePart
    at: tuple[int, int] = (0, 0)
    opacity: float = 1.0
    visible: bool = True
    blend: str = "src-over"
    clip: bool = False


@dataclass(frozen=True, slots=True)
class BroughtGroup:
    """A group of such layers, bottom first."""

    name: str
    children: tuple[BroughtPicture | BroughtGroup, ...]
    opacity: float = 1.0
    visible: bool = True
    blend: str = "src-over"
    isolated: bool = True


Brought = BroughtPicture | BroughtGroup


@dataclass(frozen=True, slots=True)
class AddPictures:
    """A new group of layers that begin with parts of a texture's picture, a pixel on a pixel of `level`; bottom first.
    In the tree as an `AddLayer` has it."""

    name: str
    texture: str
    children: tuple[Brought, ...]
    level: int = 0
    at: tuple[int, int] = (0, 0)
    group: str | Same | None = Same.SAME
    to: int | None = None
    extra: Map[str, object] = Map()  # noqa: RUF009  # it never changes

    def pictures(self) -> Iterator[BroughtPicture]:
        """Yields its layers, bottom first."""
        waiting = list(reversed(self.children))
        while waiting:
            one = waiting.pop()
            if isinstance(one, BroughtGroup):
                waiting += reversed(one.children)
            else:
                yield one


def read_pictured(members: Fields) -> Members:
    """Reads which texture is brought in, and where it lies."""
    level = members.integer("level", 0, lo=-LEVEL_LIMIT, hi=LEVEL_LIMIT)
    x, y = members.integers("at", 2, (0, 0), limit=PLACE_LIMIT)
    return {"texture": members.text("texture"), "level": level, "at": (x, y)}


def read_part_of(members: Fields, default: None = REQUIRED) -> PicturePart | None:
    """Reads which part of a picture a layer is."""
    found = members.integers("part", 4, default, limit=_SIDE)
    if found is not None and (min(found[:2]) < 0 or min(found[2:]) < 1):
        raise members.fault("part", "[X, Y, W, H] within the picture")
    return None if found is None else (found[0], found[1], found[2], found[3])


def read_children(members: Fields) -> tuple[Brought, ...]:
    """Reads the layers of the command; `write_children` is the inverse."""
    room = [MOST_NODES]
    return _children(members, room, 0)


def _children(members: Fields, room: list[int], depth: int) -> tuple[Brought, ...]:
    told, place = members.take("children", expected="a list of layers"), members.at("children")
    room[0] -= len(told) if isinstance(told, list | tuple) else MOST_NODES + 1
    if room[0] < 0 or depth > DEEPEST_TREE:
        raise members.fault("children", f"a list of layers, at most {MOST_NODES} in all, {DEEPEST_TREE} in one another")
    return tuple(_child(Fields(one, f"{place}[{i}]"), room, depth) for i, one in enumerate(told))


def _child(members: Fields, room: list[int], depth: int) -> Brought:
    name, opacity = members.text("name"), members.number("opacity", 1.0, lo=0.0, hi=1.0)
    visible, blend = members.flag("visible", True), members.text("blend", "src-over")
    if "children" in members:
        inside, isolated = _children(members, room, depth + 1), members.flag("isolated", True)
        out: Brought = BroughtGroup(name, inside, opacity, visible, blend, isolated)
    else:
        x, y = members.integers("at", 2, (0, 0), limit=PLACE_LIMIT)
        part = read_part_of(members)
        assert part is not None
        out = BroughtPicture(name, part, (x, y), opacity, visible, blend, members.flag("clip", False))
    if more := list(members.rest()):
        raise FieldError(members.at(more[0]), "a member", "none that this version does not know")
    return out


def write_children(children: tuple[Brought, ...]) -> list[dict[str, object]]:
    """Tells them as they are read; defaults are left out."""
    return [_told(one) for one in children]


def _told(one: Brought) -> dict[str, object]:
    if isinstance(one, BroughtGroup):
        out: dict[str, object] = {"name": one.name, "children": write_children(one.children)}
        rest: dict[str, tuple[object, object]] = {"isolated": (one.isolated, True)}
    else:
        out = {"name": one.name, "part": list(one.part)}
        rest = {"at": (one.at, (0, 0)), "clip": (one.clip, False)}
    rest |= {"opacity": (one.opacity, 1.0), "visible": (one.visible, True), "blend": (one.blend, "src-over")}
    for name, (value, default) in rest.items():
        if value != default:
            out[name] = list(value) if isinstance(value, tuple) else value
    return out
