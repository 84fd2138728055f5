"""A texture as one number a pixel, for what has no colour: heights, densities, the shape of a dab."""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect
from engine.texture.record import Instance

LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)


def grey(made: Instance, level: int, rect: Rect) -> np.ndarray:
    """s of a texture over `rect`: float32 (h, w), nominal 0..1.

    The mean of the channels; of a picture, its luminance, 0 where it is transparent.
    """
    seen = made.appearance(level, rect)
    if len(seen) == 4:
        luminance: np.ndarray = np.einsum("chw,c->hw", seen[:3], LUMINANCE)
        return luminance
    mean = seen[0] if len(seen) == 1 else (seen[0] + seen[1] + seen[2]) * np.float32(1.0 / 3.0)
    grey: np.ndarray = mean * np.float32(0.5) + np.float32(0.5)
    return grey
