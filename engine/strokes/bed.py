"""What a layer has of examples, under a stroke that makes it grow or takes it away.

Pixels join regions or leave them as dabs are laid.  What they show follows: `follow` brings the coarsest level up to
date, and whoever has time refines `growth` further; the final pixels depend on neither.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from engine.brush.checks import BrushError
from engine.brush.footprint import Footprint
from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.grown.shown import keys_within
from engine.canvas.growth import Growth
from engine.canvas.layers import Group
from engine.numeric.address import Rect
from engine.numeric.elementary import log2
from engine.strokes.pen_trail import PenTrail
from engine.texture.example import tiles

_LEAST_SQUARE, _SQUARES = 16, 3  # px along a square; 2^3 squares and less to a radius
_SPREAD = 2  # pixels by which a pixel is seen beyond its place when zoomed in on
Change = Callable[[Growth, Rect, np.ndarray], Growth]  # of the pixels of a mask, bool (h, w) over a rectangle


class Bed:
    """`growth`: as it is now; `seen`: as it was when it was last followed; `level`: of the stroke.

    `begin` makes the stroke's footprint; `change` is what the stroke makes of a growth where it takes pixels.
    """

    def __init__(self, growth: Growth, level: int, begin: Callable[[], Footprint | PenTrail], change: Change) -> None:
        self.before = self.growth = self.seen = growth
        self._level = level
        self._begin, self._footprint, self._change = begin, begin(), change
        self._laid: list[np.ndarray] = []
        self._over: tuple[Group, Growth, Group] | None = None

    def lay(self, points: np.ndarray) -> None:
        """More points, float64 (n, 6), of the stroke.  BrushError if it becomes too large: all is as before."""
        try:
            parts = self._footprint.lay(points)
        except BrushError:
            self._footprint = self._begin()
            for kept in self._laid:
                self._footprint.lay(kept)
            raise
        for rect, mask in parts:
            self.growth = self._change(self.growth, rect, mask)
        self._laid.append(points)

    def finish(self) -> None:
        """Takes what a stroke that ends where it began takes."""
        for rect, mask in self._footprint.rest():
            self.growth = self._change(self.growth, rect, mask)

    @property
    def behind(self) -> bool:
        """Tells whether dabs were laid that nobody can see yet."""
        return self.growth is not self.seen

    def follow(self, refined: Growth | None = None) -> Rect:
        """Brings what is seen up to date, or takes over the growth further refined: the pixels of the stroke's level
        that look different."""
        before = self.seen
        self.growth = self.seen = growths.previewed(self.growth) if refined is None else refined
        return _around(growths.changed_rects(before, self.seen, self._level))

    @property
    def rect(self) -> Rect:
        """Returns pixels of the stroke's level outside which all looks as before the stroke."""
        return _around(growths.changed_rects(self.before, self.seen, self._level))

    def over(self, root: Group, name: str) -> Group:
        """Returns the layers with what is seen on the one of that name."""
        if self._over is None or self._over[0] is not root or self._over[1] is not self.seen:
            self._over = root, self.seen, layers.with_growth(root, name, self.seen)
        return self._over[2]


def _around(rects: list[Rect]) -> Rect:
    whole = Rect(0, 0, 0, 0)
    for rect in rects:
        whole = whole.union(rect)
    return whole


class Meeting:
    """Whether a stroke meets what is painted with examples: by squares of its dabs, so that it does not matter how many
    of them come at once."""

    def __init__(
        self, level: int, origin: tuple[int, int], radius: float, limited: Callable[[Rect], bool] | None = None
    ) -> None:
        self._level, self._origin = level, origin
        self._side = max(_LEAST_SQUARE, 1 << math.ceil(log2(radius + 1.0)) >> _SQUARES)
        self._limited = limited  # whether any pixel of a rectangle of the level may change
        self._known: set[tuple[int, int]] = set()

    def any(self, growth: Growth, dabs: np.ndarray, spread: int) -> bool:
        """Tells whether some of these dabs, float64 (n, 6), which reach `spread` pixels beyond their radius, do."""
        side, reach = self._side, dabs[:, 2:3] + (1.0 + spread)
        places = dabs[:, :2][dabs[:, 3] > 0.0], reach[dabs[:, 3] > 0.0]
        first = np.floor((places[0] - places[1]) / side).astype(np.int64)
        last = np.floor((places[0] + places[1]) / side).astype(np.int64)
        for (x0, y0), (x1, y1) in zip(first.tolist(), last.tolist(), strict=True):
            for y in range(y0, y1 + 1):
                for x in range(x0, x1 + 1):
                    if (x, y) in self._known:
                        continue
                    self._known.add((x, y))
                    corner = self._origin[0] + x * side, self._origin[1] + y * side
                    square = Rect.at(*corner, side, side)
                    if self._limited is not None and not self._limited(square):
                        continue
                    if lies_in(growth, self._level, square):
                        return True
        return False


def lies_in(growth: Growth, level: int, rect: Rect) -> bool:
    """Tells whether any of a growth's pixels can be seen in a rectangle of a level."""
    for plot in growth:
        masks = plot.region.masks[0]
        at = rect.zoomed(plot.level - level)
        at = at.grown(_SPREAD) if level > plot.level else at
        for key in keys_within(at, (masks,)):
            place = tiles.rect_of(key)
            if masks[key].data[0][place.intersect(at).slices(place)].any():
                return True
    return False
