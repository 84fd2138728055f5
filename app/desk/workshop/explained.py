"""What a brush paints with, told as a text of the language: of which it is made, where the language has that."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

from immutables import Map

from app.desk.workshop.workshop_state import TextTold
from engine.brush.parts import Component
from engine.brush.settings import Brush
from engine.painting.commands import DefineTexture
from engine.texture.expression.written import USUAL_STAGES

_USUAL = 32.0  # pixels: the period of a texture that tells none
_PERIOD_OF_TEXT = 64.0


class Explained(NamedTuple):
    """A text, and what is told beside it."""

    text: str
    told: TextTold


class _Wave(NamedTuple):
    """What a texture that the program makes by itself is told by: how often it comes in one period of the text."""

    often: float
    given: Map[str, float]

    def number(self, name: str, usual: float = 0.0) -> float:
        """Returns one of its parameters."""
        return float(self.given.get(name, usual))

    def place(self, turn: float = 0.0, phase: bool = True) -> str:
        """Returns where along its direction a place lies."""
        angle = math.radians(self.number("angle") + turn)
        parts = [(math.cos(angle) * self.often, "x"), (math.sin(angle) * self.often, "y")]
        told = " + ".join(_times(factor, axis) for factor, axis in parts if abs(factor) > 1e-9)
        moved = self.number("phase") if phase else 0.0
        return (f"{told} + {moved:g}" if moved else told).replace("+ -", "- ")


def _stripes(wave: _Wave) -> str:
    return f"stripes({wave.place()}, 0.5)"


def _sawtooth(wave: _Wave) -> str:
    return f"1 - fract({wave.place()})"


def _squares(wave: _Wave) -> str:
    return f"squares(2*({wave.place()}), 2*({wave.place(90.0)}))"


def _rock(wave: _Wave) -> str:
    x, y = _times(wave.often, "x"), _times(wave.often, "y")
    return f"fbm({x}, {y}, 14, {2.0 ** -wave.number('roughness', 0.5):.3g}, 2, {wave.number('seed') % 1e6:.0f})"


_SAID: dict[str, Callable[[_Wave], str]] = {
    "white": lambda wave: "1",
    "stripes": _stripes,
    "sawtooth": _sawtooth,
    "squares": _squares,
    "rock": _rock,
}


def explained(brush: Brush, needs: Iterable[DefineTexture]) -> Explained | None:
    """Returns what a brush's ink is as a text; `needs`: what defines its textures.  None where nothing of it can be
    told."""
    written = {one.name: one.arguments for one in needs if one.maker == "expression"}
    if len(brush.ink) == 1 and brush.ink[0].texture in written:
        told = {**written[brush.ink[0].texture], **brush.ink[0].parameters}
        period = told.get("period", _PERIOD_OF_TEXT)
        stages = told.get("stages", USUAL_STAGES)
        return Explained(str(told["text"]), TextTold(Map(told.get("values", {})), float(period), stages))
    if not any(part.texture in _SAID for part in brush.ink):
        return None
    period = next(_own_period(part) for part in brush.ink if part.texture in _SAID)
    lines = ["// What this brush paints with", f"paint = pick({brush.colour})"]
    for number, part in enumerate(brush.ink, 1):
        lines += _lines(number, part, period)
    steps = [
        f"mix(LAST, tint_{n}, {_name(part, n)} * amount_{n})" for n, part in enumerate(brush.ink, 1) if _said(part)
    ]
    last = "paint"
    for step in steps:
        last = step.replace("LAST", last)
    return Explained("\n".join((*lines, last, "")), TextTold(period=period))


def _lines(number: int, part: Component, period: float) -> list[str]:
    """Returns the lines of one texture of the ink."""
    if not _said(part):
        return [f"// {part.texture}: the language has no word for it, it is left out".replace("\n", " ")]
    wave = _Wave(period / _own_period(part), part.parameters)
    like = ["// the language's own noise: much like rock, not the same"] if part.texture == "rock" else []
    return [
        *like,
        f"{_name(part, number)} = {_SAID[part.texture](wave)}",
        f"tint_{number} = pick({part.colour})",
        f"amount_{number} = slider({part.amount:g}, 0, 1)",
    ]


def _said(part: Component) -> bool:
    return part.texture in _SAID


def _name(part: Component, number: int) -> str:
    return f"{part.texture}_{number}"


def _own_period(part: Component) -> float:
    return float(part.parameters.get("period", _USUAL))


def _times(factor: float, name: str) -> str:
    return name if factor == 1.0 else f"{name}*{factor:.6g}"
