"""From a text to operations on numbers: what each part of it comes to at a pixel of a level.

A part is asked for in one of two ways. Its *mean* over the pixel is what is shown: sums and multiples are exact, of
jumps and bends what the pixel holds of each side. Its value at a *point* is what something else is made of, as a place
or the height that a threshold cuts.  What neither way is exact of is *rough*: how many samples a pixel takes follows
from how far they are from fewer, which is measured at some pixels.  Jumps of what is made of points have an *error*,
worked out for each pixel beside it, as much as it counts there: those pixels alone take more.

A line is a function of the place: where it is turned, warped or repeated, it is asked for once more, elsewhere.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import NoReturn, Protocol

from engine.numeric.formula import CONSTANTS
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import NO_ERROR, Graph, TooLarge
from engine.texture.expression.naming.elsewhere import Elsewhere
from engine.texture.expression.sampling.errors import Errors
from engine.texture.expression.slopes import Slopes
from engine.texture.expression.spreads import Spreads, part_of_one
from engine.texture.expression.written import (
    FELT,
    FULL_TURN,
    OWN_WAY,
    PICK,
    SLIDER,
    STROKE_NAMES,
    Term,
    WrittenError,
    WrittenText,
)

NESTED_MOST = 160  # parts within one another, lines that others refer to counted in
ASKED_MOST = 4000  # parts that are asked for, wherever: each line anew where it is moved
_NARROW = 1e-9
_GAUSS = 0.28867513459481287  # of an interval: two points by which cubic functions have their mean
_NOISY = 10.3  # a box so wide, squared, is folded as noise of variance 1 is
_BELL = 0.84  # of the widths of a box: a smooth step so steep is nearly that of noise of its deviation


@dataclass(frozen=True, slots=True)
class Value:
    """`nodes`: one of a number, four of a colour (red, green, blue times alpha, and alpha); `error`: the node of how
    far, about, it is from what it should be."""

    nodes: tuple[int, ...]
    error: int = NO_ERROR

    @property
    def coloured(self) -> bool:
        """Tells whether it is a colour."""
        return len(self.nodes) == 4


@dataclass(frozen=True, slots=True)
class Env:
    """Where a part is asked for: `x`, `y` and, within something repeated, the nodes of the repeat's number; `mean`:
    whether over the pixel or at a point."""

    x: int
    y: int
    cell: tuple[int, int]
    mean: bool = True
    static: bool = False  # whether what is asked for must be the same at all levels

    @property
    def point(self) -> Env:
        """Gives the same place, but not its mean."""
        return Env(self.x, self.y, self.cell, False, self.static) if self.mean else self


@dataclass(frozen=True, slots=True)
class Setting:
    """`values`: of sliders, by name; `level`, `seed` as the text sees them; `width`: of a sample, in periods; `named`:
    textures of other makers, and of other texts, by the names that the text has for them; `side`: samples along a
    pixel."""

    values: Mapping[str, float | str]
    level: int
    seed: int
    width: float
    named: Mapping[str, Elsewhere | NamedText] = field(default_factory=dict)
    side: int = 1


class NamedText(Protocol):
    """Another written texture, as `written_ink.Expression`."""

    @property
    def text(self) -> str:
        """Gives its text."""

    @property
    def seed(self) -> int:
        """Gives its seed."""

    @property
    def values(self) -> tuple[tuple[str, float | str], ...]:
        """Gives the values of its sliders."""

    @property
    def by_name(self) -> Mapping[str, Elsewhere | NamedText]:
        """Gives the textures that it names itself."""


Rule = Callable[["Weaver", Term, Env], Value]


class PlacedWords(Protocol):
    """What else the text of a weaver may ask for, as told by where its things stand."""

    def enter(self, graph: Graph) -> None:
        """Makes the graph's places those of a thing."""
        ...

    def cell(self, graph: Graph) -> tuple[int, int]:
        """Returns the nodes of the thing's numbers."""
        ...

    def named(self, weaver: Weaver, term: Term) -> int:
        """Returns the node of something that the stroke tells."""
        ...


@dataclass(frozen=True, slots=True)
class Woven:
    """What a text, or one of its lines, is at a level: `value`, the nodes of `graph` that are shown, and that of the
    error; `rough`: whether how many samples it takes is to be measured; `cost`: nanoseconds a sample, about; `whole`,
    `takes`: what holds the things that are placed, and the pictures that they come as."""

    graph: Graph
    value: Value
    rough: bool
    cost: float
    whole: object | None = None
    takes: tuple[int, ...] = ()

    @property
    def jumps(self) -> bool:
        """Tells whether some pixels take more samples than others."""
        return self.graph.value(self.value.error) is None


@dataclass(slots=True)
class AskedSoFar:
    """Counts what texts that belong together are asked for: `parts` of them, and `things` that they place."""

    parts: int = 0
    things: int = 0


class Weaver:
    """Asks for the parts of one text; remembers what it was asked for."""

    def __init__(
        self, written: WrittenText, setting: Setting, rules: Mapping[str, Rule], scene: PlacedWords | None = None
    ) -> None:
        self.written, self.setting, self.rules, self.scene = written, setting, rules, scene
        self.graph = Graph()
        if scene is not None:
            scene.enter(self.graph)
        self.slopes, self.spreads = Slopes(self.graph), Spreads(self.graph, setting.width)
        self._lines = {line.name: n for n, line in enumerate(written.lines)}
        self._known: dict[tuple[int, Env], Value] = {}
        self.texts: dict[tuple[NamedText | str, Env], Value] = {}  # others that were asked for, and where
        self.errors = Errors(self.graph, self.width)
        self.shares = set[int]()  # nodes that tell how much of a sample something covers: 0 or 1 at each of its points
        self.deep, self.asked = 0, AskedSoFar()
        zero = self.graph.constant(0.0)
        self.here = Env(self.graph.x, self.graph.y, (zero, zero) if scene is None else scene.cell(self.graph))

    def line(self, number: int, env: Env) -> Value:
        """Returns what a line of the text comes to."""
        known = self._known.get((number, env))
        if known is None:
            line = self.written.lines[number]
            given = self.setting.values.get(line.name) if line.slider is not None else None
            known = self.value(line.term, env) if given is None else self._set(given)
            self._known[number, env] = known
        return known

    def value(self, term: Term, env: Env) -> Value:
        """Returns what a part of the text comes to.  WrittenError if it is no such thing, or too much."""
        rule = self.rules.get(term.operation) or _OWN.get(term.operation)
        assert rule is not None
        if self.deep >= NESTED_MOST:
            self.refuse(term, "one level more", f"{NESTED_MOST} levels at most, those of the lines before counted in")
        self.deep += 1
        self.asked.parts += 1
        try:
            if self.asked.parts > ASKED_MOST:
                raise TooLarge
            return rule(self, term, env)
        except TooLarge:
            self.refuse(term, "too much at once", "fewer or shorter lines: each repeats all that it is made of")
        finally:
            self.deep -= 1

    def refuse(self, term: Term, found: str, expected: str) -> NoReturn:
        """Raises a mistake of a part."""
        raise WrittenError(self.written.place(term.token.at), found, expected)

    def number(self, term: Term, env: Env) -> Value:
        """Returns a part that must be a number."""
        found = self.value(term, env)
        if found.coloured:
            self.refuse(term, "a colour", "a number")
        return found

    def colour(self, term: Term, env: Env) -> Value:
        """Returns a part as a colour: a number is a grey."""
        return self.as_colour(self.value(term, env))

    def as_colour(self, value: Value) -> Value:
        """Returns a value as a colour: a number is a grey."""
        if value.coloured:
            return value
        return Value((*value.nodes * 3, self.graph.constant(1.0)), value.error)

    def fixed(self, term: Term, env: Env, least: float, most: float, whole: bool = False) -> float:
        """Returns a part that must be a number which is the same everywhere."""
        found = self.graph.value(self.number(term, Env(env.x, env.y, env.cell, False, True)).nodes[0])
        if found is None:
            self.refuse(term, "a number that changes from place to place", "one that does not, as a number or a slider")
        if not least <= found <= most or (whole and found != math.floor(found)):
            kind = "a whole number" if whole else "a number"
            self.refuse(term, f"{found:g}", f"{kind} from {least:g} to {most:g}")
        return found

    def named(self, name: str) -> int | None:
        """Returns the line of a name."""
        return self._lines.get(name)

    def width(self, node: int) -> int:
        """Returns how far something changes from one side of a sample to the other, what is lost counted in."""
        lost = self.spreads.of(node).lost
        if lost > 0.0:
            plain, wide = self.plain_width(node), self.graph.constant(_NOISY * lost * lost)
            return self.graph.node(Code.SQRT, self.graph.add(self.graph.mul(plain, plain), wide))
        return self.plain_width(node)

    def plain_width(self, node: int) -> int:
        """Returns how far something changes from one side of a sample to the other, as its slope tells."""
        across, down = (self.graph.value(one) for one in self.slopes.of(node))
        scale = self.setting.width
        if across is not None and down is not None:
            return self.graph.constant(min(math.sqrt(across * across + down * down) * scale, 1e30))
        return self.graph.node(Code.WIDTH, *self.slopes.of(node), numbers=(scale,))

    def even(self, node: int) -> bool:
        """Tells whether something changes evenly across the plane, or not at all."""
        return all(self.graph.value(one) is not None for one in self.slopes.of(node))

    def covered(self, node: int) -> int:
        """Returns how much of a sample lies where something is above 0, as far as its slope tells."""
        graph, lost = self.graph, self.spreads.of(node).lost
        wide = graph.most(self.width(node), graph.constant(_NARROW))
        if lost == 0.0:
            part = graph.within(graph.plus(graph.div(node, wide), 0.5))
            self.shares.add(part)
            return part
        part = graph.within(graph.plus(graph.times(graph.div(node, wide), _BELL), 0.5))
        made = graph.mul(graph.mul(part, part), graph.plus(graph.times(part, -2.0), 3.0))
        self.spreads.told[made] = part_of_one(self.spreads.of(made))
        self.shares.add(made)
        return made

    def ramped(self, node: int) -> int:
        """Returns the mean of something where it is above 0, and of 0 elsewhere."""
        graph = self.graph
        wide = graph.most(self.width(node), graph.constant(_NARROW))
        half = graph.times(wide, 0.5)
        under = graph.least(graph.most(graph.add(node, half), graph.constant(0.0)), wide)
        bend = graph.div(graph.mul(under, under), graph.times(wide, 2.0))
        return graph.add(bend, graph.most(graph.sub(node, half), graph.constant(0.0)))

    def _set(self, given: float | str) -> Value:
        if isinstance(given, str):
            return Value(tuple(self.graph.constant(part) for part in premultiplied(given)))
        return Value((self.graph.constant(given),))


def aslant(weaver: Weaver, node: int, mean: Callable[[int, int], int]) -> int:
    """Returns mean(node, width), or where something rises both across and down, evenly, the mean along the lesser
    way of that along the greater one, by two points (Gauss)."""
    told = [weaver.graph.value(one) for one in weaver.slopes.of(node)]
    narrow = weaver.graph.constant(_NARROW)
    if None in told or 0.0 in told:
        return mean(node, weaver.graph.most(weaver.width(node), narrow))
    less, more = sorted(abs(one) * weaver.setting.width for one in told if one is not None)
    points = [weaver.graph.plus(node, way * less) for way in (-_GAUSS, _GAUSS)]
    halves = [mean(point, weaver.graph.most(weaver.graph.constant(more), narrow)) for point in points]
    return weaver.graph.times(weaver.graph.add(*halves), 0.5)


def woven_within(weaver: Weaver, written: WrittenText, told: NamedText | None = None) -> Weaver:
    """Returns one that asks for the parts of another text, in this one's graph: its sliders and its seed as they are
    told, else the sliders as they usually are."""
    about = replace(weaver.setting, values={}, named={})
    if told is not None:
        about = replace(about, values=dict(told.values), seed=told.seed, named=told.by_name)
    other = Weaver(written, about, weaver.rules)
    other.graph, other.slopes, other.spreads = weaver.graph, weaver.slopes, weaver.spreads
    other.here, other.deep, other.scene = weaver.here, weaver.deep, weaver.scene
    other.errors, other.texts, other.asked, other.shares = weaver.errors, weaver.texts, weaver.asked, weaver.shares
    return other


def last_line(weaver: Weaver, env: Env, number: int = -1) -> Value:
    """Returns what a line, usually the last one, is at a place; those before it first, that none is reached through
    all of them."""
    number %= len(weaver.written.lines)
    for before in range(0 if weaver.written.places else number):
        weaver.line(before, env)
        weaver.line(before, env.point)
    return weaver.line(number, env)


def premultiplied(colour: str) -> tuple[float, float, float, float]:
    """Returns encoded red, green and blue times alpha, and alpha, of "#rrggbb" or "#rrggbbaa"."""
    red, green, blue, alpha = (*(value / 255.0 for value in bytes.fromhex(colour[1:])), 1.0)[:4]
    return red * alpha, green * alpha, blue * alpha, alpha


def _number(weaver: Weaver, term: Term, env: Env) -> Value:
    return Value((weaver.graph.constant(float(term.told)),))


def _constant(weaver: Weaver, term: Term, env: Env) -> Value:
    return Value((weaver.graph.constant(CONSTANTS[term.told]),))


def _colour(weaver: Weaver, term: Term, env: Env) -> Value:
    return Value(tuple(weaver.graph.constant(part) for part in premultiplied(term.told)))


def _name(weaver: Weaver, term: Term, env: Env) -> Value:
    line = weaver.named(term.told)
    if line is not None:
        return weaver.line(line, env)
    setting = weaver.setting
    if term.told in ("x", "y"):
        return Value((env.x if term.told == "x" else env.y,))
    if env.static and term.told in ("fw", "level"):
        weaver.refuse(term, "a number that changes from level to level", "one that does not")
    if term.told in FELT:
        felt = setting.values.get(FELT[term.told], 1.0)
        assert not isinstance(felt, str)
        if term.told == OWN_WAY:
            felt = _way(weaver, term) * (math.tau / FULL_TURN)
        return Value((weaver.graph.constant(felt),))
    if term.told in STROKE_NAMES and weaver.scene is not None:
        return Value((weaver.scene.named(weaver, term),))
    told = {"fw": setting.width, "level": float(setting.level), "seed": float(setting.seed % (1 << 24))}
    return Value((weaver.graph.constant(told[term.told]),))


def _way(weaver: Weaver, term: Term) -> float:
    """Returns the direction of the stroke in degrees, of which only the text of an ink knows."""
    told = weaver.setting.values.get(FELT[OWN_WAY])
    if weaver.scene is not None:
        weaver.refuse(term, OWN_WAY, '"heading" in what is placed along a stroke')
    if not isinstance(told, float):
        weaver.refuse(term, f"{OWN_WAY} in a texture by its name", "a texture that goes by no stroke")
    return told


def _first(weaver: Weaver, term: Term, env: Env) -> Value:
    return weaver.value(term.parts[0], env)


_OWN: dict[str, Rule] = {
    "number": _number,
    "constant": _constant,
    "colour": _colour,
    "name": _name,
    SLIDER: _first,
    PICK: _first,
}
