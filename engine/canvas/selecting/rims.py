"""The rim of a coverage moved or softened: grown, shrunk, feathered."""

from __future__ import annotations

import math

import numpy as np

from engine.brush.mask import Coverage
from engine.canvas.selecting.joining import with_more
from engine.canvas.selecting.occupied import alpha_at, raster
from engine.canvas.store import Pyramid
from engine.checks.field_error import FieldError
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.blur import softened
from engine.numeric.kernel import kernel

RIM_CAP = 1 << 26  # px
_SHARPEST = 16.0  # px of feather from which on it is worked out at a coarser level: nothing finer is left of it


def rim_moved(coverage: Coverage, grow: float, feather: float, grid: int, where: str) -> Coverage:
    """Returns a coverage grown by so many pixels of its level (negative: shrunk), then feathered by so many, maybe at a
    coarser level.  FieldError if it has too many pixels."""
    if grow and coverage.tiles:
        coverage = _grown(coverage, grow, where)
    if feather and coverage.tiles:
        coarser = 0
        while feather > _SHARPEST:
            coarser, feather = coarser + 1, feather / 2.0
        if coarser:
            coverage = alpha_at(with_more(Pyramid(grid=grid), coverage), coverage.level - coarser, where)
        coverage = _feathered(coverage, feather, where)
    return coverage


def _grown(coverage: Coverage, by: float, where: str) -> Coverage:
    around = _around(coverage, math.ceil(abs(by)) + 2, where)
    values = raster(coverage, around)
    inside = values >= np.float32(0.5)
    return tiled(coverage.level, around, _moved(inside if by > 0.0 else ~inside, by))


def _moved(towards: np.ndarray, by: float) -> np.ndarray:
    """Returns the coverage of all that lies within a distance of pixels, bool (h, w); of what does not, if that is
    negative: float32."""
    squares = np.empty(towards.shape, np.int64)
    _distances(towards, math.ceil(abs(by)) + 2, squares)
    near = np.clip(abs(by) + 1.0 - np.sqrt(squares), 0.0, 1.0)  # a root is the same everywhere
    near = np.where(towards, 1.0, near)
    return (near if by > 0.0 else 1.0 - near).astype(np.float32)


def _feathered(coverage: Coverage, by: float, where: str) -> Coverage:
    """Softens by a Gaussian whose rim goes over about `by` pixels to each side."""
    sigma = by / 2.0
    around = _around(coverage, math.ceil(4.0 * sigma) + 1, where)
    values = np.rint(softened(raster(coverage, around), sigma) * 65536.0) / 65536.0
    return tiled(coverage.level, around, values.astype(np.float32))


def _around(coverage: Coverage, by: int, where: str) -> Rect:
    out = coverage.rect.grown(by)
    if out.area > RIM_CAP:
        found = f"{out.width} x {out.height} px"
        raise FieldError(where, found, "at most 2^26 px; take a coarser level")
    return out


def tiled(level: int, rect: Rect, values: np.ndarray) -> Coverage:
    """Returns values 0..1 of a rectangle, float32 (h, w), as a coverage."""
    tiles: dict[TileKey, np.ndarray | float] = {}
    for key in rect.tiles(level):
        part = key.rect.intersect(rect)
        piece = values[part.slices(rect)]
        if not piece.any():
            continue
        first = float(piece[0, 0])
        if part == key.rect and (piece == piece[0, 0]).all():
            tiles[key] = first
        else:
            tile = tiles[key] = np.zeros((TILE, TILE), np.float32)
            tile[part.slices(key.rect)] = piece
    return Coverage(level, tiles, rect)


@kernel
def _distances(marks: np.ndarray, most: int, out: np.ndarray) -> None:
    """Writes the square of each pixel's distance to the nearest one that is marked, bool (h, w), into int64 (h, w);
    beyond `most` pixels something larger than its square."""
    height, width = marks.shape
    far = most + 1
    down = np.empty((height, width), np.int64)  # to the nearest mark in the column
    for x in range(width):
        last = far
        for y in range(height):
            last = 0 if marks[y, x] else min(last + 1, far)
            down[y, x] = last
        last = far
        for y in range(height - 1, -1, -1):
            last = 0 if marks[y, x] else min(last + 1, far)
            down[y, x] = min(down[y, x], last)
    hull, start = np.empty(width, np.int64), np.empty(width + 1, np.int64)
    for y in range(height):
        count = 0
        for x in range(width):  # parabolas from which the nearest is found: their lower hull
            height_here = down[y, x] * down[y, x] + x * x
            while count > 0:
                other = hull[count - 1]
                cross = (height_here - (down[y, other] * down[y, other] + other * other)) // (2 * (x - other)) + 1
                if cross > start[count - 1]:
                    break
                count -= 1
            hull[count], start[count] = x, 0 if count == 0 else cross
            if start[count] < width:
                count += 1
        start[count] = width
        for n in range(count):
            at = hull[n]
            for x in range(start[n], min(start[n + 1], width)):
                out[y, x] = (x - at) * (x - at) + down[y, at] * down[y, at]
