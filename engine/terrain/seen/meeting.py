"""Where a ray meets the tiles of land that are held, in float64: what the pointer is over.  Light, without kernels."""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from engine.terrain.seen.eye import Eye, as_fraction, from_whole
from engine.terrain.seen.land_tiles import FINER, QUADS, TEXELS, UNIT, LandTile

_NONE = math.inf


class Hit(NamedTuple):
    """A place on the land: pixels of level 0 from the painting's origin, the height there, how far it is."""

    x: Fraction
    y: Fraction
    z: float
    away: float


def met(tiles: Iterable[LandTile], eye: Eye, way: np.ndarray) -> Hit | None:
    """Returns where a ray from the eye along `way`, of length 1, first meets one of the tiles: bilinear patches between
    the corners of their texels."""
    nearest, high = _NONE, as_fraction(eye.z)
    for tile in tiles:
        side = math.ldexp(1.0, -tile.key.level - FINER)
        o = _from(tile, eye, high)
        begins, ends = _over(o, way)
        if ends > begins and begins * side < nearest:
            nearest = min(nearest, _first(tile.surface, o, way, begins, ends) * side)
    if nearest == _NONE:
        return None
    dx, dy, dz = (float(v) * nearest for v in way)
    return Hit(eye.x + as_fraction(dx), eye.y + as_fraction(dy), eye.z + dz, nearest)


def _from(tile: LandTile, eye: Eye, high: Fraction) -> tuple[float, float, float]:
    """Returns where the eye, which is so high, is from a tile's first corner and base, in pixels of its texels."""
    (level, x, y), fine = tile.key, tile.key.level + FINER
    up = math.ldexp(from_whole(high, level + UNIT, tile.base), FINER - UNIT)
    return from_whole(eye.x, fine, x * TEXELS), from_whole(eye.y, fine, y * TEXELS), up


def _over(o: tuple[float, float, float], way: np.ndarray) -> tuple[float, float]:
    """Returns from where to where a ray is above a tile."""
    begins, ends = 0.0, _NONE
    for at, d in zip(o[:2], way[:2].tolist(), strict=True):
        if d == 0.0:
            if not 0.0 <= at <= TEXELS:
                return 0.0, -1.0
            continue
        a, b = -at / d, (TEXELS - at) / d
        begins, ends = max(begins, min(a, b)), min(ends, max(a, b))
    return begins, ends


def _first(surface: np.ndarray, o: tuple[float, float, float], way: np.ndarray, begins: float, ends: float) -> float:
    """Returns where a ray first meets a surface, in pixels of its texels; infinity if it does not."""
    if not math.isfinite(ends):  # straight down
        ends = abs(o[2]) + 2.0 * TEXELS + float(np.abs(surface).max()) * (1 << FINER)
    lines = np.arange(TEXELS + 1)
    cuts = [(lines - at) / d for at, d in zip(o[:2], way[:2].tolist(), strict=True) if abs(d) > 1e-12]
    along = np.concatenate([*cuts, [begins, ends]])
    along = np.unique(along[(along >= begins) & (along <= ends)])
    if len(along) < 2:
        return _NONE
    t, span = along[:-1], np.diff(along)
    middle = t + 0.5 * span
    i, j = (np.clip(np.floor(o[a] + middle * way[a]), 0, TEXELS - 1).astype(np.int64) for a in (0, 1))
    h = [surface[j + dj, i + di].astype(np.float64) * (1 << FINER) for dj in (0, 1) for di in (0, 1)]
    across, down = h[1] - h[0], h[2] - h[0]
    twist = h[3] - h[1] - down
    u, v = o[0] + t * way[0] - i, o[1] + t * way[1] - j
    above = o[2] + t * way[2] - (h[0] + across * u + down * v + twist * u * v)
    slope = way[2] - (across * way[0] + down * way[1] + twist * (u * way[1] + v * way[0]))
    roots = _roots(-twist * way[0] * way[1], slope, above, span)
    hit = np.flatnonzero(roots >= 0.0)
    return float(t[hit[0]] + roots[hit[0]]) if len(hit) else _NONE


def _roots(a: np.ndarray, b: np.ndarray, c: np.ndarray, span: np.ndarray) -> np.ndarray:
    """Returns the first root of a s^2 + b s + c in 0..span; 0 where c is not above 0; -1 where there is none."""
    with np.errstate(divide="ignore", invalid="ignore"):
        d = b * b - 4.0 * a * c
        q = -0.5 * (b + np.copysign(np.sqrt(d), b))
        both = np.stack([q / a, c / q, np.where(b < 0.0, -c / b, np.nan) + 0.0 * d])
        both[2] = np.where(np.abs(a) < 1e-14, both[2], np.nan)
        both = np.where((both >= 0.0) & (both <= span + 1e-9), both, _NONE)
    least = both.min(axis=0)
    out: np.ndarray = np.where(c <= 0.0, 0.0, np.where(np.isfinite(least), least, -1.0))
    return out


def ground_under(tiles: Iterable[LandTile], x: Fraction, y: Fraction) -> float | None:
    """Returns how high the finest of the tiles at a place is there, in pixels of level 0; None if none covers it."""
    best: LandTile | None = None
    over: dict[int, tuple[int, int]] = {}  # by level, the tile at the place
    for tile in tiles:
        level = tile.key.level
        if best is not None and level <= best.key.level:
            continue
        if level not in over:
            over[level] = _floor(x, level) // QUADS, _floor(y, level) // QUADS
        if (tile.key.x, tile.key.y) == over[level]:
            best = tile
    return None if best is None else height_in(best, x, y)


def _floor(place: Fraction, level: int) -> int:
    """Returns the pixel of a level at a place."""
    above, below = place.numerator << max(level, 0), place.denominator << max(-level, 0)
    return above // below


def height_in(tile: LandTile, x: Fraction, y: Fraction) -> float:
    """Returns how high a tile is at a place within it, in pixels of level 0."""
    fine = tile.key.level + FINER
    u, v = from_whole(x, fine, tile.key.x * TEXELS), from_whole(y, fine, tile.key.y * TEXELS)
    i, j = (min(max(int(w), 0), TEXELS - 1) for w in (u, v))
    u, v = u - i, v - j
    (a, b), (c, d) = tile.surface[j : j + 2, i : i + 2].astype(np.float64).tolist()
    top, low = a + u * (b - a), c + u * (d - c)
    return math.ldexp(top + v * (low - top) + math.ldexp(tile.base, -UNIT), -tile.key.level)
