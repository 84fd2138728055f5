"""The commands about layers, groups and placements: records, and how each is read from members and told by them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

from immutables import Map

from engine.brush.checks import thawed
from engine.canvas.placing.pose import FINEST, SourcePart
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.painting.layering.mask_member import MaskValue, read_mask, write_mask
from engine.painting.layering.painting_member import AddPainting as AddPainting
from engine.painting.layering.painting_member import read_named, write_named
from engine.painting.layering.paste_commands import CopyPaint, CutPaint, PastePaint
from engine.painting.layering.pictures_member import AddPicture as AddPicture
from engine.painting.layering.pictures_member import AddPictures as AddPictures
from engine.painting.layering.pictures_member import read_children, read_part_of, read_pictured, write_children
from engine.painting.layering.placing_members import (
    PLACED,
    Members,
    Placing,
    Reader,
    Same,
    read_part,
    read_placing,
    write_part,
    write_placing,
)
from engine.painting.layering.role_members import read_role, read_scale, read_sea

COUNT_LIMIT = 1_000_000_000
SELECTED = COPY, CUT = "copy", "cut"  # how a copy of what is selected is made
Extra = Map[str, Any]  # members that this version does not know
NO_EXTRA: Extra = Map()


@dataclass(frozen=True, slots=True)
class AddLayer:
    """A new layer or group.  `group`: the one it goes into (None: the root; SAME: beside the active layer);
    `to`: its position there, 0 at the bottom; None: above the active layer if that lies there, else on top."""

    name: str
    kind: str = "layer"
    group: str | Same | None = Same.SAME
    to: int | None = None
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class BakePlacement:
    """Makes paint of its own of what a placement shows; it becomes a layer in its place.  `level`: of the pixels, where
    it cannot be exact; None: the finest of its source."""

    name: str
    level: int | None = None
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class MergeLayer:
    """Makes one layer of a layer, group or placement and of what lies right below it, under the name of the lower."""

    name: str
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class FlattenGroup:
    """Makes a layer of all that is seen of a group, in its place; None: of the whole painting, but for what is
    hidden."""

    name: str | None
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class ClearLayer:
    """Takes the paint off a layer that is selected, or all of it where nothing is; `outside`: off a layer, or all of
    them (None), what lies outside the frame."""

    name: str | None
    outside: bool = False
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class SelectLayer:
    """The layer that strokes without a layer go to."""

    name: str
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class RemoveLayer:
    """Takes a layer or group out of the tree."""

    name: str
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class RenameLayer:
    """Gives a layer or group another name."""

    name: str
    to: str
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class DuplicateLayer:
    """A copy named `to`, just above the original; elsewhere, if it has a `placing`, as a `SetLayer` has it.

    `selected`: the copy holds only what is selected of a layer, and "cut" takes that off the original; `aside`: it is
    hidden, to be duplicated in its turn, and takes the place of what was set aside before.
    """

    name: str
    to: str
    placing: Placing | None = None
    extra: Extra = NO_EXTRA
    selected: str | None = None
    aside: bool = False


@dataclass(frozen=True, slots=True)
class MoveLayer:
    """To position `to` among the layers of `group` (None: the root; SAME: where it is), counted without itself."""

    name: str
    to: int
    group: str | Same | None = Same.SAME
    extra: Extra = NO_EXTRA


@dataclass(frozen=True, slots=True)
class AddPlacement:
    """A new placement, in the tree as an `AddLayer` has it."""

    name: str
    placing: Placing
    group: str | Same | None = Same.SAME
    to: int | None = None
    extra: Extra = NO_EXTRA


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
    clip: bool | None = None
    mask: MaskValue | None = None
    role: str | None = None
    scale: float | None = None
    sea: float | None = None
    wrap: SourcePart | Same | None = Same.SAME
    placing: Placing | None = None
    extra: Extra = NO_EXTRA
    selected: str | None = None  # what is selected of a layer goes to the place, as "cut" or as a "copy"
    baked: int | None = None  # the level of which pixels it becomes in its layer where it is sampled; None: none

    @property
    def changes(self) -> Members:
        """Gives the properties that are set, by name."""
        names = (row[0] for row in _SETTABLE if row[0] != "mask")
        given = {name: getattr(self, name) for name in names}
        unset = {"wrap": Same.SAME}  # null takes the cell from a layer
        return {name: value for name, value in given.items() if value is not unset.get(name)}


def _no_more(members: Fields) -> Members:
    return {}


def _level(members: Fields) -> Members:
    return {"level": members.integer("level", None, lo=-FINEST, hi=FINEST)}


def _outside(members: Fields) -> Members:
    return {"outside": members.flag("outside", False)}


def _new_name(members: Fields) -> Members:
    return {"to": members.text("to")}


def _copy(members: Fields) -> Members:
    placing = read_placing(members)
    selected = _selected(members)
    aside = members.flag("aside", False)
    if aside and selected is None:
        raise members.fault("aside", 'true only with "selected"')
    given = None if placing == Placing() else placing
    return {**_new_name(members), "placing": given, "selected": selected, "aside": aside}


def _selected(members: Fields) -> str | None:
    selected = members.take("selected", None)
    if selected is not None and selected not in SELECTED:
        raise members.fault("selected", " or ".join(f'"{known}"' for known in SELECTED))
    return None if selected is None else str(selected)


def _group(members: Fields) -> str | Same | None:
    if "group" not in members:
        return Same.SAME
    return None if members.take("group") is None else members.text("group")


def _position(members: Fields) -> Members:
    return {"to": members.integer("to", lo=0, hi=COUNT_LIMIT), "group": _group(members)}


def _new_place(members: Fields) -> Members:
    return {"group": _group(members), "to": members.integer("to", None, lo=0, hi=COUNT_LIMIT)}


def _picture(members: Fields) -> Members:
    role = read_role(members, "role") if "role" in members else ""
    return {**read_pictured(members), "role": role, "part": read_part_of(members, None)}


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
    ("clip", Fields.flag),
    ("mask", read_mask),
    ("role", read_role),
    ("scale", read_scale),
    ("sea", read_sea),
    ("wrap", read_part),
)


def _settings(members: Fields) -> Members:
    settings = {name: read(members, name) for name, read in _SETTABLE if name in members}
    placing = read_placing(members)
    if placing != Placing():
        settings["placing"] = placing
    if selected := _selected(members):
        if "placing" not in settings:
            raise members.fault("selected", "it only with a place that it goes to")
        settings["selected"] = selected
    if "baked" in members:
        if not selected:
            raise members.fault("baked", 'it only with "selected"')
        settings["baked"] = members.integer("baked", lo=-FINEST, hi=FINEST)
    if not settings:
        known = ", ".join([*(row[0] for row in _SETTABLE), *PLACED])
        raise FieldError(members.place, "nothing to set", f"any of {known}")
    return settings


class LayerForm(NamedTuple):
    """A form of the layer command: which record, and how the members besides the verb's own are read."""

    record: type
    read: Callable[[Fields], Members]


LAYER_FORMS: dict[str, LayerForm] = {
    "add": LayerForm(AddLayer, _new_place),
    "bake": LayerForm(BakePlacement, _level),
    "merge": LayerForm(MergeLayer, _no_more),
    "flatten": LayerForm(FlattenGroup, _no_more),
    "clear": LayerForm(ClearLayer, _outside),
    "select": LayerForm(SelectLayer, _no_more),
    "remove": LayerForm(RemoveLayer, _no_more),
    "rename": LayerForm(RenameLayer, _new_name),
    "duplicate": LayerForm(DuplicateLayer, _copy),
    "move": LayerForm(MoveLayer, _position),
    "set": LayerForm(SetLayer, _settings),
    "copy": LayerForm(CopyPaint, _no_more),
    "cut": LayerForm(CutPaint, _no_more),
    "paste": LayerForm(PastePaint, _no_more),
}
_KINDS: dict[str, Callable[[Fields], tuple[type, Members]]] = {
    "layer": lambda members: (AddLayer, {}),
    "group": lambda members: (AddLayer, {"kind": "group"}),
    "placement": lambda members: (AddPlacement, {"placing": read_placing(members)}),
    "picture": lambda members: (AddPicture, _picture(members)),
    "pictures": lambda members: (AddPictures, {**read_pictured(members), "children": read_children(members)}),
    "painting": lambda members: (AddPainting, {**read_pictured(members), "children": read_named(members)}),
}
LayerCommand = (
    AddLayer
    | AddPicture
    | AddPictures
    | AddPainting
    | AddPlacement
    | BakePlacement
    | MergeLayer
    | FlattenGroup
    | ClearLayer
    | SelectLayer
    | RemoveLayer
    | RenameLayer
    | DuplicateLayer
    | MoveLayer
    | SetLayer
    | CopyPaint
    | CutPaint
    | PastePaint
)
_OF_ALL = ("flatten", "clear")  # the verbs whose name may be null: the whole painting
_COPYING = CopyPaint | CutPaint | PastePaint
_BRINGING = AddPicture | AddPictures | AddPainting
_OF_VERSION_2 = _BRINGING | AddPlacement | BakePlacement | MergeLayer | FlattenGroup | ClearLayer | _COPYING
# Of those that are no `AddLayer`.
_KIND_NAMES: dict[type, str] = {
    AddPicture: "picture",
    AddPictures: "pictures",
    AddPainting: "painting",
    AddPlacement: "placement",
}
RECORDS: tuple[type, ...] = (*_KIND_NAMES, *(form.record for form in LAYER_FORMS.values()))
_VERBS: dict[type, str] = {
    **dict.fromkeys(_KIND_NAMES, "add"),
    **{form.record: verb for verb, form in LAYER_FORMS.items()},
}


def read_layer(members: Fields) -> LayerCommand:
    """Reads a layer command: exactly one verb, whose value is the name, and what belongs to it."""
    verbs = [verb for verb in LAYER_FORMS if verb in members]
    if len(verbs) != 1:
        raise FieldError(members.place, " and ".join(verbs) or "none", f"exactly one of {', '.join(LAYER_FORMS)}")
    whole = verbs[0] in _OF_ALL and members.take(verbs[0]) is None
    name = None if whole else members.text(verbs[0])
    record, read = LAYER_FORMS[verbs[0]]
    more: Members = {}
    if record is AddLayer:
        kind = members.take("kind", "layer")
        if not isinstance(kind, str) or kind not in _KINDS:
            raise members.fault("kind", " or ".join(f'"{name}"' for name in _KINDS))
        record, more = _KINDS[kind](members)
    out: LayerCommand = record(name, **more, **read(members), extra=members.rest())
    return out


def write_layer(command: LayerCommand) -> Members:
    """Tells its members; `read_layer` is the inverse."""
    out: Members = {_VERBS[type(command)]: command.name}
    if type(command) in _KIND_NAMES:
        out["kind"] = _KIND_NAMES[type(command)]
    for f in fields(command):
        value = getattr(command, f.name)
        if isinstance(value, Placing):
            out.update(write_placing(value))
        elif isinstance(value, SourcePart):
            out[f.name] = write_part(value)
        elif f.name == "children":
            out[f.name] = write_named(value) if isinstance(command, AddPainting) else write_children(value)
        elif f.name not in ("name", "extra") and value != f.default:
            out[f.name] = None if value == "" else list(value) if isinstance(value, tuple) else value
    if isinstance(command, SetLayer) and command.mask is not None:
        out["mask"] = write_mask(command.mask)
    return {**out, **thawed(command.extra)}


def version(command: LayerCommand) -> int:
    """Returns the oldest version of the format that knows all members of a command."""
    newer = isinstance(command, SetLayer) and bool({"role", "scale", "sea", "clip", "wrap"} & command.changes.keys())
    newer |= isinstance(command, SetLayer) and command.mask is not None
    newer |= isinstance(command, SetLayer | DuplicateLayer) and command.placing is not None
    newer |= isinstance(command, SetLayer | DuplicateLayer) and command.selected is not None
    return 2 if newer or isinstance(command, _OF_VERSION_2) else 1
