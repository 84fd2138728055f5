"""How much fills cover of a place: found again from the painting that they were done on."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.brush.mask import Coverage
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.fill_command import place_of
from engine.painting.value import Painting, Refusal
from engine.session.steps import LoggedStep
from engine.strokes.coverage_at import carried_to
from engine.strokes.filling import covered_by

Before = Callable[[LoggedStep], "Painting | None"]  # the painting that a step was done on, where it is at hand
_KEPT = 16  # coverages
_MOST = 1 << 22  # pixels of a fill that are looked at for a place
_UNKNOWN = np.float32(0.5)  # of a place that a fill may have covered


class Poured:
    """Finds what fills covered; the last ones are kept.  Of one whose painting is not at hand nobody knows whether it
    covered what lies in its bounds: there it counts for half."""

    def __init__(self, before: Before, cache: TileCache | None) -> None:
        self._before, self._cache = before, cache
        self._known: dict[int, tuple[c.Fill, Coverage | None]] = {}

    def stroke(self, step: LoggedStep, fill: c.Fill, frame: Rect) -> tuple[c.Stroke, Rect]:
        """Returns a stroke that stands for a fill, and the bounds of what that covers."""
        coverage, (level, rect) = self._coverage(step, fill), place_of(fill)
        looked_at = frame.zoomed(level) if rect is None else rect
        point = np.zeros((1, 6))
        point[0, 2] = 1.0
        corner = (looked_at.x0, looked_at.y0)
        stroke = c.Stroke(level, corner, point, fill.brush, fill.layer, extra=fill.extra)
        return stroke, looked_at if coverage is None else coverage.rect

    def over(self, step: LoggedStep, fill: c.Fill, level: int, rect: Rect) -> np.ndarray | None:
        """Returns how much of each pixel a fill covers: float32 (h, w) over `rect` of a level; None for nothing."""
        coverage, own = self._coverage(step, fill), place_of(fill)[0]
        if coverage is None or (own > level and rect.zoomed(own - level).area > _MOST):
            return np.full((rect.height, rect.width), _UNKNOWN)
        found = carried_to(lambda there: _raster(coverage, there), own, level, rect)
        return found if found.any() else None

    def _coverage(self, step: LoggedStep, fill: c.Fill) -> Coverage | None:
        known = self._known.get(step.index)
        if known is None or known[0] is not fill:
            before = self._before(step)
            try:
                found = None if before is None else covered_by(before, fill, self._cache)
            except Refusal:  # the log is of another painting
                found = None
            while len(self._known) >= _KEPT:
                self._known.pop(next(iter(self._known)))
            known = self._known[step.index] = fill, found
        return known[1]


def _raster(coverage: Coverage, rect: Rect) -> np.ndarray:
    out = np.zeros((rect.height, rect.width), np.float32)
    for key in rect.tiles(coverage.level):
        part = key.rect.intersect(rect)
        out[part.slices(rect)] = coverage.on_grid(key)[part.slices(key.rect)]
    return out
