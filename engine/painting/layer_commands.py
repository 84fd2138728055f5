"""The commands about layers, groups and placements: records, and how each is read from members and told by them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from enum import Enum
from typing import TYPE_CHECKING, Any, NamedTuple

from immutables import Map

from engine.brush.checks import thawed
from engine.canvas.placing.pose import FINEST, MOST_LEVELS, Pose, SourcePart
from engine.checks.field_error import FieldError
from engine.checks.values import is_number
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting.places import PLACE_LIMIT

if TYPE_CHECKING:
    from engine.canvas.placing.placement import Placement

COUNT_LIMIT = 1_000_000_000
Members = dict[str, Any]
Reader = Callable[[Fields, str], Any]  # of a member of that name
Extra = Map[str, Any]  # members that this version does not know
_NOTHING: Extra = Map()


class Same(Enum):
    """Stands for "as it is now" where None has a meaning of its own."""

    SAME = "same"


@dataclass(frozen=True, slots=True)
class AddLayer:
    """A new layer or group.  `group`: the one it goes into (None: the root; SAME: beside the active layer);
    `to`: its position there, 0 at the bottom; None: above the active layer if that lies there, else on top."""

    name: str
    kind: str = "layer"
    group: str | Same | None = Same.SAME
    to: int | None = None
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class BakePlacement:
    """Makes paint of its own of what a placement shows; it becomes a layer in its place."""

    name: str
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class SelectLayer:
    """The layer that strokes without a layer go to."""

    name: str
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class RemoveLayer:
    """Takes a layer or group out of the tree."""

    name: str
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class RenameLayer:
    """Gives a layer or group another name."""

    name: str
    to: str
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class DuplicateLayer:
    """A copy named `to`, just above the original."""

    name: str
    to: str
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class MoveLayer:
    """To position `to` among the layers of `group` (None: the root; SAME: where it is), counted without itself."""

    name: str
    to: int
    group: str | Same | None = Same.SAME
    extra: Extra = _NOTHING


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


@dataclass(frozen=True, slots=True)
class AddPlacement:
    """A new placement, in the tree as an `AddLayer` has it."""

    name: str
    placing: Placing
    group: str | Same | None = Same.SAME
    to: int | None = None
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class SetLayer:
    """What of a layer, group or placement is to change; None leaves it."""

    name: str
    opacity: float | None = None
    visible: bool | None = None
    blend: str | None = None
    locked: bool | None = None
    alpha_locked: bool | None = None
    isolated: bool | None = None
    placing: Placing | None = None
    extra: Extra = _NOTHING

    @property
    def changes(self) -> Members:
        """Gives the properties that are set, by name."""
        names = (row[0] for row in _SETTABLE)
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}


def _no_more(members: Fields) -> Members:
    return {}


def _new_name(members: Fields) -> Members:
    return {"to": members.text("to")}


def _group(members: Fields) -> str | Same | None:
    if "group" not in members:
        return Same.SAME
    return None if members.take("group") is None else members.text("group")


def _position(members: Fields) -> Members:
    return {"to": members.integer("to", lo=0, hi=COUNT_LIMIT), "group": _group(members)}


def _new_place(members: Fields) -> Members:
    return {"group": _group(members), "to": members.integer("to", None, lo=0, hi=COUNT_LIMIT)}


def _opacity(members: Fields, name: str) -> float:
    out: float = members.number(name, lo=0.0, hi=1.0)
    return out


_SETTABLE: tuple[tuple[str, Reader], ...] = (
    ("opacity", _opacity),
    ("visible", Fields.flag),
    ("blend", Fields.text),
    ("locked", Fields.flag),
    ("alpha_locked", Fields.flag),
    ("isolated", Fields.flag),
)


def _settings(members: Fields) -> Members:
    settings = {name: read(members, name) for name, read in _SETTABLE if name in members}
    placing = read_placing(members)
    if placing != Placing():
        settings["placing"] = placing
    if not settings:
        known = ", ".join([*(row[0] for row in _SETTABLE), *_PLACED])
        raise FieldError(members.place, "nothing to set", f"any of {known}")
    return settings


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
    return float(value[0]), float(value[1])


def _part(members: Fields, name: str) -> SourcePart | None:
    if members.take(name) is None:
        return None
    level, x, y, width, height = members.integers(name, 5, limit=PLACE_LIMIT)
    if abs(level) > FINEST or width < 1 or height < 1:
        raise members.fault(name, f"[L, X, Y, W, H], L from -{FINEST} to {FINEST}, W and H at least 1")
    return SourcePart(level, Rect.at(x, y, width, height))


_PLACED: dict[str, tuple[str, Reader]] = {
    "of": ("of", lambda members, name: None if members.take(name) is None else members.text(name)),
    "at": ("at", _place),
    "level": ("level", lambda members, name: members.integer(name, lo=-FINEST, hi=FINEST)),
    "levels": ("levels", lambda members, name: members.integer(name, lo=-MOST_LEVELS, hi=MOST_LEVELS)),
    "turn": ("turn", lambda members, name: members.integer(name, lo=0, hi=3)),
    "c": ("turned", _complex),
    "mirror": ("mirror", _flag),
    "rect": ("part", _part),
    "repeat": ("repeat", _flag),
}  # by a member's name: that of the field, and how it is read


def read_placing(members: Fields) -> Placing:
    """Reads what members tell of a placement's source and pose."""
    if "c" in members and "turn" in members:
        raise members.fault("turn", "c or turn, not both")
    given = {name: read(members, member) for member, (name, read) in _PLACED.items() if member in members}
    wrong = Pose(**{f.name: given[f.name] for f in fields(Pose) if f.name in given}).wrong()
    if wrong is not None:
        raise members.fault(wrong[0], wrong[2])
    return Placing(**given)


def write_placing(placing: Placing) -> Members:
    """Tells its members; `read_placing` is the inverse."""
    out: Members = {}
    for member, (name, _) in _PLACED.items():
        value = getattr(placing, name)
        if isinstance(value, SourcePart):
            value = [value.level, value.rect.x0, value.rect.y0, value.rect.width, value.rect.height]
        if value is not Same.SAME:
            out[member] = list(value) if isinstance(value, tuple) else value
    return out


class LayerForm(NamedTuple):
    """A form of the layer command: which record, and how the members besides the verb's own are read."""

    record: type
    read: Callable[[Fields], Members]


LAYER_FORMS: dict[str, LayerForm] = {
    "add": LayerForm(AddLayer, _new_place),
    "bake": LayerForm(BakePlacement, _no_more),
    "select": LayerForm(SelectLayer, _no_more),
    "remove": LayerForm(RemoveLayer, _no_more),
    "rename": LayerForm(RenameLayer, _new_name),
    "duplicate": LayerForm(DuplicateLayer, _new_name),
    "move": LayerForm(MoveLayer, _position),
    "set": LayerForm(SetLayer, _settings),
}
_KINDS: dict[str, Callable[[Fields], tuple[type, Members]]] = {
    "layer": lambda members: (AddLayer, {}),
    "group": lambda members: (AddLayer, {"kind": "group"}),
    "placement": lambda members: (AddPlacement, {"placing": read_placing(members)}),
}
LayerCommand = (
    AddLayer
    | AddPlacement
    | BakePlacement
    | SelectLayer
    | RemoveLayer
    | RenameLayer
    | DuplicateLayer
    | MoveLayer
    | SetLayer
)
RECORDS: tuple[type, ...] = (AddPlacement, *(form.record for form in LAYER_FORMS.values()))
_VERBS: dict[type, str] = {AddPlacement: "add", **{form.record: verb for verb, form in LAYER_FORMS.items()}}


def read_layer(members: Fields) -> LayerCommand:
    """Reads a layer command: exactly one verb, whose value is the name, and what belongs to it."""
    verbs = [verb for verb in LAYER_FORMS if verb in members]
    if len(verbs) != 1:
        raise FieldError(members.place, " and ".join(verbs) or "none", f"exactly one of {', '.join(LAYER_FORMS)}")
    name = members.text(verbs[0])
    record, read = LAYER_FORMS[verbs[0]]
    more: Members = {}
    if record is AddLayer:
        kind = members.take("kind", "layer")
        if not isinstance(kind, str) or kind not in _KINDS:
            raise members.fault("kind", '"layer", "group" or "placement"')
        record, more = _KINDS[kind](members)
    out: LayerCommand = record(name, **more, **read(members), extra=members.rest())
    return out


def write_layer(command: LayerCommand) -> Members:
    """Tells its members; `read_layer` is the inverse."""
    out: Members = {_VERBS[type(command)]: command.name}
    if isinstance(command, AddPlacement):
        out["kind"] = "placement"
    for f in fields(command):
        value = getattr(command, f.name)
        if isinstance(value, Placing):
            out.update(write_placing(value))
        elif f.name not in ("name", "extra") and value != f.default:
            out[f.name] = value
    return {**out, **thawed(command.extra)}


def version(command: LayerCommand) -> int:
    """Returns the oldest version of the format that knows all members of a command."""
    placed = isinstance(command, SetLayer) and command.placing is not None
    return 2 if placed or isinstance(command, AddPlacement | BakePlacement) else 1
