"""Signs and functions of numbers, and what is exact of their means."""

from __future__ import annotations

import math
from collections.abc import Callable

from engine.numeric import elementary
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import NO_ERROR
from engine.texture.expression.spreads import Spread
from engine.texture.expression.weaving import Env, Rule, Value, Weaver, aslant
from engine.texture.expression.written import Term

_SEES = 0.6  # of its width: how far beyond a step a sample sees it
_WHOLE = math.sqrt(12.0)  # standard deviations within what rises evenly
_Pair = tuple[int, int]  # a node, and the error of its mean
Work = Callable[[Weaver, int, int], _Pair]


Weigh = Callable[[Weaver, Value, Value], int]


def _both(weaver: Weaver, a: Value, b: Value) -> int:
    return weaver.errors.worst(a.error, b.error)


def zipped(weaver: Weaver, term: Term, env: Env, work: Work, weigh: Weigh = _both) -> Value:
    """Returns what a function of two numbers makes of two values, channel by channel; alpha is the larger one; `weigh`:
    the error that follows from theirs."""
    a, b = (weaver.value(part, env) for part in term.parts[:2])
    error = weigh(weaver, a, b)
    if not (a.coloured or b.coloured):
        node, more = work(weaver, a.nodes[0], b.nodes[0])
        return Value((node,), weaver.errors.worst(error, more) if env.mean else error)
    left, right = (one.nodes[:3] if one.coloured else one.nodes * 3 for one in (a, b))
    made = [work(weaver, *pair) for pair in zip(left, right, strict=True)]
    alphas = [one.nodes[3] for one in (a, b) if one.coloured]
    alpha = alphas[0] if len(alphas) == 1 else weaver.graph.most(*alphas)
    if env.mean:
        error = weaver.errors.worst(error, *(more for _, more in made))
    return Value((*(node for node, _ in made), alpha), error)


def _add(weaver: Weaver, a: int, b: int) -> _Pair:
    return weaver.graph.add(a, b), NO_ERROR


def _subtract(weaver: Weaver, a: int, b: int) -> _Pair:
    return weaver.graph.sub(a, b), NO_ERROR


def _multiply(weaver: Weaver, a: int, b: int) -> _Pair:
    """The mean of a product is that of both where one is the same everywhere, or both change evenly; what covers a part
    of a sample covers as much when it is squared."""
    if a == b and a in weaver.shares and weaver.graph.value(a) is None:
        return a, NO_ERROR
    fixed = weaver.graph.value(a) is not None or weaver.graph.value(b) is not None
    error = 0.0 if fixed else weaver.spreads.of(a).within * weaver.spreads.of(b).within
    node = weaver.graph.mul(a, b)
    if a == b:
        node = weaver.graph.plus(node, weaver.spreads.of(a).lost_squared)
    return node, weaver.errors.flat(error)


def _factors(weaver: Weaver, a: Value, b: Value) -> int:
    return weaver.errors.worst(
        weaver.errors.weighed(a.error, *b.nodes[:3]), weaver.errors.weighed(b.error, *a.nodes[:3])
    )


def _divide(weaver: Weaver, a: int, b: int) -> _Pair:
    fixed = weaver.graph.value(b) is not None
    return weaver.graph.div(a, b), NO_ERROR if fixed else weaver.errors.flat(4.0 * weaver.spreads.of(b).within)


def _of_two(work: Work) -> Rule:
    return lambda weaver, term, env: zipped(weaver, term, env, work)


def _negated(weaver: Weaver, term: Term, env: Env) -> Value:
    value = weaver.value(term.parts[0], env)
    nodes = tuple(weaver.graph.times(node, -1.0) for node in value.nodes[:3])
    return Value((*nodes, *value.nodes[3:]), value.error)


def _compared(weaver: Weaver, term: Term, env: Env) -> Value:
    """How much of the pixel lies where one is below the other."""
    a, b = (weaver.number(part, env.point) for part in term.parts)
    if term.operation in (">", ">="):
        a, b = b, a
    left, right = a.nodes[0], b.nodes[0]
    graph = weaver.graph
    told = graph.sub(right, left)
    if graph.value(told) is not None:
        code = Code.LESS if len(term.operation) == 1 else Code.LESS_EQUAL
        return Value((graph.node(code, left, right),))
    return Value((weaver.covered(told),), edge_error(weaver, told, weaver.errors.worst(a.error, b.error)))


def edge_error(weaver: Weaver, node: int, given: int) -> int:
    """Returns the error of a threshold: where something is lost, and of what it is a threshold of."""
    return weaver.errors.at_edge(node, 1.3 * weaver.spreads.of(node).lost, given)


def _chosen(weaver: Weaver, term: Term, env: Env) -> Value:
    test = weaver.number(term.parts[0], env)
    told = weaver.graph.value(test.nodes[0])
    a, b = (weaver.value(part, env) for part in term.parts[1:])
    if told is not None:
        found = a if told != 0.0 else b
        return weaver.as_colour(found) if a.coloured or b.coloured else found
    return mixed_by(weaver, (b, a), Value((weaver.graph.within(test.nodes[0]),), test.error), env)


def mixed_by(weaver: Weaver, ends: tuple[Value, Value], part: Value, env: Env) -> Value:
    """Returns a mixture of two values, which become colours where one is."""
    a, b = ends
    if a.coloured != b.coloured:
        a, b = weaver.as_colour(a), weaver.as_colour(b)
    graph, way = weaver.graph, part.nodes[0]
    nodes, apart, own = [], [], 0.0
    for one, other in zip(a.nodes, b.nodes, strict=True):
        away = graph.sub(other, one)
        apart.append(away)
        if env.mean and graph.value(away) is None and graph.value(way) is None:
            own = max(own, weaver.spreads.of(away).within * weaver.spreads.of(way).within)
        nodes.append(graph.blend(one, other, way))
    rest = graph.sub(graph.constant(1.0), way)
    given = (
        weaver.errors.weighed(a.error, rest),
        weaver.errors.weighed(b.error, way),
        weaver.errors.weighed(part.error, *apart),
    )
    return Value(tuple(nodes), weaver.errors.worst(*given, weaver.errors.flat(own)))


def _mix(weaver: Weaver, term: Term, env: Env) -> Value:
    a, b = (weaver.value(part, env) for part in term.parts[:2])
    return mixed_by(weaver, (a, b), weaver.number(term.parts[2], env), env)


def _bent(weaver: Weaver, a: int, b: int, sign: float) -> int:
    """min (-1) or max (1) of two, or its mean where it bends."""
    graph = weaver.graph
    away = graph.sub(a, b)
    if graph.value(away) is not None:
        return graph.least(a, b) if sign < 0.0 else graph.most(a, b)
    return graph.sub(a, weaver.ramped(away)) if sign < 0.0 else graph.add(b, weaver.ramped(away))


def _sampled_bend(weaver: Weaver, term: Term, value: Value) -> Value:
    """Returns what is bent, with the error that follows from what is lost of it."""
    lost = max(weaver.spreads.of(node).lost for node in value.nodes)
    return Value(value.nodes, weaver.errors.worst(value.error, weaver.errors.flat(0.2 * lost)))


def _least(weaver: Weaver, term: Term, env: Env) -> Value:
    if not env.mean:
        return zipped(weaver, term, env, lambda w, a, b: (w.graph.least(a, b), NO_ERROR))
    found = zipped(weaver, term, env.point, lambda w, a, b: (_bent(w, a, b, -1.0), NO_ERROR))
    return _sampled_bend(weaver, term, found)


def _most(weaver: Weaver, term: Term, env: Env) -> Value:
    if not env.mean:
        return zipped(weaver, term, env, lambda w, a, b: (w.graph.most(a, b), NO_ERROR))
    found = zipped(weaver, term, env.point, lambda w, a, b: (_bent(w, a, b, 1.0), NO_ERROR))
    return _sampled_bend(weaver, term, found)


def _absolute(weaver: Weaver, term: Term, env: Env) -> Value:
    value, graph = weaver.number(term.parts[0], env.point), weaver.graph
    node = value.nodes[0]
    if not env.mean or graph.value(node) is not None:
        return Value((graph.node(Code.ABS, node),), value.error)
    return _sampled_bend(weaver, term, Value((graph.sub(graph.times(weaver.ramped(node), 2.0), node),), value.error))


def _clamped(weaver: Weaver, term: Term, env: Env) -> Value:
    value, low, high = (weaver.number(part, env.point) for part in term.parts)
    error = weaver.errors.worst(value.error, low.error, high.error)
    if not env.mean:
        graph = weaver.graph
        return Value((graph.least(graph.most(value.nodes[0], low.nodes[0]), high.nodes[0]),), error)
    return Value((_bent(weaver, _bent(weaver, value.nodes[0], low.nodes[0], 1.0), high.nodes[0], -1.0),), error)


def fractional(weaver: Weaver, node: int, mean: bool) -> tuple[int, int]:
    """Returns what lies behind the point of a number, and the error of that.

    Its mean is exact where it changes evenly: the integral of fract(t) is (floor(t) + fract(t)^2) / 2.  As a point it
    fades to 1/2 where a sample spans more than one whole number.
    """
    graph = weaver.graph
    plain = graph.sub(node, graph.node(Code.FLOOR, node))
    wide = weaver.width(node)
    if graph.value(wide) == 0.0:
        return plain, NO_ERROR
    if not mean:
        weaver.spreads.told[plain] = wrapped(weaver, node)
        seen = graph.within(graph.plus(graph.times(wide, -2.0), 2.4))
        half = graph.constant(0.5)
        made = graph.add(half, graph.mul(graph.sub(plain, half), seen))
        weaver.spreads.told[made] = weaver.spreads.of(plain)
        return made, weaver.errors.jump(node)

    def sawtooth(middle: int, wide: int) -> int:
        wide = graph.most(wide, graph.constant(1e-6))
        ends = [graph.add(middle, graph.times(wide, way)) for way in (-0.5, 0.5)]
        wholes = [graph.node(Code.FLOOR, end) for end in ends]
        rests = [graph.sub(end, whole) for end, whole in zip(ends, wholes, strict=True)]
        squares = graph.sub(graph.mul(rests[1], rests[1]), graph.mul(rests[0], rests[0]))
        summed = graph.add(graph.sub(wholes[1], wholes[0]), squares)
        return graph.div(summed, graph.times(wide, 2.0))

    return aslant(weaver, node, sawtooth), NO_ERROR


def wrapped(weaver: Weaver, node: int) -> Spread:
    """Returns the spread of what lies behind the point of something."""
    wide = _WHOLE * weaver.spreads.of(node).within
    return Spread(min(wide, 1.0) / _WHOLE, 1.0 / _WHOLE * min(max((wide - 0.5) / 0.7, 0.0), 1.0))


def _fract(weaver: Weaver, term: Term, env: Env) -> Value:
    value = weaver.number(term.parts[0], env.point)
    node, error = fractional(weaver, value.nodes[0], env.mean)
    return Value((node,), weaver.errors.worst(error, value.error))


def _floor(weaver: Weaver, term: Term, env: Env) -> Value:
    value = weaver.number(term.parts[0], env.point)
    node = value.nodes[0]
    if not env.mean:
        return Value((weaver.graph.node(Code.FLOOR, node),), weaver.errors.worst(weaver.errors.jump(node), value.error))
    rest, error = fractional(weaver, node, True)
    return Value((weaver.graph.sub(node, rest),), weaver.errors.worst(error, value.error))


def _mod(weaver: Weaver, term: Term, env: Env) -> Value:
    a, b = (weaver.number(part, env.point) for part in term.parts)
    rest, error = fractional(weaver, weaver.graph.div(a.nodes[0], b.nodes[0]), env.mean)
    error = weaver.errors.worst(weaver.errors.weighed(error, b.nodes[0]), a.error, b.error)
    return Value((weaver.graph.mul(b.nodes[0], rest),), error)


def _step(weaver: Weaver, term: Term, env: Env) -> Value:
    edge, value = (weaver.number(part, env.point) for part in term.parts)
    graph, away = weaver.graph, weaver.graph.sub(value.nodes[0], edge.nodes[0])
    if graph.value(away) is not None:
        return Value((graph.node(Code.LESS_EQUAL, edge.nodes[0], value.nodes[0]),))
    return Value((weaver.covered(away),), edge_error(weaver, away, weaver.errors.worst(edge.error, value.error)))


def smooth(weaver: Weaver, t: int) -> int:
    """Returns the mean of 3 t^2 - 2 t^3 over a sample, by its integral t^3 - t^4 / 2; beyond 0..1 it is level."""
    graph = weaver.graph
    flat = graph.within(t)
    plain = graph.mul(graph.mul(flat, flat), graph.plus(graph.times(flat, -2.0), 3.0))
    wide = weaver.width(t)
    told = graph.value(wide)
    if told is not None and told < 1e-3:
        return plain
    ends = []
    for way in (-0.5, 0.5):
        end = graph.add(t, graph.times(wide, way))
        within = graph.within(end)
        cube = graph.mul(graph.mul(within, within), within)
        inner = graph.mul(cube, graph.plus(graph.times(within, -0.5), 1.0))
        ends.append(graph.add(inner, graph.most(graph.plus(end, -1.0), graph.constant(0.0))))
    mean = graph.div(graph.sub(ends[1], ends[0]), graph.most(wide, graph.constant(1e-3)))
    return graph.pick(graph.node(Code.LESS, wide, graph.constant(1e-3)), plain, mean)


def _smoothstep(weaver: Weaver, term: Term, env: Env) -> Value:
    low, high, value = (weaver.number(part, env.point) for part in term.parts)
    graph = weaver.graph
    span = graph.sub(high.nodes[0], low.nodes[0])
    t = graph.div(graph.sub(value.nodes[0], low.nodes[0]), span)
    given = weaver.errors.worst(low.error, high.error, value.error)
    given = NO_ERROR if given == NO_ERROR else graph.div(given, graph.node(Code.ABS, span))
    return Value((smooth(weaver, t),), _step_error(weaver, t, given))


def _step_error(weaver: Weaver, t: int, given: int) -> int:
    """Returns the error of a smooth step: none where the sample sees but one of its ends."""
    own = weaver.errors.local(1.3 * weaver.spreads.of(t).lost)
    if own == NO_ERROR and given == NO_ERROR:
        return NO_ERROR
    graph = weaver.graph
    reach = graph.plus(graph.add(graph.times(weaver.width(t), _SEES), given), 0.5)
    seen = graph.node(Code.LESS, graph.node(Code.ABS, graph.plus(t, -0.5)), reach)
    return graph.pick(seen, weaver.errors.worst(own, weaver.errors.bounded(given, 1.5)), NO_ERROR)


def _wave(code: int) -> Rule:
    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        """The mean of a sine over the width w of a sample is sin(w / 2) / (w / 2) of it."""
        value = weaver.number(term.parts[0], env.point)
        graph, node = weaver.graph, value.nodes[0]
        wave = graph.node(code, node)
        half = graph.times(weaver.plain_width(node), 0.5)
        told = graph.value(half)
        if told == 0.0:
            return Value((wave,), weaver.errors.bounded(value.error))
        small = graph.most(half, graph.constant(1e-4))
        left = graph.div(graph.node(Code.SIN, small), small)
        if told is not None:
            left = graph.constant(_sincs(weaver, node))
        if told is None:
            left = graph.pick(graph.node(Code.LESS, half, graph.constant(3.141592653589793)), left, graph.constant(0.0))
        error = 0.0 if weaver.even(node) else weaver.spreads.of(node).within_squared
        return Value(
            (graph.mul(wave, left),), weaver.errors.worst(weaver.errors.bounded(value.error), weaver.errors.flat(error))
        )

    return rule


def _sincs(weaver: Weaver, node: int) -> float:
    """Returns what is left of a sine that changes evenly across and down, and of whose place something is lost."""
    out = 1.0
    for slope in weaver.slopes.of(node):
        half = 0.5 * abs(weaver.graph.value(slope) or 0.0) * weaver.setting.width
        out *= elementary.sin(half) / half if half > 1e-4 else 1.0
    return out * elementary.exp(-0.5 * weaver.spreads.of(node).lost_squared)


def _plain(code: int) -> Rule:
    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        """A function without an integral of its own: by samples, where it is not the same everywhere."""
        values = [weaver.number(part, env.point) for part in term.parts]
        node = weaver.graph.node(code, *(value.nodes[0] for value in values))
        error = 4.0 * sum(weaver.spreads.of(value.nodes[0]).within_squared for value in values)
        own = NO_ERROR if weaver.graph.value(node) is not None or not env.mean else weaver.errors.flat(error)
        return Value((node,), weaver.errors.worst(own, *(value.error for value in values)))

    return rule


def _power(weaver: Weaver, term: Term, env: Env) -> Value:
    base, exponent = (weaver.number(part, env.point) for part in term.parts)
    graph, told = weaver.graph, weaver.graph.value(exponent.nodes[0])
    node = base.nodes[0]
    if node in weaver.shares and graph.value(node) is None and told is not None and told > 0.0:
        return Value((node,), weaver.errors.worst(base.error, exponent.error))
    own = weaver.spreads.of(node).within_squared + weaver.spreads.of(exponent.nodes[0]).within
    error = weaver.errors.worst(base.error, exponent.error, weaver.errors.flat(own) if env.mean else NO_ERROR)
    if told is None or told not in (0.0, 1.0, 2.0, 3.0, 4.0) or graph.value(node) is not None:
        return Value((graph.node(Code.POW, node, exponent.nodes[0]),), error)
    if told % 2.0:
        node = graph.node(Code.ABS, node)
    made = graph.constant(1.0)
    for _ in range(int(told)):
        made = graph.mul(made, node)
    if told == 2.0 and env.mean:
        made = graph.plus(made, weaver.spreads.of(node).lost_squared)
    return Value((made,), error)


ARITHMETIC: dict[str, Rule] = {
    "+": _of_two(_add),
    "-": _of_two(_subtract),
    "*": lambda weaver, term, env: zipped(weaver, term, env, _multiply, _factors),
    "/": _of_two(_divide),
    "neg": _negated,
    "<": _compared,
    "<=": _compared,
    ">": _compared,
    ">=": _compared,
    "if": _chosen,
}
FUNCTIONS_OF_NUMBERS: dict[str, tuple[int, int, Rule, str]] = {
    "min": (2, 2, _least, "min(a, b): the smaller one"),
    "max": (2, 2, _most, "max(a, b): the larger one"),
    "clamp": (3, 3, _clamped, "clamp(a, low, high): a, but not below low or above high"),
    "mix": (3, 3, _mix, "mix(a, b, part): from a, at 0, to b, at 1; numbers or colours"),
    "step": (2, 2, _step, "step(edge, a): 1 where a is at least the edge, else 0"),
    "smoothstep": (3, 3, _smoothstep, "smoothstep(low, high, a): from 0 to 1 while a goes from low to high"),
    "abs": (1, 1, _absolute, "abs(a): without its sign"),
    "floor": (1, 1, _floor, "floor(a): the next whole number below"),
    "fract": (1, 1, _fract, "fract(a): what is behind the point"),
    "mod": (2, 2, _mod, "mod(a, b): what is left of a, divided by b"),
    "sqrt": (1, 1, _plain(Code.SQRT), "sqrt(a): the square root of a without its sign"),
    "pow": (2, 2, _power, "pow(a, b): a without its sign to the power of b"),
    "exp": (1, 1, _plain(Code.EXP), "exp(a): e to the power of a"),
    "log": (1, 1, _plain(Code.LOG), "log(a): the natural logarithm of a without its sign"),
    "sin": (1, 1, _wave(Code.SIN), "sin(a): the sine of a, in radians"),
    "cos": (1, 1, _wave(Code.COS), "cos(a): the cosine of a, in radians"),
    "tan": (1, 1, _plain(Code.TAN), "tan(a): the tangent of a, in radians"),
    "atan2": (2, 2, _plain(Code.ATAN2), "atan2(y, x): the direction of (x, y), in radians, clockwise from rightwards"),
}
