"""Things that a written texture places: what each looks like, where each stands, as programs for any width of a pixel.

A thing is a part of the text in places of its own, x and y from -1 to 1 about where it stands.  It is woven by itself;
what it takes from outside comes as pictures: its place, its numbers, what holds it (`outer`), the stroke, and things
within it that are drawn before.  One sample a pixel does: its edges are by how steep they are, and things are many.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from engine.texture.expression.codes import Code
from engine.texture.expression.graph import Graph, cost_of
from engine.texture.expression.programs import Program, program
from engine.texture.expression.weaving import AskedSoFar, Env, Rule, Setting, Value, Weaver, Woven
from engine.texture.expression.written import STROKE_NAMES, Term, WrittenText

DEEP_MOST, THINGS_MOST = 4, 64  # things within things, and in all, each counted wherever it is placed
_POINT = 2.0**-30  # the width at which places and sizes are told
LESSENED = 16384.0
_HALF_OCTAVE = 1.189207115002721
X, Y, OWN_A, OWN_B = range(4)  # pictures that every thing may take; then what the stroke tells, what `outer` tells
STROKE_TOLD = {name: 4 + n for n, name in enumerate(STROKE_NAMES)}
_WAYS = {"along": (1.0, 0.0), "across": (0.0, 1.0)}  # how they rise, as if the line were straight
OUTER = 16  # the first of these
CHILD = 1 << 16  # of the nth thing within, four each


class Spec(NamedTuple):
    """How things are placed: `along` a stroke, or all over; `per`: how many a unit, or how far apart; the parts of the
    text that tell how large, where, how far aside, how far turned; `vary`: how unevenly."""

    along: bool
    per: float
    size: Term
    where: Term | None
    turn: Term | None
    vary: float


@dataclass(eq=False)
class Thing:
    """`outer`: what it asks of what holds it, the first of its numbers and how many; `children`: things within it, by
    where in the text they are placed; `texts`: what it is woven of; `number`: by which its hashes differ; `measured`:
    its box, and the size that it usually has."""

    texts: Texts
    term: Term | None
    spec: Spec | None
    deep: int = 0
    number: int = 0
    outer: dict[Term, tuple[int, int]] = field(default_factory=dict)
    children: dict[int, Thing] = field(default_factory=dict)
    _programs: dict[tuple[str, int], Placing] = field(default_factory=dict)
    holder: Thing | None = None
    measured: tuple[float, ...] = ()
    asking: AskedSoFar | None = None  # with all that is placed with it, as long as it is built

    @property
    def asks(self) -> int:
        """Counts the numbers that it asks."""
        return sum(count for _, count in self.outer.values())

    def look(self, octave: int) -> Placing:
        """Returns what it looks like where a pixel is 2^(octave / 2) wide, about, in its own places."""
        return self._made("look", octave)

    @property
    def places(self) -> Placing:
        """Returns where, size and turn of each, by where it would stand and its own numbers."""
        return self._made("places", 0)

    @property
    def asked(self) -> Placing:
        """Returns what it asks of what holds it, by where it stands there."""
        return self._made("asked", 0)

    def _made(self, kind: str, octave: int) -> Placing:
        found = self._programs.get((kind, octave))
        if found is None:
            found = self._programs[kind, octave] = _WEAVING[kind](self, octave)
        return found


@dataclass(frozen=True, eq=False)
class Texts:
    """What a thing is woven of; `rules`: of the language."""

    written: WrittenText
    values: Mapping[str, float | str]
    seed: int
    rules: Mapping[str, Rule]


class Placing(NamedTuple):
    """A program, and the pictures that it takes, in order."""

    program: Program
    takes: tuple[int, ...]


class ThingScene:
    """What a weaver may ask for besides: `thing` is whose places these are, None for the whole texture's own;
    `by`: who is asked what `outer` tells."""

    def __init__(self, owner: Thing, placed: bool, by: Thing | None, stroke: bool) -> None:
        self.owner, self.placed, self.by, self.stroke = owner, placed, by, stroke
        self.takes: list[int] = []
        self._nodes: dict[int, int] = {}
        self.frame: tuple[int, int] = (0, 0)

    def node(self, graph: Graph, kind: int) -> int:
        """Returns the node of a picture."""
        if kind not in self._nodes:
            self._nodes[kind] = graph.node(Code.PICTURE, kind=len(self.takes))
            self.takes.append(kind)
        return self._nodes[kind]

    def enter(self, graph: Graph) -> None:
        """As `PlacedWords.enter`."""
        if self.placed:
            graph.x, graph.y = self.node(graph, X), self.node(graph, Y)
            graph.ways = {graph.x: (1.0, 0.0), graph.y: (0.0, 1.0)}
        self.frame = graph.x, graph.y

    def cell(self, graph: Graph) -> tuple[int, int]:
        """As `PlacedWords.cell`."""
        if not self.placed:
            zero = graph.constant(0.0)
            return zero, zero
        return self.node(graph, OWN_A), self.node(graph, OWN_B)

    def named(self, weaver: Weaver, term: Term) -> int:
        """As `PlacedWords.named`."""
        if not self.stroke:
            weaver.refuse(term, f"{term.told} within a thing", f"outer({term.told}): what it is where the thing stands")
        node = self.node(weaver.graph, STROKE_TOLD[term.told])
        if term.told in _WAYS:
            weaver.graph.ways[node] = _WAYS[term.told]
            weaver.spreads.told[node] = weaver.spreads.told[weaver.graph.x]
        return node

    def told_by(self, weaver: Weaver, term: Term) -> tuple[int, ...] | None:
        """Returns the nodes of what `outer` tells; None where nothing holds it."""
        if self.by is None:
            return None
        asked = self.by.outer
        if term not in asked:
            first = sum(count for _, count in asked.values())
            asked[term] = first, 0
            asked[term] = first, 4 if _asking(self.by, term).coloured else 1
        first, count = asked[term]
        return tuple(self.node(weaver.graph, OUTER + n) for n in range(first, first + count))

    def child(self, weaver: Weaver, term: Term, spec: Spec) -> tuple[int, ...]:
        """Returns the nodes of the colours of things within."""
        if weaver.setting.width <= _POINT:
            weaver.refuse(term, f"{term.operation} where a number is wanted", "numbers: things are only looked at")
        place = zlib.crc32(weaver.written.text.encode()) ^ term.token.at
        texts = Texts(weaver.written, weaver.setting.values, weaver.setting.seed, weaver.rules)
        if place not in self.owner.children:
            weaver.asked.things += 1
            if weaver.asked.things > THINGS_MOST:
                weaver.refuse(term, "one thing more", f"{THINGS_MOST} at most, each counted wherever it is placed")
            made = Thing(texts, term.parts[0], spec, self.owner.deep + 1, place, asking=weaver.asked)
            self.owner.children[place] = made
            _build(made, self.owner)
        first = CHILD + 4 * list(self.owner.children).index(place)
        return tuple(self.node(weaver.graph, first + n) for n in range(4))


def _build(thing: Thing, holder: Thing) -> None:
    """Weaves all of a thing once, so that what it asks for is known, and what is wrong is told."""
    thing.holder = holder
    thing.look(-8)
    _ = thing.places, thing.asked
    thing.asking = None


def _weaver(thing: Thing, scene: ThingScene, width: float) -> Weaver:
    texts = thing.texts
    made = Weaver(texts.written, Setting(texts.values, 0, texts.seed, width), texts.rules, scene)
    made.asked = thing.asking or made.asked
    return made


def _placing(weaver: Weaver, value: Value) -> Placing:
    assert isinstance(weaver.scene, ThingScene)
    return Placing(
        program(Woven(weaver.graph, value, False, cost_of(weaver.graph, value.nodes)), 1), tuple(weaver.scene.takes)
    )


def _look(thing: Thing, octave: int) -> Placing:
    assert thing.term is not None
    width = _HALF_OCTAVE * 2.0 ** (octave // 2) * (1.4142135623730951 if octave % 2 else 1.0)
    weaver = _weaver(thing, ThingScene(thing, True, thing, False), width)
    return _placing(weaver, weaver.as_colour(weaver.value(thing.term, weaver.here)))


def _places(thing: Thing, octave: int) -> Placing:
    spec, stroke = thing.spec, thing.deep == 1
    assert spec is not None
    weaver = _weaver(thing, ThingScene(thing, True, thing, stroke), _POINT)
    one, nothing = weaver.graph.constant(1.0), weaver.graph.constant(0.0)
    nodes = [
        usual if term is None else weaver.number(term, weaver.here.point).nodes[0]
        for term, usual in ((spec.where, one), (spec.size, one), (spec.turn, nothing))
    ]
    return _placing(weaver, _lessened(weaver, nodes))


def _asked(thing: Thing, octave: int) -> Placing:
    weaver = _holding(thing)
    nodes: list[int] = []
    for term in thing.outer:
        nodes += weaver.value(term, weaver.here.point).nodes
    return _placing(weaver, _lessened(weaver, nodes))


def _asking(thing: Thing, term: Term) -> Value:
    """Returns what something that a thing asks is, where it stands."""
    weaver = _holding(thing)
    return weaver.value(term, weaver.here.point)


def _holding(thing: Thing) -> Weaver:
    """Returns what tells of the places of what holds a thing."""
    holder = thing.holder
    assert holder is not None
    return _weaver(thing, ThingScene(holder, True, holder if holder.deep else None, holder.deep == 0), _POINT)


def _lessened(weaver: Weaver, nodes: list[int]) -> Value:
    """Returns numbers so small that the machine shows them."""
    return Value(tuple(weaver.graph.times(node, 1.0 / LESSENED) for node in nodes))


_WEAVING = {"look": _look, "places": _places, "asked": _asked}


def cost_of_things(whole: Thing) -> float:
    """Returns about how many nanoseconds a pixel all things within one take, where two lie over each pixel."""
    total, open_ = 0.0, list(whole.children.values())
    while open_:
        thing = open_.pop()
        made = thing.look(-8).program
        total += 2.0 * made.cost
        open_.extend(thing.children.values())
    return total


def env_is_plain(weaver: Weaver, env: Env) -> bool:
    """Tells whether a part is asked for where the thing is, neither turned nor warped."""
    assert isinstance(weaver.scene, ThingScene)
    return (env.x, env.y) == weaver.scene.frame
