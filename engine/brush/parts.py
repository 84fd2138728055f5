"""The parts of a brush that are more than a number: textures in its ink, what thins its coverage, its rim, its tip.

Each is a frozen record with a strict reader, (JSON value, place) -> record, and a writer that leaves out defaults.
BrushError names the field, what was found and what was expected.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from immutables import Map

from engine.brush import checks
from engine.brush.checks import BrushError
from engine.brush.tip_shape import tip_shape_json
from engine.brush.wet import wet_json
from engine.checks.values import described
from engine.numeric.curves import CURVES, EDGES, Shape

COMPONENTS_CAP = 8
_LEVEL_LIMIT = 4096
WIDTH_CAP = 4.0  # radii
TIPS = ("sample", "window")


@dataclass(frozen=True, slots=True)
class Component:
    """One texture of a brush's ink: how much of it, towards which colour, its own parameters by name, and the curve
    that its values are sent through."""

    texture: str
    amount: float = 1.0
    colour: str = "#ffffff"
    parameters: Map[str, Any] = field(default_factory=Map)
    shaping: Shape | None = None

    @property
    def rgb(self) -> tuple[float, float, float]:
        """Gives the colour as three numbers 0..1."""
        return checks.rgb(self.colour)


@dataclass(frozen=True, slots=True)
class Surface:
    """A texture that thins a brush's coverage: `density` of a dry brush, or the `grain` of the surface painted on.

    `amount`: 0..1, how much it is felt.  `level`: of a grain, the level in whose pixels its parameters are; a density
    is in pixels of the stroke's level.
    """

    texture: str
    amount: float = 1.0
    shaping: Shape | None = None
    level: int = 0
    parameters: Map[str, Any] = field(default_factory=Map)


@dataclass(frozen=True, slots=True)
class Edge:
    """What happens along the rim of a stroke: `curve`, of EDGES or knots, by the distance from the rim in `width`s.

    `width`: in radii of the brush; `amount`: 0..1, how much of it; `colour`: what the paint turns to at the rim, None
    for no other colour; `extra`: members of the JSON form that this version does not know.
    """

    curve: Shape = "wet"
    width: float = 0.5
    amount: float = 1.0
    colour: str | None = None
    extra: Map[str, Any] = field(default_factory=Map)

    @property
    def rgb(self) -> tuple[float, float, float]:
        """Gives the colour as three numbers 0..1; black where there is none."""
        return checks.rgb(self.colour or "#000000")


@dataclass(frozen=True, slots=True)
class Tip:
    """A texture in the shape of the dab (Lewis 1984, section 6.1, small brushes).

    `source`: "sample", the texture's own sample laid out over the dab, or "window", another piece of its field for
    every dab.
    """

    texture: str
    source: str = "sample"
    shaping: Shape | None = None
    parameters: Map[str, Any] = field(default_factory=Map)


BY_STROKE = "stroke"  # the way the stroke runs, in place of a texture's name
CHANNELS_CAP = 8


def control(value: object, place: str) -> Map[str, str | float]:
    """Reads what a brush tells of control channels.  BrushError names what is wrong."""
    if not isinstance(value, Mapping) or len(value) > CHANNELS_CAP:
        raise BrushError(place, described(value), f"an object of at most {CHANNELS_CAP} channels")
    return Map(
        {checks.text(name, place, "a channel's name"): _told(told, f"{place}.{name}") for name, told in value.items()}
    )


def _told(value: object, place: str) -> str | float:
    if isinstance(value, str):
        return checks.text(value, place, '"stroke", or a texture\'s name')
    return checks.number(value, place, 0.0, 1.0)


def named_by_control(told: Mapping[str, str | float]) -> list[str]:
    """Returns the textures that control channels are told by."""
    return [one for one in told.values() if isinstance(one, str) and one != BY_STROKE]


def ink(value: Any, place: str) -> tuple[Component, ...]:
    """Reads a brush's ink.  BrushError names what is wrong."""
    if not isinstance(value, list | tuple) or len(value) > COMPONENTS_CAP:
        raise BrushError(place, described(value), f"a list of at most {COMPONENTS_CAP} components")
    return tuple(_component(part, f"{place}[{i}]") for i, part in enumerate(value))


def _component(value: Any, place: str) -> Component:
    if not isinstance(value, Mapping):
        raise BrushError(place, described(value), 'an object {"texture": NAME, ...}')
    return Component(
        checks.text(value.get("texture"), f"{place}.texture", "a texture's name"),
        checks.number(value.get("amount", 1.0), f"{place}.amount", 0.0, 1.0),
        checks.colour(value.get("colour", "#ffffff"), f"{place}.colour"),
        _others(value, "texture", "amount", "colour", "shaping"),
        shaping(value.get("shaping"), f"{place}.shaping"),
    )


def ink_json(components: tuple[Component, ...]) -> list[dict[str, Any]]:
    """Tells a brush's ink as JSON; `ink` is the inverse."""
    return [
        {"texture": part.texture, "amount": part.amount, "colour": part.colour}
        | _given("shaping", part.shaping)
        | checks.thawed(part.parameters)
        for part in components
    ]


def shaping(value: Any, place: str) -> Shape | None:
    """Returns a name of CURVES, knots of 0..1 into 0..1, or null."""
    return None if value is None else _shape(value, place, tuple(CURVES))


def _shape(value: Any, place: str, names: tuple[str, ...]) -> Shape:
    if isinstance(value, list | tuple):
        return checks.knots(value, place, 1.0)
    if not isinstance(value, str):
        raise BrushError(place, described(value), "a curve's name or knots [in, out]")
    return checks.one_of(value, place, names)


def surface(value: Any, place: str) -> Surface:
    """Returns a texture's name, or an object that holds one."""
    if isinstance(value, str):
        return Surface(checks.text(value, place, "a texture's name"))
    if not isinstance(value, Mapping):
        raise BrushError(place, described(value), 'a texture\'s name or {"texture": NAME, ...}')
    return Surface(
        checks.text(value.get("texture"), f"{place}.texture", "a texture's name"),
        checks.number(value.get("amount", 1.0), f"{place}.amount", 0.0, 1.0),
        shaping(value.get("shaping"), f"{place}.shaping"),
        _level(value.get("level", 0), f"{place}.level"),
        _others(value, "texture", "amount", "shaping", "level"),
    )


def surface_json(part: Surface) -> Any:
    """Tells a density or grain as JSON."""
    rest: dict[str, Any] = {} if part.amount == 1.0 else {"amount": part.amount}
    rest |= _given("shaping", part.shaping) | ({"level": part.level} if part.level else {})
    rest |= checks.thawed(part.parameters)
    return {"texture": part.texture, **rest} if rest else part.texture


def _level(value: Any, place: str) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or abs(value) > _LEVEL_LIMIT:
        raise BrushError(place, described(value), f"an integer from -{_LEVEL_LIMIT} to {_LEVEL_LIMIT}")
    return value


def edge(value: Any, place: str) -> Edge:
    """Returns a name of EDGES, or an object."""
    if not isinstance(value, Mapping):
        return Edge(_shape(value, place, tuple(EDGES)))
    colour = value.get("colour")
    return Edge(
        _shape(value.get("curve", "wet"), f"{place}.curve", tuple(EDGES)),
        checks.number(value.get("width", 0.5), f"{place}.width", 0.0, WIDTH_CAP),
        checks.number(value.get("amount", 1.0), f"{place}.amount", 0.0, 1.0),
        None if colour is None else checks.colour(colour, f"{place}.colour"),
        _others(value, "curve", "width", "amount", "colour"),
    )


def edge_json(part: Edge) -> Any:
    """Tells an edge as JSON."""
    rest: dict[str, Any] = {} if part.width == 0.5 else {"width": part.width}
    rest |= {} if part.amount == 1.0 else {"amount": part.amount}
    rest |= _given("colour", part.colour) | checks.thawed(part.extra)
    return {"curve": checks.thawed(part.curve), **rest} if rest else checks.thawed(part.curve)


def tip(value: Any, place: str) -> Tip:
    """Returns a texture's name, or an object that holds one."""
    if isinstance(value, str):
        return Tip(checks.text(value, place, "a texture's name"))
    if not isinstance(value, Mapping):
        raise BrushError(place, described(value), 'a texture\'s name or {"texture": NAME, ...}')
    return Tip(
        checks.text(value.get("texture"), f"{place}.texture", "a texture's name"),
        checks.one_of(value.get("from", "sample"), f"{place}.from", TIPS),
        shaping(value.get("shaping"), f"{place}.shaping"),
        _others(value, "texture", "from", "shaping"),
    )


def tip_json(part: Tip) -> Any:
    """Tells a tip as JSON."""
    rest = ({} if part.source == "sample" else {"from": part.source}) | _given("shaping", part.shaping)
    rest |= checks.thawed(part.parameters)
    return {"texture": part.texture, **rest} if rest else part.texture


def flag(value: Any, place: str) -> bool:
    """Returns true or false; BrushError for anything else."""
    if not isinstance(value, bool):
        raise BrushError(place, described(value), "true or false")
    return value


def _others(value: Mapping[str, Any], *own: str) -> Map[str, Any]:
    out: Map[str, Any] = checks.frozen({k: v for k, v in value.items() if k not in own})
    return out


def _given(name: str, value: Any) -> dict[str, Any]:
    return {} if value is None else {name: checks.thawed(value)}


WRITERS: dict[str, Callable[[Any], Any]] = {
    "ink": ink_json,
    "density": surface_json,
    "grain": surface_json,
    "edge": edge_json,
    "tip": tip_json,
    "shape": tip_shape_json,
    "wet": wet_json,
}
