"""A height map laid over a rectangle of the canvas: its holes closed, its heights between its pixels, and how rough it
is at its finest, so that rock below its pixels goes on as it does.

Sums, products, quotients and roots alone, in one order: the same bits everywhere.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from engine.numeric.address import Rect
from engine.terrain.layer_heights import expanded

_SPREAD = 3  # halvings of how rough it is, so that this is a matter of 8 pixels around
_AT_ONCE = 1 << 8  # rows of a map, an even number: the temporary arrays of a whole one take much memory
_SMALLEST = 4  # pixels of a side from which on it may be halved


def filled_in(heights: np.ndarray) -> np.ndarray:
    """Returns heights (h, w), float64, with smooth ones where there is none (NaN): from the nearest that are known, at
    half the size, a quarter, and so on.  There is one at least."""
    known = ~np.isnan(heights)
    if known.all():
        return heights
    seen, weight = np.where(known, heights, 0.0), known.astype(np.float64)
    sums, weights = _quarter_sums(seen), _quarter_sums(weight)
    there = weights > 0.0
    coarse = np.where(there, sums / np.where(there, weights, 1.0), np.nan)
    return np.where(known, heights, _doubled(filled_in(coarse), heights.shape))


def _quarter_sums(values: np.ndarray) -> np.ndarray:
    """Returns the sums of 2 x 2 values; what is missing at an odd side counts 0."""
    h, w = values.shape
    values = np.pad(values, ((0, h % 2), (0, w % 2)))
    out: np.ndarray = (values[::2, ::2] + values[1::2, ::2]) + (values[::2, 1::2] + values[1::2, 1::2])
    return out


def _halved(values: np.ndarray) -> np.ndarray:
    """Returns the means of 2 x 2 values; the last row or column of an odd side twice."""
    h, w = values.shape
    return _quarter_sums(np.pad(values, ((0, h % 2), (0, w % 2)), "edge")) * 0.25


def _doubled(values: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Returns them expanded, cut to a shape."""
    return expanded(np.pad(values, 1, "edge"))[: shape[0], : shape[1]]


def roughness_of(heights: np.ndarray) -> np.ndarray:
    """Returns how much heights (h, w) vary, around each place, at twice the size of a pixel, where enlarged maps still
    tell the truth: the standard deviation of that octave, float64 (half the size)."""
    half = np.concatenate([_halved(heights[top : top + _AT_ONCE]) for top in range(0, len(heights), _AT_ONCE)])
    if min(half.shape) < _SMALLEST:
        return np.zeros_like(half)
    half -= _doubled(_halved(half), half.shape)  # the octave; in place, as large maps are
    half *= half
    power, shapes = half, []
    del half
    for _ in range(_SPREAD):
        shapes.append(power.shape)
        power = _halved(power)
    for shape in reversed(shapes):
        power = _doubled(power, shape)
    out: np.ndarray = np.sqrt(power)
    return out


@dataclass(frozen=True, eq=False)
class FittedMap:
    """A map (h, w), without holes, over `rect` of a level; `rim`: over how many pixels of it it grows from nothing."""

    heights: np.ndarray
    level: int
    rect: Rect
    rim: float = 0.0

    @property
    def own_level(self) -> int:
        """Gives the coarsest level that has a pixel at least for each of the map's."""
        level = self.level
        while self._too_few(level):
            level += 1
        while not self._too_few(level - 1):
            level -= 1
        return level

    def _too_few(self, level: int) -> bool:
        height, width = self.heights.shape
        by = 2.0 ** (level - self.level)
        return bool(self.rect.width * by < width or self.rect.height * by < height)

    def rect_at(self, level: int) -> Rect:
        """Returns the pixels of a level whose middles lie in the rectangle."""
        if level >= self.level:
            return self.rect.zoomed(level - self.level)
        by = self.level - level
        half = 1 << (by - 1)
        x0, y0, x1, y1 = (-((half - side) >> by) for side in self.rect)
        return Rect(x0, y0, x1, y1)

    def at(self, level: int, part: Rect) -> np.ndarray:
        """Returns its heights in a part of the rectangle, in pixels of a level: float64 (h, w)."""
        out: np.ndarray = _between(self.heights, *self._places(level, part, self.heights.shape))
        return out * self._within(level, part)

    def rough(self, level: int, part: Rect) -> np.ndarray:
        """Returns, likewise, how rough it is."""
        told = self._roughness
        out: np.ndarray = np.maximum(_between(told, *self._places(level, part, told.shape)), 0.0)
        return out * self._within(level, part)

    @property
    def roughest(self) -> float:
        """Gives the most of it at any place of the map."""
        return float(self._roughness.max())

    def roughness_alone(self) -> FittedMap:
        """Returns a map that tells how rough this one is, without its heights, which take much memory."""
        out = replace(self, heights=np.broadcast_to(np.float64(0.0), self.heights.shape))
        out.__dict__["_roughness"] = self._roughness
        return out

    @cached_property
    def _roughness(self) -> np.ndarray:
        return roughness_of(self.heights)

    def _places(self, level: int, part: Rect, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Returns where rows and columns of pixels lie in an array over the rectangle, in its pixels."""
        down = self._middles(level, part.y0, part.height, self.rect.y0) * shape[0] / self.rect.height - 0.5
        across = self._middles(level, part.x0, part.width, self.rect.x0) * shape[1] / self.rect.width - 0.5
        return down, across

    def _middles(self, level: int, first: int, count: int, start: int) -> np.ndarray:
        """Returns how far the middles of pixels lie from a side of the rectangle, in pixels of its level."""
        by, middles = level - self.level, np.arange(count) + 0.5
        if by >= 0:
            out: np.ndarray = np.ldexp(middles + (first - (start << by)), -by)
            return out
        told: np.ndarray = np.ldexp(middles, -by) + float((first << -by) - start)
        return told

    def _within(self, level: int, part: Rect) -> np.ndarray | float:
        if self.rim == 0.0:
            return 1.0
        sides = []
        for first, count, start, long in (
            (part.y0, part.height, self.rect.y0, self.rect.height),
            (part.x0, part.width, self.rect.x0, self.rect.width),
        ):
            far = self._middles(level, first, count, start)
            t = np.minimum(np.minimum(far, long - far) / self.rim, 1.0)
            sides.append(t * t * (3.0 - 2.0 * t))
        out: np.ndarray = sides[0][:, None] * sides[1][None, :]
        return out


def _between(values: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Returns values at places between pixels, by cubic convolution (Keys 1981, a = -1/2); beyond the rim as there."""
    first = min(max(int(np.floor(columns[0])) - 1, 0), values.shape[1] - 1)
    last = max(min(int(np.floor(columns[-1])) + 2, values.shape[1] - 1), first)
    return _along(_along(values[:, first : last + 1], rows).T, columns - first).T


def _along(values: np.ndarray, places: np.ndarray) -> np.ndarray:
    low = np.floor(places)
    t, first = (places - low)[:, None], low.astype(np.int64)
    if not t.any():  # a pixel for each of the map's: what the weights come to
        there: np.ndarray = values[np.clip(first, 0, len(values) - 1)]
        return there
    weights = (
        ((2.0 - t) * t - 1.0) * t * 0.5,
        ((3.0 * t - 5.0) * t * t + 2.0) * 0.5,
        ((4.0 - 3.0 * t) * t + 1.0) * t * 0.5,
        (t - 1.0) * t * t * 0.5,
    )
    taken = [values[np.clip(first + i - 1, 0, len(values) - 1)] * weight for i, weight in enumerate(weights)]
    out: np.ndarray = (taken[0] + taken[3]) + (taken[1] + taken[2])
    return out
