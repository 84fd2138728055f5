"""The reading of a brush's dynamics: what follows what, by which curve."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from immutables import Map

from engine.brush import checks
from engine.brush.checks import BrushError
from engine.brush.inputs import INPUTS, Input
from engine.brush.targets import FOLLOWERS
from engine.checks.values import described


def dynamics(value: object, place: str) -> Map[str, object]:
    """Reads an object of curves by target; a null curve is none.  BrushError names what is wrong.

    One of pressure alone is kept as that curve, so that a brush has one form; what this version does not know is kept.
    """
    if not isinstance(value, Mapping):
        raise BrushError(place, described(value), 'an object {"opacity": "pressure", ...}')
    found: dict[str, object] = {}
    for name, curve in value.items():
        read = _curve(curve, f"{place}.{name}") if name in FOLLOWERS else checks.frozen(curve)
        if name not in FOLLOWERS or read is not None:
            found[str(name)] = read
    return Map(found)


def magnified(dynamics: Map[str, object], by: float) -> Map[str, object]:
    """Returns the same dynamics on another scale: what is measured in pixels goes over so many times as many."""
    for target, curve in dynamics.items():
        if isinstance(curve, Mapping) and any(INPUTS[name].in_pixels for name in curve if name in INPUTS):
            scaled = {name: _scaled(knots, by, INPUTS[name]) for name, knots in curve.items()}
            dynamics = dynamics.set(target, Map(scaled))
    return dynamics


def _scaled(knots: checks.Knots, by: float, row: Input) -> checks.Knots:
    if not row.in_pixels or by == 1.0 or not knots[-1][0] * by <= row.most:
        return knots
    places = [x * by for x, _ in knots]
    rising = all(a < b for a, b in pairwise(places))
    return tuple((x, y) for x, (_, y) in zip(places, knots, strict=True)) if rising else knots


def _curve(value: object, place: str) -> object:
    """Returns "pressure", knots, or knots by input; None for no curve."""
    if value is None:
        return None
    if isinstance(value, str):
        return checks.one_of(value, place, ("pressure",))
    if not isinstance(value, Mapping):
        return checks.knots(value, place)
    found: dict[str, object] = {}
    for name, knots in value.items():
        checks.one_of(name, place, tuple(INPUTS))
        if knots is not None:
            found[name] = checks.knots(knots, f"{place}.{name}", widest=INPUTS[name].most)
    if set(found) == {"pressure"}:
        return found["pressure"]
    return Map(found) if found else None
