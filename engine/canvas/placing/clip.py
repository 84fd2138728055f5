"""How much of each pixel lies within the part of a source that is shown."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from engine.canvas.placing.pose import SourcePart
from engine.canvas.placing.sampling import density, source_level
from engine.numeric.address import Rect, lies_within
from engine.numeric.kernel import kernel
from engine.numeric.similarity import Dyadic, Similarity

_BITS = 20  # of the fractions of places in the part
_KEPT = 4096  # bounds of clips
_FAR = 1 << 60  # beyond which a side is beside every pixel of a tile, in 2^-20 pixels


@dataclass(frozen=True, slots=True)
class Clip:
    """A part of a source, and the similarity by which it is shown."""

    part: SourcePart
    similarity: Similarity

    def through(self, outer: Similarity) -> Clip:
        """Returns the clip as it is shown by another similarity."""
        return Clip(self.part, self.similarity.then(outer))

    def bounds(self, level: int) -> Rect:
        """Returns the pixels of a level that meet it."""
        return _bounds(self, level)

    def on_pixels(self, level: int) -> bool:
        """Tells whether it is a rectangle of whole pixels of a level."""
        if self.similarity.quarter is None:
            return False
        rect, at = self.part.rect, self.part.level
        return all(self.similarity(Dyadic.of(x, y, at)).e <= level for x, y in (rect[:2], rect[2:]))

    def holds(self, level: int, rect: Rect) -> bool:
        """Tells whether a rectangle lies within it, a pixel from its rim."""
        grown, part = rect.grown(1), self.part.rect
        if self.similarity.quarter is not None:
            return lies_within(grown, _inner(self, level))
        for x in (grown.x0, grown.x1):
            for y in (grown.y0, grown.y1):
                u, v = self.similarity.back((2 * x, 2 * y), level, self.part.level, 8)
                if not (part.x0 << 8 <= u < part.x1 << 8 and part.y0 << 8 <= v < part.y1 << 8):
                    return False
        return True


@functools.lru_cache(_KEPT)  # it is asked for by every tile of the screen
def _bounds(clip: Clip, level: int) -> Rect:
    return clip.similarity.shown(clip.part.rect, clip.part.level, level)


@functools.lru_cache(_KEPT)
def _inner(clip: Clip, level: int) -> Rect:
    """Returns the pixels of a level that lie within an upright clip."""
    part = clip.part
    one, other = (clip.similarity(Dyadic.of(*corner, part.level)) for corner in (part.rect[:2], part.rect[2:]))
    sides = []
    for a, b in ((one.x, other.x), (one.y, other.y)):
        low, high = sorted((_whole(a, level - one.e), _whole(b, level - other.e)))
        sides.append((low + 1, high))
    (x0, x1), (y0, y1) = sides
    return Rect(x0, y0, max(x0, x1), max(y0, y1))


def within(clips: Sequence[Clip], level: int, rect: Rect) -> Rect:
    """Returns the pixels of a rectangle that meet all clips."""
    for clip in clips:
        rect = rect.intersect(clip.bounds(level))
        if rect.empty:
            break
    return rect


def clipped(pixels: np.ndarray, clips: Sequence[Clip], level: int, rect: Rect) -> np.ndarray:
    """Returns pixels of a rectangle, (4, h, w), as much of each as lies within all clips; `rect` meets them."""
    for clip in clips:
        if clip.similarity.quarter is not None and lies_within(rect, _inner(clip, level)):
            continue
        if clip.on_pixels(level):
            inner = rect.intersect(clip.bounds(level))
            if inner != rect:
                cut = np.zeros_like(pixels)
                cut[:, *inner.slices(rect)] = pixels[:, *inner.slices(rect)]
                pixels = cut
        elif clip.similarity.quarter is not None:
            across, down = _shares(clip, level, rect)
            pixels = pixels * (across * down[:, None])
        elif not clip.holds(level, rect):
            pixels = _masked(pixels, clip, level, rect)
    return pixels


def _shares(clip: Clip, level: int, rect: Rect) -> tuple[np.ndarray, np.ndarray]:
    """Returns the shares of columns and rows that lie within an upright clip: float32."""
    part = clip.part
    one = clip.similarity(Dyadic.of(*part.rect[:2], part.level))
    other = clip.similarity(Dyadic.of(*part.rect[2:], part.level))
    sides = []
    for a, b, first, last in ((one.x, other.x, rect.x0, rect.x1), (one.y, other.y, rect.y0, rect.y1)):
        low, high = sorted((_scaled(a, level - one.e), _scaled(b, level - other.e)))
        shares = np.zeros(last - first, np.float32)
        left, right = max(math.floor(low), first), min(math.ceil(high), last)
        shares[max(left - first, 0) : max(right - first, 0)] = 1.0
        for i in {left, right - 1} if left < right else ():  # pixels that the rim may cross
            shares[i - first] = float(min(high, Fraction(i + 1)) - max(low, Fraction(i)))
        sides.append(shares)
    return sides[0], sides[1]


def _scaled(value: int, shift: int) -> Fraction:
    return Fraction(value << max(shift, 0), 1 << max(-shift, 0))


def _masked(pixels: np.ndarray, clip: Clip, level: int, rect: Rect) -> np.ndarray:
    """As `clipped`, by one turned clip: by the distances of pixels' middles to its four sides, told from the corner of
    their tile."""
    f, at_level = clip.similarity, source_level(clip.similarity, level)
    unit = density(f) * 2**_BITS
    left, top, right, bottom = (_whole(value, at_level - clip.part.level + _BITS) for value in clip.part.rect)
    right_x, right_y, down_x, down_y = (value / unit for value in f.pitch(level, at_level, _BITS))
    out = np.empty_like(pixels, order="C")
    for tile in rect.tiles(level):
        corner, part = tile.rect, tile.rect.intersect(rect)
        x, y = f.back((2 * corner.x0 + 1, 2 * corner.y0 + 1), level, at_level, _BITS)
        sides = _near(x - left) / unit, _near(right - x) / unit, _near(y - top) / unit, _near(bottom - y) / unit
        first, place = (part.x0 - corner.x0, part.y0 - corner.y0), part.slices(rect)
        _mask(pixels[:, *place], sides, (right_x, right_y, down_x, down_y), first, out[:, *place])
    return out


def _whole(value: int, shift: int) -> int:
    """Returns floor(value 2^shift)."""
    return value << shift if shift >= 0 else value >> -shift


def _near(distance: int) -> int:
    """Returns a distance, or one as far as it matters."""
    return min(max(distance, -_FAR), _FAR)


@kernel
def _mask(
    pixels: np.ndarray,
    sides: tuple[float, float, float, float],
    pitch: tuple[float, float, float, float],
    first: tuple[int, int],
    out: np.ndarray,
) -> None:
    """`out` gets the pixels' shares; `sides`: how far the middle of the tile's first pixel is within, in pixels;
    `first`: the place of the first pixel in it."""
    for row in range(pixels.shape[1]):
        for column in range(pixels.shape[2]):
            x, y = first[0] + column, first[1] + row
            u, v = x * pitch[0] + y * pitch[2], x * pitch[1] + y * pitch[3]
            across = min(max(sides[0] + u + 0.5, 0.0), 1.0) + min(max(sides[1] - u + 0.5, 0.0), 1.0) - 1.0
            down = min(max(sides[2] + v + 0.5, 0.0), 1.0) + min(max(sides[3] - v + 0.5, 0.0), 1.0) - 1.0
            share = np.float32(max(across, 0.0) * max(down, 0.0))
            for c in range(4):
                out[c, row, column] = share * pixels[c, row, column]
