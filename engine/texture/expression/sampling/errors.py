"""How far what a written texture shows of a pixel is from the mean over it: nodes beside those of its values.

What is not exact about everywhere is noted, and measured (`sample_trial`); what jumps, or bends at edges, has an
error at those pixels alone.
"""

from __future__ import annotations

from collections.abc import Callable

from engine.texture.expression.codes import Code
from engine.texture.expression.graph import NO_ERROR, Graph

POINT_SIDE, JUMP_SIDE = 2, 4  # samples along a pixel where a mean is not exact, and where it jumps
FEW_FROM, MANY_FROM = 0.01, 0.045  # errors of a mean, from which on four samples are taken, and sixteen
_SLIGHT = 0.2 * FEW_FROM  # of one part; there may be many
_BEYOND = 0.75  # of its width: how far what a sample sees of an edge may lie away
_GREY = 10.0  # wholes within a sample, of which each part of it has too many itself
_NARROW = 1e-9


class Errors:
    """Makes the errors of one texture; `rough`: whether something of it is not exact."""

    def __init__(self, graph: Graph, width: Callable[[int], int]) -> None:
        self._graph, self._width, self.rough = graph, width, False

    def flat(self, error: float) -> int:
        """Notes an error that is about the same everywhere: how large it is indeed is measured.  Returns no node."""
        self.rough = self.rough or error >= _SLIGHT
        return NO_ERROR

    def worst(self, *errors: int) -> int:
        """Returns the largest of some errors."""
        found = sorted({error for error in errors if error != NO_ERROR})
        out = found[0] if found else NO_ERROR
        for error in found[1:]:
            out = self._graph.most(out, error)
        return out

    def weighed(self, error: int, *weights: int) -> int:
        """Returns an error times the largest of some weights, whatever their signs."""
        if error == NO_ERROR:
            return NO_ERROR
        told = [self._graph.value(weight) for weight in weights]
        if None not in told:
            return self._graph.times(error, max(abs(one) for one in told if one is not None))
        weight = self._graph.node(Code.ABS, weights[0])
        for one in weights[1:]:
            weight = self._graph.most(weight, self._graph.node(Code.ABS, one))
        return self._graph.mul(error, weight)

    def bounded(self, error: int, scale: float = 1.0) -> int:
        """Returns an error times a number, but no more than 1."""
        return (
            NO_ERROR
            if error == NO_ERROR
            else self._graph.least(self._graph.times(error, scale), self._graph.constant(1.0))
        )

    def local(self, error: float) -> int:
        """Notes an error of what lies at some places only; returns one for which a few samples are taken there."""
        self.flat(error)
        return self._graph.constant(FEW_FROM * 1.5) if error >= FEW_FROM else NO_ERROR

    def at_edge(self, node: int, noted: float, given: int) -> int:
        """Returns the error of what changes where something passes through 0, where the sample sees that edge: one that
        is noted, and what follows of the one that is given."""
        own = self.local(noted)
        if own == NO_ERROR and given == NO_ERROR:
            return NO_ERROR
        graph, wide = self._graph, self._graph.most(self._width(node), self._graph.constant(_NARROW))
        error = self.worst(own, self.bounded(NO_ERROR if given == NO_ERROR else graph.div(given, wide)))
        reach = graph.add(graph.times(wide, _BEYOND), given)
        return graph.pick(graph.node(Code.LESS, graph.node(Code.ABS, node), reach), error, NO_ERROR)

    def jump(self, node: int) -> int:
        """Returns 1 where a whole number lies within the sample, else 0."""
        graph, wide = self._graph, self._width(node)
        told = graph.value(wide)
        if told is not None and (told == 0.0 or told > _GREY):
            return NO_ERROR
        ends = [graph.node(Code.FLOOR, graph.add(node, graph.times(wide, way))) for way in (_BEYOND, -_BEYOND)]
        return graph.least(graph.sub(*ends), graph.constant(1.0))
