"""What of a placement's source and pose a command gives: the record, how it is read from members and told by them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from enum import Enum
from typing import TYPE_CHECKING, Any

from engine.canvas.placing.pose import FINEST, MOST_LEVELS, Pose, SourcePart
from engine.checks.values import is_number
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting.places import PLACE_LIMIT

if TYPE_CHECKING:
    from engine.canvas.placing.placement import Placement

Members = dict[str, Any]
Reader = Callable[[Fields, str], Any]  # of a member of that name


class Same(Enum):
    """Stands for "as it is now" where None has a meaning of its own."""

    SAME = "same"


@dataclass(frozen=True, slots=True)
class Placing:
    """What of a placement's source and pose is given; SAME leaves it as it is, or as a `Pose` has it by itself.

    `of`: the name of what is shown, None for the whole painting; `turned` and the rest as of a `Pose`; `part`: None for
    all of the source.
    """

    of: str | Same | None = Same.SAME
    at: tuple[int, int] | Same = Same.SAME
    level: int | Same = Same.SAME
    levels: int | Same = Same.SAME
    turn: int | Same = Same.SAME
    turned: tuple[float, float] | Same = Same.SAME
    mirror: bool | Same = Same.SAME
    part: SourcePart | Same | None = Same.SAME
    repeat: bool | Same = Same.SAME

    @classmethod
    def told(cls, node: Placement) -> Placing:
        """Tells where a placement is, and what of its source it shows; not which one."""
        return replace(cls.at_pose(node.pose), part=node.part, repeat=node.repeat)

    @classmethod
    def at_pose(cls, pose: Pose) -> Placing:
        """Tells a pose, and nothing of what is shown."""
        told = {f.name: getattr(pose, f.name) for f in fields(Pose)}
        told["turned" if pose.turned is None else "turn"] = Same.SAME
        return cls(**told)

    def fields(self) -> Members:
        """Returns the fields of a placement that are given, but for its pose and its source."""
        given = {"part": self.part, "repeat": self.repeat}
        return {name: value for name, value in given.items() if value is not Same.SAME}

    def posed(self, pose: Pose) -> Pose:
        """Returns a pose with what is given of it."""
        given = {f.name: getattr(self, f.name) for f in fields(pose) if getattr(self, f.name) is not Same.SAME}
        if "turn" in given and "turned" not in given:
            given["turned"] = None
        if "turned" in given and "turn" not in given:
            given["turn"] = 0
        return replace(pose, **given)


def _flag(members: Fields, name: str) -> bool:
    out: bool = members.flag(name)
    return out


def _place(members: Fields, name: str) -> tuple[int, int]:
    x, y = members.integers(name, 2, limit=PLACE_LIMIT)
    return x, y


def _complex(members: Fields, name: str) -> tuple[float, float]:
    value = members.take(name)
    if not (isinstance(value, list) and len(value) == 2 and all(map(is_number, value))):
        raise members.fault(name, "[re, im], two numbers")
    try:
        return float(value[0]), float(value[1])
    except OverflowError:
        raise members.fault(name, "numbers near 1") from None


def read_part(members: Fields, name: str) -> SourcePart | None:
    """Reads a rectangle of a level, or null."""
    if members.take(name) is None:
        return None
    level, x, y, width, height = members.integers(name, 5, limit=PLACE_LIMIT)
    if abs(level) > FINEST or width < 1 or height < 1:
        raise members.fault(name, f"[L, X, Y, W, H], L from -{FINEST} to {FINEST}, W and H at least 1")
    return SourcePart(level, Rect.at(x, y, width, height))


def write_part(part: SourcePart) -> list[int]:
    """Tells a rectangle of a level; `read_part` is the inverse."""
    return [part.level, part.rect.x0, part.rect.y0, part.rect.width, part.rect.height]


PLACED: dict[str, tuple[str, Reader]] = {
    "of": ("of", lambda members, name: None if members.take(name) is None else members.text(name)),
    "at": ("at", _place),
    "level": ("level", lambda members, name: members.integer(name, lo=-FINEST, hi=FINEST)),
    "levels": ("levels", lambda members, name: members.integer(name, lo=-MOST_LEVELS, hi=MOST_LEVELS)),
    "turn": ("turn", lambda members, name: members.integer(name, lo=0, hi=3)),
    "c": ("turned", _complex),
    "mirror": ("mirror", _flag),
    "rect": ("part", read_part),
    "repeat": ("repeat", _flag),
}  # by a member's name: that of the field, and how it is read


def read_placing(members: Fields) -> Placing:
    """Reads what members tell of a placement's source and pose."""
    if "c" in members and "turn" in members:
        raise members.fault("turn", "c or turn, not both")
    given = {name: read(members, member) for member, (name, read) in PLACED.items() if member in members}
    wrong = Pose(**{f.name: given[f.name] for f in fields(Pose) if f.name in given}).wrong()
    if wrong is not None:
        raise members.fault(wrong[0], wrong[2])
    return Placing(**given)


def write_placing(placing: Placing) -> Members:
    """Tells its members; `read_placing` is the inverse."""
    out: Members = {}
    for member, (name, _) in PLACED.items():
        value = getattr(placing, name)
        if isinstance(value, SourcePart):
            value = write_part(value)
        if value is not Same.SAME:
            out[member] = list(value) if isinstance(value, tuple) else value
    return out
