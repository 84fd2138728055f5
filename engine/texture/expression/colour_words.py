"""Colours: ramps and curves, parts of colours, blend modes, and the light on a relief."""

from __future__ import annotations

import math

from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.functions import functions
from engine.texture.expression.arithmetic_words import Work, zipped
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import NO_ERROR
from engine.texture.expression.sampling.errors import FEW_FROM
from engine.texture.expression.spreads import steepest as spread_of_ramp
from engine.texture.expression.weaving import Env, Rule, Value, Weaver
from engine.texture.expression.written import Term

_KNOTS_MOST = 64
_UNEVEN = 1.5 * FEW_FROM  # the error of what bends, or is a product, that is not looked into
_AZIMUTH, _DEPTH = 315.0, 0.25


def _knots(weaver: Weaver, t: Value, places: list[float], columns: list[tuple[float, ...]]) -> Value:
    """Returns a number looked up between knots, as the mean over the sample: a channel for each column."""
    node = t.nodes[0]
    nodes = tuple(
        weaver.graph.node(Code.RAMP, node, weaver.width(node), numbers=(*places, *column)) for column in columns
    )
    steepest = max(spread_of_ramp((*places, *column)) for column in columns)
    own = weaver.errors.flat(0.3 * weaver.spreads.of(node).lost * steepest)
    return Value(nodes, weaver.errors.worst(own, weaver.errors.bounded(t.error, steepest)))


def _ramp(weaver: Weaver, term: Term, env: Env) -> Value:
    """ramp(t, colour, ...) evenly from 0 to 1, or ramp(t, place, colour, ...)."""
    given = [weaver.value(part, env.point) for part in term.parts[1:]]
    if not given[0].coloured and len(given) > 1 and given[1].coloured:
        places = _rising(weaver, term, env, term.parts[1::2])
        found, parts = given[1::2], term.parts[2::2]
        if len(places) != len(found):
            weaver.refuse(term, "a place without a colour", "ramp(a, place, colour, place, colour, ...)")
    else:
        found, parts = given, term.parts[1:]
        places = [n / max(len(found) - 1, 1) for n in range(len(found))]
    if len(found) < 2:
        weaver.refuse(term, "one colour", "two at least")
    channels: list[list[float]] = [[], [], [], []]
    for part, value in zip(parts, found, strict=True):
        for channel, node in zip(channels, weaver.as_colour(value).nodes, strict=True):
            told = weaver.graph.value(node)
            if told is None:
                weaver.refuse(part, "a colour that changes from place to place", "one that does not")
            channel.append(told)
    columns = [tuple(channel) for channel in channels]
    made = _knots(weaver, weaver.number(term.parts[0], env.point), places, columns)
    opaque = all(one == 1.0 for one in columns[3])
    return Value((*made.nodes[:3], weaver.graph.constant(1.0)), made.error) if opaque else made


def _rising(weaver: Weaver, term: Term, env: Env, parts: tuple[Term, ...]) -> list[float]:
    places: list[float] = []
    for part in parts:
        place = weaver.fixed(part, env, -1e9, 1e9)
        if places and place <= places[-1]:
            weaver.refuse(part, f"{place:g}", f"a place above {places[-1]:g}, the one before")
        places.append(place)
    return places


def _curve(weaver: Weaver, term: Term, env: Env) -> Value:
    if len(term.parts) % 2 == 0:
        weaver.refuse(term, "a place without a value", "curve(a, place, value, place, value, ...)")
    places = _rising(weaver, term, env, term.parts[1::2])
    values = tuple(weaver.fixed(part, env, -1e9, 1e9) for part in term.parts[2::2])
    return _knots(weaver, weaver.number(term.parts[0], env.point), places, [values])


def _rgb(weaver: Weaver, term: Term, env: Env) -> Value:
    values = [weaver.number(part, env) for part in term.parts]
    error = weaver.errors.worst(*(value.error for value in values))
    return Value((*(value.nodes[0] for value in values), weaver.graph.constant(1.0)), error)


def _hsv(weaver: Weaver, term: Term, env: Env) -> Value:
    values = [weaver.number(part, env.point) for part in term.parts]
    graph, (hue, saturation, value) = weaver.graph, (one.nodes[0] for one in values)
    nodes = []
    for shift in (1.0, 2.0 / 3.0, 1.0 / 3.0):
        turn = graph.plus(hue, shift)
        rest = graph.sub(turn, graph.node(Code.FLOOR, turn))
        away = graph.node(Code.ABS, graph.plus(graph.times(rest, 6.0), -3.0))
        pure = graph.within(graph.plus(away, -1.0))
        nodes.append(graph.mul(value, graph.blend(graph.constant(1.0), pure, saturation)))
    fixed = all(graph.value(node) is not None for node in nodes)
    own = NO_ERROR if fixed or not env.mean else weaver.errors.flat(_UNEVEN)
    return Value((*nodes, graph.constant(1.0)), weaver.errors.worst(own, *(one.error for one in values)))


def _channel(number: int) -> Rule:
    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        value = weaver.colour(term.parts[0], env)
        return Value((value.nodes[number],), value.error)

    return rule


def _luma(weaver: Weaver, term: Term, env: Env) -> Value:
    value, graph = weaver.colour(term.parts[0], env), weaver.graph
    parts = [graph.times(node, part) for node, part in zip(value.nodes, (0.3, 0.59, 0.11), strict=False)]
    return Value((graph.add(graph.add(parts[0], parts[1]), parts[2]),), value.error)


def _fade(weaver: Weaver, term: Term, env: Env) -> Value:
    value, part = weaver.colour(term.parts[0], env), weaver.number(term.parts[1], env)
    graph, way = weaver.graph, weaver.graph.within(part.nodes[0])
    changing = env.mean and graph.value(way) is None and any(graph.value(node) is None for node in value.nodes)
    nodes = tuple(graph.mul(node, way) for node in value.nodes)
    given = weaver.errors.weighed(value.error, way), weaver.errors.weighed(part.error, *value.nodes)
    return Value(nodes, weaver.errors.worst(*given, weaver.errors.flat(_UNEVEN) if changing else NO_ERROR))


def _over(weaver: Weaver, term: Term, env: Env) -> Value:
    above, below = (weaver.colour(part, env) for part in term.parts)
    graph = weaver.graph
    left = graph.sub(graph.constant(1.0), above.nodes[3])
    told = graph.value(left)
    nodes = tuple(graph.add(a, graph.mul(b, left)) for a, b in zip(above.nodes, below.nodes, strict=True))
    fixed = told is not None or all(graph.value(node) is not None for node in below.nodes)
    given = above.error, weaver.errors.weighed(below.error, left)
    return Value(nodes, weaver.errors.worst(*given, NO_ERROR if fixed or not env.mean else weaver.errors.flat(_UNEVEN)))


def _blend(work: Work) -> Rule:
    return lambda weaver, term, env: zipped(weaver, term, env, work)


def _even(weaver: Weaver, a: int, b: int) -> int:
    fixed = weaver.graph.value(a) is not None or weaver.graph.value(b) is not None
    return NO_ERROR if fixed else weaver.errors.flat(_UNEVEN)


def _screen(weaver: Weaver, a: int, b: int) -> tuple[int, int]:
    graph = weaver.graph
    return graph.sub(graph.add(a, b), graph.mul(a, b)), _even(weaver, a, b)


def _hard(weaver: Weaver, a: int, b: int) -> tuple[int, int]:
    """Multiplies where b is below 1/2, else screens."""
    graph = weaver.graph
    twice = graph.times(b, 2.0)
    dark = graph.mul(a, twice)
    over = graph.plus(twice, -1.0)
    light = graph.sub(graph.add(a, over), graph.mul(a, over))
    return graph.pick(graph.node(Code.LESS, b, graph.constant(0.5)), dark, light), weaver.errors.flat(_UNEVEN)


def _overlay(weaver: Weaver, a: int, b: int) -> tuple[int, int]:
    return _hard(weaver, b, a)


def _soft(weaver: Weaver, a: int, b: int) -> tuple[int, int]:
    """a + (2 b - 1)(a - a^2), with the root of a in place of a^2 where b is above 1/2 and a above 1/4 (W3C)."""
    graph = weaver.graph
    way = graph.plus(graph.times(b, 2.0), -1.0)
    square = graph.mul(a, a)
    bent = graph.mul(graph.plus(graph.mul(graph.plus(graph.times(a, 16.0), -12.0), a), 4.0), a)
    high = graph.pick(graph.node(Code.LESS_EQUAL, a, graph.constant(0.25)), bent, graph.node(Code.SQRT, a))
    dark = graph.add(a, graph.mul(way, graph.sub(a, square)))
    light = graph.add(a, graph.mul(way, graph.sub(high, a)))
    return graph.pick(graph.node(Code.LESS, b, graph.constant(0.5)), dark, light), weaver.errors.flat(_UNEVEN)


def _difference(weaver: Weaver, a: int, b: int) -> tuple[int, int]:
    return weaver.graph.node(Code.ABS, weaver.graph.sub(a, b)), weaver.errors.flat(_UNEVEN)


def _dodge(weaver: Weaver, a: int, b: int) -> tuple[int, int]:
    graph = weaver.graph
    left = graph.most(graph.sub(graph.constant(1.0), b), graph.constant(1e-6))
    return graph.within(graph.div(a, left)), weaver.errors.flat(_UNEVEN)


def _burn(weaver: Weaver, a: int, b: int) -> tuple[int, int]:
    graph, one = weaver.graph, weaver.graph.constant(1.0)
    dark = graph.within(graph.div(graph.sub(one, a), graph.most(b, graph.constant(1e-6))))
    return graph.sub(one, dark), weaver.errors.flat(_UNEVEN)


def _relief(weaver: Weaver, term: Term, env: Env) -> Value:
    """How a relief of that height looks in light from the side: 1/2 where it is level."""
    height = weaver.number(term.parts[0], env.point)
    azimuth = weaver.fixed(term.parts[1], env, -1e6, 1e6) if len(term.parts) > 1 else _AZIMUTH
    depth = weaver.number(term.parts[2], env.point) if len(term.parts) > 2 else Value((weaver.graph.constant(_DEPTH),))
    own, graph = functions(EVERYWHERE), weaver.graph
    turn = azimuth * math.pi / 180.0
    across, down = weaver.slopes.of(height.nodes[0])
    facing = graph.sub(graph.times(down, own.cos(turn)), graph.times(across, own.sin(turn)))
    node = graph.plus(graph.mul(facing, depth.nodes[0]), 0.5)
    bent = NO_ERROR if weaver.even(height.nodes[0]) else weaver.errors.flat(_UNEVEN)
    return Value((graph.within(node),), weaver.errors.worst(height.error, depth.error, bent))


def _slope(axis: int) -> Rule:
    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        value = weaver.number(term.parts[0], env.point)
        return Value(
            (weaver.slopes.of(value.nodes[0])[axis],), weaver.errors.worst(value.error, weaver.errors.flat(_UNEVEN))
        )

    return rule


COLOUR_WORDS: dict[str, tuple[int, int, Rule, str]] = {
    "ramp": (3, 2 * _KNOTS_MOST + 1, _ramp, "ramp(a, colour, ...): colours by a, from 0 to 1; or a place before each"),
    "curve": (5, 2 * _KNOTS_MOST + 1, _curve, "curve(a, place, value, ...): straight from one value to the next"),
    "rgb": (3, 3, _rgb, "rgb(red, green, blue): a colour, each from 0 to 1"),
    "hsv": (3, 3, _hsv, "hsv(hue, saturation, value): a colour; a hue of 0 is red, 1/3 green, 2/3 blue"),
    "red": (1, 1, _channel(0), "red(colour): how red it is"),
    "green": (1, 1, _channel(1), "green(colour): how green it is"),
    "blue": (1, 1, _channel(2), "blue(colour): how blue it is"),
    "alpha": (1, 1, _channel(3), "alpha(colour): how opaque it is"),
    "luma": (1, 1, _luma, "luma(colour): how bright it is"),
    "fade": (2, 2, _fade, "fade(colour, part): less opaque; 0 is nothing"),
    "over": (2, 2, _over, "over(a, b): a laid over b"),
    "screen": (2, 2, _blend(_screen), "screen(a, b): both as light; brighter than either"),
    "overlay": (2, 2, _blend(_overlay), "overlay(a, b): a, its contrast raised by b"),
    "hard_light": (2, 2, _blend(_hard), "hard_light(a, b): a, darkened or brightened by b"),
    "soft_light": (2, 2, _blend(_soft), "soft_light(a, b): a, gently darkened or brightened by b"),
    "difference": (2, 2, _blend(_difference), "difference(a, b): how far one is from the other"),
    "dodge": (2, 2, _blend(_dodge), "dodge(a, b): a, brightened by b up to white"),
    "burn": (2, 2, _blend(_burn), "burn(a, b): a, darkened by b down to black"),
    "relief": (1, 3, _relief, "relief(height, azimuth, depth): the light on a relief, 0.5 where it is level"),
    "slope_x": (1, 1, _slope(0), "slope_x(a): how fast a rises to the right"),
    "slope_y": (1, 1, _slope(1), "slope_y(a): how fast a rises downwards"),
}
