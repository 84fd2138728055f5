"""What a written texture comes to: operations on numbers, each made once, with constants worked out at once.

A node is a number: the place of its operation in a list, behind those of all that it needs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Iterable
from typing import NamedTuple

from engine.numeric import elementary
from engine.texture.expression.codes import COST, Code
from engine.texture.expression.naming.elsewhere import Elsewhere

NODES_MOST = 4000  # operations of one texture
NO_ERROR = 2  # the node of 0, in every graph
ASKED_COST = 150.0  # nanoseconds a sample, about, of a channel of a texture of another maker


class TooLarge(ValueError):
    """A texture of more operations than are allowed."""


class Operation(NamedTuple):
    """`numbers`: constants that it works with; `key`: of its hashes; `kind`, `slope`: which variant."""

    code: int
    parts: tuple[int, ...] = ()
    numbers: tuple[float, ...] = ()
    key: tuple[int, ...] = ()
    kind: int = 0
    slope: int = 0


def _quotient(a: float, b: float) -> float:
    return a / b if b != 0.0 else a * 1e30 * 1e30


def _floor(a: float) -> float:
    return float(math.floor(a)) if math.isfinite(a) else a


def _power(a: float, b: float) -> float:
    return elementary.power(abs(a), b)


_WORKED: dict[int, Callable[..., float]] = {
    Code.ADD: lambda a, b: a + b,
    Code.SUB: lambda a, b: a - b,
    Code.MUL: lambda a, b: a * b,
    Code.DIV: _quotient,
    Code.MIN: lambda a, b: a if a < b else b,
    Code.MAX: lambda a, b: a if a > b else b,
    Code.LESS: lambda a, b: float(a < b),
    Code.LESS_EQUAL: lambda a, b: float(a <= b),
    Code.ABS: abs,
    Code.FLOOR: _floor,
    Code.SQRT: lambda a: math.sqrt(abs(a)),
    Code.SELECT: lambda test, a, b: a if test != 0.0 else b,
    Code.SIN: elementary.sin,
    Code.COS: elementary.cos,
    Code.TAN: elementary.tan,
    Code.ATAN2: elementary.atan2,
    Code.EXP: lambda a: elementary.exp(a if a < 700.0 else 700.0),
    Code.LOG: lambda a: elementary.log(abs(a) + 1e-300),
    Code.POW: _power,
}


class Graph:
    """Holds the operations; every method that makes one returns its node."""

    def __init__(self) -> None:
        self.operations: list[Operation] = []
        self._known: dict[tuple[object, ...], int] = {}
        self._numbers: dict[float, int] = {}  # the nodes of numbers,
        self._values: dict[int, float] = {}  # and the other way round
        self.x, self.y = self.node(Code.X), self.node(Code.Y)
        self.ways = {self.x: (1.0, 0.0), self.y: (0.0, 1.0)}  # of what is told by place: how fast it rises
        self.elsewhere: list[Elsewhere] = []  # textures of other makers that it asks for
        assert self.constant(0.0) == NO_ERROR

    def node(self, code: int, *parts: int, numbers: tuple[float, ...] = (), key: tuple[int, ...] = (), kind: int = 0,
             slope: int = 0) -> int:  # fmt: skip
        """Returns the node of an operation; TooLarge if there are too many."""
        work = _WORKED.get(code)
        if work is not None and not numbers:
            given = [self._values[part] for part in parts if part in self._values]
            if len(given) == len(parts):
                return self.constant(work(*given))
        told = code, parts, numbers, key, kind, slope
        found = self._known.get(told)
        if found is None:
            if len(self.operations) >= NODES_MOST:
                raise TooLarge
            found = self._known[told] = len(self.operations)
            self.operations.append(Operation(*told))
        return found

    def constant(self, value: float) -> int:
        """Returns the node of a number; what is none counts as 0."""
        value = value + 0.0 if math.isfinite(value) else 0.0
        found = self._numbers.get(value)
        if found is None:
            found = self._numbers[value] = self.node(Code.CONST, numbers=(value,))
            self._values[found] = value
        return found

    def value(self, node: int) -> float | None:
        """Returns the number that a node always is, if it is one."""
        return self._values.get(node)

    def add(self, a: int, b: int) -> int:
        """Returns a + b."""
        left, right = self.value(a), self.value(b)
        if left is not None and right is None:
            a, b, left, right = b, a, right, left
        if right is None or left is not None:
            return self.node(Code.ADD, min(a, b), max(a, b))
        return a if right == 0.0 else self.node(Code.ADD_TO, a, numbers=(right,))

    def sub(self, a: int, b: int) -> int:
        """Returns a - b."""
        right = self.value(b)
        if right is not None:
            return self.add(a, self.constant(-right))
        return self.constant(0.0) if a == b else self.node(Code.SUB, a, b)

    def mul(self, a: int, b: int) -> int:
        """Returns a b."""
        left, right = self.value(a), self.value(b)
        if left is not None and right is None:
            a, b, left, right = b, a, right, left
        if right is None or left is not None:
            return self.node(Code.MUL, min(a, b), max(a, b))
        if right == 0.0:
            return self.constant(0.0)
        told = self.operations[a]
        if told.code == Code.TIMES and told.numbers[0] != 0.0:
            a, right = told.parts[0], told.numbers[0] * right
        return a if right == 1.0 else self.node(Code.TIMES, a, numbers=(right,))

    def div(self, a: int, b: int) -> int:
        """Returns a / b."""
        right = self.value(b)
        if right is not None and right != 0.0 and math.frexp(right)[0] == 0.5:
            return self.mul(a, self.constant(1.0 / right))
        return self.node(Code.DIV, a, b)

    def times(self, a: int, number: float) -> int:
        """Returns a times a number."""
        return self.mul(a, self.constant(number))

    def plus(self, a: int, number: float) -> int:
        """Returns a plus a number."""
        return self.add(a, self.constant(number))

    def least(self, a: int, b: int) -> int:
        """Returns the smaller of two."""
        return a if a == b else self.node(Code.MIN, a, b)

    def most(self, a: int, b: int) -> int:
        """Returns the larger of two."""
        return a if a == b else self.node(Code.MAX, a, b)

    def within(self, a: int, low: float = 0.0, high: float = 1.0) -> int:
        """Returns a, bounded by two numbers."""
        return self.least(self.most(a, self.constant(low)), self.constant(high))

    def pick(self, test: int, a: int, b: int) -> int:
        """Returns a where the test is not 0, else b."""
        told = self.value(test)
        if told is not None or a == b:
            return a if told != 0.0 else b
        return self.node(Code.SELECT, test, a, b)

    def blend(self, a: int, b: int, part: int) -> int:
        """Returns a + (b - a) part."""
        return self.add(a, self.mul(self.sub(b, a), part))


def needed_by(graph: Graph, nodes: Iterable[int], known: Container[int] = ()) -> list[int]:
    """Returns all nodes that these need, and these, each behind what it needs; but for what is known, and what only
    that needs."""
    found, open_ = set(), list(nodes)
    while open_:
        node = open_.pop()
        if node not in found and node not in known:
            found.add(node)
            open_.extend(graph.operations[node].parts)
    return sorted(found)


def cost_of(graph: Graph, nodes: Iterable[int]) -> float:
    """Returns about how many nanoseconds a sample of these takes."""
    total = 0.0
    for node in needed_by(graph, nodes):
        told = graph.operations[node]
        total += _octaves_cost(graph, told) if told.code == Code.NOISE else COST[told.code]
        total += ASKED_COST if told.code == Code.PICTURE and told.parts else 0.0
    return total


def _octaves_cost(graph: Graph, told: Operation) -> float:
    """Of octaves near the size of a sample, several blocks must be looked at."""
    width = graph.value(told.parts[2]) or 0.0
    wide = [max(0.0, width * scale) for scale in told.numbers[::5]]
    shared = 0.4 if told.slope else 1.0  # slopes are made beside the value
    return shared * sum(COST[Code.NOISE] if one <= 0.25 else 35.0 + 1.5 * (0.5 * one + 2.0) ** 2 for one in wide)
