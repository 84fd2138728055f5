"""What a brush paints with, told as a text of the language: of which it is made, where the language has that."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from immutables import Map

from app.desk.workshop.inlined import Given, by_pressure, inlined, is_coloured, number_of, text_of, text_period
from app.desk.workshop.workshop_state import TextTold
from engine.brush.parts import Component
from engine.brush.settings import Brush
from engine.numeric.curves import CURVES, Shape, smooth_curve
from engine.painting.commands import DefineTexture
from engine.texture.expression.written import PRESSURE, STAGES_MOST, USUAL_STAGES, WrittenError

_USUAL = 32.0  # pixels: the period of a texture that tells none
_PERIOD_OF_TEXT = 64.0
_SAMPLE = 256.0  # pixels: of one that is made of a sample
_GREY_MAKERS = ("spectrum", "sparse")
_LOOKED, _KNOTS_MOST, _NEAR = (
    64,
    16,
    0.01,
)  # places along a curve, ends of straight lines in its place, how near these are
_WRITTEN, _UNKNOWN = "expression", ""  # what makes a texture that only the painting has
_OWN = ("tint", "amount")  # what lines of a text are called anyway


class Explained(NamedTuple):
    """A text, and what is told beside it."""

    text: str
    told: TextTold


class _Told(NamedTuple):
    """A component, what is told of its texture, in how many pixels it repeats, what makes it; the text of a
    written one, and whether it is `written` line by line."""

    part: Component
    given: Given
    period: float
    kind: str
    text: str = ""
    written: bool = False

    @property
    def weight(self) -> str:
        """Gives which texture of a series it is, as the third of a texture's values."""
        told = self.given.get("weight", 0.0)
        if told == 0.0 or self.given.get("stages", 1) == 1 or self.kind == _WRITTEN:
            return ""
        if isinstance(told, list | tuple):
            return f", {by_pressure(told)}"
        return f", {PRESSURE if isinstance(told, str) else format(told, '.9g')}"

    @property
    def stages(self) -> int:
        """Gives for how many pressures there are textures."""
        if "clamp" in self.weight:
            return STAGES_MOST
        return int(number_of(self.given if self.kind == _WRITTEN or self.weight else {}, "stages", USUAL_STAGES))


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
    """Returns what a brush's ink is as a text; `needs`: what defines its textures.  Written ones stand in it line by
    line, as far as that is not too much, all others by their names.  None where a brush has no ink of textures."""
    defined = {one.name: one for one in needs}
    parts = [_told(part, defined.get(part.texture)) for part in brush.ink]
    if not parts:
        return None
    if len(parts) == 1 and parts[0].written:
        given = parts[0].given
        values, period = given.get("values"), number_of(given, "period", _PERIOD_OF_TEXT)
        told = Map(values) if isinstance(values, Mapping) else Map()
        return Explained(parts[0].text, TextTold(told, period, parts[0].stages))
    found = _mixed(brush, parts)
    if any(part.written for part in parts) and not _is_text(found):
        found = _mixed(brush, [part._replace(written=False) for part in parts])
    return Explained(found, TextTold(period=parts[0].period, stages=max(part.stages for part in parts)))


def _told(part: Component, defined: DefineTexture | None) -> _Told:
    """Returns a component with what defines its texture."""
    given = {**(defined.arguments if defined is not None else {}), **part.parameters}
    if "values" in part.parameters and defined is not None:
        given["values"] = {**defined.arguments.get("values", {}), **part.parameters["values"]}
    if defined is not None and defined.maker == _WRITTEN:
        about = text_period(given, "period" in part.parameters), defined.maker, text_of(defined)
        return _Told(part, given, *about, written=not given.get("seed"))
    return _Told(part, given, number_of(given, "period", _usual_period(given, defined)), _kind(part, defined))


def _kind(part: Component, defined: DefineTexture | None) -> str:
    if defined is not None:
        return defined.maker
    return part.texture if part.texture in _SAID else _UNKNOWN


def _usual_period(given: Given, defined: DefineTexture | None) -> float:
    """Returns how many pixels a texture has before it repeats, where that is not told: its sample's, as far as what
    makes it tells them."""
    size, rect = given.get("size"), given.get("rect")
    if isinstance(size, tuple | list):
        return float(size[0])
    if isinstance(rect, tuple | list):
        return float(rect[3])
    return _USUAL if defined is None else _SAMPLE


def _mixed(brush: Brush, parts: Sequence[_Told]) -> str:
    """Returns a mix as a text."""
    lines, sums, names = ["// What this brush paints with", f"paint = pick({brush.colour})"], ["paint"], {"paint"}
    for n, part in enumerate(parts, 1):
        names |= {_name(part.part, n), f"tint_{n}", f"amount_{n}"}
    for n, part in enumerate(parts, 1):
        own, coloured = _lines(n, part, parts[0].period, (brush.shaping, names))
        lines += own
        name = _name(part.part, n)
        shown = f"(tint_{n}*{name} - paint*alpha({name}))*amount_{n}"
        sums.append(shown if coloured else f"(tint_{n} - paint)*amount_{n}*{name}")
    return "\n".join((*lines, " + ".join(sums), ""))


def _lines(number: int, told: _Told, period: float, around: tuple[Shape | None, set[str]]) -> tuple[list[str], bool]:
    """Returns the lines of one texture of the ink, and whether it is a colour; `around`: the brush's own shaping, and
    the names that lines have."""
    part, often, name = told.part, period / told.period, _name(told.part, number)
    knots = [found for found in map(_knots, (part.shaping, around[0])) if found]
    before: list[str] = []
    if told.written:
        own = name if often == 1.0 and not knots else _free("own", number, around[1])
        made, coloured = inlined(told.text, told.given, often, (own, lambda line: _free(line, number, around[1])))
        before, seen = [f"// {part.texture}".replace("\n", " "), made], own
        if often != 1.0:
            seen = f"scale({own}, {1.0 / often:.9g})"
    elif told.kind in _SAID:
        seen, coloured = _SAID[told.kind](_Wave(often, part.parameters)), False
        before = ["// the language's own noise: much like rock, not the same"] if told.kind == "rock" else []
    else:
        seen = f'"{part.texture}"({_times(often, "x")}, {_times(often, "y")}{told.weight})'
        coloured = is_coloured(told.text) if told.text else told.kind not in _GREY_MAKERS
    for ends in knots:
        seen = _bent(seen, ", ".join(f"{value:.2g}" for knot in ends for value in knot), coloured)
    shown = [] if seen == name else [f"{name} = {seen}"]
    tint, amount = f"pick({part.colour})", f"slider({part.amount:g}, 0, {max(part.amount, 1.0):g})"
    return [*before, *shown, f"tint_{number} = {tint}", f"amount_{number} = {amount}"], coloured


def _bent(seen: str, ends: str, coloured: bool) -> str:
    if not coloured:
        return f"curve({seen}, {ends})"
    bent = ", ".join(f"curve({channel}({seen}), {ends})" for channel in ("red", "green", "blue"))
    return f"fade(rgb({bent}), alpha({seen}))"


def _free(line: str, number: int, names: set[str]) -> str:
    """Returns a name for a line of a text within another, and notes it."""
    name = f"{line}_{number}"
    while name in names:
        name += "_"
    names.add(name)
    return name


def _is_text(text: str) -> bool:
    from engine.texture.expression.language import read  # with all that it takes to draw, which is there by now

    try:
        return bool(read(text).lines)
    except WrittenError:
        return False


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


def _times(factor: float, name: str) -> str:
    return name if factor == 1.0 else f"{name}*{factor:.9g}"
