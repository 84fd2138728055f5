"""The centre line of a stroke: where it runs, how thick it is, and how far from it a place lies.

Lengths are in units of the brush's diameter, from the pixel where the stroke begins; y goes downward.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from engine.numeric import elementary
from engine.numeric.kernel import uncounted

POINTS_MOST = 256
LINE_STEPS = 1024.0  # of a unit: what a key tells of places and sizes
_BEYOND = 1e30


@dataclass(frozen=True, slots=False)
class CentreLine:
    """`told`: x, y and size of each point in turn, in steps of 1 / LINE_STEPS; it has one at least."""

    told: tuple[int, ...]

    @cached_property
    def points(self) -> np.ndarray:
        """Gives x, y, size, and how far along each point lies: float64 (n, 4), two at least."""
        found = np.array(self.told, np.float64).reshape(-1, 3) / LINE_STEPS
        if len(found) == 1:
            found = np.concatenate([found, found + np.array([1.0 / LINE_STEPS, 0.0, 0.0])])
        steps = np.diff(found[:, :2], axis=0)
        lengths = _far(steps[:, 0], steps[:, 1])
        along = np.concatenate([[0.0], np.cumsum(lengths)])
        return np.concatenate([found, along[:, None]], axis=1)

    @property
    def length(self) -> float:
        """Gives how long it is."""
        return float(self.points[-1, 3])

    @cached_property
    def box(self) -> tuple[float, float, float, float]:
        """Gives the least and the greatest x and y."""
        low, high = self.points[:, :2].min(axis=0), self.points[:, :2].max(axis=0)
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    def at(self, along: np.ndarray) -> tuple[np.ndarray, ...]:
        """Returns x, y, size, and the direction (cos, sin), so far along: float64 (n,) each."""
        points = self.points
        k = np.clip(np.searchsorted(points[:, 3], along, side="right") - 1, 0, len(points) - 2)
        a, b = points[k], points[k + 1]
        long = np.maximum(b[:, 3] - a[:, 3], 1e-9)
        part = (along - a[:, 3]) / long
        x, y, size = (a[:, c] + (b[:, c] - a[:, c]) * part for c in range(3))
        return x, y, size, (b[:, 0] - a[:, 0]) / long, (b[:, 1] - a[:, 1]) / long

    def about(self, xs: np.ndarray, ys: np.ndarray) -> np.ndarray:
        """Returns of places, float64 (n,) each, how far along and to the right they lie of the nearest point of the
        line, its direction and its size: float64 (4, n)."""
        out = np.empty((4, xs.size))
        if xs.size:
            _nearest(xs, ys, self._near(xs, ys), out)
        return out

    def _near(self, xs: np.ndarray, ys: np.ndarray) -> np.ndarray:
        """Returns the parts of the line that may be nearest to any of the places: float64 (n, 8)."""
        points = self.points
        parts = np.concatenate([points[:-1], points[1:]], axis=1)
        middle = np.array([0.5 * (xs.min() + xs.max()), 0.5 * (ys.min() + ys.max())])
        reach = float(_far(xs.max() - middle[0], ys.max() - middle[1]))
        half = 0.5 * (parts[:, :2] + parts[:, 4:6])
        away = _far(half[:, 0] - middle[0], half[:, 1] - middle[1])
        long = 0.5 * (parts[:, 7] - parts[:, 3])
        nearest = float((away + long).min()) + reach
        return np.ascontiguousarray(parts[away - long - reach <= nearest * (1.0 + 1e-9) + 1e-9])


def _far(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    out: np.ndarray = np.sqrt(x * x + y * y)
    return out


@uncounted
def _nearest(xs: np.ndarray, ys: np.ndarray, parts: np.ndarray, out: np.ndarray) -> None:
    """Writes along, across, direction and size of the nearest point of some parts of a line: their ends as (x, y, size,
    along) twice, float64 (n, 8)."""
    for i in range(xs.size):
        best, where, part_at = _BEYOND, 0, 0.0
        for k in range(parts.shape[0]):
            ex, ey = parts[k, 4] - parts[k, 0], parts[k, 5] - parts[k, 1]
            dx, dy = xs[i] - parts[k, 0], ys[i] - parts[k, 1]
            squared = max(ex * ex + ey * ey, 1e-18)
            part = min(max((dx * ex + dy * ey) / squared, 0.0), 1.0)
            fx, fy = dx - part * ex, dy - part * ey
            far = fx * fx + fy * fy
            if far < best:
                best, where, part_at = far, k, part
        ex, ey = parts[where, 4] - parts[where, 0], parts[where, 5] - parts[where, 1]
        dx, dy = xs[i] - parts[where, 0], ys[i] - parts[where, 1]
        side = 1.0 if ex * dy - ey * dx >= 0.0 else -1.0
        out[0, i] = parts[where, 3] + part_at * (parts[where, 7] - parts[where, 3])
        out[1, i] = side * math.sqrt(best)
        out[2, i] = elementary.atan2(ey, ex)
        out[3, i] = parts[where, 2] + part_at * (parts[where, 6] - parts[where, 2])


STRAIGHT_LINE = CentreLine(
    (
        -int(4096 * LINE_STEPS),
        int(LINE_STEPS),
        int(LINE_STEPS),
        int(4096 * LINE_STEPS),
        int(LINE_STEPS),
        int(LINE_STEPS),
    )
)


def simplified(places: Sequence[tuple[float, float, float]]) -> CentreLine:
    """Returns the line through places (x, y, size), in units: of these as many as are told, evenly, each as soon as it
    lies so far from the one before."""
    apart = 1.0 / 16.0
    while True:
        kept = [places[0]]
        for place in places[1:]:
            if (place[0] - kept[-1][0]) ** 2 + (place[1] - kept[-1][1]) ** 2 >= apart * apart:
                kept.append(place)
        if kept[-1] != places[-1]:
            kept.append(places[-1])
        if len(kept) <= POINTS_MOST:
            return CentreLine(tuple(round(v * LINE_STEPS) for place in kept for v in place))
        apart *= 1.25
