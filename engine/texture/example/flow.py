"""Directions around lines: which way the nearest of them runs, or all of them together do."""

from __future__ import annotations

import numpy as np

from engine.numeric.elementary import angles
from engine.numeric.kernel import inner, kernel

_SOFT = 16.0  # px^2, within which a line counts as if it were as far


def flow_around(lines: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Returns the directions of a field, (height, width), that runs along lines, float64 (n, 4), from x, y to x, y, and
    in between as the near ones do: uint8, 256 a turn."""
    sums = np.zeros((2, *size))
    _sum_up(lines, sums)
    turned = np.rint(angles(sums[1], sums[0]) * (128.0 / np.pi)).astype(np.int64)
    out: np.ndarray = (turned & 255).astype(np.uint8)
    return out


@kernel
def _sum_up(lines: np.ndarray, sums: np.ndarray) -> None:
    for y in range(sums.shape[1]):
        for x in range(sums.shape[2]):
            for k in range(lines.shape[0]):
                along, down = lines[k, 2] - lines[k, 0], lines[k, 3] - lines[k, 1]
                near = 1.0 / (_SOFT + _apart(lines[k], x + 0.5, y + 0.5))
                sums[0, y, x] += along * near * near
                sums[1, y, x] += down * near * near


@inner
def _apart(line: np.ndarray, x: float, y: float) -> float:
    """Returns the square of the distance from a line."""
    along, down = line[2] - line[0], line[3] - line[1]
    length = along * along + down * down
    t = ((x - line[0]) * along + (y - line[1]) * down) / length if length > 0.0 else 0.0
    t = min(1.0, max(0.0, t))
    dx, dy = line[0] + t * along - x, line[1] + t * down - y
    apart: float = dx * dx + dy * dy
    return apart


@kernel
def follow(
    lines: np.ndarray, values: np.ndarray, left: float, top: float, nearest: np.ndarray, out: np.ndarray
) -> None:
    """Writes the values, uint8 (n,), of those lines, float64 (n, 5), that are nearest to pixels, into `out`, uint8 (h,
    w), whose corner is `left`, `top`, and how far they are, squared, into `nearest`, float32 (h, w): of each line up to
    its reach, the fifth number.  Of two that are as far the first stays."""
    height, width = out.shape
    for k in range(lines.shape[0]):
        line, reach = lines[k], lines[k, 4]
        y0 = max(0, int(np.floor(min(line[1], line[3]) - reach - top)))
        y1 = min(height, int(np.ceil(max(line[1], line[3]) + reach - top)))
        x0 = max(0, int(np.floor(min(line[0], line[2]) - reach - left)))
        x1 = min(width, int(np.ceil(max(line[0], line[2]) + reach - left)))
        for y in range(y0, y1):
            for x in range(x0, x1):
                apart = np.float32(_apart(line, left + x + 0.5, top + y + 0.5))
                if apart < nearest[y, x] and apart <= reach * reach:
                    nearest[y, x], out[y, x] = apart, values[k]
