"""The painting with the stroke in hand on it, so that the land shows it while the pen is down."""

from __future__ import annotations

from collections.abc import Callable

from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.painting.difference import Areas, areas
from engine.painting.value import Painting
from engine.strokes.example_stroke import Live
from engine.studio.easel import Easel

_SLOW = 0.05  # seconds; a stroke that takes longer to be laid down is so for a third of the time at most
_REACH = 8  # pixels of the coarser of two levels that a change goes beyond where it was made


class StrokeSeen(Owned):
    """It belongs to the engine's thread.  `clock` tells seconds."""

    def __init__(self, easel: Easel, clock: Callable[[], float]) -> None:
        self._easel, self._clock = easel, clock
        self._live: Live | None = None  # whose stroke lies on `_painting`
        self._painting: Painting | None = None
        self._before: Painting | None = None  # what was given out before, of the same stroke
        self._count, self._next = 0, 0.0
        self._grown = Rect(0, 0, 0, 0)

    def painting(self) -> Painting:
        """Returns the painting as the land is to show it: the same object as long as nothing is news.  What is grown
        of an example comes with its end alone."""
        live = self._easel.live
        if live is None or live.empty or live.bed is not None:
            self._live = self._painting = self._before = None
            return self._easel.session.painting
        if self._painting is not None and live is self._live:
            begins = self._clock()
            if live.count == self._count or begins < self._next:
                return self._painting
        begins = self._clock()
        self._before = self._painting if live is self._live else None
        self._live, self._count = live, live.count
        self._painting = live.commit()
        took = self._clock() - begins
        self._next = begins + 3.0 * took if took > _SLOW else 0.0
        self._grown = self._easel.taken_growth()
        return self._painting

    def between(self, before: Painting, after: Painting) -> Areas:
        """Tells where two paintings differ, that were given out one after the other: of one stroke, where it grew."""
        if self._before is not before or self._painting is not after or self._live is None:
            return areas(before, after)
        level, grown = self._live.level, self._grown

        def where(at: int) -> list[Rect]:
            if at >= level:
                return [grown.grown(_REACH).zoomed(at - level)]
            return [grown.zoomed(at - level).grown(_REACH)]

        return where
