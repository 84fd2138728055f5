"""Where the light stands that a picture is lit by, and how strongly its relief shows."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

AMBIENT, DIFFUSE = 0.35, 0.65  # parts of a flat place's brightness: from everywhere, and from the sun
SHININESS = 24  # the power of the gloss; `lit_relief.py` and light.frag multiply it out
RIM = 1  # pixels around a place whose heights its light needs
BY_PICTURE, BY_ALPHA, BY_IMPASTO = "composite", "alpha", "impasto"  # where heights come from, if not from a layer
_DEPTH = 12.0  # pixels: the usual depth, in which impasto is as thick as it was painted
_THICKEST = 128.0  # pixels that impasto is told of, up and down: heights 1 and 0
BRIGHTNESS = 0.2126, 0.7152, 0.0722  # parts of red, green and blue in luminance
LOWEST, MOST_DEPTH = 1.0, 1000.0


@dataclass(frozen=True, slots=True)
class Light:
    """A sun over the picture, which lies flat; nothing of it is stored in a painting.

    `azimuth`: degrees, where it stands, clockwise from the top of the picture; `altitude`: degrees above the picture,
    1 to 90; `depth`: how far white lies above black, in pixels of what is shown, whatever the level: negative where
    black lies higher; `gloss`: strength of the reflection, 0 to 1; `height`: what heights are taken from: the
    luminance of all that is seen (`BY_PICTURE`), how much paint there is (`BY_ALPHA`), how thick it was laid
    (`BY_IMPASTO`, whose thickness is in pixels of what is shown itself, as it is at the usual depth), or the luminance
    of the layer or group of that name.
    """

    azimuth: float = 315.0
    altitude: float = 45.0
    depth: float = _DEPTH
    gloss: float = 0.15
    height: str = BY_PICTURE

    def __post_init__(self) -> None:
        """Checks the ranges; ValueError tells which is left."""
        if not math.isfinite(self.azimuth):
            raise ValueError(f"azimuth: found {self.azimuth}, expected degrees")
        for name, value, low, high in (
            ("altitude", self.altitude, LOWEST, 90.0),
            ("depth", self.depth, -MOST_DEPTH, MOST_DEPTH),
            ("gloss", self.gloss, 0.0, 1.0),
        ):
            if not low <= value <= high:
                raise ValueError(f"{name}: found {value:g}, expected {low:g} to {high:g}")

    @property
    def sun(self) -> tuple[float, float, float]:
        """Gives the unit vector to the sun: to the right, downward, out of the picture."""
        around, up = math.radians(self.azimuth % 360.0), math.radians(self.altitude)
        return math.sin(around) * math.cos(up), -math.cos(around) * math.cos(up), math.sin(up)

    @property
    def slope(self) -> float:
        """Gives the slope where the heights of the two neighbours of a pixel differ by one."""
        raised = 2.0 * _THICKEST / _DEPTH if self.height == BY_IMPASTO else 1.0
        return 0.5 * self.depth * raised


def height_of_thickness(pixels: np.ndarray) -> np.ndarray:
    """Returns the heights, about 1/2, of paint so many pixels thick."""
    out: np.ndarray = pixels * np.float32(0.5 / _THICKEST) + np.float32(0.5)
    return out
