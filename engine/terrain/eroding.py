"""Erosion by rain and by what comes down on its own: heights in, heights out.

Drops run down the slope, take up ground where they are fast and lay it down where they slow (Beyer 2015), on grids of
a quarter, a half and all of the samples, so that valleys are as long as the land lets them; then what is steeper than
loose ground can be slides (thermal weathering, Musgrave, Kolb, Mace 1989); last, what is lower or higher than all
around it is levelled.  Sums, products, quotients and roots alone, in one order: the same bits everywhere.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from engine.numeric.kernel import inlined, kernel

_SCALES = 3
_SHORTEST = 24  # samples of a side, below which no coarser grid is worth it
_LIFE = 64  # steps of a drop
_INERTIA, _PULL, _DRAG, _DRYING = 0.12, 0.3, 0.14, 0.02
_CARRIES, _LEAST, _TAKES, _LEAVES = 0.8, 0.008, 0.16, 0.2
_RADIUS = 2  # samples around a drop that it takes ground from
_RIM = _RADIUS + 1  # samples along the border that stay
_AT_ONCE = 8192  # drops between looks at whether it is still wanted
_SLIDES = 24  # steps of what slides
_LEVELLED = 4


@dataclass(frozen=True)
class Weather:
    """`rain`: drops of a sample; `strength`: of what they take, 0..1; `talus`: the steepest slope of loose ground, in
    pixels of height a pixel, None where nothing slides; `seed`: of where drops fall."""

    rain: float = 0.6
    strength: float = 0.5
    talus: float | None = 1.0
    seed: int = 0


def eroded(heights: np.ndarray, weather: Weather) -> np.ndarray:
    """Returns heights (h, w), float64, in samples' sides, after that weather."""
    work = eroding(heights, weather)
    while True:
        try:
            next(work)
        except StopIteration as told:
            return np.asarray(told.value)


def eroding(heights: np.ndarray, weather: Weather) -> Generator[float, None, np.ndarray]:
    """Works out `eroded`, which it returns; yields the part that is done, every some milliseconds."""
    grids = [np.ascontiguousarray(heights, np.float64)]
    while len(grids) < _SCALES and min(grids[-1].shape) >= 2 * _SHORTEST:
        grids.append(_halved(grids[-1]))
    h, done, whole = grids[-1], 0, sum(grid.size for grid in grids)
    for k in range(len(grids) - 1, -1, -1):
        before = grids[k]
        h = before + _doubled(h - grids[k + 1], before.shape) if k < len(grids) - 1 else before.copy()
        count = int(weather.rain * h.size)
        for first in range(0, count, _AT_ONCE):
            rain(h, first, min(first + _AT_ONCE, count), weather.seed * 4 + k, weather.strength, _NEAR)
            yield 0.9 * (done + first / count * h.size) / whole
        done += h.size
    for step in range(_SLIDES if weather.talus is not None else 0):
        moved = np.zeros_like(h)
        slide(h, float(weather.talus or 0.0), moved)
        h += moved
        yield 0.9 + 0.1 * step / _SLIDES
    for _ in range(_LEVELLED):
        h = _levelled(h)
    yield 1.0
    return h


def _halved(h: np.ndarray) -> np.ndarray:
    """Returns the means of 2 x 2 samples, in pixels twice as wide; the last row or column of an odd number twice."""
    rows, columns = h.shape[0] % 2, h.shape[1] % 2
    h = np.pad(h, ((0, rows), (0, columns)), "edge")
    out: np.ndarray = ((h[::2, ::2] + h[1::2, ::2]) + (h[::2, 1::2] + h[1::2, 1::2])) * 0.125
    return out


def _doubled(h: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Returns samples between those of a grid half as fine, in pixels half as wide."""
    for axis in (0, 1):
        at = (np.arange(shape[axis]) + 0.5) / 2.0 - 0.5
        at = np.clip(at, 0.0, h.shape[axis] - 1.0)
        first = np.minimum(at.astype(np.int64), max(0, h.shape[axis] - 2))
        part = (at - first).reshape([-1, 1] if axis == 0 else [1, -1])
        low, high = np.take(h, first, axis), np.take(h, np.minimum(first + 1, h.shape[axis] - 1), axis)
        h = low + part * (high - low)
    return 2.0 * h


def _levelled(h: np.ndarray) -> np.ndarray:
    """Returns heights none of which is below or above all eight around it."""
    about = np.pad(h, 1, "edge")
    rows, columns = h.shape
    around = [about[y : y + rows, x : x + columns] for y in range(3) for x in range(3) if (y, x) != (1, 1)]
    low, high = around[0], around[0]
    for other in around[1:]:
        low, high = np.minimum(low, other), np.maximum(high, other)
    out = h.copy()
    inside = np.s_[1:-1, 1:-1]
    out[inside] = np.minimum(np.maximum(h[inside], low[inside]), high[inside])
    return out


def _near() -> np.ndarray:
    """Returns how much of what a drop takes comes from the samples around it: their sum is 1."""
    out = np.arange(-_RADIUS, _RADIUS + 1.0)
    out = np.maximum(0.0, 1.0 - np.sqrt(out[:, None] * out[:, None] + out * out) / (_RADIUS + 0.5))
    total = 0.0
    for value in out.ravel().tolist():
        total += value
    return np.asarray(out / total)


_NEAR = _near()


@inlined
def _fallen(drop: int, seed: int) -> np.uint64:
    """Where a drop falls: two numbers of 32 bits."""
    v = np.uint64(drop) * np.uint64(0x9E3779B97F4A7C15) + np.uint64(seed) * np.uint64(0xD1B54A32D192ED03)
    v = (v ^ (v >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    v = (v ^ (v >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return v ^ (v >> np.uint64(31))


@inlined
def _sloped(h: np.ndarray, j: int, i: int, a: float, b: float) -> tuple[float, float, float]:
    """How steep it is between four samples, to the right and down, and how high."""
    nw, ne, sw, se = h[j, i], h[j, i + 1], h[j + 1, i], h[j + 1, i + 1]
    gx = (ne - nw) * (1.0 - b) + (se - sw) * b
    gy = (sw - nw) * (1.0 - a) + (se - ne) * a
    return gx, gy, (nw * (1.0 - a) + ne * a) * (1.0 - b) + (sw * (1.0 - a) + se * a) * b


@inlined
def _take(h: np.ndarray, j: int, i: int, taken: float, near: np.ndarray) -> None:
    for y in range(2 * _RADIUS + 1):
        for x in range(2 * _RADIUS + 1):
            h[j + y - _RADIUS, i + x - _RADIUS] -= taken * near[y, x]


@inlined
def _leave(h: np.ndarray, j: int, i: int, a: float, b: float, left: float) -> None:
    h[j, i] += left * (1.0 - a) * (1.0 - b)
    h[j, i + 1] += left * a * (1.0 - b)
    h[j + 1, i] += left * (1.0 - a) * b
    h[j + 1, i + 1] += left * a * b


@kernel
def rain(h: np.ndarray, first: int, last: int, seed: int, strength: float, near: np.ndarray) -> None:
    """Drops first..last - 1 change heights (h, w), one after the other."""
    rows, columns = h.shape
    for drop in range(first, last):
        v = _fallen(drop, seed)
        x = float(v & np.uint64(0xFFFFFFFF)) / 4294967296.0 * (columns - 2 * _RIM) + _RIM
        y = float(v >> np.uint64(32)) / 4294967296.0 * (rows - 2 * _RIM) + _RIM
        dx = dy = sediment = 0.0
        speed, water = 0.5, 1.0
        for _ in range(_LIFE):
            i, j = int(x), int(y)
            a, b = x - i, y - j
            gx, gy, here = _sloped(h, j, i, a, b)
            dx = dx * _INERTIA - gx * (1.0 - _INERTIA)
            dy = dy * _INERTIA - gy * (1.0 - _INERTIA)
            size = np.sqrt(dx * dx + dy * dy)
            if size < 1e-9:
                break
            dx /= size
            dy /= size
            x, y = x + dx, y + dy
            if x < _RIM or y < _RIM or x >= columns - _RIM or y >= rows - _RIM:
                break
            fall = here - _sloped(h, int(y), int(x), x - int(x), y - int(y))[2]
            carries = max(fall, _LEAST) * speed * water * _CARRIES
            if fall <= 0.0 or sediment > carries:
                left = min(-fall, sediment) if fall <= 0.0 else (sediment - carries) * _LEAVES
                sediment -= left
                _leave(h, j, i, a, b, left)
            else:
                taken = min((carries - sediment) * _TAKES * 2.0 * strength, fall)
                sediment += taken
                _take(h, j, i, taken, near)
            speed = np.sqrt(max(0.01, (speed * speed + _PULL * fall) * (1.0 - _DRAG)))
            water *= 1.0 - _DRYING


@kernel
def slide(h: np.ndarray, talus: float, moved: np.ndarray) -> None:
    """Adds to `moved` (h, w) what slides from each sample to the lowest around it, where it is steeper than that."""
    rows, columns = h.shape
    for j in range(rows):
        for i in range(columns):
            most, to_j, to_i = 0.0, j, i
            for oy in range(-1, 2):
                for ox in range(-1, 2):
                    if 0 <= j + oy < rows and 0 <= i + ox < columns:
                        far = 1.4142135623730951 if ox != 0 and oy != 0 else 1.0
                        over = h[j, i] - h[j + oy, i + ox] - talus * far
                        if over > most:
                            most, to_j, to_i = over, j + oy, i + ox
            if most > 0.0:
                moved[j, i] -= 0.2 * most
                moved[to_j, to_i] += 0.2 * most
