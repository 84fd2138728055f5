"""Where one stands in land, and which windows of it are seen from there."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from engine.files.fault import Cancelled
from engine.numeric.address import Rect
from engine.terrain.caster import maxima, mipmap_of, room_of
from engine.terrain.drape import Cover
from engine.terrain.height_window import FINEST_TOLD, in_pixels
from engine.terrain.layer_heights import Pixel
from engine.terrain.plane import DEEP, Land
from engine.terrain.seen.eye import axes_of

CELLS = 1024  # of a window's side
_APART = 2  # levels from one window to the next
_GAPS = ((8, 1), (12, 2))  # of a picture that is to be sharp: up to so many windows, so many levels; then
_LAST_GAP = 3
_AHEAD = 0.3  # of a window's side: how far before the eye its middle lies at most
WINDOW_RIM = 0.14  # of its side, in which a window becomes the next coarser one
_ROWS_AT_ONCE = 128  # of heights that are worked out at a time
_ROOM = 4  # times the frame that the coarsest window shows


@dataclass(frozen=True)
class Camera:
    """An eye `height` pixels of `level` above the ground, or the water, at (x, y) of it; it looks `azimuth` degrees
    clockwise from the top of the canvas, `tilt` degrees up; `fov`: degrees from left to right."""

    level: int
    x: Fraction
    y: Fraction
    height: float
    azimuth: float = 0.0
    tilt: float = -10.0
    fov: float = 60.0

    def axes(self) -> np.ndarray:
        """Returns right, up and forward (3, 3), as `axes_of`."""
        return axes_of(self.azimuth, self.tilt)

    def finest(self, size: tuple[int, int]) -> int:
        """Returns the level whose pixels are no larger than those of a picture of that size, at the nearest ground."""
        half = math.tan(math.radians(self.fov) / 2)
        below = math.radians(min(90.0, max(4.0, self.fov / 2 * size[1] / size[0] - self.tilt)))
        pixel = self.height / math.sin(below) * 2 * half / size[0]
        return min(FINEST_TOLD, self.level - math.floor(math.log2(pixel)))


def camera_before(level: int, rect: Rect, land: Land, size: tuple[int, int]) -> Camera:
    """Returns a camera before a rectangle, which sees all of it."""
    fov, tilt, azimuth = 50.0, -15.0, 18.0
    across = math.hypot(rect.width, rect.height) * max(1.0, 1.25 * size[1] / size[0])
    away = 0.56 * across / math.tan(math.radians(fov) / 2)
    flat = away * math.cos(math.radians(tilt))
    turn = math.radians(azimuth)
    x = Fraction(rect.x0 + rect.x1, 2) - Fraction(flat * math.sin(turn))
    y = Fraction(rect.y0 + rect.y1, 2) + Fraction(flat * math.cos(turn))
    return Camera(level, x, y, away * math.sin(math.radians(-tilt)), azimuth, tilt, fov)


@dataclass(frozen=True)
class Windows:
    """Nested windows of land around a camera, as `engine.terrain.caster` has them; `colours` uint8; `levels` of each;
    `eye`: how high the camera is, `sea`: how high the water lies, both above the camera's foot, in pixels of the
    finest level; `base`: how high that foot is, pixels of level 0, `about`: to what."""

    heights: np.ndarray
    tops: np.ndarray
    mips: np.ndarray
    places: np.ndarray
    colours: np.ndarray
    levels: tuple[int, ...]
    eye: float
    sea: float
    base: float
    about: Pixel | None


def windows_of(
    land: Land,
    camera: Camera,
    cover: Cover,
    finest: int,
    wet: bool = False,
    cells: int = CELLS,
    sharp: bool = False,
    cancelled: Callable[[], bool] | None = None,
    room: int = 0,
) -> Windows:
    """Returns the windows that a camera sees whose finest is of a level; `wet`: all below height 0 is water;
    `sharp`: with more of them near the eye, and no more than nineteen in all down to level 32; `room`: their arrays are
    parts of ones that have room for so many windows more.  `cancelled` is asked every some milliseconds: Cancelled if
    it says so."""
    foot = _pixel_of(camera, finest)
    about = foot.above(finest - DEEP) if finest > DEEP else None
    ground = float(land.height(finest, foot.rect, about)[0, 0])
    wet = wet and about is None
    base = max(ground, 0.0) if wet else ground
    levels = _levels(land, camera, finest, cells, sharp)
    side = cells + 1
    count, mips = len(levels), mipmap_of(cells)
    heights = np.empty((count + room, side, side), np.float32)[:count]
    colours = np.empty((count + room, side, side, 3), np.uint8)[:count]
    tops = np.empty((count + room, room_of(mips)), np.float32)[:count]
    before = np.empty(0, np.float32)  # the colours of the window before, linear
    places: list[tuple[float, float, float]] = []
    for w, level in enumerate(levels):
        rect = _rect_of(camera, level, cells)
        h = heights[w]
        for first, told in _told(land, level, rect, about, cancelled):
            if wet:
                told = np.maximum(told, 0.0)
            h[first : first + len(told)] = in_pixels(told - base, level)
        paint = cover.colours(level, rect, h, base).astype(np.float32, copy=False)
        place = _place_of(camera, rect, level, finest)
        if w:
            _nest((h, paint, place), (heights[w - 1], before, places[-1]), cover.root is None)
        before = paint
        for rows in _strips(side):
            colours[w, rows] = np.rint(np.sqrt(np.clip(paint[rows], 0.0, 1.0)) * 255.0)
        tops[w] = maxima(h)
        places.append(place)
    eye = math.ldexp(camera.height, finest - camera.level)
    sea = math.ldexp(-base, finest) if wet else -math.inf
    return Windows(heights, tops, np.stack(mips), np.array(places), colours, levels, eye, sea, base, about)


def _pixel_of(camera: Camera, level: int) -> Pixel:
    by = Fraction(2) ** (level - camera.level)
    return Pixel(level, math.floor(camera.x * by), math.floor(camera.y * by))


def _strips(side: int) -> Iterator[slice]:
    """Yields the rows of a window that are worked out at a time."""
    return (slice(y, min(y + _ROWS_AT_ONCE, side)) for y in range(0, side, _ROWS_AT_ONCE))


def _told(
    land: Land, level: int, rect: Rect, about: Pixel | None, cancelled: Callable[[], bool] | None
) -> Iterator[tuple[int, np.ndarray]]:
    """Yields the heights of a window piece by piece, each with its first row: what comes and goes meanwhile would be
    many times the window."""
    for rows in _strips(rect.height):
        if cancelled is not None and cancelled():
            raise Cancelled
        part = Rect(rect.x0, rect.y0 + rows.start, rect.x1, rect.y0 + rows.stop)
        yield rows.start, land.height(level, part, about)


def _levels(land: Land, camera: Camera, finest: int, cells: int, sharp: bool) -> tuple[int, ...]:
    """Returns the levels of the windows, coarsest first."""
    frame = land.painting.frame
    levels = [finest]
    while levels[-1] > finest - DEEP:
        by = Fraction(2) ** (levels[-1] - camera.level)
        side = Fraction(2) ** levels[-1] * max(frame.width, frame.height) * _ROOM
        if side + 8 * Fraction(camera.height) * by <= cells:
            break
        gap = next((gap for most, gap in _GAPS if len(levels) < most), _LAST_GAP) if sharp else _APART
        coarser = levels[-1] - gap
        levels.append(max(coarser, finest - DEEP) if finest > DEEP else coarser)  # heights are told from there
    return tuple(reversed(levels))


def _rect_of(camera: Camera, level: int, cells: int) -> Rect:
    """Returns the samples of a window: its middle lies before the eye, no farther than what the camera looks at."""
    by = Fraction(2) ** (level - camera.level)
    away = _AHEAD * cells
    if camera.tilt < -1.0:
        away = min(away, float(camera.height * by) / math.tan(math.radians(-camera.tilt)))
    turn = math.radians(camera.azimuth)
    x = math.floor(camera.x * by + Fraction(away * math.sin(turn))) - cells // 2
    y = math.floor(camera.y * by - Fraction(away * math.cos(turn))) - cells // 2
    return Rect.at(x, y, cells + 1, cells + 1)


def _place_of(camera: Camera, rect: Rect, level: int, finest: int) -> tuple[float, float, float]:
    """Returns where the first sample lies, the centre of its pixel, and a pixel's side."""
    side, by = Fraction(2) ** (finest - level), Fraction(2) ** (finest - camera.level)
    half = Fraction(1, 2)
    return float((rect.x0 + half) * side - camera.x * by), float((rect.y0 + half) * side - camera.y * by), float(side)


Sheet = tuple[np.ndarray, np.ndarray, tuple[float, float, float]]


def _nest(fine: Sheet, coarse: Sheet, natural: bool) -> None:
    """Has heights and colours of a window become those of the coarser one at its rim.  What would grow there by itself
    grows there by the coarser one, more than half: the same slope is steeper the nearer one looks."""
    n = len(fine[0]) - 1
    at = np.arange(n + 1)
    off = np.minimum(at, n - at) / (WINDOW_RIM * n)
    off = np.clip(np.minimum(off[:, None], off[None]), 0.0, 1.0)
    part = (off * off * (3.0 - 2.0 * off)).astype(np.float32)
    ratio = fine[2][2] / coarse[2][2]
    columns, rows = ((fine[2][a] - coarse[2][a]) / coarse[2][2] + at * ratio for a in range(2))
    for here in _strips(n + 1):
        above = resampled(coarse[0], rows[here], columns) / np.float32(ratio)
        under = resampled(coarse[1], rows[here], columns)
        own = part[here] * (0.4 if natural else 1.0)
        fine[0][here] = above + part[here] * (fine[0][here] - above)
        fine[1][here] = under + own[:, :, None] * (fine[1][here] - under)


def resampled(values: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Returns values between samples, linearly; those beyond the rim are at it."""
    for axis, where in enumerate((rows, columns)):
        last = values.shape[axis] - 1
        where = np.clip(where, 0.0, last)
        first = np.minimum(where.astype(np.int64), last - 1)
        shape = [1] * values.ndim
        shape[axis] = len(where)
        part = (where - first).astype(np.float32).reshape(shape)
        low, high = np.take(values, first, axis), np.take(values, first + 1, axis)
        values = low + part * (high - low)
    return values
