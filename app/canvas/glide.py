"""The smooth zoom: the view glides to a target zoom while one place stays under one point of the screen."""

from __future__ import annotations

import math
from dataclasses import replace

from app.canvas.standpoint import Standpoint
from app.canvas.travel import Travel
from app.canvas.view import Place, View, distance

PACE = 0.055  # seconds in which the rest of the way falls to 1/e
_NEAR = 1.0 / 512  # levels: close enough to arrive


class Glide:
    """A zoom on its way.  Where it ends does not depend on the frames it took."""

    def __init__(self) -> None:
        self._target: tuple[int, float] | None = None
        self._anchor: tuple[Place, float, float] | None = None
        self._left = 0.0  # seconds that a flight still takes
        self._travel: Travel | None = None
        self._gone = 0.0  # seconds of it
        self._middle = (0.0, 0.0)

    @property
    def moving(self) -> bool:
        """Tells whether the view is on its way."""
        return self._target is not None or self._travel is not None

    def zoom(self, view: View, levels: float, x: float, y: float) -> None:
        """Zooms `levels` farther than the present target, about the screen point (x, y)."""
        self._travel = None
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

    def fly(self, view: View, there: View, seconds: float) -> View:
        """Goes to the view `there` in a time; the view to begin with.  Both have the same size, angle and side.

        The one place that both show at the same point of the screen is held.  Where there is none near, the way is
        a jump.
        """
        self.stop()
        ratio = 2.0 ** max(-60.0, min(60.0, -distance(view, there.level, there.fraction)))
        if abs(1 - ratio) < 0.02 or seconds <= 0:
            return there
        x, y = view.to_screen(there.centre)
        mx, my = view.width / 2, view.height / 2
        x, y = mx + (x - mx) / (1 - ratio), my + (y - my) / (1 - ratio)
        if math.hypot(x - mx, y - my) > 1e7:
            return there
        self._anchor = there.to_canvas(x, y), x, y
        self._target = there.level, there.fraction
        self._left = seconds
        return view

    def travel(self, view: View, there: Standpoint, x: float, y: float) -> View:
        """Flies to a standpoint, of which the middle is the screen point (x, y); the view to begin with."""
        self.stop()
        travel = Travel(Standpoint.of(view, x, y), there, min(view.width, view.height))
        self._travel, self._gone, self._middle = travel, 0.0, (x, y)
        return view

    def stop(self) -> None:
        """The view is moved by something else: the place under the pointer is no longer the one held."""
        self._target = self._anchor = self._travel = None
        self._left = 0.0

    def land(self) -> None:
        """A flight ends where it is; a zoom goes on."""
        self._travel = None

    def step(self, view: View, seconds: float) -> View:
        """Returns the view `seconds` later."""
        if self._travel is not None:
            self._gone += seconds
            part = self._gone / self._travel.seconds
            view = self._travel.at(part).seen_from(view, *self._middle)
            self._travel = self._travel if part < 1.0 else None
            return view
        if self._target is None or self._anchor is None:
            return view
        level, fraction = self._target
        rest = distance(view, level, fraction)
        if self._left > seconds:
            view = view.zoomed(rest * seconds / self._left)
            self._left -= seconds
        elif abs(rest) < _NEAR or self._left > 0:
            view, self._target, self._left = replace(view, level=level, fraction=fraction), None, 0.0
        else:
            view = view.zoomed(rest * (1 - math.exp(-seconds / PACE)))
        return view.held(*self._anchor)
