"""A picture sampled through any similarity: turned, scaled by anything, moved by parts of pixels.

A pixel's place in the source follows from its tile by exact integers, so its value does not depend on the rectangle in
which it was asked for, nor on the machine.  The source's level is the one of like density: 0.84 to 1.68 of its pixels
for each one, the same at every level, so that zooming never switches it.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator
from fractions import Fraction

import numpy as np

from engine.numeric.abreast import abreast
from engine.numeric.address import TILE, Rect
from engine.numeric.grid import snap
from engine.numeric.kernel import Int, inlined, kernel
from engine.numeric.similarity import Similarity

BITS = 40  # of the fractions of places in the source
_HALF = 1 << (BITS - 1)
_TO_PHASE, _PHASES = BITS - 8, 256
_TAPS = 4
_MARGIN = _TAPS // 2 + 1  # pixels of the source around a rectangle that its pixels can see
_PIECE = 2 * TILE  # a turned rectangle is gone through in squares: the boxes around them are smaller than the one
_SHARP, _SOFT = 1.1892, 1.4142  # source pixels a pixel: Catmull and Rom's kernel up to here, Mitchell's from here on
Picture = Callable[[int, Rect], "np.ndarray | None"]  # premultiplied float32 (4, h, w) of a level; None: empty


def sampled(picture: Picture, similarity: Similarity, level: int, rect: Rect, part: Rect | None) -> np.ndarray | None:
    """Returns what is shown of a picture in `rect` of `level`: float32 (4, h, w), on the grid, None where it is empty.

    `part`: pixels of the source's level (`source_level`) beyond which its rim goes on (None: anywhere).
    """
    out: np.ndarray | None = None
    for piece in _pieces(rect):
        pixels = _piece(picture, similarity, level, piece, part)
        if pixels is not None:
            if piece == rect:
                return pixels
            if out is None:
                out = np.zeros((4, rect.height, rect.width), np.float32)
            out[:, *piece.slices(rect)] = pixels
    return out


def source_level(similarity: Similarity, level: int) -> int:
    """Returns the level of a source that is sampled for a level of what is shown."""
    return level + similarity.like_levels


def density(similarity: Similarity) -> float:
    """Returns how many pixels of the source's level there are for one that is shown, along an axis.  The same on every
    machine."""
    n, e = similarity.squared
    by = e + 2 * similarity.like_levels
    return math.sqrt(Fraction(1 << max(by, 0), n << max(-by, 0)))


def weights_at(similarity: Similarity, level: int, x: int, y: int) -> tuple[int, Rect, np.ndarray]:
    """Returns which pixels of a source tell of a pixel of `level` that is sampled: their level, the 4 x 4 of them, and
    the weight of each, float32 (4, 4)."""
    at_level = source_level(similarity, level)
    u, v = (value - _HALF for value in similarity.back((2 * x + 1, 2 * y + 1), level, at_level, BITS))
    half, table = 1 << (_TO_PHASE - 1), _table(round(density(similarity) * 16))
    u, v = u + half, v + half
    across, down = table[(u >> _TO_PHASE) & 255], table[(v >> _TO_PHASE) & 255]
    return at_level, Rect.at((u >> BITS) - 1, (v >> BITS) - 1, _TAPS, _TAPS), down[:, None] * across


def _pieces(rect: Rect) -> Iterator[Rect]:
    for y in range(rect.y0 - rect.y0 % _PIECE, rect.y1, _PIECE):
        for x in range(rect.x0 - rect.x0 % _PIECE, rect.x1, _PIECE):
            yield Rect.at(x, y, _PIECE, _PIECE).intersect(rect)


def _piece(picture: Picture, similarity: Similarity, level: int, rect: Rect, part: Rect | None) -> np.ndarray | None:
    at_level = source_level(similarity, level)
    box = similarity.box(rect, level, at_level, _MARGIN)
    source = _source(picture, at_level, box, part)
    if source is None:
        return None
    out = np.empty((4, rect.height, rect.width), np.float32)
    right_x, right_y, down_x, down_y = similarity.pitch(level, at_level, BITS)
    table = _table(round(density(similarity) * 16))
    for tile in rect.tiles(level):
        corner, shown = tile.rect, tile.rect.intersect(rect)
        x, y = similarity.back((2 * corner.x0 + 1, 2 * corner.y0 + 1), level, at_level, BITS)
        x, y = x - (box.x0 << BITS) - _HALF, y - (box.y0 << BITS) - _HALF  # from the middle of its first pixel
        columns, rows = shown.x0 - corner.x0, shown.y0 - corner.y0
        first = x + columns * right_x + rows * down_x, y + columns * right_y + rows * down_y
        _sample(source, first, (right_x, right_y, down_x, down_y), table, out[:, *shown.slices(rect)])
    return out


def _source(picture: Picture, level: int, box: Rect, part: Rect | None) -> np.ndarray | None:
    """Returns a picture's pixels of `box`, interleaved, float32 (h, w, 4), those beyond `part` its rim's."""
    if part is not None and not box.meets(part):  # its rim is cut off there; it may be farther than 2^63 pixels
        return None
    inner = box if part is None else _nearest(box, part)
    found = picture(level, inner)
    if found is None:
        return None
    found = np.ascontiguousarray(found).view()
    found.flags.writeable = False  # whatever is given: so the kernel is compiled once
    out = np.empty((inner.height, inner.width, 4), np.float32)
    _interleave(found, out)
    if inner == box:
        return out
    rows = np.clip(np.arange(box.height) + (box.y0 - inner.y0), 0, inner.height - 1)
    columns = np.clip(np.arange(box.width) + (box.x0 - inner.x0), 0, inner.width - 1)
    spread: np.ndarray = out[rows[:, None], columns]
    return spread


def _nearest(box: Rect, part: Rect) -> Rect:
    """Returns the pixels of both, or the rows or columns of `part` that are nearest to the box."""
    x0, y0 = min(max(box.x0, part.x0), part.x1 - 1), min(max(box.y0, part.y0), part.y1 - 1)
    return Rect(x0, y0, max(min(box.x1, part.x1), x0 + 1), max(min(box.y1, part.y1), y0 + 1))


@functools.cache
def _table(sixteenths: int) -> np.ndarray:
    """Returns the weights of four neighbours by the place between the inner two, float32 (257, 4), for a density in
    1/16: what keeps edges where there is a pixel for each, and what evens them where there is not."""
    soft = min(1.0, max(0.0, (sixteenths / 16 - _SHARP) / (_SOFT - _SHARP)))
    b, c = soft / 3, 0.5 - soft / 6
    place = np.arange(_PHASES + 1)[:, None] / _PHASES
    weights = _cubic(np.abs(np.arange(_TAPS) - 1 - place), b, c)
    out: np.ndarray = (weights / weights.sum(axis=1, keepdims=True)).astype(np.float32)
    out.flags.writeable = False
    return out


def _cubic(x: np.ndarray, b: float, c: float) -> np.ndarray:
    """Mitchell and Netravali's family of cubics (1988) at distances from 0 on."""
    inner = ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6
    outer = ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6
    out: np.ndarray = np.where(x < 1, inner, np.where(x < 2, outer, 0.0))
    return out


@kernel
def _interleave(planes: np.ndarray, out: np.ndarray) -> None:
    """`out` (h, w, 4) gets `planes` (4, h, w): NumPy takes six times as long."""
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            for c in range(4):
                out[y, x, c] = planes[c, y, x]


@inlined
def _weighted(
    source: np.ndarray, row: Int, column: Int, across: np.ndarray, down: np.ndarray
) -> tuple[np.float32, np.float32, np.float32, np.float32]:
    """Returns the four channels of the 4 x 4 pixels from a place on, weighted."""
    zero = np.float32(0)
    r = g = b = a = zero
    for j in range(_TAPS):
        r0 = g0 = b0 = a0 = zero
        for i in range(_TAPS):
            weight, pixel = across[i], source[row + j, column + i]
            r0 += weight * pixel[0]
            g0 += weight * pixel[1]
            b0 += weight * pixel[2]
            a0 += weight * pixel[3]
        r += down[j] * r0
        g += down[j] * g0
        b += down[j] * b0
        a += down[j] * a0
    return r, g, b, a


@abreast
def _sample(
    source: np.ndarray,
    first: tuple[int, int],
    pitch: tuple[int, int, int, int],
    table: np.ndarray,
    out: np.ndarray,
) -> None:
    """`out` (4, h, w) from `source` (H, W, 4): `first` and `pitch` in 2^-40 pixels, from the middle of its first."""
    right_x, right_y, down_x, down_y = pitch
    zero, one, half = np.float32(0), np.float32(1), np.int64(1) << np.int64(_TO_PHASE - 1)
    for y in range(out.shape[1]):
        for x in range(out.shape[2]):
            u, v = first[0] + x * right_x + y * down_x + half, first[1] + x * right_y + y * down_y + half
            column, row = (u >> BITS) - 1, (v >> BITS) - 1
            across, down = table[(u >> _TO_PHASE) & 255], table[(v >> _TO_PHASE) & 255]
            r, g, b, a = _weighted(source, row, column, across, down)
            alpha = min(max(snap(a), zero), one)
            out[0, y, x] = min(max(snap(r), zero), alpha)
            out[1, y, x] = min(max(snap(g), zero), alpha)
            out[2, y, x] = min(max(snap(b), zero), alpha)
            out[3, y, x] = alpha
