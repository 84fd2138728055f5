"""Rays that meet land: exactly, with the bilinear patch between four samples, through maximum mipmaps of nested windows
(Tevs, Ihrke, Seidel 2008; windows as in a clipmap).

A window is (n + 1, n + 1) float32 heights in pixels of its own level; cell (i, j) lies between samples i, i + 1 and j,
j + 1.  A row of `places` is a window's first sample and its pixel, (x, y, side), in pixels of the finest window, from
the camera's foot: float64, as rays are.  Finest last.
"""

from __future__ import annotations

import math

import numpy as np

from engine.numeric.kernel import inlined, inner_uncounted, kernel

_PAST = 1e-6  # cells by which a ray goes on past the rim of a cell
CELLS_PER_PIXEL = 1.5  # beyond so many pixels of a window to one of the picture, the next coarser one is seen
MISSED = -1.0


def mipmap_of(cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns (offsets, sides) of the levels of a mipmap over `cells` cells a side, a power of two.  The first level,
    that of the cells, is none of it: four heights tell as much, and it would take as much room as all of these."""
    sides = np.array([cells >> k for k in range(cells.bit_length())], np.int64)
    return np.concatenate([[0, 0], np.cumsum(sides[1:] * sides[1:])[:-1]])[: len(sides)].astype(np.int64), sides


def room_of(mips: tuple[np.ndarray, np.ndarray]) -> int:
    """Returns how many numbers a mipmap holds."""
    sides = mips[1][1:]
    return int((sides * sides).sum())


def maxima(heights: np.ndarray) -> np.ndarray:
    """Returns the largest height of each 2 x 2 cells, then of each 2 x 2 of these, and so on, one after another."""
    rows = np.maximum(np.maximum(heights[:-1:2], heights[1::2]), heights[2::2])
    level = np.maximum(np.maximum(rows[:, :-1:2], rows[:, 1::2]), rows[:, 2::2])
    found = [level.ravel()]
    while len(level) > 1:
        rows = np.maximum(level[::2], level[1::2])
        level = np.maximum(rows[:, ::2], rows[:, 1::2])
        found.append(level.ravel())
    return np.concatenate(found)


@inlined
def between(h: np.ndarray, x: float, y: float) -> float:
    """Returns the bilinear surface; x and y within the window."""
    i = int(x)
    j = int(y)
    u = x - i
    v = y - j
    top = h[j, i] + u * (h[j, i + 1] - h[j, i])
    low = h[j + 1, i] + u * (h[j + 1, i + 1] - h[j + 1, i])
    return float(top + v * (low - top))


@inlined
def _in_patch(a: float, b: float, c: float, length: float) -> float:
    """The first root of a s^2 + b s + c in 0..length, c above 0; -1 where there is none."""
    s = -1.0
    if abs(a) < 1e-14:
        if b < 0.0:
            s = -c / b
    else:
        d = b * b - 4.0 * a * c
        if d >= 0.0:
            q = -0.5 * (b + math.copysign(math.sqrt(d), b))
            first = q / a
            second = c / q if q != 0.0 else -1.0
            if first > second:
                first, second = second, first
            s = first if first >= 0.0 else second
    return s if s <= length + _PAST else -1.0


@inner_uncounted
def _first_hit(
    h: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    ox: float,
    oy: float,
    oz: float,
    dx: float,
    dy: float,
    dz: float,
    t: float,
    end: float,
    k: int,
) -> float:
    """Where in t..end a ray first meets a window, all in its cells; MISSED if it does not.  `k`: the level of the
    mipmap with which it begins, low where land is near."""
    offsets, sides = mips[0], mips[1]
    n, top = sides[0], len(sides) - 1
    right, down = (1 if dx >= 0.0 else 0), (1 if dy >= 0.0 else 0)
    ix, iy = (1.0 / dx if dx != 0.0 else 1e30), (1.0 / dy if dy != 0.0 else 1e30)
    while t < end:
        x = ox + t * dx
        y = oy + t * dy
        if x < 0.0 or y < 0.0 or x >= n or y >= n:
            return MISSED
        z = oz + t * dz
        i, j = int(x) >> k, int(y) >> k
        tx, ty = (((i + right) << k) - ox) * ix, (((j + down) << k) - oy) * iy
        out = max(t, min(min(tx, ty), end))
        low = min(z, oz + out * dz)
        if k > 0:
            most = tops[offsets[k] + j * sides[k] + i]
            if low <= most:
                if z > most:
                    t = max(t, min(out, t + (z - most) / -dz) - _PAST)
                k -= 1
                continue
        else:
            here, east, south, other = h[j, i], h[j, i + 1], h[j + 1, i], h[j + 1, i + 1]
            if low <= max(max(here, east), max(south, other)):
                across, along = east - here, south - here
                twist = other - east - along
                u, v = x - i, y - j
                above = z - (here + across * u + along * v + twist * u * v)
                slope = dz - (across * dx + along * dy + twist * (u * dy + v * dx))
                s = 0.0 if above <= 0.0 else _in_patch(-twist * dx * dy, slope, above, out - t)
                if s >= 0.0:
                    return t + s
        t = out + _PAST
        if k < top and ((tx <= ty and (i & 1) == right) or (ty <= tx and (j & 1) == down)):
            k += 1
    return MISSED


@inlined
def _inside(place: np.ndarray, n: int, o: np.ndarray, ix: float, iy: float, far: float) -> tuple[float, float]:
    """From where to where a ray, by the inverse of its direction, is above a window; it begins after it ends where it
    never is."""
    wide = n * place[2] * 0.999999
    a, b = (place[0] - o[0]) * ix, (place[0] - o[0] + wide) * ix
    c, e = (place[1] - o[1]) * iy, (place[1] - o[1] + wide) * iy
    return max(0.0, max(min(a, b), min(c, e))), min(far, min(max(a, b), max(c, e)))


@inner_uncounted
def nearest_land(
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    o: np.ndarray,
    d: np.ndarray,
    start: float,
    far: float,
    cone: float,
    k: int,
) -> tuple[float, int]:
    """Returns (t, window) of the first land that a ray meets from `start` to `far`, in pixels of the finest window;
    (MISSED, -1) where it meets none.  `cone`: how much a pixel grows along it; 0 for one that has no width.  `k`: as
    `_first_hit` has it.

    At each place the finest window counts whose cells are not too small for a pixel; what lies before a finer window is
    followed in the coarser one up to where that begins.
    """
    n = mips[1, 0]
    ix, iy = (1.0 / d[0] if d[0] != 0.0 else 1e300), (1.0 / d[1] if d[1] != 0.0 else 1e300)
    cells = CELLS_PER_PIXEL / cone if cone > 0.0 else 1e300
    t = start
    while t < far:
        found, until, to_finer = -1, far, far
        for w in range(len(places) - 1, -1, -1):
            finest_until = cells * places[w, 2]
            if w > 0 and t >= finest_until:
                continue
            begins, ends = _inside(places[w], n, o, ix, iy, far)
            if w > 0:
                ends = min(ends, finest_until)
            if ends <= begins or t >= ends - _PAST * places[w, 2]:
                continue
            if begins <= t:
                found, until = w, min(ends, to_finer)
                break
            to_finer = min(to_finer, begins)
        if found < 0:
            if to_finer >= far:
                break
            t = to_finer + _PAST
            continue
        s = places[found, 2]
        x, y = (o[0] - places[found, 0]) / s, (o[1] - places[found, 1]) / s
        hit = _first_hit(heights[found], tops[found], mips, x, y, o[2] / s, d[0], d[1], d[2], t / s, until / s, k)
        if hit >= 0.0:
            return hit * s, found
        t = max(until, t + _PAST)
    return MISSED, -1


@kernel
def cast(
    heights: np.ndarray, tops: np.ndarray, mips: np.ndarray, places: np.ndarray, rays: np.ndarray, hits: np.ndarray
) -> None:
    """Where rays (n, 6), their beginnings and directions of length 1, first meet land: hits (n, 2), the distance and
    the window.  `mips` int64 (2, k): offsets and sides of the mipmaps in `tops` (windows, ...)."""
    for r in range(len(rays)):
        t, w = nearest_land(heights, tops, mips, places, rays[r, :3], rays[r, 3:], 0.0, 1e18, 0.0, mips.shape[1] - 1)
        hits[r, 0] = t
        hits[r, 1] = w
