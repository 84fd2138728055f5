"""The shape of a brush's tip: an ellipse, turned with the stroke or the pen; scattered, many, or of bristles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from immutables import Map

from engine.brush import checks
from engine.brush.checks import BrushError
from engine.checks.values import described

FOLLOWS = ("none", "direction", "pen")
LEAST_RATIO, MOST_SCATTER, MOST_COUNT, MOST_BRISTLES = 0.01, 16.0, 16, 200


@dataclass(frozen=True, slots=True)
class TipShape:
    """`ratio`: of the tip's breadth to its length, which is twice the radius; `angle`: degrees clockwise by which it is
    turned, from what it `follow`s; `scatter`: radii by which dabs lie aside at most, `count`: dabs at each place;
    `bristles`: hairs, 0 for a whole tip.  `extra`: members of the JSON form that this version does not know."""

    ratio: float = 1.0
    angle: float = 0.0
    follow: str = "none"
    bristles: int = 0
    scatter: float = 0.0
    count: int = 1
    extra: Map[str, object] = field(default_factory=Map)


ROUND = TipShape()


def tip_shape(value: object, place: str) -> TipShape:
    """Reads the shape of a tip; BrushError names what is wrong."""
    if not isinstance(value, Mapping):
        raise BrushError(place, described(value), 'an object {"ratio": 0.3, ...}')
    rest = Map({str(k): checks.frozen(v) for k, v in value.items() if k not in _MEMBERS})
    return TipShape(
        checks.number(value.get("ratio", 1.0), f"{place}.ratio", LEAST_RATIO, 1.0),
        checks.number(value.get("angle", 0.0), f"{place}.angle", -360.0, 360.0),
        checks.one_of(value.get("follow", "none"), f"{place}.follow", FOLLOWS),
        checks.integer(value.get("bristles", 0), f"{place}.bristles", 0, MOST_BRISTLES),
        checks.number(value.get("scatter", 0.0), f"{place}.scatter", 0.0, MOST_SCATTER),
        checks.integer(value.get("count", 1), f"{place}.count", 1, MOST_COUNT),
        rest,
    )


def tip_shape_json(shape: TipShape) -> dict[str, object]:
    """Tells a shape as JSON, without what is at its default."""
    told = {name: getattr(shape, name) for name in _MEMBERS if getattr(shape, name) != getattr(ROUND, name)}
    return told | dict(checks.thawed(shape.extra))


_MEMBERS = ("ratio", "angle", "follow", "bristles", "scatter", "count")
