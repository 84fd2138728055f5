"""The brightness of a layer in float64, at any level: what heights are made of.

A canvas rounds its values to 2^-16.  Seen as heights, that is terraces a few levels down, and nothing but terraces
sixteen levels down.  So below level 0 the brightness is carried beside the canvas: with E for expand

    h_k = E h_(k-1) + sum over inks of luma(ink_k) bandpass_k + luma(residual_k),

rounded to 2^-46.  Up to there E and the sums are exact for |h| < 8, and each pixel is worked out of the same numbers by
the same operations whatever window it lies in, and whatever was looked at before.  Nothing is clamped.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from engine.canvas import growth
from engine.canvas.evaluate import evaluate, step
from engine.canvas.layers import Layer
from engine.canvas.reading import covered
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, Planes

LUMINANCES = (0.2126, 0.7152, 0.0722)
FINEST_GRID = 46  # bits of the grid on which brightness lies as long as it is not told relative to another pixel
_FIRST = 0  # the level whose values are the canvas' own
_ALPHA = 3


class Pixel(NamedTuple):
    """One pixel of a level."""

    level: int
    x: int
    y: int

    def above(self, level: int) -> Pixel:
        """Returns the pixel of a coarser level in which it lies."""
        up = self.level - level
        return Pixel(level, self.x >> up, self.y >> up)

    @property
    def rect(self) -> Rect:
        """Returns it as a rectangle of its level."""
        return Rect.at(self.x, self.y, 1, 1)


class Zero(NamedTuple):
    """From which level on brightness is told relative to what it is at a pixel of that level."""

    level: int
    value: float


class Brightness(NamedTuple):
    """A rectangle of premultiplied brightness: `fine` + `still`, `still` being what the zeros took away; `alpha`.
    float64 (h, w), or numbers where they are the same all over."""

    fine: np.ndarray
    still: np.ndarray | float
    alpha: np.ndarray | float


def luma(planes: np.ndarray) -> np.ndarray:
    """Returns the brightness of planes (3 or more, h, w): float64 (h, w), not clamped."""
    red, green, blue = (planes[c].astype(np.float64) for c in range(3))
    out: np.ndarray = (LUMINANCES[0] * red + LUMINANCES[1] * green) + LUMINANCES[2] * blue
    return out


def expanded(values: np.ndarray) -> np.ndarray:
    """E of float64 (h + 2, w + 2), unrounded: the children of its inner pixels, (2h, 2w)."""
    middle, rows = 3.0 * values[1:-1], (values[:-2], values[2:])
    out = np.empty((2 * (values.shape[0] - 2), 2 * (values.shape[1] - 2)))
    for r, row in enumerate(rows):
        near = middle + row
        inner = 3.0 * near[:, 1:-1]
        out[r::2, ::2] = (inner + near[:, :-2]) * 0.0625
        out[r::2, 1::2] = (inner + near[:, 2:]) * 0.0625
    return out


def snapped(values: np.ndarray) -> np.ndarray:
    """Returns values on the grid of brightness, ties to even."""
    out: np.ndarray = np.rint(values * 2.0**FINEST_GRID) * 2.0**-FINEST_GRID
    return out


def layer_brightness(
    layer: Layer, level: int, rect: Rect, zeros: Sequence[Zero] = (), cache: TileCache | None = None
) -> Brightness:
    """Returns the brightness of `rect` of a layer at a level, relative to `zeros`, coarsest first."""
    return _of_paint(_Descent(layer, level, rect, cache), layer, level, rect, zeros, cache)


def zeros_of(layer: Layer, pixel: Pixel, levels: Sequence[int], cache: TileCache | None = None) -> tuple[Zero, ...]:
    """Returns the zeros of a layer at the pixels of some `levels`, coarsest first, in which a pixel lies."""
    found: list[Zero] = []
    descent = _Descent(layer, pixel.level, pixel.rect, cache)
    while True:
        if descent.level in levels:
            here = pixel.above(descent.level)
            found.append(Zero(descent.level, float(descent.h[here.y - descent.at.y0, here.x - descent.at.x0])))
            descent.take(found[-1].value)
        if not descent.down():
            return tuple(found)


def _of_paint(
    descent: _Descent, layer: Layer, level: int, rect: Rect, zeros: Sequence[Zero], cache: TileCache | None
) -> Brightness:
    values, still = {zero.level: zero.value for zero in zeros}, 0.0
    while True:
        if descent.level in values:
            still += values[descent.level]
            descent.take(values[descent.level])
        if not descent.down():
            break
    inside = rect.slices(descent.at)
    fine, alpha = descent.h[inside], descent.alpha
    seen = Brightness(fine, still, alpha if isinstance(alpha, float) else alpha[inside])
    return _covered(seen, layer, level, rect, cache)


class _Descent:
    """Brightness on its way down to a rectangle, level by level.

    `level`, `at`: where it has come to; `h`: brightness, float64 (h, w); `alpha`: likewise, or 1.0.
    """

    def __init__(self, layer: Layer, level: int, rect: Rect, cache: TileCache | None) -> None:
        self._pyramid, self._finest = layer.pyramid, level
        self._rects = [rect.evened()]
        for _ in range(level - _FIRST):
            self._rects.append(self._rects[-1].parents().evened())
        self.at = self._rects.pop()
        self.level = level - len(self._rects)
        value = evaluate(layer.pyramid, self.level, self.at, cache)
        self.h = snapped(luma(value.data))
        self.alpha: np.ndarray | float = _or_one(value.data[_ALPHA].astype(np.float64))
        self._snaps = True
        self._inks: Planes | None = Planes(value.data.copy(), value.inks)

    def take(self, value: float) -> None:
        """Takes a number off all of it, which is told as finely as float64 can from then on."""
        self.h = self.h - value
        self._snaps = False

    def down(self) -> bool:
        """Goes down one level; False where there is none left."""
        if not self._rects:
            return False
        above, rect = self.at, self._rects.pop()
        self.at, self.level = rect, self.level + 1
        within = rect.parents().slices(above)
        h = expanded(self.h[within])
        before, after = self._inks, self._stepped(above)
        alpha = self.alpha if isinstance(self.alpha, float) else expanded(self.alpha[within])
        if after is not None:
            h += self._texture(after)
            h += luma(after.data)
            alpha = self._alpha(alpha, before, above, after)
        self.h, self.alpha, self._inks = snapped(h) if self._snaps else h, alpha, after
        return True

    def _stepped(self, above: Rect) -> Planes | None:
        """Returns the next level as the canvas has it, but for the colours, which are only what was stored there."""
        if self._inks is not None:
            self._inks.data[:_ALPHA] = 0.0
        return step(self._pyramid, self._inks, above, self.level, self.at, self._finest, textured=False)

    def _texture(self, laid: Planes) -> np.ndarray:
        """Returns what the ink adds at this level."""
        out = np.zeros((self.at.height, self.at.width))
        for i, ink in enumerate(laid.inks):
            amplitude = laid.data[COLOURS + 3 * i : COLOURS + 3 * i + 3]
            if self.level <= ink.base or not amplitude.any():
                continue
            detail = ink.bandpass(self.level, self.at)
            if detail is not None:
                whole = len(detail) == 1
                out += luma(amplitude) * detail[0] if whole else luma(amplitude.astype(np.float64) * detail[:3])
        return out

    def _alpha(
        self, carried: np.ndarray | float, before: Planes | None, above: Rect, after: Planes
    ) -> np.ndarray | float:
        """Returns alpha with what the level stores of it, of which the canvas knows the sum alone."""
        new = after.data[_ALPHA]
        if isinstance(carried, float) and (new == 1.0).all():
            return carried
        out = np.array(new, np.float64)
        if before is not None:
            canvas = np.empty((1, self.at.height, self.at.width), np.float32)
            top, left = (self.at.y0 >> 1) - 1 - above.y0, (self.at.x0 >> 1) - 1 - above.x0
            planes, height = np.array([_ALPHA], np.int64), self.at.height
            expand_into(before.data, top, left, planes, canvas, 0, height, self._pyramid.step)
            out -= canvas[0]
        out += carried
        return _or_one(np.clip(out, 0.0, 1.0))


def _or_one(alpha: np.ndarray) -> np.ndarray | float:
    return 1.0 if (alpha == 1.0).all() else alpha


def _covered(seen: Brightness, layer: Layer, level: int, rect: Rect, cache: TileCache | None) -> Brightness:
    """Returns a layer's brightness with what was painted with examples over it, as the canvas has that."""
    if not layer.growth or not growth.meets(layer.growth, level, rect):
        return seen
    paint = evaluate(layer.pyramid, level, rect, cache).rgba
    over = covered(paint, layer.growth, level, rect)
    assert over is not None
    changed = (over != paint).any(axis=0)
    fine = np.where(changed, luma(over) - seen.still, seen.fine)
    return Brightness(fine, seen.still, _or_one(np.where(changed, over[_ALPHA].astype(np.float64), seen.alpha)))
