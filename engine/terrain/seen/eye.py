"""Where one looks at land from: exact places, whatever the level.  Light on purpose: the window imports it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

_KEPT = 96  # binary places of pixels of level 0 that a place keeps
STEEPEST_TILT = 89.0  # degrees that one may look up or down


def axes_of(azimuth: float, tilt: float) -> np.ndarray:
    """Returns right, up and forward (3, 3) of who looks there, degrees; x to the right of the canvas, y down it, z up
    from it."""
    a, t = math.radians(azimuth), math.radians(tilt)
    right = np.array([math.cos(a), math.sin(a), 0.0])
    forward = np.array([math.sin(a) * math.cos(t), -math.cos(a) * math.cos(t), math.sin(t)])
    return np.stack([right, np.cross(forward, right), forward])


@dataclass(frozen=True, slots=True)
class Eye:
    """An eye at (x, y), pixels of level 0, `z` pixels of level 0 above the sea; it looks `azimuth` degrees clockwise
    from the top of the canvas, `tilt` degrees up; `fov`: degrees from left to right."""

    x: Fraction
    y: Fraction
    z: float
    azimuth: float = 0.0
    tilt: float = -20.0
    fov: float = 55.0

    def axes(self) -> np.ndarray:
        """Returns right, up and forward (3, 3), as `axes_of`."""
        return axes_of(self.azimuth, self.tilt)

    def direction(self, x: float, y: float, size: tuple[int, int]) -> np.ndarray:
        """Returns where a point of a picture of `size` lies from here: length 1."""
        right, up, forward = self.axes()
        pixel = self.pixel(size[0])
        out: np.ndarray = forward + (x - size[0] / 2) * pixel * right - (y - size[1] / 2) * pixel * up
        return out / math.sqrt(float(out @ out))

    def pixel(self, width: int) -> float:
        """Returns a pixel's side, at distance 1, in a picture so wide."""
        return 2.0 * math.tan(math.radians(self.fov) / 2) / width

    def turned(self, across: float, up: float) -> Eye:
        """Returns it looking elsewhere, by degrees."""
        return replace(
            self, azimuth=(self.azimuth + across) % 360.0, tilt=max(-STEEPEST_TILT, min(STEEPEST_TILT, self.tilt + up))
        )

    def moved(self, by: np.ndarray) -> Eye:
        """Returns it elsewhere, by pixels of level 0."""
        return replace(
            self,
            x=place_kept(self.x + as_fraction(by[0])),
            y=place_kept(self.y + as_fraction(by[1])),
            z=self.z + float(by[2]),
        )

    def offset(self, x: Fraction, y: Fraction) -> tuple[float, float]:
        """Returns a place seen from here, in pixels of level 0."""
        return float(x - self.x), float(y - self.y)


def as_fraction(number: float) -> Fraction:
    """Returns a float as what it is."""
    return Fraction(float(number))


def from_whole(place: Fraction, up: int, less: int) -> float:
    """Returns place * 2^up - less, rounded once: a frame asks this of every tile, and fractions would be slow."""
    top, bottom = (place.numerator << up, place.denominator) if up >= 0 else (place.numerator, place.denominator << -up)
    return (top - less * bottom) / bottom


def place_kept(place: Fraction) -> Fraction:
    """Returns a place with as many binary places as are kept."""
    return Fraction(round(place * (1 << _KEPT)), 1 << _KEPT)
