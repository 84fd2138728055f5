"""Light laid on a tile of land once and for all: sun with a soft shadow, sky, what hollows keep; as `daylight` has it,
but for whole squares at once.

How high the land stands against the sun is looked for along the sun's way in steps that grow: the same shift for every
place of a square, so each step is a difference of two parts of one array.  What is far away is looked for in squares of
coarser levels around it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

SUN = (300.0, 28.0)  # degrees from the top of the canvas, clockwise, and above the horizon
_SOFT = 0.045  # of the sun's slope: how far its rim is from its middle, as haze makes it
_DARKEST = 0.42
_WARM, _SKY, _BOUNCE = (3.3, 2.65, 1.85), (0.34, 0.46, 0.70), (0.22, 0.18, 0.13)
_WATER = (0.05, 0.10, 0.13)
_FIRST, _GROWS = 1.25, 1.35  # pixels of the first step towards the sun, and how much longer the next one is


class Square(NamedTuple):
    """Heights (n, n) of corners of a level, in pixels of it above a common base told in the finest square's pixels:
    `scale` of those is one of its own.  `inset`: where the finest square's inner part begins, (x, y) pixels from its
    first corner, and `across`, how many of its own pixels that is wide."""

    heights: np.ndarray
    scale: float
    inset: tuple[float, float]
    across: float


def towards_sun(sun: tuple[float, float] = SUN) -> tuple[float, float, float]:
    """Returns the way to the sun: x, y on the canvas, z upwards; length 1."""
    azimuth, altitude = (math.radians(v) for v in sun)
    flat = math.cos(altitude)
    return flat * math.sin(azimuth), -flat * math.cos(azimuth), math.sin(altitude)


def steps_to(room: float, first: float = _FIRST) -> list[float]:
    """Returns the distances at which the land is looked at, pixels, none beyond `room`."""
    found, at = list[float](), first
    while at <= room:
        found.append(at)
        at = at * _GROWS + 0.25
    return found


def sunlit(squares: Sequence[Square], sides: int, sun: tuple[float, float] = SUN) -> np.ndarray:
    """Returns how much of the sun the corners (sides, sides) of the inner part of the first square see, 0..1; the
    others are coarser ones around it, finest first."""
    x, y, z = towards_sun(sun)
    flat = math.hypot(x, y)
    highest = np.full((sides, sides), -np.inf, np.float32)
    left, top = (int(v) for v in squares[0].inset)
    inner = squares[0].heights[top : top + sides, left : left + sides]
    first = _FIRST
    for square in squares:
        room = min(square.inset) / max(abs(x / flat), abs(y / flat)) - 1.0
        columns, rows = (v + np.arange(sides) * (square.across / (sides - 1)) for v in square.inset)
        for at in steps_to(room, first / square.scale):
            there = _bilinear(square.heights, rows + at * y / flat, columns + at * x / flat) * np.float32(square.scale)
            np.maximum(highest, (there - inner) / np.float32(at * square.scale), out=highest)
        first = room * square.scale
    slope = z / flat
    t = np.clip((slope * (1.0 + _SOFT) - highest) / (2.0 * _SOFT * slope), 0.0, 1.0)
    out: np.ndarray = t * t * (3.0 - 2.0 * t)
    return out


def _bilinear(values: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Returns values between samples."""
    j, i = np.floor(rows).astype(np.int64), np.floor(columns).astype(np.int64)
    v, u = (rows - j).astype(np.float32)[:, None], (columns - i).astype(np.float32)[None]
    near, after = values[j], values[j + 1]
    mixed = near + v * (after - near)
    left, right = mixed[:, i], mixed[:, i + 1]
    out: np.ndarray = left + u * (right - left)
    return out


def lit(
    heights: np.ndarray, colours: np.ndarray, seen: np.ndarray, margin: int, sea: float, sun: tuple[float, float] = SUN
) -> np.ndarray:
    """Returns the light (n, n, 3) of ground: `heights` of corners with `margin` (4 or more) more on each side, pixels;
    linear `colours` and how much of the sun is `seen`, (n, n).  What is not above `sea` is water."""
    x, y, z = towards_sun(sun)
    h = heights.astype(np.float32)

    def at(dx: int, dy: int) -> np.ndarray:
        n, m = len(h) - 2 * margin, margin
        return h[m + dy : m + dy + n, m + dx : m + dx + n]

    gx, gy = (at(1, 0) - at(-1, 0)) * 0.5, (at(0, 1) - at(0, -1)) * 0.5
    nz = 1.0 / np.sqrt(1.0 + gx * gx + gy * gy)
    open_sky = np.ones_like(nz)
    for q in (3, min(12, margin)):
        around = 0.25 * (at(q, 0) + at(-q, 0) + at(0, q) + at(0, -q))
        open_sky -= 0.55 * np.maximum(0.0, around - at(0, 0)) / q
    np.maximum(open_sky, _DARKEST, out=open_sky)
    direct = np.maximum(0.0, nz * (z - gx * x - gy * y)) * seen
    up = 0.5 + 0.5 * nz
    out = np.empty((*nz.shape, 3), np.float32)
    water = at(0, 0) <= sea + 1e-3
    for c in range(3):
        light = _WARM[c] * direct + open_sky * (_SKY[c] * up + _BOUNCE[c] * (1.0 - up))
        out[..., c] = np.where(water, _WATER[c] * (0.6 + 0.9 * seen), colours[..., c] * light)
    return out
