"""Textures bound anew, so that a written one can ask for them in periods of their own."""

from __future__ import annotations

from dataclasses import replace

from engine.checks.field_error import FieldError
from engine.texture.expression.defined import expression
from engine.texture.expression.naming.elsewhere import unit_of
from engine.texture.expression.written_ink import Expression
from engine.texture.gradient import Gradient
from engine.texture.record import Instance


def bound_anew(made: Instance) -> Instance:
    """Returns a texture bound to level 0, at which its period has as many pixels as a text that names it counts on;
    FieldError where it has no period.  Texts are not bound: they are woven into the one that names them; nor are
    gradients, which are texts then."""
    if isinstance(made, Gradient):
        return written_gradient(made)
    return made if hasattr(made, "text") else _bound(made)


def written_gradient(made: Gradient) -> Expression:
    """Returns a gradient as a text: it begins at 0, 0 and ends at 1, 0; by angle it begins to the right."""
    at = {"linear": "x", "radial": "distance(x, y)", "angular": "fract(atan2(y, x)/tau)"}[made.shape]
    knots = ", ".join(f"{place!r}, {colour}" for place, colour in made.ramp)
    return expression({"text": f"ramp({at}, {knots})"}, 0)


def _bound(made: Instance) -> Instance:
    inner = getattr(made, "inner", None)
    if inner is not None:
        return replace(made, inner=_bound(inner))  # type: ignore[type-var]
    if isinstance(made, Gradient):
        made = written_gradient(made)
    if not hasattr(made, "period"):
        raise FieldError("named", f"a {made.key[0]}", "a texture that repeats, or goes on, after a period")
    unit = unit_of(made)
    if hasattr(made, "text"):
        return replace(made, base=0, level=0, period=float(unit))  # type: ignore[type-var]
    return replace(made, base=0, period=type(made.period)(unit))  # type: ignore[type-var]
