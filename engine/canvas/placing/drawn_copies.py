"""How nodes are drawn that hold copies of one another: what of them is asked for, and what is known by then."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, NamedTuple, Protocol, TypeVar

import numpy as np

from engine.canvas.placing.placement import Placement
from engine.canvas.placing.through import Seen
from engine.numeric.address import Rect


class Laid(Protocol):
    """What is asked of a composite's step: whether it is laid over what is below or cuts it, and how opaque."""

    @property
    def over(self) -> bool:
        """Tells whether the operator is src-over."""

    @property
    def cuts(self) -> bool:
        """Tells whether all that it leaves of what is below is what lies within its own alpha."""

    @property
    def opacity(self) -> np.float32:
        """Gives its opacity, 0..1."""


Shown = int | None  # the id of a node that is shown; None: the whole painting
Copies = Mapping[Shown, Sequence[Placement]]  # by node, those in it of such nodes
SourceT = TypeVar("SourceT")  # a source of a step
FoundT = TypeVar("FoundT")  # what was found of all


class Above(NamedTuple):
    """What lies above a source: how much of it all that is around leaves, and steps with their pixels, (4, n), where
    they are of one source."""

    share: float
    found: tuple[Sequence[tuple[Laid, object]], ...]


ABOVE_ALL = Above(1.0, ())
Asking = Generator[
    tuple[SourceT, "Above | None"], "np.ndarray | None", FoundT
]  # also for what lies above, where that is known


@dataclass(frozen=True)
class Drawing(Generic[SourceT, FoundT]):
    """How the nodes are drawn whose copies these are.

    `asking`: asks for the pixels of a node's sources, from the top down; returns what was found.  `copy`: the placement
    if a source is a copy of one of the nodes.  `read`: the pixels of one that is none: float32 (4, h, w), None where it
    is empty.  `drawn`: what was found composited, likewise, not to be written to.
    """

    asking: Callable[[Shown], Asking[SourceT, FoundT]]
    copy: Callable[[SourceT], Placement | None]
    read: Callable[[SourceT, int, Rect, Seen], np.ndarray | None]
    drawn: Callable[[FoundT, Rect], np.ndarray | None]
