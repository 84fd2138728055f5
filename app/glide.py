"""The smooth zoom: the view glides to a target zoom while one place stays under one point of the screen."""

from __future__ import annotations

import math
from dataclasses import replace

from app.view import Place, View, distance

PACE = 0.055  # seconds in which the rest of the way falls to 1/e
NEAR = 1.0 / 512  # levels: close enough to arrive


class Glide:
    """A zoom on its way.  Where it ends does not depend on the frames it took."""

    def __init__(self) -> None:
        self._target: tuple[int, float] | None = None
        self._anchor: tuple[Place, float, float] | None = None

    @property
    def moving(self) -> bool:
        return self._target is not None

    def zoom(self, view: View, levels: float, x: float, y: float) -> None:
        """Zooms `levels` farther than the present target, about the screen point (x, y)."""
        level, fraction = self._target or (view.level, view.fraction)
        whole = math.floor(fraction + levels)
        self._target = level + whole, fraction + levels - whole
        if self._anchor is None or self._anchor[1:] != (x, y):
            self._anchor = view.to_canvas(x, y), x, y

    def to(self, view: View, level: int, fraction: float, x: float, y: float) -> None:
        """Zooms to (level, fraction) about the screen point (x, y)."""
        self.stop()
        self.zoom(view, distance(view, level, fraction), x, y)
        self._target = level, fraction

    def stop(self) -> None:
        """The view is moved by something else: the place under the pointer is no longer the one held."""
        self._target = self._anchor = None

    def step(self, view: View, seconds: float) -> View:
        """The view `seconds` later."""
        if self._target is None or self._anchor is None:
            return view
        level, fraction = self._target
        rest = distance(view, level, fraction)
        if abs(rest) < NEAR:
            view, self._target = replace(view, level=level, fraction=fraction), None
        else:
            view = view.zoomed(rest * (1 - math.exp(-seconds / PACE)))
        return view.held(*self._anchor)
