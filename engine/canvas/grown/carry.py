"""Masks painted at one level of the canvas, carried to the pixels of another."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from engine.canvas.grown.shown import keys_within
from engine.numeric.address import Rect
from engine.texture.example import tiles
from engine.texture.example.tiles import TILE_SIDE, Tiles

_SPARSE = 4  # times the pixels of the tiles that are there: a larger rectangle is dealt with tile by tile


def carried(rect: Rect, mask: np.ndarray, finer: int, where: Tiles) -> Iterator[tuple[Rect, np.ndarray]]:
    """Yields the parts of a mask, bool (h, w) over `rect`, that lie on tiles of a level `finer` levels below (above
    it, if negative): their rectangles there, and bool masks.

    A finer pixel takes the value of the one that it lies in; a coarser one that of the pixel at its centre, so that
    the carried mask of several strokes is that of all of them together.
    """
    if finer < 0:
        rect, mask = _centres(rect, mask, -finer)
        finer = 0
    whole = rect.zoomed(finer)
    keys = keys_within(whole, (where,))
    if not keys:
        return
    there = Rect(0, 0, 0, 0)
    for key in keys:
        there = there.union(tiles.rect_of(key))
    there = there.intersect(whole)
    parts = [there]
    if there.area > _SPARSE * len(keys) * TILE_SIDE * TILE_SIDE:
        parts = [tiles.rect_of(key).intersect(whole) for key in sorted(keys)]
    for part in parts:
        found = mask[np.ix_(_above(part.y0, part.y1, finer, rect.y0), _above(part.x0, part.x1, finer, rect.x0))]
        if found.any():
            yield part, found


def _above(first: int, last: int, up: int, origin: int) -> np.ndarray:
    """Tells which of the pixels from `origin` on, `up` levels above, each of [first, last) lies in."""
    return np.fromiter(((n >> up) - origin for n in range(first, last)), np.int64, last - first)


def _centres(rect: Rect, mask: np.ndarray, up: int) -> tuple[Rect, np.ndarray]:
    """Returns the pixels `up` levels above whose centres lie in a rectangle, and the mask there."""
    half = 1 << up - 1
    inner = Rect(*(-((half - n) >> up) for n in rect))  # the first whose centre is not before n
    if inner.empty:
        return inner, np.zeros((0, 0), bool)
    top, left = (inner.y0 << up) + half - rect.y0, (inner.x0 << up) + half - rect.x0
    step = min(1 << up, max(mask.shape))
    return inner, mask[top::step, left::step]
