"""How much a part of a written texture varies within a sample: standard deviations, about, in its own units.

`within`: in all, from which follows how many samples a mean needs; `lost`: what of that neither value nor slope tells,
as of noise that is too fine for the sample: by that much a threshold is softer, and a pixel of specks grey.
Sources, as noise, tell theirs; sums and multiples follow from these.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

from engine.numeric import elementary
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import Graph, Operation, needed_by

_EVEN = 1.0 / math.sqrt(12.0)  # of what rises evenly by 1
_TYPICAL = 0.6  # of a factor
_SPREADS_KEPT = 1 << 14


class Spread(NamedTuple):
    """Standard deviations within a sample."""

    within: float
    lost: float

    @property
    def within_squared(self) -> float:
        """Gives the variance in all."""
        return self.within * self.within

    @property
    def lost_squared(self) -> float:
        """Gives the variance of what is lost."""
        return self.lost * self.lost


_LEVEL = Spread(0.0, 0.0)


@lru_cache(_SPREADS_KEPT)
def spread_within(deviation: float, width: float, half: float, power: float, seen: tuple[float, float]) -> Spread:
    """Returns the spread of something whose variance within a pixel of that width is that of all of it where the width
    is far above `half`, falling as a power; its slope tells all up to the first of `seen`, and nothing from the second
    on."""
    gone = 1.0 - 1.0 / (1.0 + elementary.power(width / half, power))
    blind = min(max((width - seen[0]) / (seen[1] - seen[0]), 0.0), 1.0)
    return Spread(deviation * math.sqrt(gone), deviation * math.sqrt(gone * blind))


def summed_up(spreads: list[Spread]) -> Spread:
    """Returns the spread of a sum."""
    within, lost = (sum(one[n] * one[n] for one in spreads) for n in (0, 1))
    return Spread(math.sqrt(within), math.sqrt(lost))


def part_of_one(spread: Spread) -> Spread:
    """Returns the spread of what lies between 0 and 1, made of something with that spread."""
    return Spread(min(spread.within, _EVEN), min(spread.lost, _EVEN))


class Spreads:
    """Remembers the spreads of a graph's nodes; `told`: those of sources; `width`: of a sample."""

    def __init__(self, graph: Graph, width: float) -> None:
        even = Spread(width * _EVEN, 0.0)
        self._graph, self.told = graph, dict.fromkeys(graph.ways, even)

    def of(self, target: int) -> Spread:
        """Returns the spread of a node."""
        known = self.told
        if target not in known:
            for node in needed_by(self._graph, [target], known):
                told = self._graph.operations[node]
                known[node] = self._made(told, [known[part] for part in told.parts])
        return known[target]

    def _made(self, told: Operation, parts: list[Spread]) -> Spread:
        if not parts or told.code in (Code.LESS, Code.LESS_EQUAL, Code.FLOOR, Code.WIDTH):
            return _LEVEL
        if told.code in (Code.ADD, Code.SUB):
            return summed_up(parts)
        if told.code == Code.TIMES:
            scale = abs(told.numbers[0])
            return Spread(parts[0].within * scale, parts[0].lost * scale)
        if told.code == Code.DIV:
            by = self._graph.value(told.parts[1])
            return _scaled(parts[0], 1.0 / abs(by)) if by else summed_up(parts)
        if told.code == Code.MUL:
            return _scaled(Spread(parts[0].within + parts[1].within, parts[0].lost + parts[1].lost), _TYPICAL)
        if told.code == Code.RAMP:
            return _scaled(parts[0], steepest(told.numbers))
        return Spread(max(part.within for part in parts), max(part.lost for part in parts))


def _scaled(spread: Spread, scale: float) -> Spread:
    return Spread(spread.within * scale, spread.lost * scale)


def steepest(knots: tuple[float, ...]) -> float:
    """Returns the steepest slope of a piecewise linear function: places, then values."""
    places, values = knots[: len(knots) // 2], knots[len(knots) // 2 :]
    steps = zip(places, places[1:], values, values[1:], strict=False)
    return max((abs(d - c) / (b - a) for a, b, c, d in steps), default=0.0)
