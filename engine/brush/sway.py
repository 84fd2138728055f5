"""A series of textures under the pen: its weight follows the pressure, pixel by pixel.

A component of a brush's ink may give, for the `weight` of a series (`engine.texture.matched.Series`), a curve of the
pressure.  The stages of the series are inks of their own; at the pressure p, of weight w = curve(p), stage k of K has
the part max(0, 1 - |w (K - 1) - k|) of the amplitude: at most two neighbours at a pixel, which were made of the same
noise, and together all of it.  So where the pen is steady there is one texture, between two matched ones, and where the
pressure changes one becomes the other.  The pressure at a pixel is the strongest that went over it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from engine.brush import checks
from engine.brush.heading import Ways
from engine.brush.parts import Component
from engine.texture.expression.written import FULL_TURN
from engine.texture.expression.written_ink import Expression
from engine.texture.record import Instance
from engine.texture.table import EXPRESSION

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
    """An instance of the ink whose amplitude, float32 (3,), goes with the pressure, with the distance from the
    stroke's rim, or with the way that it runs: the number `way` of 16."""

    instance: Instance
    amplitude: np.ndarray
    hat: Hat | None = None
    rim: Hat | None = None
    way: int | None = None

    def part(self, pressure: np.ndarray, rim: np.ndarray | None, ways: Ways) -> np.ndarray:
        """Returns how much of it there is, of pressures and distances, 0..1, and ways: float32."""
        found = np.ones_like(pressure) if self.hat is None else self.hat.of(pressure)
        found = found if self.rim is None or rim is None else found * self.rim.of(rim)
        return found if self.way is None else found * ways.part(self.way)

    def lies_in(self, ways: Ways) -> bool:
        """Tells whether a stroke that runs these ways may show it."""
        return self.way is None or ways.has(self.way)


def stages_of(
    own: Instance, component: Component, curve: checks.Knots | None
) -> Iterator[tuple[dict[str, float], tuple[Hat | None, Hat | None, int | None]]]:
    """Yields for each of the textures that a stroke mixes what a component tells to be it, and where it is; nothing
    where there is one for all."""
    pressures = getattr(own, "stages", 1) if curve is not None else 1
    rims = 1 if "rim" in component.parameters else getattr(own, "rims", 1)
    ways = 1 if "direction" in component.parameters else getattr(own, "ways", 1)
    if pressures == rims == ways == 1:
        return
    for k, n, way in product(range(pressures), range(rims), range(ways)):
        told = {"weight": k / (pressures - 1)} if pressures > 1 else {}
        told |= {"rim": n / (rims - 1)} if rims > 1 else {}
        told |= {"direction": way * FULL_TURN / ways} if ways > 1 else {}
        hat = Hat(curve, k, pressures) if curve is not None and pressures > 1 else None
        yield told, (hat, Hat(_STRAIGHT, n, rims) if rims > 1 else None, way if ways > 1 else None)


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


def told_so(component: Component, told: Mapping[str, float]) -> Component:
    """Gives a component with other parameters."""
    return replace(component, parameters=component.parameters.update(told))


def still(component: Component, textures: Mapping[str, object]) -> Component:
    """Returns a component, whose texture is one of these, as it is at full pressure and far within its stroke."""
    curve = curve_of(component, "weight")
    if curve is not None:
        return at_weight(component, curve[-1][1])
    written = getattr(textures.get(component.texture), "kind", "") == EXPRESSION
    return told_so(component, {"weight": 1.0, "rim": 1.0, **component.parameters}) if written else component
