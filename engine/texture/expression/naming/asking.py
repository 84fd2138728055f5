"""What a written texture asks of those of other makers: which of them, at which places, as samples of which width."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from engine.texture.expression.codes import Code
from engine.texture.expression.graph import Graph, Operation
from engine.texture.expression.naming.elsewhere import Elsewhere

AskedPlace = tuple[int, tuple[int, ...]]


@dataclass(frozen=True, slots=True)
class AskedTexture:
    """`other`: the texture; `parts`: the nodes of both places and of the width; `slopes`: 0 for what is there, 1 and 2
    for how fast that changes by either place; `plane`: the first picture that holds the answer."""

    other: Elsewhere
    parts: tuple[int, ...]
    slopes: tuple[int, ...]
    plane: int

    @property
    def planes(self) -> int:
        """Gives the pictures that hold the answer."""
        return self.other.channels * len(self.slopes)

    def picture(self, told: Operation) -> int:
        """Returns the picture that holds what an operation asks."""
        return self.plane + self.slopes.index(told.slope) * self.other.channels + told.key[1]

    def answer(self, u: np.ndarray, v: np.ndarray, width: np.ndarray) -> np.ndarray:
        """Returns the planes of the answer for some samples: float64 (planes, n)."""
        half, still = 0.5 * width, 0.0 * width
        steps = {0: [(still, still)], 1: [(half, still), (-half, still)], 2: [(still, half), (still, -half)]}
        moved = [step for slope in self.slopes for step in steps[slope]]
        across, down = (np.concatenate([place + step[axis] for step in moved]) for axis, place in ((0, u), (1, v)))
        seen = self.other.seen(across, down, np.tile(width, len(moved))).reshape(self.other.channels, -1, u.size)
        out, first = [], 0
        for slope in self.slopes:
            if slope == 0:
                out.append(seen[:, first])
            else:
                out.append((seen[:, first] - seen[:, first + 1]) / np.maximum(width, 1e-30))
            first += len(steps[slope])
        return np.concatenate(out)


def place_asked(told: Operation) -> AskedPlace:
    """Returns which texture an operation asks, and where."""
    return told.key[0], told.parts


def asked_of(graph: Graph, nodes: Iterable[int], first: int = 0) -> Mapping[AskedPlace, AskedTexture]:
    """Returns what some nodes ask, in an order in which each asks of those before it at most; `first`: the plane from
    which on the answers are."""
    slopes: dict[AskedPlace, set[int]] = {}
    for node in sorted(nodes):
        told = graph.operations[node]
        if told.code == Code.PICTURE and told.parts:
            slopes.setdefault(place_asked(told), set()).add(told.slope)
    found: dict[AskedPlace, AskedTexture] = {}
    for place in sorted(slopes, key=lambda asked: max(asked[1])):
        one = AskedTexture(graph.elsewhere[place[0]], place[1], tuple(sorted(slopes[place])), first)
        found[place] = one
        first += one.planes
    return found
