"""What a brush paints with, told as a text of the language: of which it is made, where the language has that."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from immutables import Map

from app.desk.workshop.workshop_state import TextTold
from engine.brush.parts import Component
from engine.brush.settings import Brush
from engine.numeric.curves import CURVES, Shape, smooth_curve
from engine.painting.commands import DefineTexture
from engine.texture.expression.written import USUAL_STAGES

_USUAL = 32.0  # pixels: the period of a texture that tells none
_PERIOD_OF_TEXT = 64.0
_SAMPLE = 256.0  # pixels: of one that is made of a sample
_GREY_MAKERS = ("spectrum", "sparse")
_LOOKED, _KNOTS_MOST, _NEAR = (
    64,
    16,
    0.01,
)  # places along a curve, ends of straight lines in its place, how near these are
_OWN = ("tint", "amount")  # what lines of a text are called anyway
_NOTHING = DefineTexture("", "")


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
    """Returns what a brush's ink is as a text; `needs`: what defines its textures, which the text has by their names.
    None where nothing of it can be told."""
    told = {one.name: one for one in needs}
    if len(brush.ink) == 1 and told.get(brush.ink[0].texture, _NOTHING).maker == "expression":
        given = {**told[brush.ink[0].texture].arguments, **brush.ink[0].parameters}
        about = (
            Map(given.get("values", {})),
            float(given.get("period", _PERIOD_OF_TEXT)),
            given.get("stages", USUAL_STAGES),
        )
        return Explained(str(given["text"]), TextTold(*about))
    greys = {name for name, one in told.items() if one.maker in _GREY_MAKERS}
    said = [part.texture in greys or (part.texture in _SAID and part.texture not in told) for part in brush.ink]
    if not any(said):
        return None
    period = next(_own_period(part, greys) for part, can in zip(brush.ink, said, strict=True) if can)
    lines, sums = ["// What this brush paints with", f"paint = pick({brush.colour})"], ["paint"]
    for n, (part, can) in enumerate(zip(brush.ink, said, strict=True), 1):
        if not can:
            lines.append(f"// {part.texture}: the language has no word for it, it is left out".replace("\n", " "))
            continue
        lines += _lines(n, part, period / _own_period(part, greys), greys, brush.shaping)
        sums.append(f"(tint_{n} - paint)*amount_{n}*{_name(part, n)}")
    return Explained("\n".join((*lines, " + ".join(sums), "")), TextTold(period=period))


def _lines(number: int, part: Component, often: float, greys: Collection[str], last: Shape | None) -> list[str]:
    """Returns the lines of one texture of the ink; `last`: the brush's own shaping."""
    wave, like = _Wave(often, part.parameters), []
    if part.texture in greys:
        seen = f'"{part.texture}"({_times(often, "x")}, {_times(often, "y")})'
    else:
        seen = _SAID[part.texture](wave)
        like = ["// the language's own noise: much like rock, not the same"] if part.texture == "rock" else []
    for shape in (part.shaping, last):
        knots = _knots(shape)
        if knots:
            seen = f"curve({seen}, {', '.join(f'{value:.2g}' for knot in knots for value in knot)})"
    return [
        *like,
        f"{_name(part, number)} = {seen}",
        f"tint_{number} = pick({part.colour})",
        f"amount_{number} = slider({part.amount:g}, 0, {max(part.amount, 1.0):g})",
    ]


@lru_cache(64)
def _knots(shape: Shape | None) -> tuple[tuple[float, float], ...]:
    """Returns straight lines about as a curve runs, as their ends; () for none, and for one that changes nothing."""
    if shape is None:
        return ()
    t = np.linspace(0.0, 1.0, _LOOKED + 1)
    values = np.clip(CURVES[shape].of(t) if isinstance(shape, str) else smooth_curve(shape, t), 0.0, 1.0)
    ends = [0, _LOOKED]
    while len(ends) < _KNOTS_MOST:
        apart = np.abs(np.interp(t, t[ends], values[ends]) - values)
        if apart.max() < _NEAR:
            break
        ends = sorted((*ends, int(apart.argmax())))
    if len(ends) == 2 and (values[0], values[-1]) == (0.0, 1.0):
        return ()
    return tuple((float(t[end]), float(values[end])) for end in ends)


def _name(part: Component, number: int) -> str:
    word = re.sub(r"\W+", "_", part.texture.lower(), flags=re.ASCII).strip("_0123456789") or "texture"
    return f"{word}_{number}" if word not in _OWN else f"{word}_of_{number}"


def _own_period(part: Component, greys: Collection[str]) -> float:
    return float(part.parameters.get("period", _SAMPLE if part.texture in greys else _USUAL))


def _times(factor: float, name: str) -> str:
    return name if factor == 1.0 else f"{name}*{factor:.9g}"
