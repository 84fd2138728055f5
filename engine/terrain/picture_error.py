"""By how many pixels of a picture by rays the land in it may lie elsewhere than endlessly fine land would."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from fractions import Fraction

import numpy as np

from engine.files.fault import Cancelled
from engine.numeric.address import Rect
from engine.terrain.camera import WINDOW_RIM, Camera, Windows
from engine.terrain.caster import CELLS_PER_PIXEL
from engine.terrain.land_bound import Remainder
from engine.terrain.plane import Land

_LOOKED_AT = 256  # of a window's side that are looked at
_BLOCKS_ACROSS = 4  # of a window's side, each with a bound of its own
_WIDER = 1.2  # than a pixel, that rays may be (as `daylight` has them)
_BEYOND = 1.05  # times what the picture shows, that is looked at


def picture_error(
    land: Land,
    windows: Windows,
    camera: Camera,
    size: tuple[int, int],
    cancelled: Callable[[], bool] | None = None,
) -> Remainder | None:
    """Returns what it comes to, None where that is not known: the bound of each part of a window, seen as near as any
    of it lies that the picture shows by this window.  `hard`: at most, in any of its pixels; `rms`: over all of them,
    each taking as much room as its distance lets it.  Cancelled where `cancelled` says so, asked before each part."""
    cone = 2.0 * math.tan(math.radians(camera.fov) / 2) / size[0]
    finest, hard, squares, room = windows.levels[-1], 0.0, 0.0, 0.0
    for w, level in enumerate(windows.levels):
        for rect, away in _parts(windows, w, camera, size):
            if cancelled is not None and cancelled():
                raise Cancelled
            found = land.bound(level, rect)
            if found is None:
                return None
            pixels = math.ldexp(1.0, finest) / (away * cone)
            seen = (windows.places[w, 2] / away) ** 2
            hard = max(hard, found.hard * float(pixels.max()))
            squares, room = squares + float((seen * (found.rms * pixels) ** 2).sum()), room + float(seen.sum())
    return Remainder(hard, math.sqrt(squares / room) if room else 0.0)


def _parts(windows: Windows, w: int, camera: Camera, size: tuple[int, int]) -> Iterator[tuple[Rect, np.ndarray]]:
    """Yields the parts of a window that are in the picture, in pixels of its level, and how far the eye is from places
    there, in pixels of the finest."""
    cells = windows.heights.shape[1] - 1
    away = _away(windows, w, camera, size)
    x, y = _first_of(windows, w, camera)
    part, every = -(-cells // _BLOCKS_ACROSS), _every(windows)
    for top in range(0, cells, part):
        for left in range(0, cells, part):
            rows, columns = (slice(a // every, (a + part) // every + 1) for a in (top, left))
            there = away[rows, columns]
            there = there[there < math.inf]
            if len(there):
                yield Rect.at(x + left, y + top, min(part, cells - left) + 1, min(part, cells - top) + 1), there


def _every(windows: Windows) -> int:
    """Returns how far samples that are looked at are apart."""
    return max(1, (len(windows.heights[0]) - 1) // _LOOKED_AT)


def _first_of(windows: Windows, w: int, camera: Camera) -> tuple[int, int]:
    """Returns the pixel of a window's first sample, of its level."""
    x, y, side = windows.places[w].tolist()
    by = Fraction(2) ** (windows.levels[-1] - camera.level)
    half = Fraction(1, 2)
    return (
        round((Fraction(x) + camera.x * by) / Fraction(side) - half),
        round((Fraction(y) + camera.y * by) / Fraction(side) - half),
    )


def _away(windows: Windows, w: int, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """Returns how far samples of a window are from the eye, in pixels of the finest; infinity where the picture does
    not show them, or shows a finer window."""
    x0, y0, side = windows.places[w].tolist()
    n, every = windows.heights.shape[1], _every(windows)
    spacing = every * side
    at = np.arange(0, n, every) * side
    z = windows.heights[w, ::every, ::every].astype(np.float64) * side - windows.eye
    x, y = np.broadcast_to(x0 + at[None, :], z.shape), np.broadcast_to(y0 + at[:, None], z.shape)
    right, up, forward = camera.axes()
    deep = x * forward[0] + y * forward[1] + z * forward[2]
    wide = _BEYOND * math.tan(math.radians(camera.fov) / 2)
    across = np.abs(x * right[0] + y * right[1] + z * right[2]) <= wide * deep + spacing
    high = wide * size[1] / size[0]
    shown = across & (np.abs(x * up[0] + y * up[1] + z * up[2]) <= high * deep + spacing) & (deep > -spacing)
    away: np.ndarray = np.sqrt(x * x + y * y + z * z)
    if w + 1 < len(windows.levels):
        finer, cone = windows.places[w + 1], wide / _BEYOND * 2.0 / size[0]
        within = (
            (1.0 - WINDOW_RIM) * (n - 1) * finer[2] - 0.5 * spacing,
            WINDOW_RIM * (n - 1) * finer[2] + 0.5 * spacing,
        )
        inner = [(a >= at0 + within[1]) & (a <= at0 + within[0]) for a, at0 in ((x, finer[0]), (y, finer[1]))]
        until = CELLS_PER_PIXEL / (_WIDER * cone) * finer[2]
        shown &= ~(inner[0] & inner[1] & (away < until))
        nearer = np.where(inner[0] & inner[1], until, 0.0)
        away = np.maximum(away, nearer)
    return np.where(shown, np.maximum(away - spacing, 0.5 * side), math.inf)
