"""What is seen of strokes that wait for their kernels: plain paint in their colour, above the picture.

Plain paint needs no kernel (`numeric.stand_in`).  A brush that has nothing else looks in the sketch as it will.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from engine.brush.checks import BrushError
from engine.brush.settings import Brush
from engine.kernel_cache import NotCompiled, refusing
from engine.numeric.address import Rect
from engine.painting.points import rounded
from engine.painting.value import Painting
from engine.strokes.paint_stroke import LiveStroke
from engine.studio import requests as q

_KEPT = ("radius", "hardness", "opacity", "flow", "spacing", "colour", "dynamics")


class Sketch:
    """The strokes of requests, in their order.  All calls come from one thread."""

    def __init__(self) -> None:
        self._strokes: list[tuple[LiveStroke, bool]] = []  # and whether it erases
        self._open = False  # the last one has its pen down

    def begin(self, requests: Iterable[q.Request]) -> None:
        """Shows the strokes of these, and no others."""
        self._strokes, self._open = [], False
        for request in requests:
            self.add(request)

    def add(self, request: q.Request) -> tuple[int, Rect] | None:
        """Returns one request more; the level and the pixels that look different by it."""
        match request:
            case q.Begin():
                row = request.brush.row
                seen = request.layer is None  # one on another layer is seen elsewhere, by placements
                self._open = seen and (row.lays_ink or row.takes_away)
                if self._open:
                    stroke = LiveStroke(
                        Painting(), request.level, request.origin, _plain(request.brush), copies=request.copies
                    )
                    self._strokes.append((stroke, row.takes_away))
            case q.Points() if self._open:
                stroke = self._strokes[-1][0]
                try:
                    with refusing():
                        return stroke.level, stroke.add(rounded(request.points))
                except (BrushError, NotCompiled):
                    self._open = False  # it will tell by itself
            case q.Finish():
                self._open = False
            case q.Abandon() if self._open:
                self._open = False
                self._strokes.pop()
        return None

    def rects(self, level: int) -> list[Rect]:
        """Returns the pixels of a level that they may cover."""
        return [stroke.rect for stroke, _ in self._strokes if stroke.level == level and not stroke.empty]

    def over(self, level: int, rect: Rect, pixels: np.ndarray) -> np.ndarray:
        """Returns a picture of a rectangle, float32 (4, h, w), premultiplied, with them above it."""
        for stroke, erases in self._strokes:
            if stroke.level == level and not stroke.empty and stroke.rect.meets(rect):
                paint = stroke.preview(rect).rgba
                pixels = pixels * (1.0 - paint[3]) + (0.0 if erases else paint)
        return pixels


def _plain(brush: Brush) -> Brush:
    """Returns a brush without texture of any sort."""
    return Brush(**{name: getattr(brush, name) for name in _KEPT})
