"""How much fills cover of a place: found again from the painting that they were done on."""

from __future__ import annotations

import numpy as np

from engine.brush.mask import Coverage
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.fill_command import place_of
from engine.painting.value import Refusal
from engine.session.here.chosen import UNKNOWN, Choices, Held
from engine.session.here.lineage import Laid
from engine.strokes.coverage_at import carried_to
from engine.strokes.filling import covered_by, opacity_of

_KEPT = 16  # coverages
_MOST = 1 << 22  # pixels of a fill that are looked at for a place
_UNKNOWN = np.float32(0.5)  # of a place that a fill may have covered


class Poured:
    """Finds what fills covered; the last ones are kept.  Where the painting that one of like colour was done on is not
    at hand, nobody knows whether it covered what lies in its bounds: there it counts for half."""

    def __init__(self, held: Held, choices: Choices, cache: TileCache | None) -> None:
        self._held, self._choices, self._cache = held, choices, cache
        self._known: dict[int, tuple[c.Fill, Coverage | None]] = {}  # by the index of the step
        self._bounds: dict[int, tuple[Laid, Rect]] = {}

    def stroke(self, laid: Laid, fill: c.Fill) -> tuple[c.Stroke, Rect]:
        """Returns a stroke that stands for a fill, and the bounds of what that covers."""
        level, rect = place_of(fill)
        looked_at = laid.frame.zoomed(level) if rect is None else rect
        coverage = self._coverage(laid, fill) if fill.like is not None else None
        if fill.like is None:
            looked_at = self._selected(laid, level)
        point = np.zeros((1, 6))
        point[0, 2] = 1.0
        corner = (looked_at.x0, looked_at.y0)
        stroke = c.Stroke(level, corner, point, fill.brush, fill.layer, extra=fill.extra)
        return stroke, looked_at if coverage is None else coverage.rect

    def over(self, laid: Laid, fill: c.Fill, level: int, rect: Rect) -> np.ndarray | None:
        """Returns how much of each pixel a fill covers: float32 (h, w) over `rect` of a level; None for nothing."""
        whole = np.ones((rect.height, rect.width), np.float32)
        part = 1.0 if laid.limit is None else self._choices.part(laid.limit, level, rect)
        if fill.like is None:
            grows = fill.brush.row.grows
            return whole * (np.greater_equal(part, _UNKNOWN) if grows else opacity_of(fill.brush) * np.float32(part))
        coverage, own = self._coverage(laid, fill), place_of(fill)[0]
        if coverage is None or (own > level and rect.zoomed(own - level).area > _MOST):
            return whole * (_UNKNOWN * np.float32(part))
        found = carried_to(lambda there: _raster(coverage, there), own, level, rect)
        return found if found.any() else None

    def _selected(self, laid: Laid, level: int) -> Rect:
        """Returns the bounds of what was selected."""
        known = self._bounds.get(laid.step.index)
        if known is None or known[0] is not laid:
            found = self._choices.value(laid.limit)
            bounds = laid.frame.zoomed(level)
            if found is not None and found is not UNKNOWN:
                bounds = found.pyramid.bounds(level)
            known = self._bounds[laid.step.index] = laid, bounds
        return known[1]

    def _coverage(self, laid: Laid, fill: c.Fill) -> Coverage | None:
        known = self._known.get(laid.step.index)
        if known is None or known[0] is not fill:
            before = self._held(laid.step.number - 1)
            try:
                found = None if before is None else covered_by(before, fill, self._cache)
            except Refusal:  # the log is of another painting
                found = None
            while len(self._known) >= _KEPT:
                self._known.pop(next(iter(self._known)))
            known = self._known[laid.step.index] = fill, found
        return known[1]


def _raster(coverage: Coverage, rect: Rect) -> np.ndarray:
    out = np.zeros((rect.height, rect.width), np.float32)
    for key in rect.tiles(coverage.level):
        part = key.rect.intersect(rect)
        out[part.slices(rect)] = coverage.on_grid(key)[part.slices(key.rect)]
    return out
