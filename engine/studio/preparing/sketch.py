"""What is seen of strokes that wait for their kernels: plain paint in their colour, above the picture.

Plain paint needs no kernel (`numeric.stand_in`).  A brush that has nothing else looks in the sketch as it will.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress

import numpy as np

from engine.brush.checks import BrushError
from engine.brush.settings import Brush
from engine.canvas.selecting.selection import Selection
from engine.kernel_cache import NotCompiled, refusing
from engine.numeric.address import Rect, TileKey
from engine.painting.points import rounded
from engine.painting.value import Painting
from engine.strokes.paint_stroke import LiveStroke
from engine.studio import requests as q

_FEW = 8  # strokes that are kept as such; what those before them come to is kept as pixels
_Sheet = dict[TileKey, np.ndarray]  # float32 (5, 128, 128): paint, premultiplied, and how much stays of what lies below
_KEPT = ("radius", "hardness", "opacity", "flow", "spacing", "colour", "dynamics")


class Sketch:
    """The strokes of requests, in their order, each within what `selection` tells is selected.  All calls come from one
    thread."""

    def __init__(self, selection: Callable[[], Selection | None] = lambda: None) -> None:
        self._selection = selection
        self._strokes: list[tuple[LiveStroke, bool]] = []  # and whether it erases
        self._sheets: dict[int, _Sheet] = {}  # by level, what strokes before these come to
        self._rects: dict[int, list[Rect]] = {}  # and where they lie
        self._open = False  # the last one has its pen down

    def begin(self, requests: Iterable[q.Request]) -> None:
        """Shows the strokes of these, and no others."""
        self._strokes, self._sheets, self._rects, self._open = [], {}, {}, False
        for request in requests:
            self.add(request)

    def add(self, request: q.Request) -> tuple[int, Rect] | None:
        """Returns one request more; the level and the pixels that look different by it."""
        match request:
            case q.Begin():
                row = request.brush.row
                seen = request.layer is None and not request.onto  # one on another layer is seen elsewhere
                self._open = seen and (row.lays_ink or row.takes_away)
                while len(self._strokes) >= _FEW:
                    with suppress(NotCompiled):  # it is seen once it is painted
                        self._lay(*self._strokes.pop(0))
                if self._open:
                    ground = Painting(selection=self._selection())
                    stroke = LiveStroke(
                        ground, request.level, request.origin, _plain(request.brush), copies=request.copies
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
        laid = [stroke.rect for stroke, _ in self._strokes if stroke.level == level and not stroke.empty]
        return self._rects.get(level, []) + laid

    def over(self, level: int, rect: Rect, pixels: np.ndarray) -> np.ndarray:
        """Returns a picture of a rectangle, float32 (4, h, w), premultiplied, with them above it."""
        sheets = [(key, found) for key, found in self._sheets.get(level, {}).items() if key.rect.meets(rect)]
        pixels = pixels.copy() if sheets else pixels
        for key, sheet in sheets:
            part = key.rect.intersect(rect)
            seen, own = pixels[:, *part.slices(rect)], sheet[:, *part.slices(key.rect)]
            seen[...] = seen * own[4] + own[:4]
        for stroke, erases in self._strokes:
            if stroke.level == level and not stroke.empty and stroke.rect.meets(rect):
                paint = stroke.preview(rect).rgba
                pixels = pixels * (1.0 - paint[3]) + (0.0 if erases else paint)
        return pixels

    def _lay(self, stroke: LiveStroke, erases: bool) -> None:
        """Lays a stroke over what those before it come to: a mask each, while kernels are compiled for a minute, would
        take hundreds of megabytes."""
        if stroke.empty:
            return
        self._rects.setdefault(stroke.level, []).append(stroke.rect)
        sheet = self._sheets.setdefault(stroke.level, {})
        for key in stroke.rect.tiles(stroke.level):
            paint = stroke.preview(key.rect).rgba
            if paint[3].any():
                old, keep = sheet.get(key), 1.0 - paint[3]
                new = np.concatenate([np.zeros_like(paint) if erases else paint, keep[None]])
                if old is not None:
                    new[:4] += old[:4] * keep
                    new[4] *= old[4]
                sheet[key] = new


def _plain(brush: Brush) -> Brush:
    """Returns a brush without texture of any sort."""
    return Brush(**{name: getattr(brush, name) for name in _KEPT})
