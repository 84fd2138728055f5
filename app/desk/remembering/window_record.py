"""The record of what a window remembers, and the object of its file."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from immutables import Map

from app.desk import presets
from app.desk.arranging.arrangement import Arrangement
from app.desk.arranging.kept_arrangement import arrangement_json, arrangement_of, workspaces_of
from app.desk.colours import from_hex
from app.desk.exporting.export_state import EXPORT_CHOICES, EXPORT_FORMATS, FINER, ExportState
from app.desk.presets import Preset
from app.desk.remembering.kept_json import KeptObject
from app.desk.solids.kept_solid import KeptSolid, solid_json, solid_of
from app.input.window_box import WindowBox, box_of
from engine.brush.parts import flag
from engine.brush.steadying import STEADIED
from engine.checks.field_error import FieldError
from engine.checks.values import described, is_within

_NAMES, _MANY = 4096, 200  # characters of a text, members of a table, at most


class KeptHand(NamedTuple):
    """What is in the hand: a `brush` as it was changed, under the name that it was taken by; the two colours,
    #rrggbb; how strokes are steadied."""

    brush: Preset | None = None
    colours: tuple[str, str] | None = None
    stabiliser: float | None = None
    steadying: str = ""


@dataclass(frozen=True, slots=True)
class KeptWindow:
    """`box`: where it lies; `welcomed`: the start page was seen; `strip`: what is open below the canvas; `folded`: by
    sections of panels that were folded or unfolded, whether they are open; `folders`: by what was chosen there;
    `panels`: where these lie; `workspaces`: such arrangements under names; `solid`: what solids were set
    to."""

    box: WindowBox | None = None
    welcomed: bool = False
    strip: str = ""
    folded: tuple[tuple[str, bool], ...] = ()
    folders: tuple[tuple[str, str], ...] = ()
    hand: KeptHand = KeptHand()  # noqa: RUF009  # it never changes
    export: ExportState = field(default_factory=ExportState)
    panels: Arrangement = field(default_factory=Arrangement)
    workspaces: Map[str, Arrangement] = field(default_factory=Map)
    solid: KeptSolid = field(default_factory=KeptSolid)


def window_json(kept: KeptWindow) -> KeptObject:
    """Returns the object that the file holds."""
    hand, box = kept.hand, kept.box
    export = {name: getattr(kept.export, name) for name in EXPORT_CHOICES}
    told: KeptObject = {"welcomed": kept.welcomed, "strip": kept.strip}
    told |= {"box": list(box.area), "maximised": box.maximised} if box is not None else {}
    told |= {"folded": dict(kept.folded), "folders": dict(kept.folders), "export": export}
    told |= {"panels": panels} if (panels := arrangement_json(kept.panels)) else {}
    if kept.workspaces:
        told["workspaces"] = {name: arrangement_json(one) for name, one in sorted(kept.workspaces.items())}
    told |= {"solid": solid_json(kept.solid)} if kept.solid != KeptSolid() else {}
    told |= {"colours": list(hand.colours)} if hand.colours is not None else {}
    told |= {"stabiliser": hand.stabiliser} if hand.stabiliser is not None else {}
    told |= {"steadying": hand.steadying} if hand.steadying else {}
    return told | ({"brush": presets.preset_json(hand.brush)} if hand.brush is not None else {})


def window_of(told: KeptObject) -> KeptWindow:
    """Returns what an object of a file tells.  ValueError, one line, where a member is not what it should be; choices
    that there are not, of a newer program perhaps, are as they come."""
    box = None
    if "box" in told:
        box = box_of(told["box"], told.get("maximised", False))
        if box is None:
            raise FieldError("box", described(told["box"]), "left, top, width and height of a window")
    folded = {name: flag(there, f"folded.{name}") for name, there in _table(told, "folded")}
    folders = {name: _words(folder, f"folders.{name}") for name, folder in _table(told, "folders")}
    welcomed, strip = flag(told.get("welcomed", False), "welcomed"), _words(told.get("strip", ""), "strip")
    return KeptWindow(
        box,
        welcomed,
        strip,
        tuple(folded.items()),
        tuple(folders.items()),
        _hand(told),
        _export(_table(told, "export")),
        arrangement_of(told.get("panels", {}), "panels"),
        workspaces_of(told.get("workspaces", {})),
        solid_of(told.get("solid", {})),
    )


def _hand(told: KeptObject) -> KeptHand:
    brush = None
    if "brush" in told:
        if not isinstance(told["brush"], dict):
            raise FieldError("brush", described(told["brush"]), "a brush")
        brush = presets.preset_of(told["brush"], "Brush", presets.own_folder())
    colours, steadying = None, _words(told.get("steadying", ""), "steadying")
    if "colours" in told:
        found = told["colours"]
        if not isinstance(found, list) or len(found) != 2 or not all(isinstance(one, str) for one in found):
            raise FieldError("colours", described(found), "two colours, #rrggbb")
        for one in found:
            from_hex(one)
        colours = found[0], found[1]
    stabiliser = told.get("stabiliser")
    if stabiliser is not None and not (isinstance(stabiliser, float | int) and is_within(stabiliser, 0.0, 1.0)):
        raise FieldError("stabiliser", described(stabiliser), "a number from 0 to 1")
    return KeptHand(brush, colours, stabiliser, steadying if steadying in STEADIED else "")


def _export(members: list[tuple[str, object]]) -> ExportState:
    usual = ExportState()
    told = {name: getattr(usual, name) for name in EXPORT_CHOICES} | dict(members)
    if not is_within(told["finer"], *FINER, whole=True):
        raise FieldError("export.finer", described(told["finer"]), f"a whole number from {FINER[0]} to {FINER[1]}")
    area, chosen = (_words(told[name], f"export.{name}") for name in ("area", "format"))
    transparent, apart, lit = (flag(told[name], f"export.{name}") for name in ("transparent", "apart", "lit"))
    known = chosen if chosen in EXPORT_FORMATS else usual.format
    return ExportState(area, int(told["finer"]), known, transparent, apart, lit)


def _table(told: KeptObject, name: str) -> list[tuple[str, object]]:
    found = told.get(name, {})
    if not isinstance(found, dict) or len(found) > _MANY:
        raise FieldError(name, described(found), f"an object of at most {_MANY} members")
    return [(_words(key, name), value) for key, value in found.items()]


def _words(value: object, place: str) -> str:
    if not isinstance(value, str) or len(value) > _NAMES:
        raise FieldError(place, described(value), f"a text of at most {_NAMES} characters")
    return value
