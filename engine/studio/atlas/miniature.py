"""A small picture of a bookmark: its rectangle, turned and mirrored as it is seen."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from engine.numeric.address import Rect
from engine.painting.places import Bookmark, middle_of

Picture = Callable[[int, Rect], np.ndarray]  # of a rectangle of a level: float32 (4, h, w), premultiplied


def miniature(bookmark: Bookmark, size: tuple[int, int], picture: Picture) -> np.ndarray:
    """Returns the bookmark's rectangle as large as `size` (width, height) has room for: float32 (4, h, w),
    premultiplied."""
    scale = min(wide / side for wide, side in zip(size, bookmark.size, strict=True))
    width, height = (max(1, round(side * scale)) for side in bookmark.size)
    zoom = bookmark.level + math.log2(scale)
    level = math.ceil(zoom - 1e-9)  # of which 1 to 2 pixels are one of the picture
    step = 2.0 ** (level - zoom)
    cos, sin = math.cos(math.radians(bookmark.angle)), math.sin(math.radians(bookmark.angle))
    across = (np.arange(width) + 0.5 - width / 2) * step
    down = ((np.arange(height) + 0.5 - height / 2) * step)[:, None]
    x, y = cos * across + sin * down, cos * down - sin * across
    if bookmark.mirrored:
        x = -x
    column, row, (left, top) = *_corner(bookmark, level), (math.floor(x.min()) - 2, math.floor(y.min()) - 2)
    (whole_x, part_x), (whole_y, part_y) = column, row
    x, y = x + part_x - left - 0.5, y + part_y - top - 0.5  # from the middle of the first pixel read
    wide, tall = math.ceil(x.max()) + 2, math.ceil(y.max()) + 2
    return _sampled(picture(level, Rect.at(whole_x + left, whole_y + top, wide, tall)), x, y)


def _corner(bookmark: Bookmark, level: int) -> tuple[tuple[int, float], tuple[int, float]]:
    """Returns the bookmark's middle in pixels of a level, (whole, rest) along each axis."""
    x, y, exponent = middle_of(bookmark)
    bits = exponent - level
    if bits <= 0:
        return (x << -bits, 0.0), (y << -bits, 0.0)
    return _split(x, bits), _split(y, bits)


def _split(value: int, bits: int) -> tuple[int, float]:
    whole = value >> bits
    rest = value - (whole << bits)
    return whole, (rest >> max(0, bits - 40)) / (1 << min(bits, 40))


def _sampled(planes: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Returns the picture at places, (h, w) each, in pixels from the middle of its first one, between four of them."""
    i, j = np.floor(y).astype(np.int64), np.floor(x).astype(np.int64)
    i, j = np.clip(i, 0, planes.shape[1] - 2), np.clip(j, 0, planes.shape[2] - 2)
    v, u = (y - i).astype(np.float32), (x - j).astype(np.float32)
    upper = planes[:, i, j] * (1 - u) + planes[:, i, j + 1] * u
    lower = planes[:, i + 1, j] * (1 - u) + planes[:, i + 1, j + 1] * u
    out: np.ndarray = upper * (1 - v) + lower * v
    return out
