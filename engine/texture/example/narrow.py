"""Where strokes are narrow: there an example whose rim begins faint would show nothing but that.

A pixel counts as narrow where no square of some pixels, level or tilted, lies wholly inside near it.  Its shape is then
widened, by as much as the example's rim is faint, so that it is grown as if it lay so much deeper.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.kernel import Array, Int, inner, kernel
from engine.numeric.neighbourhood import FULL, RADIUS, SIDE, region_bits
from engine.texture.example import tiles
from engine.texture.example.region_value import Region
from engine.texture.example.region_window import Window

_NARROW, _SLIM = 12, 20  # pixels: below the first a shape is widened wholly, below the second by half
_RIM = np.uint64(1 << SIDE * SIDE)  # set in widened shapes
_BESIDE = 2  # pixels from one at an outline to where such a square would be seen whole
_SIGHT = RADIUS + _BESIDE
_SEEN = 2  # level at which finer ones look, too
_NOT_LAST = np.uint64(sum(1 << SIDE * y + x for y in range(SIDE) for x in range(SIDE - 1)))  # column


def wider(region: Region, n: int, amount: int = 2) -> int:
    """Tells by how many pixels of a level narrow shapes are widened; 0 where none is."""
    faint = region.exemplar.faint if region.exemplar.seamless else 0
    return min(RADIUS, (faint * amount + (1 << n)) >> n + 1)


def narrow_reach(region: Region, n: int) -> int:
    """Tells how far from a pixel that joins or leaves a region others may become narrow at a level."""
    return _SIGHT + 1 << seen_level(region, n) - n if wider(region, n) else 0


def newly_narrow(region: Region, n: int, masks: Rect) -> Rect:
    """Returns the smallest rectangle around what is narrow now and was not, or the other way round, `masks` being that
    around what has joined or left the region."""
    reach = narrow_reach(region, n)
    if masks.empty or not reach:
        return Rect(0, 0, 0, 0)
    around = masks.grown(reach)
    now, before = _amounts(region, n, around)
    y0, y1, x0, x1 = tiles.bounds((now ^ before)[None])
    return Rect(around.x0 + x0, around.y0 + y0, around.x0 + x1, around.y0 + y1)


def widen(region: Region, n: int, rect: Rect, window: Window) -> None:
    """Widens the shapes of narrow pixels in a window of `rect`, and asks for those that are so since or no more."""
    if wider(region, n):
        now, before = _amounts(region, n, rect)
        _widen(window, now, before, wider(region, n, 1), wider(region, n))


def seen_level(region: Region, n: int) -> int:
    """Tells at which level it is looked whether pixels of one are narrow."""
    return max(n, min(_SEEN, len(region.masks) - 1))


def _amounts(region: Region, n: int, rect: Rect) -> tuple[np.ndarray, np.ndarray]:
    """Returns how narrow each pixel is, now and when the level was refined: 0, 1 or 2, uint8 (h, w)."""
    seen = seen_level(region, n)
    up = seen - n
    wide = rect.zoomed(-up).grown(_SIGHT)
    out = np.zeros((2, rect.height, rect.width), np.uint8)
    for masks, amounts in zip((region.masks[seen], region.levels[n].seen), out, strict=True):
        held = tiles.gathered(masks, wide, np.zeros((1, wide.height, wide.width), np.uint8))[0]
        if held.any():
            sides = (max(2, _NARROW >> seen), max(3, _SLIM + (1 << seen) - 1 >> seen))
            _narrow(held, sides, (rect.y0 - (wide.y0 << up), rect.x0 - (wide.x0 << up)), up, amounts)
    return out[0], out[1]


@kernel
def _narrow(mask: Array, sides: tuple[Int, Int], offset: tuple[Int, Int], up: Int, out: Array) -> None:
    """Writes how narrow the pixels are `up` levels below those of a mask, (h, w), the first of which begins `offset`
    pixels before."""
    bits, held, amounts = (
        np.zeros(mask.shape, np.uint64),
        np.zeros(mask.shape, np.uint8),
        np.zeros(mask.shape, np.uint8),
    )
    region_bits(mask, bits)
    for y in range(RADIUS, mask.shape[0] - RADIUS):
        for x in range(RADIUS, mask.shape[1] - RADIUS):
            if mask[y, x] and _has_square(bits[y, x], sides[0]):
                held[y, x] = 2 if _has_square(bits[y, x], sides[1]) else 1
    for y in range(_SIGHT, mask.shape[0] - _SIGHT):
        for x in range(_SIGHT, mask.shape[1] - _SIGHT):
            if mask[y, x]:
                amounts[y, x] = 2 - held[y - _BESIDE : y + _BESIDE + 1, x - _BESIDE : x + _BESIDE + 1].max()
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            out[y, x] = amounts[(y + offset[0]) >> up, (x + offset[1]) >> up]


@inner
def _has_square(bits: Int, side: Int) -> bool:
    """Tells whether a shape holds a square of so many pixels, or one that stands on a corner and is about as wide."""
    upright, tilted = bits, bits
    for turn in range(2):
        step = np.uint64(SIDE if turn else 1)
        for _ in range(side - 1):
            upright &= (upright >> step) & (FULL if turn else _NOT_LAST)
    for _ in range((side + 1) // 2):
        beside = ((tilted >> np.uint64(1)) & _NOT_LAST) & ((tilted & _NOT_LAST) << np.uint64(1))
        tilted &= beside & (tilted >> np.uint64(SIDE)) & (tilted << np.uint64(SIDE))
    return upright != np.uint64(0) or tilted != np.uint64(0)


@inner
def _dilated(bits: Int) -> Int:
    """A shape with the eight neighbours of each of its pixels."""
    bits |= ((bits & _NOT_LAST) << np.uint64(1)) | ((bits >> np.uint64(1)) & _NOT_LAST)
    return (bits | (bits << np.uint64(SIDE)) | (bits >> np.uint64(SIDE))) & FULL


@kernel
def _widen(window: Window, now: Array, before: Array, some: Int, most: Int) -> None:
    """Widens shapes by `some` pixels where they are narrow by 1, by `most` where by 2."""
    height, width = window.mask.shape
    for y in range(height):
        for x in range(width):
            if window.mask[y, x] == 0:
                continue
            if now[y, x] != before[y, x] and not window.fresh:
                for p in range(window.need.shape[0]):
                    window.need[p, y, x] = 1
            bits = window.bits[y, x]
            if now[y, x] and bits != FULL:
                for _ in range(most if now[y, x] == 2 else some):
                    bits = _dilated(bits)
                window.bits[y, x] = bits | _RIM
