"""Shapes by their signed distances, below 0 within, and what is made of these; textures turned, moved and repeated."""

from __future__ import annotations

import math
from dataclasses import replace

from engine.numeric import elementary
from engine.texture.expression.arithmetic_words import wrapped
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import NO_ERROR
from engine.texture.expression.sampling.errors import FEW_FROM
from engine.texture.expression.spreads import part_of_one
from engine.texture.expression.weaving import Env, Rule, Value, Weaver
from engine.texture.expression.written import Term


def _nodes(weaver: Weaver, term: Term, env: Env) -> tuple[list[int], int]:
    values = [weaver.number(part, env.point) for part in term.parts]
    return [value.nodes[0] for value in values], weaver.errors.worst(*(value.error for value in values))


def _length(weaver: Weaver, x: int, y: int) -> int:
    graph = weaver.graph
    return graph.node(Code.SQRT, graph.add(graph.mul(x, x), graph.mul(y, y)))


def _distance(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y), error = _nodes(weaver, term, env)
    return Value((_length(weaver, x, y),), error)


def _circle(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y, radius), error = _nodes(weaver, term, env)
    return Value((weaver.graph.sub(_length(weaver, x, y), radius),), error)


def _box(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y, width, height, *rest), error = _nodes(weaver, term, env)
    graph, zero = weaver.graph, weaver.graph.constant(0.0)
    round_ = rest[0] if rest else zero
    over = [
        graph.add(graph.sub(graph.node(Code.ABS, t), graph.times(size, 0.5)), round_)
        for t, size in ((x, width), (y, height))
    ]
    outside = _length(weaver, *(graph.most(one, zero) for one in over))
    return Value((graph.sub(graph.add(outside, graph.least(graph.most(*over), zero)), round_),), error)


def _segment(weaver: Weaver, term: Term, env: Env) -> Value:
    (x, y, x0, y0, x1, y1, *rest), error = _nodes(weaver, term, env)
    graph = weaver.graph
    right, below, ex, ey = graph.sub(x, x0), graph.sub(y, y0), graph.sub(x1, x0), graph.sub(y1, y0)
    squared = graph.most(graph.add(graph.mul(ex, ex), graph.mul(ey, ey)), graph.constant(1e-18))
    part = graph.within(graph.div(graph.add(graph.mul(right, ex), graph.mul(below, ey)), squared))
    far = _length(weaver, graph.sub(right, graph.mul(ex, part)), graph.sub(below, graph.mul(ey, part)))
    return Value((graph.sub(far, graph.times(rest[0], 0.5)) if rest else far,), error)


def _sector(weaver: Weaver, x: int, y: int, corners: int) -> tuple[int, int]:
    """Returns the place as seen from one corner's side: along, and away to either side of it."""
    graph, whole = weaver.graph, 2.0 * math.pi / corners
    turn = graph.times(graph.node(Code.ATAN2, x, graph.times(y, -1.0)), 1.0 / whole)
    rest = graph.sub(turn, graph.node(Code.FLOOR, graph.plus(turn, 0.5)))
    angle = graph.times(graph.node(Code.ABS, rest), whole)
    far = _length(weaver, x, y)
    return graph.mul(far, graph.node(Code.COS, angle)), graph.mul(far, graph.node(Code.SIN, angle))


def _polygon(weaver: Weaver, term: Term, env: Env) -> Value:
    corners = int(weaver.fixed(term.parts[2], env, 3, 64, True))
    (x, y, _, radius), error = _nodes(weaver, term, env)
    graph, half = weaver.graph, math.pi / corners
    along, away = _sector(weaver, x, y, corners)
    edge = graph.add(graph.times(along, elementary.cos(half)), graph.times(away, elementary.sin(half)))
    return Value((graph.sub(edge, graph.times(radius, elementary.cos(half))),), error)


def _star(weaver: Weaver, term: Term, env: Env) -> Value:
    corners = int(weaver.fixed(term.parts[2], env, 3, 64, True))
    (x, y, _, radius, inner), error = _nodes(weaver, term, env)
    graph, half = weaver.graph, math.pi / corners
    along, away = _sector(weaver, x, y, corners)
    ex, ey = graph.sub(graph.times(inner, elementary.cos(half)), radius), graph.times(inner, elementary.sin(half))
    long = graph.most(_length(weaver, ex, ey), graph.constant(1e-9))
    beside = graph.sub(graph.mul(graph.sub(along, radius), ey), graph.mul(away, ex))
    return Value((graph.div(beside, long),), error)


def _fill(weaver: Weaver, term: Term, env: Env) -> Value:
    (far,), error = _nodes(weaver, term, env)
    away = weaver.graph.times(far, -1.0)
    return Value((weaver.covered(away),), weaver.errors.at_edge(away, _corners(weaver, far), error))


def _corners(weaver: Weaver, far: int) -> float:
    """Returns the error of a shape along its edge: its corners and bends have no slope of their own."""
    return 0.0 if weaver.even(far) else 2.0 * FEW_FROM


def _outline(weaver: Weaver, term: Term, env: Env) -> Value:
    (far, thick), error = _nodes(weaver, term, env)
    graph, half = weaver.graph, weaver.graph.times(thick, 0.5)
    ends, own = (graph.sub(far, half), graph.add(far, half)), _corners(weaver, far)
    inner, outer = (weaver.covered(end) for end in ends)
    made = graph.sub(outer, inner)
    weaver.shares.add(made)
    return Value((made,), weaver.errors.worst(*(weaver.errors.at_edge(end, own, error) for end in ends)))


def _glow(weaver: Weaver, term: Term, env: Env) -> Value:
    (far, reach), error = _nodes(weaver, term, env)
    graph = weaver.graph
    left = graph.plus(graph.times(graph.div(far, reach), -1.0), 1.0)
    made, spread = graph.sub(weaver.ramped(left), weaver.ramped(graph.plus(left, -1.0))), weaver.spreads.of(left)
    weaver.spreads.told[made] = part_of_one(spread)
    own = NO_ERROR if weaver.even(left) else weaver.errors.flat(spread.within_squared)
    return Value((made,), weaver.errors.worst(own, weaver.errors.bounded(error)))


def _join(weaver: Weaver, term: Term, env: Env) -> Value:
    """With a third value, the two flow into one another where they are as near as that."""
    (a, b, *rest), error = _nodes(weaver, term, env)
    graph = weaver.graph
    if not rest:
        return Value((graph.least(a, b),), error)
    soft = graph.most(rest[0], graph.constant(1e-9))
    near = graph.sub(soft, graph.node(Code.ABS, graph.sub(a, b)))
    over = graph.div(graph.most(near, graph.constant(0.0)), soft)
    return Value((graph.sub(graph.least(a, b), graph.times(graph.mul(graph.mul(over, over), soft), 0.25)),), error)


def _cut(weaver: Weaver, term: Term, env: Env) -> Value:
    (a, b), error = _nodes(weaver, term, env)
    return Value((weaver.graph.most(a, weaver.graph.times(b, -1.0)),), error)


# ---- elsewhere -------------------------------------------------------------------------------------------------------


def _moved(weaver: Weaver, term: Term, env: Env, x: int, y: int) -> Value:
    """Returns the texture that comes first, at another place."""
    return weaver.value(term.parts[0], replace(env, x=x, y=y))


def _given(weaver: Weaver, term: Term, env: Env) -> tuple[list[int], int]:
    """Returns the nodes of all values but the first."""
    values = [weaver.number(part, env.point) for part in term.parts[1:]]
    return [value.nodes[0] for value in values], weaver.errors.worst(*(value.error for value in values))


def _warp(weaver: Weaver, term: Term, env: Env) -> Value:
    (right, below), error = _given(weaver, term, env)
    found = _moved(weaver, term, env, weaver.graph.add(env.x, right), weaver.graph.add(env.y, below))
    return replace(found, error=weaver.errors.worst(found.error, error))


def _shift(weaver: Weaver, term: Term, env: Env) -> Value:
    (right, below), error = _given(weaver, term, env)
    found = _moved(weaver, term, env, weaver.graph.sub(env.x, right), weaver.graph.sub(env.y, below))
    return replace(found, error=weaver.errors.worst(found.error, error))


def _rotate(weaver: Weaver, term: Term, env: Env) -> Value:
    (degrees,), error = _given(weaver, term, env)
    graph = weaver.graph
    turn = graph.times(degrees, math.pi / 180.0)
    cos, sin = graph.node(Code.COS, turn), graph.node(Code.SIN, turn)
    x = graph.add(graph.mul(env.x, cos), graph.mul(env.y, sin))
    y = graph.sub(graph.mul(env.y, cos), graph.mul(env.x, sin))
    found = _moved(weaver, term, env, x, y)
    return replace(found, error=weaver.errors.worst(found.error, error))


def _scale(weaver: Weaver, term: Term, env: Env) -> Value:
    sizes, error = _given(weaver, term, env)
    graph = weaver.graph
    found = _moved(weaver, term, env, graph.div(env.x, sizes[0]), graph.div(env.y, sizes[-1]))
    return replace(found, error=weaver.errors.worst(found.error, error))


def _repeat(weaver: Weaver, term: Term, env: Env) -> Value:
    """Within a repeat x and y go from -0.5 to 0.5, and `random` has other numbers in each."""
    counts, error = _given(weaver, term, env)
    graph = weaver.graph
    across, down = graph.mul(env.x, counts[0]), graph.mul(env.y, counts[min(1, len(counts) - 1)])
    row = graph.node(Code.FLOOR, down)
    if len(counts) > 2:
        across = graph.add(across, graph.mul(row, counts[2]))
    column = graph.node(Code.FLOOR, across)
    places = [graph.plus(graph.sub(*pair), -0.5) for pair in ((across, column), (down, row))]
    for node, whole in zip(places, (across, down), strict=True):
        weaver.spreads.told[node] = wrapped(weaver, whole)
    edges = weaver.errors.jump(across), weaver.errors.jump(down)
    found = weaver.value(term.parts[0], replace(env, x=places[0], y=places[1], cell=(column, row)))
    return replace(found, error=weaver.errors.worst(found.error, error, *edges))


SHAPE_WORDS: dict[str, tuple[int, int, Rule, str]] = {
    "distance": (2, 2, _distance, "distance(x, y): how far it is from 0, 0"),
    "circle": (3, 3, _circle, "circle(x, y, radius): how far it is to a circle around 0, 0; below 0 within"),
    "box": (4, 5, _box, "box(x, y, width, height, round): how far it is to a box around 0, 0; below 0 within"),
    "segment": (6, 7, _segment, "segment(x, y, x0, y0, x1, y1, thick): how far it is to a line from x0, y0 to x1, y1"),
    "polygon": (4, 4, _polygon, "polygon(x, y, corners, radius): how far it is to a polygon around 0, 0"),
    "star": (5, 5, _star, "star(x, y, corners, radius, inner): how far it is to a star around 0, 0"),
    "fill": (1, 1, _fill, "fill(d): 1 where the distance d is below 0, else 0"),
    "outline": (2, 2, _outline, "outline(d, thick): 1 along the edge of a shape, d being the distance to it"),
    "glow": (2, 2, _glow, "glow(d, reach): 1 within a shape, falling to 0 as far as that from it"),
    "join": (2, 3, _join, "join(a, b, soft): both shapes as one; soft lets them flow together"),
    "cut": (2, 2, _cut, "cut(a, b): the shape a without b"),
    "warp": (3, 3, _warp, "warp(texture, right, down): the texture as it is so far away"),
    "shift": (3, 3, _shift, "shift(texture, right, down): the texture moved as far as that"),
    "rotate": (2, 2, _rotate, "rotate(texture, degrees): the texture turned clockwise around 0, 0"),
    "scale": (2, 3, _scale, "scale(texture, across, down): the texture so many times as large"),
    "repeat": (2, 4, _repeat, "repeat(texture, across, down, shift): so many a unit; in each, x and y are -0.5 to 0.5"),
}
