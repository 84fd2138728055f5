"""The commands: the one small language that pen, panels, key map, command line and recordings speak.

Each is a frozen record and one JSON object {"do": NAME, ...}; `parse` and `to_json` are inverse to one another.
Members that this version does not know are kept in `extra` and written back.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from enum import Enum
from typing import Any, NamedTuple

import numpy as np
from immutables import Map

from engine.brush import settings
from engine.brush.checks import thawed
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.painting import places
from engine.painting.places import LEVEL_LIMIT as LEVEL_LIMIT
from engine.painting.places import PLACE_LIMIT as PLACE_LIMIT
from engine.painting.places import Bookmark as Bookmark
from engine.painting.places import RemoveBookmark as RemoveBookmark
from engine.painting.places import RenameBookmark as RenameBookmark
from engine.painting.places import View as View
from engine.painting.points import plain, points_array, points_json

SEED_LIMIT = (1 << 63) - 1
COUNT_LIMIT = 1_000_000_000
_NOTHING: Map[str, Any] = Map()


class Same(Enum):
    """Stands for "as it is now" where None has a meaning of its own."""

    SAME = "same"


@dataclass(frozen=True, eq=False, slots=True)
class Stroke:
    """One stroke.  `points`: float64 (n, 6), read-only, columns as POINT_COLUMNS, in pixels of `level` from `origin`.

    `layer`: its name, None for the active one.  `seed`: of the ink's textures; None for the painting's.
    """

    level: int
    origin: tuple[int, int]
    points: np.ndarray
    brush: Brush
    layer: str | None = None
    seed: int | None = None
    extra: Map[str, Any] = _NOTHING

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Stroke):
            return NotImplemented
        return np.array_equal(self.points, other.points) and all(
            getattr(self, f.name) == getattr(other, f.name) for f in fields(self) if f.name != "points"
        )

    def __hash__(self) -> int:
        return hash((self.level, self.origin, self.layer, self.seed, self.points.tobytes()))


@dataclass(frozen=True, slots=True)
class AddLayer:
    """A new layer or group.  `group`: the one it goes into (None: the root; SAME: beside the active layer);
    `to`: its position there, 0 at the bottom; None: above the active layer if that lies there, else on top."""

    name: str
    kind: str = "layer"
    group: str | Same | None = Same.SAME
    to: int | None = None
    extra: Map[str, Any] = _NOTHING


@dataclass(frozen=True, slots=True)
class SelectLayer:
    """The layer that strokes without a layer go to."""

    name: str
    extra: Map[str, Any] = _NOTHING


@dataclass(frozen=True, slots=True)
class RemoveLayer:
    """Takes a layer or group out of the tree."""

    name: str
    extra: Map[str, Any] = _NOTHING


@dataclass(frozen=True, slots=True)
class RenameLayer:
    """Gives a layer or group another name."""

    name: str
    to: str
    extra: Map[str, Any] = _NOTHING


@dataclass(frozen=True, slots=True)
class DuplicateLayer:
    """A copy named `to`, just above the original."""

    name: str
    to: str
    extra: Map[str, Any] = _NOTHING


@dataclass(frozen=True, slots=True)
class MoveLayer:
    """To position `to` among the layers of `group` (None: the root; SAME: where it is), counted without itself."""

    name: str
    to: int
    group: str | Same | None = Same.SAME
    extra: Map[str, Any] = _NOTHING


@dataclass(frozen=True, slots=True)
class SetLayer:
    """What of a layer or group is to change; None leaves it."""

    name: str
    opacity: float | None = None
    visible: bool | None = None
    blend: str | None = None
    locked: bool | None = None
    alpha_locked: bool | None = None
    isolated: bool | None = None
    extra: Map[str, Any] = _NOTHING

    @property
    def changes(self) -> dict[str, Any]:
        """Gives the properties that are set, by name."""
        names = (row[0] for row in _SETTABLE)
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}


@dataclass(frozen=True, slots=True)
class Undo:
    """Takes back so many steps."""

    count: int = 1
    extra: Map[str, Any] = _NOTHING


@dataclass(frozen=True, slots=True)
class Redo:
    """Does so many steps again."""

    count: int = 1
    extra: Map[str, Any] = _NOTHING


@dataclass(frozen=True, slots=True)
class DefineTexture:
    """A texture under a name.  `arguments` belong to the maker and are checked when the texture is made."""

    name: str
    maker: str
    arguments: Map[str, Any] = field(default_factory=Map)


@dataclass(frozen=True, slots=True)
class Swap:
    """Another example for the region that lies on top at pixel `at` of `level`, on a layer (None: the active one), of
    one depth or (None) of any; `detail` as the brush's."""

    level: int
    at: tuple[int, int]
    example: str
    layer: str | None = None
    depth: float | None = None
    detail: int = 0
    extra: Map[str, Any] = _NOTHING


LayerCommand = AddLayer | SelectLayer | RemoveLayer | RenameLayer | DuplicateLayer | MoveLayer | SetLayer
Command = Stroke | LayerCommand | Undo | Redo | View | DefineTexture | Swap | places.BookmarkCommand


def parse(value: Any, where: str = "") -> Command:
    """Returns the command that a JSON object tells; FieldError names the member, what was found and what was
    expected."""
    members = Fields(value, where)
    name = members.take("do", expected="the command's name")
    row = COMMANDS.get(name) if isinstance(name, str) else None
    if row is None:
        raise members.fault("do", f"one of {', '.join(COMMANDS)}")
    return row.read(members)


def to_json(command: Command) -> dict[str, Any]:
    """Returns the JSON object of a command; defaults are left out."""
    name = NAMES[type(command)]
    return {"do": name, **COMMANDS[name].write(command)}


def _read_stroke(members: Fields) -> Stroke:
    level = members.integer("level", 0, lo=-LEVEL_LIMIT, hi=LEVEL_LIMIT)
    origin = members.integers("origin", 2, (0, 0), limit=PLACE_LIMIT)
    points = points_array(members.take("points", expected="a list of points"), members.at("points"))
    brush = _read_brush(members)
    layer = None if members.take("layer", None) is None else members.text("layer")
    seed = None if members.take("seed", None) is None else members.integer("seed", lo=-SEED_LIMIT, hi=SEED_LIMIT)
    return Stroke(level, origin, points, brush, layer, seed, members.rest())


def _read_brush(members: Fields) -> Brush:
    return settings.from_json(members.take("brush", {}), members.at("brush"))


def _write_stroke(stroke: Stroke) -> dict[str, Any]:
    out: dict[str, Any] = {"level": stroke.level, "origin": list(stroke.origin)}
    if stroke.layer is not None:
        out["layer"] = stroke.layer
    if stroke.seed is not None:
        out["seed"] = stroke.seed
    return {
        **out,
        "brush": settings.to_json(stroke.brush),
        "points": points_json(stroke.points),
        **thawed(stroke.extra),
    }


class LayerForm(NamedTuple):
    """A form of the layer command: which record, and how the members besides the verb's own are read."""

    record: type
    read: Callable[[Fields], dict[str, Any]]


def _no_more(members: Fields) -> dict[str, Any]:
    return {}


def _new_name(members: Fields) -> dict[str, Any]:
    return {"to": members.text("to")}


def _group(members: Fields) -> str | Same | None:
    if "group" not in members:
        return Same.SAME
    return None if members.take("group") is None else members.text("group")


def _position(members: Fields) -> dict[str, Any]:
    return {"to": members.integer("to", lo=0, hi=COUNT_LIMIT), "group": _group(members)}


def _new_place(members: Fields) -> dict[str, Any]:
    kind = members.take("kind", "layer")
    if kind not in ("layer", "group"):
        raise members.fault("kind", '"layer" or "group"')
    return {"kind": kind, "group": _group(members), "to": members.integer("to", None, lo=0, hi=COUNT_LIMIT)}


def _opacity(members: Fields, name: str) -> float:
    out: float = members.number(name, lo=0.0, hi=1.0)
    return out


_SETTABLE: tuple[tuple[str, Callable[[Fields, str], Any]], ...] = (
    ("opacity", _opacity),
    ("visible", Fields.flag),
    ("blend", Fields.text),
    ("locked", Fields.flag),
    ("alpha_locked", Fields.flag),
    ("isolated", Fields.flag),
)


def _settings(members: Fields) -> dict[str, Any]:
    settings = {name: read(members, name) for name, read in _SETTABLE if name in members}
    if not settings:
        raise FieldError(members.place, "nothing to set", f"any of {', '.join(row[0] for row in _SETTABLE)}")
    return settings


LAYER_FORMS: dict[str, LayerForm] = {
    "add": LayerForm(AddLayer, _new_place),
    "select": LayerForm(SelectLayer, _no_more),
    "remove": LayerForm(RemoveLayer, _no_more),
    "rename": LayerForm(RenameLayer, _new_name),
    "duplicate": LayerForm(DuplicateLayer, _new_name),
    "move": LayerForm(MoveLayer, _position),
    "set": LayerForm(SetLayer, _settings),
}
_VERBS = {form.record: verb for verb, form in LAYER_FORMS.items()}


def _read_layer(members: Fields) -> Command:
    verbs = [verb for verb in LAYER_FORMS if verb in members]
    if len(verbs) != 1:
        raise FieldError(members.place, " and ".join(verbs) or "none", f"exactly one of {', '.join(LAYER_FORMS)}")
    name = members.text(verbs[0])
    form = LAYER_FORMS[verbs[0]]
    out: Command = form.record(name, **form.read(members), extra=members.rest())
    return out


def _write_layer(command: LayerCommand) -> dict[str, Any]:
    out: dict[str, Any] = {_VERBS[type(command)]: command.name}
    for f in fields(command):
        value = getattr(command, f.name)
        if f.name not in ("name", "extra") and value != f.default:
            out[f.name] = value
    return {**out, **thawed(command.extra)}


def _reads_count(form: type) -> Callable[[Fields], Any]:
    return lambda members: form(members.integer("count", 1, lo=1, hi=COUNT_LIMIT), members.rest())


def _write_count(command: Undo | Redo) -> dict[str, Any]:
    return {**({"count": command.count} if command.count != 1 else {}), **thawed(command.extra)}


def _read_texture(members: Fields) -> DefineTexture:
    return DefineTexture(members.text("name"), members.text("maker"), members.rest())


def _write_texture(command: DefineTexture) -> dict[str, Any]:
    return {"name": command.name, "maker": command.maker, **thawed(command.arguments)}


def _read_swap(members: Fields) -> Swap:
    x, y = members.integers("at", 2, limit=PLACE_LIMIT)
    return Swap(
        members.integer("level", 0, lo=-LEVEL_LIMIT, hi=LEVEL_LIMIT),
        (x, y),
        members.text("example"),
        None if members.take("layer", None) is None else members.text("layer"),
        None
        if members.take("depth", None) is None
        else members.number("depth", lo=-settings.DEEPEST, hi=settings.DEEPEST),
        members.integer("example_detail", 0, lo=0, hi=settings.MOST_DETAIL),
        members.rest(),
    )


def _write_swap(swap: Swap) -> dict[str, Any]:
    out: dict[str, Any] = {"level": swap.level, "at": list(swap.at), "example": swap.example}
    if swap.layer is not None:
        out["layer"] = swap.layer
    if swap.depth is not None:
        out["depth"] = plain(swap.depth)
    if swap.detail:
        out["example_detail"] = swap.detail
    return {**out, **thawed(swap.extra)}


class Form(NamedTuple):
    """How a command is read from its members and written to them."""

    records: tuple[type, ...]
    read: Callable[[Fields], Command]
    write: Callable[[Any], Mapping[str, Any]]


COMMANDS: dict[str, Form] = {
    "stroke": Form((Stroke,), _read_stroke, _write_stroke),
    "layer": Form(tuple(_VERBS), _read_layer, _write_layer),
    "undo": Form((Undo,), _reads_count(Undo), _write_count),
    "redo": Form((Redo,), _reads_count(Redo), _write_count),
    "view": Form((View,), places.read_view, places.write_view),
    "texture": Form((DefineTexture,), _read_texture, _write_texture),
    "swap": Form((Swap,), _read_swap, _write_swap),
    "bookmark": Form((Bookmark, RemoveBookmark, RenameBookmark), places.read_bookmark, places.write_bookmark),
}
NAMES = {record: name for name, form in COMMANDS.items() for record in form.records}
