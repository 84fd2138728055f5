"""Slopes of what a written texture is made of: how fast it changes across the plane, by the rules of calculus.

Jumps have none: `floor` is level, `fract` is not.  A slope of a slope that is not arithmetic counts as level.
"""

from __future__ import annotations

from collections.abc import Callable

from engine.texture.expression.codes import Code
from engine.texture.expression.graph import Graph, Operation, needed_by

_Rule = Callable[[Graph, int, Operation, list[int]], int]


def _product(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    a, b = told.parts
    return graph.add(graph.mul(a, slopes[1]), graph.mul(b, slopes[0]))


def _quotient(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    return graph.div(graph.sub(slopes[0], graph.mul(node, slopes[1])), told.parts[1])


def _smaller(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    return graph.pick(graph.node(Code.LESS, *told.parts), *slopes)


def _larger(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    return graph.pick(graph.node(Code.LESS, *told.parts), slopes[1], slopes[0])


def _magnitude(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    below = graph.node(Code.LESS, told.parts[0], graph.constant(0.0))
    return graph.pick(below, graph.times(slopes[0], -1.0), slopes[0])


def _root(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    return graph.div(graph.times(_magnitude(graph, node, told, slopes), 0.5), graph.most(node, graph.constant(1e-9)))


def _angle(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    y, x = told.parts
    far = graph.most(graph.add(graph.mul(x, x), graph.mul(y, y)), graph.constant(1e-18))
    return graph.div(graph.sub(graph.mul(x, slopes[0]), graph.mul(y, slopes[1])), far)


def _tangent(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    return graph.mul(graph.plus(graph.mul(node, node), 1.0), slopes[0])


def _power(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    a, b = told.parts
    by_base = graph.div(graph.mul(graph.mul(node, b), slopes[0]), a)
    return graph.add(by_base, graph.mul(graph.mul(node, graph.node(Code.LOG, a)), slopes[1]))


def _scattered(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    """Smooth noise and cells, textures of other makers: by their own slopes along u and v."""
    if told.slope:
        return graph.constant(0.0)
    total = graph.constant(0.0)
    for axis in (0, 1):
        if graph.value(slopes[axis]) != 0.0:
            own = graph.node(told.code, *told.parts, numbers=told.numbers, key=told.key, kind=told.kind, slope=axis + 1)
            total = graph.add(total, graph.mul(own, slopes[axis]))
    return total


def _ramp(graph: Graph, node: int, told: Operation, slopes: list[int]) -> int:
    if told.slope:
        return graph.constant(0.0)
    own = graph.node(told.code, *told.parts, numbers=told.numbers, slope=1)
    return graph.mul(own, slopes[0])


_RULES: dict[int, _Rule] = {
    Code.ADD: lambda g, n, told, s: g.add(*s),
    Code.SUB: lambda g, n, told, s: g.sub(*s),
    Code.ADD_TO: lambda g, n, told, s: s[0],
    Code.TIMES: lambda g, n, told, s: g.times(s[0], told.numbers[0]),
    Code.MUL: _product,
    Code.DIV: _quotient,
    Code.MIN: _smaller,
    Code.MAX: _larger,
    Code.ABS: _magnitude,
    Code.SQRT: _root,
    Code.SELECT: lambda g, n, told, s: g.pick(told.parts[0], s[1], s[2]),
    Code.SIN: lambda g, n, told, s: g.mul(g.node(Code.COS, told.parts[0]), s[0]),
    Code.COS: lambda g, n, told, s: g.times(g.mul(g.node(Code.SIN, told.parts[0]), s[0]), -1.0),
    Code.TAN: _tangent,
    Code.ATAN2: _angle,
    Code.EXP: lambda g, n, told, s: g.mul(n, s[0]),
    Code.LOG: lambda g, n, told, s: g.div(s[0], told.parts[0]),
    Code.POW: _power,
    Code.NOISE: _scattered,
    Code.CELLS: _scattered,
    Code.RAMP: _ramp,
    Code.PICTURE: _scattered,
}


class Slopes:
    """Remembers the slopes of a graph's nodes, across (0) and down (1)."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._known: tuple[dict[int, int], dict[int, int]] = ({}, {})

    def of(self, node: int) -> tuple[int, int]:
        """Returns the nodes of a node's slopes: across, and down."""
        return self._along(node, 0), self._along(node, 1)

    def _along(self, target: int, axis: int) -> int:
        graph, known = self._graph, self._known[axis]
        if target not in known:
            flat = graph.constant(0.0)
            for node, way in graph.ways.items():
                if node not in known:
                    known[node] = graph.constant(float(way[axis]))
            for node in needed_by(graph, [target], known):
                told = graph.operations[node]
                rule = _RULES.get(told.code)
                slopes = [known[part] for part in told.parts]
                level = rule is None or slopes.count(flat) == len(slopes)
                known[node] = flat if level or rule is None else rule(graph, node, told, slopes)
        return known[target]
