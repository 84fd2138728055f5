"""The commands: the one small language that pen, panels, key map, command line and recordings speak.

Each is a frozen record and one JSON object {"do": NAME, ...}; `parse` and `to_json` are inverse to one another.
Members that this version does not know are kept in `extra` and written back.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple

import numpy as np
from immutables import Map

from engine.brush import settings
from engine.brush.checks import thawed
from engine.brush.copies import NO_COPIES, Copies
from engine.brush.settings import Brush
from engine.canvas.placing.pose import Pose
from engine.files.strict_json import Fields
from engine.painting import fill_command, layer_commands, places, select_commands
from engine.painting.fill_command import Fill as Fill
from engine.painting.fill_command import Like as Like
from engine.painting.guiding import guides
from engine.painting.guiding.guides import Guide as Guide
from engine.painting.guiding.guides import RemoveGuide as RemoveGuide
from engine.painting.layer_commands import COUNT_LIMIT as COUNT_LIMIT
from engine.painting.layer_commands import AddLayer as AddLayer
from engine.painting.layer_commands import AddPainting as AddPainting
from engine.painting.layer_commands import AddPicture as AddPicture
from engine.painting.layer_commands import AddPictures as AddPictures
from engine.painting.layer_commands import AddPlacement as AddPlacement
from engine.painting.layer_commands import BakePlacement as BakePlacement
from engine.painting.layer_commands import ClearLayer as ClearLayer
from engine.painting.layer_commands import DuplicateLayer as DuplicateLayer
from engine.painting.layer_commands import FlattenGroup as FlattenGroup
from engine.painting.layer_commands import LayerCommand as LayerCommand
from engine.painting.layer_commands import MergeLayer as MergeLayer
from engine.painting.layer_commands import MoveLayer as MoveLayer
from engine.painting.layer_commands import RemoveLayer as RemoveLayer
from engine.painting.layer_commands import RenameLayer as RenameLayer
from engine.painting.layer_commands import SelectLayer as SelectLayer
from engine.painting.layer_commands import SetLayer as SetLayer
from engine.painting.layering.erode_command import Erode as Erode
from engine.painting.layering.erode_command import read_erode, write_erode
from engine.painting.layering.frame_command import SetFrame as SetFrame
from engine.painting.layering.frame_command import read_frame, write_frame
from engine.painting.layering.ground_command import LayGround as LayGround
from engine.painting.layering.ground_command import read_ground, write_ground
from engine.painting.layering.onto_member import ONTO_PAINT, read_onto
from engine.painting.layering.paper_command import SetPaper as SetPaper
from engine.painting.layering.paper_command import read_set_paper, write_set_paper
from engine.painting.layering.paste_commands import CopyPaint as CopyPaint
from engine.painting.layering.paste_commands import CutPaint as CutPaint
from engine.painting.layering.paste_commands import PastePaint as PastePaint
from engine.painting.layering.placing_members import Placing as Placing
from engine.painting.layering.placing_members import Same as Same
from engine.painting.layering.seen_member import read_seen, write_seen
from engine.painting.layering.touch_command import CleanSolid as CleanSolid
from engine.painting.layering.touch_command import Touch as Touch
from engine.painting.layering.touch_command import read_touch, write_touch
from engine.painting.places import LEVEL_LIMIT as LEVEL_LIMIT
from engine.painting.places import PLACE_LIMIT as PLACE_LIMIT
from engine.painting.places import Bookmark as Bookmark
from engine.painting.places import RemoveBookmark as RemoveBookmark
from engine.painting.places import RenameBookmark as RenameBookmark
from engine.painting.places import View as View
from engine.painting.points import plain, points_array, points_json
from engine.painting.select_commands import Select as Select
from engine.painting.stroke_copies import read_copies, write_copies

SEED_LIMIT = (1 << 63) - 1
_NOTHING: Map[str, Any] = Map()


@dataclass(frozen=True, eq=False, slots=True)
class Stroke:
    """One stroke.  `points`: float64 (n, 6), read-only, columns as POINT_COLUMNS, in pixels of `level` from `origin`.

    `layer`: its name, None for the active one.  `seed`: of the ink's textures; None for the painting's.
    `copies`: where it is drawn again, in the same step.  `onto`: the layer's paint, or its mask.
    `seen`: where the layer is seen by the selection that limits it, if not where it lies.
    """

    level: int
    origin: tuple[int, int]
    points: np.ndarray
    brush: Brush
    layer: str | None = None
    seed: int | None = None
    extra: Map[str, Any] = _NOTHING
    copies: Copies = NO_COPIES
    onto: str = ONTO_PAINT
    seen: Pose | None = None

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Stroke):
            return NotImplemented
        return np.array_equal(self.points, other.points) and all(
            getattr(self, f.name) == getattr(other, f.name) for f in fields(self) if f.name != "points"
        )

    def __hash__(self) -> int:
        return hash((self.level, self.origin, self.layer, self.seed, self.points.tobytes()))


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


Command = (
    Stroke
    | Fill
    | LayerCommand
    | SetFrame
    | SetPaper
    | Erode
    | LayGround
    | Touch
    | CleanSolid
    | Undo
    | Redo
    | View
    | DefineTexture
    | Swap
    | Select
    | places.BookmarkCommand
    | guides.GuideCommand
)


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
    copies, onto = read_copies(members), read_onto(members)
    seen = read_seen(members)
    return Stroke(level, origin, points, brush, layer, seed, members.rest(), copies, onto, seen)


def _read_brush(members: Fields) -> Brush:
    return settings.from_json(members.take("brush", {}), members.at("brush"))


def _write_stroke(stroke: Stroke) -> dict[str, Any]:
    out: dict[str, Any] = {"level": stroke.level, "origin": list(stroke.origin)}
    if stroke.layer is not None:
        out["layer"] = stroke.layer
    if stroke.seed is not None:
        out["seed"] = stroke.seed
    if stroke.copies:
        out["copies"] = write_copies(stroke.copies)
    if stroke.onto:
        out["onto"] = stroke.onto
    if stroke.seen is not None:
        out["seen"] = write_seen(stroke.seen)
    return {
        **out,
        "brush": settings.to_json(stroke.brush),
        "points": points_json(stroke.points),
        **thawed(stroke.extra),
    }


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
    "fill": Form((Fill,), fill_command.read_fill, fill_command.write_fill),
    "layer": Form(layer_commands.RECORDS, layer_commands.read_layer, layer_commands.write_layer),
    "frame": Form((SetFrame,), read_frame, write_frame),
    "paper": Form((SetPaper,), read_set_paper, write_set_paper),
    "erode": Form((Erode,), read_erode, write_erode),
    "ground": Form((LayGround,), read_ground, write_ground),
    "touch": Form((Touch, CleanSolid), read_touch, write_touch),
    "undo": Form((Undo,), _reads_count(Undo), _write_count),
    "redo": Form((Redo,), _reads_count(Redo), _write_count),
    "view": Form((View,), places.read_view, places.write_view),
    "texture": Form((DefineTexture,), _read_texture, _write_texture),
    "swap": Form((Swap,), _read_swap, _write_swap),
    "select": Form((Select,), select_commands.read_select, select_commands.write_select),
    "bookmark": Form((Bookmark, RemoveBookmark, RenameBookmark), places.read_bookmark, places.write_bookmark),
    "guide": Form((Guide, RemoveGuide), guides.read_guide, guides.write_guide),
}
NAMES = {record: name for name, form in COMMANDS.items() for record in form.records}
