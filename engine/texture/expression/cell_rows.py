"""Cells around scattered points, one to each unit square (Worley 1996), along a row of samples."""

from __future__ import annotations

import math

import numpy as np

from engine.numeric.kernel import forced, inner_uncounted
from engine.texture.expression.noise_rows import hash32

DISTANCE, EDGE, RANDOM = 0, 1, 2  # to the nearest point; to the nearest edge of the cell; a number for each cell
MEANS = (0.429, 0.166, 0.5)  # over the plane, for points that lie anywhere in their squares
_FAR = 2.0**30
_FINE, _COARSE = 1.0, 3.0  # units a pixel, between which cells fade to their mean
_HALF = np.uint32(0xFFFF)


@forced
def _point(key: np.uint32, x: int, y: int, jitter: float) -> tuple[float, float]:
    h = hash32(key, x, y)
    right = np.float64(np.int32(h & _HALF)) * (1.0 / 65535.0) - 0.5
    below = np.float64(np.int32(h >> np.uint32(16))) * (1.0 / 65535.0) - 0.5
    return x + 0.5 + jitter * right, y + 0.5 + jitter * below


@inner_uncounted
def _nearest(px: float, py: float, key: np.uint32, jitter: float) -> tuple[int, int, float, float]:
    """Returns the square of the nearest point, and how far that lies right and below."""
    column, row = math.floor(px), math.floor(py)
    best, x, y, right, below = 1e30, column, row, 0.0, 0.0
    for j in range(row - 1, row + 2):
        for i in range(column - 1, column + 2):
            qx, qy = _point(key, i, j, jitter)
            dx, dy = qx - px, qy - py
            far = dx * dx + dy * dy
            if far < best:
                best, x, y, right, below = far, i, j, dx, dy
    return x, y, right, below


@inner_uncounted
def _border(
    px: float, py: float, key: np.uint32, jitter: float, nearest: tuple[int, int, float, float]
) -> tuple[float, float, float]:
    """Returns how far the nearest edge is, and in which direction."""
    x, y, right, below = nearest
    best, across, down = 1e30, 0.0, 0.0
    for j in range(y - 2, y + 3):
        for i in range(x - 2, x + 3):
            if i == x and j == y:
                continue
            qx, qy = _point(key, i, j, jitter)
            dx, dy = qx - px, qy - py
            ex, ey = dx - right, dy - below
            length = math.sqrt(ex * ex + ey * ey)
            if length > 1e-9:
                far = (0.5 * (dx + right) * ex + 0.5 * (dy + below) * ey) / length
                if far < best:
                    best, across, down = far, ex / length, ey / length
    return best, across, down


@inner_uncounted
def cell_row(
    u: np.ndarray, v: np.ndarray, widths: tuple[np.ndarray, np.ndarray], jitter: float, key: np.uint32, kind: int,
    slope: int, out: np.ndarray,
) -> None:  # fmt: skip
    """Writes DISTANCE, EDGE or RANDOM of the cell that each sample lies in; `slope` 1, 2: its slope along u or v."""
    for i in range(out.size):
        width = max(widths[0][i], widths[1][i])
        seen = min(max((_COARSE - width) / (_COARSE - _FINE), 0.0), 1.0)
        value, mean = 0.0, 0.0 if slope else MEANS[kind]
        if seen > 0.0 and abs(u[i]) < _FAR and abs(v[i]) < _FAR:
            found = _nearest(u[i], v[i], key, jitter)
            if kind == RANDOM:
                h = hash32(key ^ np.uint32(0x5BD1E995), found[0], found[1])
                value = 0.0 if slope else np.float64(h >> np.uint32(8)) * (1.0 / 16777215.0)
            elif kind == EDGE:
                far, across, down = _border(u[i], v[i], key, jitter, found)
                value = far if slope == 0 else (-across if slope == 1 else -down)
            else:
                far = math.sqrt(found[2] * found[2] + found[3] * found[3])
                value = far
                if slope:
                    value = -(found[2] if slope == 1 else found[3]) / max(far, 1e-9)
        out[i] = mean + seen * (value - mean)
