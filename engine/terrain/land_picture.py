"""Pictures of land by rays: the same bits for any number of threads."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from engine.files.fault import Cancelled
from engine.terrain import daylight
from engine.terrain.camera import Camera, Windows, windows_of
from engine.terrain.caster import CELLS_PER_PIXEL
from engine.terrain.drape import Cover
from engine.terrain.plane import Land

_BLOCK = 256, 8  # pixels that are worked out at a time
_ROWS_DEVELOPED = 64
_QUARTER = 4
_HAZE = 13.0  # frames' widths at which it hides all but a third
_EXPOSURE = 0.86


@dataclass(frozen=True)
class Shot:
    """How a picture of land is taken: `size` (width, height), samples of a pixel, where the sun stands (degrees from
    the top of the canvas, clockwise, and above the horizon), whether all below height 0 is water, how many times the
    usual haze there is."""

    camera: Camera
    size: tuple[int, int] = (1280, 800)
    samples: int = 16
    sun: tuple[float, float] = (300.0, 28.0)
    wet: bool = False
    haze: float = 1.0


class Stage(NamedTuple):
    """A picture on its way: uint8 (h, w, 3), sRGB, of pixels `by` of the shot's each way; `samples` of each are
    in it.  Those at the right and at the bottom may reach beyond the shot."""

    picture: np.ndarray
    by: int
    samples: int


def picture_of_land(
    land: Land,
    cover: Cover,
    shot: Shot,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> np.ndarray:
    """Returns a picture of land: uint8 (h, w, 3), sRGB."""
    windows = windows_of(land, shot.camera, cover, shot.camera.finest(shot.size), shot.wet)
    light = _exposed(windows, shot, land.painting.frame.width, (0, shot.samples), None, progress, cancelled)
    return developed(light, shot.samples)


def refinement(
    windows: Windows,
    shot: Shot,
    wide: float,
    cancelled: Callable[[], bool] | None = None,
    quarter: bool = True,
) -> Iterator[Stage]:
    """Yields a picture of land that becomes sharper: a `quarter` of the shot's size each way, its size with one sample
    of a pixel, with four, with all of them.  Each stage is a function of what was asked for alone, and the last one
    that of `picture_of_land`, bit for bit.

    `windows`: by `windows_of(land, shot.camera, cover, shot.camera.finest(shot.size), shot.wet)`.  `wide`: the width of
    the painting's frame.  A stage is worked out, on all cores, when it is asked for; meanwhile `cancelled` is asked
    every some milliseconds, by several threads: Cancelled if it says so."""
    if quarter:
        small = _exposed(windows, shot, wide, (0, 1), None, None, cancelled, _QUARTER)
        yield Stage(developed(small, 1), _QUARTER, 1)
    light, done = None, 0
    for samples in (1, 4, shot.samples):
        if done < samples <= shot.samples:
            light = _exposed(windows, shot, wide, (done, samples), light, None, cancelled)
            done = samples
            yield Stage(developed(light, done), 1, done)


def exposed(windows: Windows, shot: Shot, wide: float) -> np.ndarray:
    """Returns the sum of all samples, linear light (h, w, 3), float32; `wide`: the width of the frame."""
    return _exposed(windows, shot, wide, (0, shot.samples), None, None, None)


def _exposed(
    windows: Windows,
    shot: Shot,
    wide: float,
    samples: tuple[int, int],
    before: np.ndarray | None,
    progress: Callable[[float], None] | None,
    cancelled: Callable[[], bool] | None,
    by: int = 1,
) -> np.ndarray:
    """Returns light with some samples more than what there was `before`, in pixels of `by`."""
    width, height = (-(-side // by) for side in shot.size)
    out = np.zeros((height, width, 3), np.float32) if before is None else before
    numbers, eye = numbers_of(windows, shot, wide, samples), eye_of(windows, shot, by)
    tables = windows.heights, windows.tops, windows.mips, windows.places, windows.colours

    def work(corner: tuple[int, int]) -> None:
        if cancelled is not None and cancelled():
            raise Cancelled
        left, top = corner
        place = np.array([left, top, min(left + _BLOCK[0], width), min(top + _BLOCK[1], height)])
        daylight.picture_block(*tables, eye, numbers, place, out)

    with ThreadPoolExecutor(os.cpu_count() or 1, "inkfall land") as pool:
        corners = [(x, y) for y in range(0, height, _BLOCK[1]) for x in range(0, width, _BLOCK[0])]
        for done, _ in enumerate(pool.map(work, corners)):
            if progress is not None:
                progress((done + 1) / len(corners))
    return out


def eye_of(windows: Windows, shot: Shot, by: int) -> np.ndarray:
    """Returns where the eye is, a pixel's width and height, and the way to the middle of the first pixel."""
    right, up, forward = shot.camera.axes()
    pixel = 2.0 * math.tan(math.radians(shot.camera.fov) / 2) / shot.size[0]
    corner = forward + pixel * (0.5 * shot.size[1] * up - 0.5 * shot.size[0] * right)
    right, up = by * pixel * right, by * pixel * up
    return np.stack([np.array([0.0, 0.0, windows.eye]), right, up, corner + 0.5 * right - 0.5 * up])


def numbers_of(
    windows: Windows, shot: Shot, wide: float, samples: tuple[int, int], cells: float = CELLS_PER_PIXEL
) -> np.ndarray:
    """Returns the numbers that a picture is made with, as `daylight` has them; `cells`: of a window to a pixel, at
    most."""
    azimuth, altitude = (math.radians(v) for v in shot.sun)
    flat = math.cos(altitude)
    sun = flat * math.sin(azimuth), -flat * math.cos(azimuth), math.sin(altitude)
    sides = windows.places[:, 2].max()
    cone = 2.0 * math.tan(math.radians(shot.camera.fov) / 2) / shot.size[0]
    haze = min(1e15, math.ldexp(_HAZE * wide / max(shot.haze, 1e-9), min(200, windows.levels[-1])))
    highest = float((windows.tops[:, -1] * windows.places[:, 2]).max()) + 1e-3
    far = 4.0 * sides * len(windows.heights[0])
    sea = max(windows.sea, -1e30)
    return np.array([*sun, cone * (CELLS_PER_PIXEL / cells), haze, sea, highest, far, *samples, cone])


def developed(light: np.ndarray, samples: int) -> np.ndarray:
    """Returns sums of linear light as a picture: a film's shoulder and toe (Narkowicz's fit), sRGB, uint8."""
    out = np.empty(light.shape, np.uint8)
    for y in range(0, len(light), _ROWS_DEVELOPED):
        v = light[y : y + _ROWS_DEVELOPED] * np.float32(_EXPOSURE / samples)
        v = np.clip(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0)
        v = np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** np.float32(1 / 2.4) - 0.055)
        out[y : y + _ROWS_DEVELOPED] = v * 255.0 + 0.5
    return out
