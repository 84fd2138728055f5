"""The law of light on relief: colour times f, plus gloss, both as they are on a flat place, which stays as it was.

f = .35 + .65 max(n . sun, 0) / sun_z, written so that it is exactly 1 where n points straight up.  The gloss is the
24th power of n . (sun + up) / 2, less its value on a flat place.  light.frag has the same law for the window.
"""

from __future__ import annotations

import math

import numpy as np

from engine.light.light import BRIGHTNESS, DIFFUSE, RIM, Light
from engine.numeric.kernel import forced, kernel

_RED, _GREEN, _BLUE = (np.float32(part) for part in BRIGHTNESS)


def luminance(planes: np.ndarray) -> np.ndarray:
    """Returns the heights that colours stand for: float32 (h, w) of planes (4, h, w), of the values as they are
    encoded, premultiplied."""
    luma: np.ndarray = _RED * planes[0] + _GREEN * planes[1] + _BLUE * planes[2]
    return luma


def lit(planes: np.ndarray, heights: np.ndarray, light: Light) -> np.ndarray:
    """Returns the picture in the light: float32 (4, h, w), premultiplied, clamped for display.

    `planes`: the picture, float32 (4, h + 2, w + 2), with a rim of one pixel; `heights`: float32 of the same size.
    """
    _, height, width = planes.shape
    out = np.empty((4, height - 2 * RIM, width - 2 * RIM), np.float32)
    sun = np.array(light.sun)
    _relief(planes, heights, light.slope, sun, light.gloss, out)
    return out


@forced
def _power24(x: float) -> float:
    x2 = x * x
    x4 = x2 * x2
    x8 = x4 * x4
    return x8 * x8 * x8


@kernel
def _relief(
    planes: np.ndarray, heights: np.ndarray, slope: float, sun: np.ndarray, gloss: float, out: np.ndarray
) -> None:
    """Lights the inner part of (4, h + 2, w + 2) planes by heights of the same size; `sun`: float64 (3,)."""
    flat = gloss * _power24(0.5 * (sun[2] + 1.0))
    for y in range(out.shape[1]):
        for x in range(out.shape[2]):
            gx = slope * (np.float64(heights[y + 1, x + 2]) - np.float64(heights[y + 1, x]))
            gy = slope * (np.float64(heights[y + 2, x + 1]) - np.float64(heights[y, x + 1]))
            alpha = planes[3, y + 1, x + 1]
            out[3, y, x] = alpha
            if gx == 0.0 and gy == 0.0:
                for c in range(3):
                    out[c, y, x] = planes[c, y + 1, x + 1]
                continue
            up = 1.0 / math.sqrt(gx * gx + gy * gy + 1.0)
            towards = (sun[2] - gx * sun[0] - gy * sun[1]) * up
            bright = 1.0 + DIFFUSE * (max(towards, 0.0) / sun[2] - 1.0)
            shine = (gloss * _power24(0.5 * max(towards + up, 0.0)) - flat) * alpha
            for c in range(3):
                value = np.float32(planes[c, y + 1, x + 1] * bright + shine)
                out[c, y, x] = min(max(value, np.float32(0.0)), alpha)
