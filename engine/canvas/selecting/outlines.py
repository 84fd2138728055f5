"""How far each pixel lies within a closed line: the exact part of its area, where the line goes round once."""

from __future__ import annotations

import math

import numpy as np

from engine.brush.mask import Coverage
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.kernel import inner, kernel

LONGEST_SIDE, COVERED_CAP = 1 << 16, 1 << 28  # px of a rectangle that is covered
EMPTY_RECT = Rect(0, 0, 0, 0)
_APART = 1.0 / 64.0  # px between an ellipse and the line that is taken for it, at most
_FEWEST, _MOST = 64, 4096  # pieces of a quarter of it


def checked_size(rect: Rect, where: str) -> Rect:
    """Returns a rectangle itself; FieldError if it has too many pixels."""
    if max(rect.width, rect.height) > LONGEST_SIDE or rect.area > COVERED_CAP:
        found = f"{described(rect.width)} x {described(rect.height)} px"
        raise FieldError(where, found, f"at most {LONGEST_SIDE} px along a side and 2^28 in all; take a coarser level")
    return rect


def boxed(level: int, rect: Rect, where: str) -> Coverage:
    """Returns a rectangle's coverage."""
    checked_size(rect, where)
    tiles: dict[TileKey, np.ndarray | float] = {}
    for key in rect.tiles(level):
        part = key.rect.intersect(rect)
        if part == key.rect:
            tiles[key] = 1.0
        else:
            tile = tiles[key] = np.zeros((TILE, TILE), np.float32)
            tile[part.slices(key.rect)] = 1.0
    return Coverage(level, tiles, rect)


def rounded_off(level: int, rect: Rect, where: str) -> Coverage:
    """Returns the coverage of the ellipse that touches a rectangle's sides."""
    checked_size(rect, where)
    count = _FEWEST
    while count < _MOST and max(rect.width, rect.height) > 4.0 * _APART * count * count:
        count *= 2
    t = np.arange(count) / count
    x, y = (1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t)  # a quarter of the circle, without an angle
    ring = np.concatenate([np.stack(p, axis=1) for p in ((x, y), (-y, x), (-x, -y), (y, -x))])
    points = (ring + 1.0) * (rect.width * 0.5, rect.height * 0.5)
    return outlined(level, (rect.x0, rect.y0), points, where)


def outlined(level: int, origin: tuple[int, int], points: np.ndarray, where: str) -> Coverage:
    """Returns the coverage of what a closed line goes round: float64 (n, 2), pixels of the level from `origin`."""
    low, high = np.floor(points.min(axis=0)), np.ceil(points.max(axis=0))
    x0, y0, x1, y1 = (int(v) for v in (*low, *high))
    rect = Rect(origin[0] + x0, origin[1] + y0, origin[0] + x1, origin[1] + y1)
    tiles: dict[TileKey, np.ndarray | float] = {}
    if rect.empty:
        return Coverage(level, tiles, rect)
    checked_size(rect, where)
    places = rect.within_tiles()
    area = np.empty((TILE, places.width * TILE + 1))
    for y in range(places.y0, places.y1):
        corner = places.x0 * TILE - origin[0], y * TILE - origin[1]
        area[...] = 0.0
        _go_round(points, float(corner[0]), float(corner[1]), area)
        for x in range(places.x0, places.x1):
            left = (x - places.x0) * TILE
            tile = area[:, left : left + TILE].astype(np.float32)
            first = float(tile[0, 0])
            alike = bool((tile == tile[0, 0]).all())
            if not alike or first:
                tiles[TileKey(level, x, y)] = first if alike else tile
    return Coverage(level, tiles, rect)


@inner
def _leave(row: np.ndarray, a: float, b: float, depth: float) -> None:
    """Adds to the pixels of a row what lies right of a line from column `a` to `b` over a `depth`, as differences."""
    first, last = int(a), int(b)
    before = 0.0
    for x in range(first, last + 1):
        inside = b - a
        if inside <= 0.0:
            part = 1.0 - (a - first)
        else:
            lo, hi = max(a, float(x)), min(b, x + 1.0)
            # of the depth, what was passed left of this pixel lies wholly to the right; the piece within it in part
            part = (lo - a) / inside + (hi - lo) / inside * (x + 1.0 - (lo + hi) * 0.5)
        row[x] += depth * (part - before)
        before = part
    if last + 1 < row.shape[0]:
        row[last + 1] += depth * (1.0 - before)


@kernel
def _go_round(points: np.ndarray, left: float, top: float, area: np.ndarray) -> None:
    """Writes into `area`, float64 (h, w + 1), zero before, the part of each pixel that a closed line goes round: in
    steps of 2^-16.  `points` (n, 2) lie within the columns of `area`, `left` and `top` being its corner.

    Each piece of the line adds what it leaves to its right, row by row; sums along the rows make areas of that.
    """
    height, count = area.shape[0], points.shape[0]
    for i in range(count):
        x0, y0 = points[i, 0] - left, points[i, 1] - top
        x1, y1 = points[(i + 1) % count, 0] - left, points[(i + 1) % count, 1] - top
        sign = 1.0
        if y0 > y1:
            x0, y0, x1, y1, sign = x1, y1, x0, y0, -1.0
        if y0 == y1 or y1 <= 0.0 or y0 >= height:
            continue
        slope = (x1 - x0) / (y1 - y0)
        if not math.isfinite(slope):  # it goes down by next to nothing: what it leaves is none of a step
            continue
        low, high = min(x0, x1), max(x0, x1)
        for row in range(max(0, int(y0)), min(height, math.ceil(y1))):
            upper, lower = max(y0, float(row)), min(y1, row + 1.0)
            a = min(max(x0 + slope * (upper - y0), low), high)
            b = min(max(x0 + slope * (lower - y0), low), high)
            _leave(area[row], min(a, b), max(a, b), sign * (lower - upper))
    for row in range(height):
        total = 0.0
        for x in range(area.shape[1]):
            total += area[row, x]
            area[row, x] = np.rint(min(abs(total), 1.0) * 65536.0) / 65536.0
