"""A series of textures under the pen: its weight follows the pressure, pixel by pixel.

A component of a brush's ink may give, for the `weight` of a series (`engine.texture.matched.Series`), a curve of the
pressure.  The stages of the series are inks of their own; at the pressure p, of weight w = curve(p), stage k of K has
the part max(0, 1 - |w (K - 1) - k|) of the amplitude: at most two neighbours at a pixel, which were made of the same
noise, and together all of it.  So where the pen is steady there is one texture, between two matched ones, and where the
pressure changes one becomes the other.  The pressure at a pixel is the strongest that went over it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from engine.brush import checks
from engine.brush.parts import Component
from engine.texture.expression.written_ink import Expression
from engine.texture.record import Instance

_STRAIGHT = ((0.0, 0.0), (1.0, 1.0))


@dataclass(frozen=True, slots=True)
class Hat:
    """The part of stage `stage` of `stages` by the pressure, through the knots `curve` (pressure, weight)."""

    curve: checks.Knots
    stage: int
    stages: int

    def of(self, pressure: np.ndarray) -> np.ndarray:
        """0..1, float32, of pressures 0..1."""
        inputs, outputs = np.array(self.curve, np.float64).T
        weight = np.interp(pressure, inputs, outputs) * (self.stages - 1)
        out: np.ndarray = np.maximum(1.0 - np.abs(weight - self.stage), 0.0).astype(np.float32)
        return out


@dataclass(frozen=True, eq=False, slots=True)
class Swayed:
    """An instance of the ink whose amplitude, float32 (3,), goes with the pressure."""

    instance: Instance
    amplitude: np.ndarray
    hat: Hat


def curve_of(component: Component, place: str) -> checks.Knots | None:
    """Returns the curve by which the pressure sets a component's weight; None if it has a number or none."""
    given: Any = component.parameters.get("weight")
    if isinstance(given, str):
        checks.one_of(given, f"{place}.weight", ("pressure",))
        return _STRAIGHT
    return checks.knots(given, f"{place}.weight", 1.0) if isinstance(given, list | tuple) else None


def curve_of_pen(own: Instance, component: Component, told: checks.Knots | None) -> checks.Knots | None:
    """Returns the curve by which the pressure sets a texture: that which is told; as it is for a written texture that
    looks at it, unless the component tells a weight."""
    pressed = isinstance(own, Expression) and own.stages > 1 and "weight" not in component.parameters
    return _STRAIGHT if told is None and pressed else told


def at_weight(component: Component, weight: float) -> Component:
    """Gives a component of a series at another weight, 0..1."""
    return replace(component, parameters=component.parameters.set("weight", weight))


def still(component: Component) -> Component:
    """Returns a component whose weight goes with the pressure as it is at full pressure."""
    curve = curve_of(component, "weight")
    return component if curve is None else at_weight(component, curve[-1][1])
