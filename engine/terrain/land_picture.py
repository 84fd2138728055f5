"""Pictures of land by rays: the same bits for any number of threads."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from engine.files.fault import Cancelled
from engine.terrain import daylight
from engine.terrain.camera import Camera, Windows, windows_of
from engine.terrain.drape import Cover
from engine.terrain.plane import Land

_ROWS = 8  # of a strip
_HAZE = 13.0  # frames' widths at which it hides all but a third
_EXPOSURE = 0.86


@dataclass(frozen=True)
class Shot:
    """How a picture of land is taken: `size` (width, height), samples of a pixel, where the sun stands (degrees from
    the top of the canvas, clockwise, and above the horizon), whether all below height 0 is water."""

    camera: Camera
    size: tuple[int, int] = (1280, 800)
    samples: int = 16
    sun: tuple[float, float] = (300.0, 28.0)
    wet: bool = False


def picture_of_land(
    land: Land,
    cover: Cover,
    shot: Shot,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> np.ndarray:
    """Returns a picture of land: uint8 (h, w, 3), sRGB."""
    windows = windows_of(land, shot.camera, cover, shot.camera.finest(shot.size), shot.wet)
    return developed(exposed(windows, shot, land.painting.frame.width, progress, cancelled), shot.samples)


def exposed(
    windows: Windows,
    shot: Shot,
    wide: float,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> np.ndarray:
    """Returns the sum of all samples of linear light (h, w, 3), float32; `wide`: pixels of level 0 by which haze goes.
    Cancelled, if the one who asked says so."""
    width, height = shot.size
    out = np.zeros((height, width, 3), np.float32)
    numbers, eye = _numbers(windows, shot, wide), _eye(windows, shot)
    tables = windows.heights, windows.tops, windows.mips, windows.places, windows.colours

    def work(top: int) -> None:
        if cancelled is not None and cancelled():
            raise Cancelled
        daylight.picture_rows(*tables, eye, numbers, top, height, out[top : top + _ROWS])

    with ThreadPoolExecutor(os.cpu_count() or 1, "inkfall land") as pool:
        tops = range(0, height, _ROWS)
        for done, _ in enumerate(pool.map(work, tops)):
            if progress is not None:
                progress((done + 1) / len(tops))
    return out


def _eye(windows: Windows, shot: Shot) -> np.ndarray:
    right, up, forward = shot.camera.axes()
    pixel = 2.0 * math.tan(math.radians(shot.camera.fov) / 2) / shot.size[0]
    return np.stack([np.array([0.0, 0.0, windows.eye]), right * pixel, up * pixel, forward])


def _numbers(windows: Windows, shot: Shot, wide: float) -> np.ndarray:
    azimuth, altitude = (math.radians(v) for v in shot.sun)
    flat = math.cos(altitude)
    sun = flat * math.sin(azimuth), -flat * math.cos(azimuth), math.sin(altitude)
    sides = windows.places[:, 2].max()
    cone = 2.0 * math.tan(math.radians(shot.camera.fov) / 2) / shot.size[0]
    haze = min(1e15, math.ldexp(_HAZE * wide, min(200, windows.levels[-1])))
    highest = float((windows.tops[:, -1] * windows.places[:, 2]).max()) + 1e-3
    far = 4.0 * sides * len(windows.heights[0])
    sea = max(windows.sea, -1e30)
    return np.array([*sun, cone, haze, sea, highest, far, 0.0, shot.samples])


def developed(light: np.ndarray, samples: int) -> np.ndarray:
    """Returns sums of linear light as a picture: a film's shoulder and toe (Narkowicz's fit), sRGB, uint8."""
    v = light * np.float32(_EXPOSURE / samples)
    v = np.clip(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0)
    v = np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** np.float32(1 / 2.4) - 0.055)
    return np.asarray(v * 255.0 + 0.5).astype(np.uint8)
