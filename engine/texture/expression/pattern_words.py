"""Patterns that repeat: stripes, squares, bricks, tiles, dots, hexagons, with what the pixel holds of each side."""

from __future__ import annotations

import math

from engine.texture.expression.codes import Code
from engine.texture.expression.graph import NO_ERROR
from engine.texture.expression.noise_words import half_white, white
from engine.texture.expression.sampling.errors import FEW_FROM
from engine.texture.expression.weaving import Env, Rule, Value, Weaver, aslant
from engine.texture.expression.written import Term

_GAP, _SHIFT, _RADIUS = 0.1, 0.5, 0.3
_HEX = math.sqrt(3.0)
_SEES = 0.75  # of its width: how far an edge may be that a sample sees
_FINE, _COARSE = 0.03, 1.6  # units a pixel, between which patterns that go by their slopes take more samples


def _numbers(weaver: Weaver, term: Term, env: Env, usual: tuple[float, ...]) -> tuple[list[int], int]:
    """Returns nodes of a function's values; those that are left out take what is usual, of the last ones."""
    values = [weaver.number(part, env.point) for part in term.parts]
    nodes = [value.nodes[0] for value in values]
    error = weaver.errors.bounded(weaver.errors.worst(*(value.error for value in values)))
    missing = PATTERN_WORDS[term.operation][1] - len(nodes)
    return nodes + [weaver.graph.constant(one) for one in usual[len(usual) - missing :]], error


def pulse(weaver: Weaver, t: int, part: int) -> int:
    """Returns the mean of what is 1 while fract(t) is below `part`, else 0."""
    graph = weaver.graph

    def mean(middle: int, wide: int) -> int:
        ends = [graph.add(middle, graph.times(wide, way)) for way in (-0.5, 0.5)]
        wholes = [graph.node(Code.FLOOR, end) for end in ends]
        rests = [graph.least(graph.sub(end, whole), part) for end, whole in zip(ends, wholes, strict=True)]
        summed = graph.add(graph.mul(graph.sub(wholes[1], wholes[0]), part), graph.sub(rests[1], rests[0]))
        return graph.div(summed, wide)

    return aslant(weaver, t, mean)


def _bounded(weaver: Weaver, node: int) -> int:
    return weaver.graph.within(node)


def _rest(weaver: Weaver, node: int) -> tuple[int, int]:
    """Returns the whole number below, and what is behind the point, as they are at a point."""
    whole = weaver.graph.node(Code.FLOOR, node)
    return whole, weaver.graph.sub(node, whole)


def _stripes(weaver: Weaver, term: Term, env: Env) -> Value:
    (t, part), error = _numbers(weaver, term, env, (0.5,))
    return Value((pulse(weaver, t, _bounded(weaver, part)),), error)


def _squares(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y), error = _numbers(weaver, term, env, ())
    graph, half = weaver.graph, weaver.graph.constant(0.5)
    waves = [graph.plus(graph.times(pulse(weaver, graph.times(t, 0.5), half), 2.0), -1.0) for t in (x, y)]
    aslant = any(0.0 not in [graph.value(one) for one in weaver.slopes.of(t)] for t in (x, y))
    error = weaver.errors.worst(error, _uneven(weaver, (x, y)) if aslant else NO_ERROR)
    return Value((graph.plus(graph.times(graph.mul(*waves), 0.5), 0.5),), error)


def _bar(weaver: Weaver, t: int, gap: int) -> int:
    """Returns 1 but for a gap about each whole number."""
    graph = weaver.graph
    there = graph.plus(graph.times(gap, -1.0), 1.0)
    return pulse(weaver, graph.sub(t, graph.times(gap, 0.5)), there)


def _tiles(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y, gap), error = _numbers(weaver, term, env, (_GAP,))
    gap = _bounded(weaver, gap)
    return Value((weaver.graph.mul(_bar(weaver, x, gap), _bar(weaver, y, gap)),), error)


def _bricks(weaver: Weaver, term: Term, env: Env) -> Value:
    """Every other course is shifted: what the pixel holds of these and of those, each times its upright joints."""
    (x, y, gap, shift), error = _numbers(weaver, term, env, (_GAP, _SHIFT))
    graph, gap = weaver.graph, _bounded(weaver, gap)
    half = graph.times(graph.plus(graph.times(gap, -1.0), 1.0), 0.5)
    total = graph.constant(0.0)
    for course in (0.0, 0.5):
        rows = pulse(weaver, graph.plus(graph.times(graph.sub(y, graph.times(gap, 0.5)), 0.5), -course), half)
        along = _bar(weaver, graph.add(x, shift) if course else x, gap)
        total = graph.add(total, graph.mul(rows, along))
    return Value((total,), error)


def _bricks_random(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y, shift), error = _numbers(weaver, term, env, (_SHIFT,))
    graph, half = weaver.graph, weaver.graph.times(y, 0.5)
    even = half_white(weaver, [x, half], (1, 1), 0.25, env)
    odd = half_white(weaver, [graph.add(x, shift), graph.plus(half, -0.5)], (2, 1), 0.25, env)
    made = graph.add(even, odd)
    if not env.mean:
        courses = weaver.errors.jump(y), weaver.errors.jump(x), weaver.errors.jump(graph.add(x, shift))
        error = weaver.errors.worst(error, *courses)
    return Value((made,), error)


def _dots(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y, radius), error = _numbers(weaver, term, env, (_RADIUS,))
    graph = weaver.graph
    near = [graph.plus(_rest(weaver, t)[1], -0.5) for t in (x, y)]
    far = graph.node(Code.SQRT, graph.add(graph.mul(near[0], near[0]), graph.mul(near[1], near[1])))
    inside = graph.sub(radius, far)
    dot = weaver.covered(inside)
    area = graph.within(graph.times(graph.mul(radius, radius), math.pi))
    return Value((_unless_fine(weaver, dot, area, (x, y)),), weaver.errors.worst(error, _uneven(weaver, (x, y))))


def _unless_fine(weaver: Weaver, node: int, mean: int, place: tuple[int, int]) -> int:
    """Returns something, or its mean where a sample spans a whole repeat of it."""
    graph = weaver.graph
    wide = graph.most(*(weaver.width(t) for t in place))
    return graph.blend(node, mean, graph.within(graph.plus(graph.times(wide, 2.5), -1.5)))


def _uneven(weaver: Weaver, place: tuple[int, int]) -> int:
    """Notes the error of a pattern that goes by its slopes: more where the pixel is no small part of it."""
    told = [weaver.graph.value(weaver.width(t)) for t in place]
    wide = max(one for one in told if one is not None) if None not in told else 0.1
    if wide > _COARSE:
        return NO_ERROR
    return weaver.errors.flat(2.0 * FEW_FROM if wide > _FINE else 0.0)


def _hexagon(weaver: Weaver, x: int, y: int) -> tuple[int, int, int]:
    """Returns how far it is to the edge of the hexagon, a unit across, and the middle of that."""
    graph = weaver.graph
    found = []
    for half in (0.0, 0.5):
        across = graph.plus(graph.node(Code.FLOOR, graph.plus(x, 0.5 - half)), half)
        row = graph.plus(graph.node(Code.FLOOR, graph.plus(graph.times(y, 1.0 / _HEX), 0.5 - half)), half)
        right, below = graph.sub(x, across), graph.sub(y, graph.times(row, _HEX))
        far = graph.add(graph.mul(right, right), graph.mul(below, below))
        found.append((far, right, below, across, row))
    nearer = graph.node(Code.LESS, found[0][0], found[1][0])
    right, below, across, row = (graph.pick(nearer, *pair) for pair in list(zip(*found, strict=True))[1:])
    right, below = (graph.node(Code.ABS, one) for one in (right, below))
    slanted = graph.add(graph.times(right, 0.5), graph.times(below, _HEX / 2.0))
    edge = graph.sub(graph.constant(0.5), graph.most(right, slanted))
    return edge, across, row


def _hexagons(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y, gap), error = _numbers(weaver, term, env, (_GAP,))
    graph, gap = weaver.graph, _bounded(weaver, gap)
    edge, _, _ = _hexagon(weaver, x, y)
    inside = graph.sub(edge, graph.times(gap, 0.5))
    there = weaver.covered(inside)
    rest = graph.plus(graph.times(gap, -1.0), 1.0)
    shown = _unless_fine(weaver, there, graph.mul(rest, rest), (x, y))
    return Value((shown,), weaver.errors.worst(error, _uneven(weaver, (x, y))))


def _hexagons_random(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y), error = _numbers(weaver, term, env, ())
    edge, across, row = _hexagon(weaver, x, y)
    graph = weaver.graph
    place = [graph.plus(graph.times(one, 2.0), 0.5) for one in (across, row)]
    made = white(weaver, place, 3, env)
    _uneven(weaver, (x, y))
    reach = graph.times(graph.most(weaver.width(x), weaver.width(y)), _SEES)
    near = graph.pick(graph.node(Code.LESS, edge, reach), graph.constant(1.0), NO_ERROR)
    shown = _unless_fine(weaver, made, graph.constant(0.5), (x, y))
    return Value((shown,), weaver.errors.worst(error, near))


PATTERN_WORDS: dict[str, tuple[int, int, Rule, str]] = {
    "stripes": (1, 2, _stripes, "stripes(a, part): 1 for the first part of each unit of a, else 0"),
    "squares": (2, 2, _squares, "squares(x, y): a checkerboard of unit squares, 1 and 0"),
    "tiles": (2, 3, _tiles, "tiles(x, y, gap): 1 in unit squares, 0 in the gaps between them"),
    "bricks": (2, 4, _bricks, "bricks(x, y, gap, shift): 1 in unit bricks, each course shifted, 0 in the joints"),
    "bricks_random": (2, 3, _bricks_random, "bricks_random(x, y, shift): a random number for each brick"),
    "dots": (2, 3, _dots, "dots(x, y, radius): 1 in a disc in each unit square, else 0"),
    "hexagons": (2, 3, _hexagons, "hexagons(x, y, gap): 1 in hexagons a unit across, 0 in the gaps"),
    "hexagons_random": (2, 2, _hexagons_random, "hexagons_random(x, y): a random number for each hexagon"),
}
