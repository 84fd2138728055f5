"""A brush's curves by what they follow, as the panel edits them: pure, knots of 0..1 on both sides."""

from __future__ import annotations

from collections.abc import Mapping

from immutables import Map

from app.desk.knots import STRAIGHT, Knots
from engine.brush.inputs import INPUTS
from engine.brush.targets import Target

OneCurve = str | Knots
FALLING: Knots = ((0.0, 1.0), (1.0, 0.0))
_DIGITS = 4


def by_input(curve: object) -> dict[str, OneCurve]:
    """Returns the curves of a target by their inputs, in the order of these."""
    if curve is None:
        return {}
    if not isinstance(curve, Mapping):
        return {"pressure": curve}  # type: ignore[dict-item]
    return {name: curve[name] for name in INPUTS if name in curve}


def with_curve(dynamics: Map[str, object], target: str, name: str, curve: OneCurve | None) -> Map[str, object]:
    """Returns the dynamics with another curve of one input of a target, none if that is None."""
    curves = by_input(dynamics.get(target))
    curves.pop(name, None)
    if curve is not None:
        curves[name] = curve
    if not curves:
        return dynamics.delete(target) if target in dynamics else dynamics
    if set(curves) == {"pressure"}:
        return dynamics.set(target, curves["pressure"])
    return dynamics.set(target, Map({name: STRAIGHT if isinstance(v, str) else v for name, v in curves.items()}))


def span_of(name: str, curve: OneCurve) -> float:
    """Tells how far an input goes in a curve: to its natural end, or to the last knot."""
    row = INPUTS[name]
    last = curve[-1][0] if isinstance(curve, tuple) else 0.0
    return (last or row.span) if row.open_ended else row.span


def unit_knots(name: str, curve: OneCurve) -> OneCurve:
    """Returns a curve with its input as a part of its span."""
    if isinstance(curve, str):
        return curve
    span = span_of(name, curve)
    return tuple((min(round(x / span, _DIGITS), 1.0), y) for x, y in curve)


def heights_of(target: Target, curve: OneCurve | None) -> tuple[float, float]:
    """Returns the factors at the bottom and at the top of the editor.  What adds to an angle or changes a colour has
    in the middle what leaves it; an angle that goes from none on has that at the bottom."""
    if target.own is None and not target.turns:
        return 0.0, 1.0
    if not target.turns:
        return 0.0, 2.0
    within = not isinstance(curve, tuple) or all(0.5 <= y <= 1.5 for _, y in curve)
    return (0.5, 1.5) if within else (0.0, 1.0)


def unit_heights(curve: OneCurve, heights: tuple[float, float]) -> OneCurve:
    """Returns a curve with its factors as parts of what the editor shows."""
    low, high = heights
    if isinstance(curve, str) and heights != (0.0, 1.0):
        curve = STRAIGHT
    if isinstance(curve, str):
        return curve
    return tuple((x, min(max(round((y - low) / (high - low), _DIGITS), 0.0), 1.0)) for x, y in curve)


def raised(curve: OneCurve | None, heights: tuple[float, float]) -> OneCurve | None:
    """Returns a curve of the editor as one of factors; `unit_heights` is its inverse."""
    low, high = heights
    if not isinstance(curve, tuple) or heights == (0.0, 1.0):
        return curve
    return tuple((x, round(low + y * (high - low), _DIGITS)) for x, y in curve)


def spread(name: str, curve: OneCurve | None, span: float) -> OneCurve | None:
    """Returns a curve of parts of a span as one of the input; `unit_knots` is its inverse.  One that has no natural end
    keeps a knot at the end of its span."""
    if not isinstance(curve, tuple) or span == 1.0:
        return curve
    if INPUTS[name].open_ended and curve[-1][0] < 1.0:
        curve = (*curve, (1.0, curve[-1][1]))
    return tuple((round(x * span, _DIGITS), y) for x, y in curve)
