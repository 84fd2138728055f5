"""The brush as a value: its settings in one table, and its strict reading from and writing to JSON.

The fields are those of the recording format.  Every field is read, checked and kept; which of them this version can
paint with is decided when the brush is used (`edits.check`).  Unknown members are kept and ignored.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from immutables import Map

from engine.brush import checks, follow_curves, ops, parts
from engine.brush.checks import BrushError, Knots
from engine.brush.modes import MODES, Mode
from engine.brush.parts import COMPONENTS_CAP, Component, Edge, Surface, Tip
from engine.brush.tip_shape import ROUND, TipShape, tip_shape
from engine.brush.wet import Wet, wet
from engine.checks.values import described
from engine.numeric.curves import Shape

__all__ = ["COMPONENTS_CAP", "SETTINGS", "Brush", "Component", "Curve", "Setting", "from_json", "to_json"]

LEVEL_LIMIT = 1 << 16  # of an example's pixels
DEEPEST = 2.0**31  # of the layers of examples
MOST_DETAIL = 4

MOST_HEIGHT = 4000.0  # px of the stroke's level
AUTO = "auto"
FIXED_TO = ("canvas", "stroke", "dab")

Curve = str | Knots  # "pressure", or knots [in, out]
Thickness = float | str | None


@dataclass(frozen=True, slots=True)
class Setting:
    """One number of a brush.  `lo`..`hi` is what is accepted, `slider` what a slider offers, `logarithmic` how."""

    name: str
    label: str
    default: float
    lo: float
    hi: float
    slider: tuple[float, float]
    unit: str
    tooltip: str
    dynamic: bool = True  # may follow the pen's pressure
    logarithmic: bool = False

    def clamped(self, value: float) -> float:
        """Gives the nearest value that the setting may have; its default for NaN."""
        return min(max(float(value), self.lo), self.hi) if value == value else self.default


SETTINGS: dict[str, Setting] = {
    row.name: row
    for row in (
        Setting(
            "radius",
            "Radius",
            16.0,
            0.0,
            4000.0,
            (0.5, 1000.0),
            "px",
            "Half the width of the stroke, in pixels of the level painted on",
            logarithmic=True,
        ),
        Setting(
            "opacity",
            "Opacity",
            1.0,
            0.0,
            1.0,
            (0.0, 1.0),
            "",
            "The most paint one stroke can lay down, however often it crosses itself",
        ),
        Setting(
            "flow",
            "Flow",
            1.0,
            0.0,
            1.0,
            (0.0, 1.0),
            "",
            "How fast a stroke comes up to its opacity: low for an airbrush",
        ),
        Setting("hardness", "Hardness", 0.8, 0.0, 1.0, (0.0, 1.0), "", "How much of the radius is covered in full"),
        Setting(
            "spacing",
            "Spacing",
            0.25,
            0.0,
            16.0,
            (0.05, 2.0),
            "radii",
            "Distance from dab to dab; small is smooth, above 2 is a row of dots",
            logarithmic=True,
        ),
    )
}


@dataclass(frozen=True, slots=True)
class Brush:
    """A brush; immutable and hashable.  BrushError if a number is out of its range.

    `example`: the texture that mode "example" grows, on the layer of depth `depth`, in pixels of `example_level` (None:
    the stroke's own); `example_detail`: how many levels of the example are finer than these.
    `control`: by channel of the example, what it tells of the pixels that it takes: "stroke" for the way
    the stroke runs (of `orientation`), a texture's name, or a number 0..1.
    `height`: what it heaps on the layer of heights in place of its paint, in pixels of the stroke's level, negative to
    carve, "auto" for a quarter of the radius; None: its paint, by whose brightness that layer is as high.  `impasto`:
    how thick its paint lies on other layers, likewise.
    `shape`: of its tip.  `wet`: how it mixes its paint with what lies there; None: not at all.
    `fixed`: what its textures, those of ink and density, lie still on, one of FIXED_TO.  `dynamics`: by target
    (module `targets`), the curve of pen pressure by which its value is
    multiplied, or those of several inputs by their names; the value of what has no curve stays as it is.
    `extra`: members of the JSON form that this version does not know.
    """

    radius: float = 16.0
    hardness: float = 0.8
    opacity: float = 1.0
    flow: float = 1.0
    spacing: float = 0.25
    mode: str = "paint"
    colour: str = "#000000"
    ink: tuple[Component, ...] = ()
    op: ops.OpValue = "toward"
    density: Surface | None = None
    grain: Surface | None = None
    shaping: Shape | None = None
    edge: Edge | None = None
    tip: Tip | None = None
    extent: bool = False
    example: str | None = None
    depth: float | None = None
    example_level: int | None = None
    example_detail: int = 0
    control: Map[str, str | float] = field(default_factory=Map)
    height: Thickness = None
    impasto: float = 0.0
    shape: TipShape = ROUND
    wet: Wet | None = None
    fixed: str = FIXED_TO[0]
    dynamics: Map[str, Any] = field(default_factory=lambda: Map({"opacity": "pressure"}))
    extra: Map[str, Any] = field(default_factory=Map)

    def __post_init__(self) -> None:
        for name, row in SETTINGS.items():
            object.__setattr__(self, name, checks.number(getattr(self, name), f"brush.{name}", row.lo, row.hi))
        checks.one_of(self.mode, "brush.mode", tuple(MODES))
        checks.one_of(self.fixed, "brush.fixed", FIXED_TO)
        object.__setattr__(self, "colour", checks.colour(self.colour, "brush.colour"))
        for name in ("depth", "example_level", "example_detail", "height", "impasto"):
            object.__setattr__(self, name, _READERS[name](getattr(self, name), f"brush.{name}"))

    @property
    def row(self) -> Mode:
        """Returns the row of its mode."""
        return MODES[self.mode]

    @property
    def heaps(self) -> float | None:
        """Gives the `height` that it heaps, in pixels of the stroke's level."""
        return self.radius / 4.0 if isinstance(self.height, str) else self.height

    def magnified(self, by: float) -> Brush:
        """Returns the same brush on another scale: its radius, and the heights that it lays."""
        height = self.height if self.height is None or isinstance(self.height, str) else _within(self.height * by)
        dynamics = follow_curves.magnified(self.dynamics, by)
        return replace(
            self, radius=self.radius * by, height=height, impasto=_within(self.impasto * by), dynamics=dynamics
        )

    @property
    def rgb(self) -> tuple[float, float, float]:
        """Gives the colour as three numbers 0..1."""
        return checks.rgb(self.colour)


def from_json(data: Any, where: str = "brush") -> Brush:
    """Returns the brush that a JSON object describes.  BrushError names the field, what was found and what was
    expected."""
    if not isinstance(data, Mapping):
        raise BrushError(where, described(data), "an object")
    known = {name: read(data[name], f"{where}.{name}") for name, read in _READERS.items() if name in data}
    return Brush(**known, extra=checks.frozen({name: v for name, v in data.items() if name not in _READERS}))


def to_json(brush: Brush) -> dict[str, Any]:
    """Returns the JSON object from which `from_json` makes the same brush; what is at its default and rarely used is
    left out."""
    data: dict[str, Any] = {}
    for part in fields(Brush):
        value = getattr(brush, part.name)
        if part.name == "extra" or (part.name in _RARE and value == _RARE[part.name]):
            continue
        data[part.name] = parts.WRITERS.get(part.name, checks.thawed)(value)
    out: dict[str, Any] = data | checks.thawed(brush.extra)
    return out


def textures_of(brush: Brush) -> list[str]:
    """Returns the names of the textures that a brush uses, each once: of its ink, coverage, tip and example."""
    used = (*brush.ink, brush.density, brush.grain, brush.tip)
    named = [*(part.texture for part in used if part is not None), *([brush.example] if brush.example else ())]
    return list(dict.fromkeys([*named, *parts.named_by_control(brush.control)]))


_RARE: dict[str, Any] = {
    "ink": (),
    "op": "toward",
    "density": None,
    "grain": None,
    "shaping": None,
    "edge": None,
    "tip": None,
    "extent": False,
    "example": None,
    "depth": None,
    "example_level": None,
    "example_detail": 0,
    "control": Map(),
    "height": None,
    "impasto": 0.0,
    "shape": ROUND,
    "wet": None,
    "fixed": FIXED_TO[0],
}


# ---- one reader a field: (value, place) -> what Brush holds ---------------------------------------------------------


def _setting(name: str) -> Callable[[Any, str], float]:
    row = SETTINGS[name]
    return lambda value, place: checks.number(value, place, row.lo, row.hi)


def _optional(read: Callable[[Any, str], Any]) -> Callable[[Any, str], Any]:
    return lambda value, place: None if value is None else read(value, place)


def _within(height: float) -> float:
    return min(max(height, -MOST_HEIGHT), MOST_HEIGHT)


def _height(value: object, place: str) -> Thickness:
    return AUTO if value == AUTO else checks.number(value, place, -MOST_HEIGHT, MOST_HEIGHT)


_READERS: dict[str, Callable[[Any, str], Any]] = {
    **{name: _setting(name) for name in SETTINGS},
    "mode": lambda value, place: checks.one_of(value, place, tuple(MODES)),
    "colour": checks.colour,
    "ink": parts.ink,
    "op": ops.read,
    "density": _optional(parts.surface),
    "grain": _optional(parts.surface),
    "shaping": parts.shaping,
    "edge": _optional(parts.edge),
    "tip": _optional(parts.tip),
    "extent": parts.flag,
    "example": _optional(lambda value, place: checks.text(value, place, "an example's name")),
    "depth": _optional(lambda value, place: checks.number(value, place, -DEEPEST, DEEPEST)),
    "example_level": _optional(lambda value, place: checks.integer(value, place, -LEVEL_LIMIT, LEVEL_LIMIT)),
    "example_detail": lambda value, place: checks.integer(value, place, 0, MOST_DETAIL),
    "control": parts.control,
    "height": _optional(_height),
    "impasto": lambda value, place: checks.number(value, place, -MOST_HEIGHT, MOST_HEIGHT),
    "shape": tip_shape,
    "wet": _optional(wet),
    "fixed": lambda value, place: checks.one_of(value, place, FIXED_TO),
    "dynamics": follow_curves.dynamics,
}
