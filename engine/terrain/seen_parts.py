"""Which land each part of a picture shows, and the windows of finer cells that hold it.

A window here is `side` = 2^k pixels of the finest window of `engine.terrain.camera` a cell; its cells are counted from
the one in which the camera's foot lies.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect
from engine.terrain.camera import Camera, Windows
from engine.terrain.caster import cast

LAID_SIDE = 64  # cells of a side of the squares that a window is made of where land is seen in it
PART_WINDOWS = 3  # windows of a part
_COLUMN_STEP = 2  # columns of pixels from one that is looked at to the next
_ROWS_LOOKED_AT = 64  # of pixels, at a time
_CELLS_AROUND = 12  # cells around a place that is seen, which are made, too
_PIXELS_AROUND = 3  # pixels around a part whose land is, too
_LEAST_PART = 8  # pixels of a part's side
_RAYS_WIDER = 1.25  # than a pixel, that a ray may be (as `daylight` has them), and what its end is nearer than it was
_OF_SKY = np.int64(-(1 << 40))  # where sky is seen


@dataclass(frozen=True)
class SeenLand:
    """What pixels of a picture show, each in its row, every second one of it: arrays (h, w / 2).  `k`: of the window
    that it is to be seen by, x, y: where it lies, `away`: how far, pixels of the finest window."""

    k: np.ndarray
    x: np.ndarray
    y: np.ndarray
    away: np.ndarray

    def within(self, box: Rect, margin: int = 0) -> tuple[slice, slice]:
        """Returns rows and columns of what a part of the picture shows."""
        rows = slice(max(0, box.y0 - margin), box.y1 + margin)
        return rows, slice(max(0, box.x0 - margin) // _COLUMN_STEP, -(-(box.x1 + margin) // _COLUMN_STEP))


def seen_by(windows: Windows, eye: np.ndarray, size: tuple[int, int], pixel: float, cells: float) -> SeenLand:
    """Returns what a picture shows whose pixels grow by `pixel` along a ray; `cells`: of a window to a pixel at most.
    `eye`: as `engine.terrain.land_picture.eye_of` has it."""
    shape = size[1], -(-size[0] // _COLUMN_STEP)
    k, x, y, away = np.empty(shape, np.int64), np.empty(shape), np.empty(shape), np.empty(shape)
    for first in range(0, size[1], _ROWS_LOOKED_AT):
        rows = slice(first, min(first + _ROWS_LOOKED_AT, size[1]))
        down, across = np.mgrid[rows, 0 : size[0] : _COLUMN_STEP].astype(np.float64)
        ways = eye[3] + across[:, :, None] * eye[1] - down[:, :, None] * eye[2]
        ways /= np.sqrt((ways * ways).sum(axis=2, keepdims=True))
        rays = np.concatenate([np.broadcast_to(eye[0], ways.shape), ways], axis=2).reshape(-1, 6)
        hits = np.empty((len(rays), 2))
        cast(windows.heights, windows.tops, windows.mips, windows.places, rays, hits)
        away[rows] = hits[:, 0].reshape(down.shape)
        there = away[rows] > 0.0
        level = np.ceil(np.log2(np.where(there, away[rows], 1.0) * (_RAYS_WIDER * pixel / cells)))
        k[rows] = np.where(there, level.astype(np.int64), _OF_SKY)
        x[rows], y[rows] = away[rows] * ways[:, :, 0], away[rows] * ways[:, :, 1]
    return SeenLand(k, x, y, away)


class Grid(NamedTuple):
    """The cells of a level around the camera's foot: (x, y) is the foot's one, of the level, and `rest` where in it
    the foot is; `side` of a cell, pixels of the finest window."""

    level: int
    x: int
    y: int
    rest: tuple[float, float]
    side: float

    def cells(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns the cells, between samples at pixels' centres, in which places lie."""
        i, j = (np.floor(at / self.side + (rest - 0.5)) for at, rest in zip((x, y), self.rest, strict=True))
        return i.astype(np.int64), j.astype(np.int64)

    def place(self, i: int, j: int) -> tuple[float, float, float]:
        """Returns where a sample lies, and a cell's side."""
        return (i + 0.5 - self.rest[0]) * self.side, (j + 0.5 - self.rest[1]) * self.side, self.side


def grid_of(camera: Camera, finest: int, k: int) -> Grid:
    """Returns the cells of 2^k pixels of the finest window's level."""
    level = finest - k
    by = 2**level if level >= 0 else None
    x, y = ((at * by if by is not None else at / 2**-level) for at in _at_level_0(camera))
    i, j = math.floor(x), math.floor(y)
    return Grid(level, i, j, (float(x - i), float(y - j)), math.ldexp(1.0, k))


def _at_level_0(camera: Camera) -> tuple[Fraction, Fraction]:
    by = Fraction(2) ** -camera.level
    return camera.x * by, camera.y * by


class Fine(NamedTuple):
    """A window: its first sample's cell, and which of its blocks (n, n) are made."""

    k: int
    left: int
    top: int
    made: np.ndarray


class LandPart(NamedTuple):
    """A part of the picture, with the windows that it is seen by, coarsest first."""

    box: Rect
    windows: list[Fine]


def parts_of(seen: SeenLand, camera: Camera, finest: int, size: tuple[int, int], cells: int) -> Iterator[LandPart]:
    """Yields the parts of a picture that show land; `cells` of a window's side."""
    grids: dict[int, Grid] = {}
    waiting = [Rect(0, 0, *size)]
    while waiting:
        box = waiting.pop()
        rows, columns = seen.within(box, _PIXELS_AROUND)
        k = seen.k[rows, columns]
        shown = np.unique(k[k != _OF_SKY]).tolist()
        if not shown:
            continue
        smallest = max(box.width, box.height) <= _LEAST_PART
        if len(shown) <= PART_WINDOWS or smallest:
            found = []
            for one in shown[::-1][-PART_WINDOWS:]:
                grid = grids.setdefault(one, grid_of(camera, finest, one))
                there = k == one
                at = grid.cells(seen.x[rows, columns][there], seen.y[rows, columns][there])
                found.append(_window_around(one, at, cells, smallest))
            whole = [one for one in found if one is not None]
            if len(whole) == len(found):
                yield LandPart(box, whole)
                continue
        waiting += _halves(box)


def _halves(box: Rect) -> list[Rect]:
    x0, y0, x1, y1 = box
    if box.width >= box.height:
        x = x0 + (box.width // 2 + _COLUMN_STEP - 1) // _COLUMN_STEP * _COLUMN_STEP
        return [Rect(x, y0, x1, y1), Rect(x0, y0, x, y1)]
    y = y0 + box.height // 2
    return [Rect(x0, y, x1, y1), Rect(x0, y0, x1, y)]


def _window_around(k: int, at: tuple[np.ndarray, np.ndarray], cells: int, smallest: bool) -> Fine | None:
    """Returns the window around cells; None where these are too far apart, unless the part is the `smallest`: then
    those around the middle are in it."""
    corner = []
    for i in at:
        low, high = int(i.min()) - _CELLS_AROUND, int(i.max()) + _CELLS_AROUND
        first = low // LAID_SIDE * LAID_SIDE
        if high >= first + cells:
            if not smallest:
                return None
            first = (int(np.median(i)) - cells // 2) // LAID_SIDE * LAID_SIDE
        corner.append(first)
    n = cells // LAID_SIDE
    made = np.zeros((n, n), np.bool_)
    for dx in (-_CELLS_AROUND, _CELLS_AROUND):
        for dy in (-_CELLS_AROUND, _CELLS_AROUND):
            column, row = ((i + d - first) // LAID_SIDE for i, d, first in zip(at, (dx, dy), corner, strict=True))
            inside = (column >= 0) & (column < n) & (row >= 0) & (row < n)
            made[row[inside], column[inside]] = True
    return Fine(k, corner[0], corner[1], made)
