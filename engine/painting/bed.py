"""What a layer has of examples, under a stroke that makes it grow or takes it away.

Pixels join regions or leave them as dabs are laid.  What they show follows: `follow` brings the coarsest level up to
date, and whoever has time refines `growth` further; the final pixels depend on neither.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.brush.checks import BrushError
from engine.brush.footprint import Footprint
from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.growth import Growth
from engine.canvas.layers import Group
from engine.canvas.shown import keys_within
from engine.numeric.address import Rect
from engine.texture.example import tiles

_SPREAD = 2  # pixels by which a pixel is seen beyond its place when zoomed in on
Change = Callable[[Growth, Rect, np.ndarray], Growth]  # of the pixels of a mask, bool (h, w) over a rectangle


class Bed:
    """`growth`: as it is now; `seen`: as it was when it was last followed; `level`: of the stroke.

    `begin` makes the stroke's footprint; `change` is what the stroke makes of a growth where it takes pixels.
    """

    def __init__(self, growth: Growth, level: int, begin: Callable[[], Footprint], change: Change) -> None:
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

    @property
    def behind(self) -> bool:
        """Whether dabs were laid that nobody can see yet."""
        return self.growth is not self.seen

    def follow(self, refined: Growth | None = None) -> Rect:
        """Brings what is seen up to date, or takes over the growth further refined: the pixels of the stroke's level
        that look different."""
        before = self.seen
        self.growth = self.seen = growths.previewed(self.growth) if refined is None else refined
        return _around(growths.changed_rects(before, self.seen, self._level))

    @property
    def rect(self) -> Rect:
        """Pixels of the stroke's level outside which all looks as before the stroke."""
        return _around(growths.changed_rects(self.before, self.seen, self._level))

    def over(self, root: Group, name: str) -> Group:
        """The layers with what is seen on the one of that name."""
        if self._over is None or self._over[0] is not root or self._over[1] is not self.seen:
            self._over = root, self.seen, layers.with_growth(root, name, self.seen)
        return self._over[2]


def _around(rects: list[Rect]) -> Rect:
    whole = Rect(0, 0, 0, 0)
    for rect in rects:
        whole = whole.union(rect)
    return whole


def lies_in(growth: Growth, level: int, rect: Rect) -> bool:
    """Whether any of a growth's pixels can be seen in a rectangle of a level."""
    for plot in growth:
        masks = plot.region.masks[0]
        at = rect.zoomed(plot.level - level)
        at = at.grown(_SPREAD) if level > plot.level else at
        for key in keys_within(at, (masks,)):
            place = tiles.rect_of(key)
            if masks[key][0][place.intersect(at).slices(place)].any():
                return True
    return False
