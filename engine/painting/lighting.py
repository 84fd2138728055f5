"""The light on a painting: its picture with the heights around each piece, whatever the pieces are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.canvas.composite import composite
from engine.canvas.heaps.seen_heaps import thickness
from engine.canvas.layers import Group
from engine.canvas.placing.composite_steps import Planned
from engine.canvas.reading import Read
from engine.light.light import BY_ALPHA, RIM, Light, height_of_thickness
from engine.light.lit_relief import lit, luminance
from engine.numeric.address import Rect


@dataclass(frozen=True, eq=False, slots=True)
class Lighting:
    """`relief`: whose luminance the heights are; None: the picture's own.  `heaped`: the layers whose impasto they are,
    where the light takes them from that."""

    light: Light
    relief: Group | Planned | None = None
    heaped: Group | None = None


def needed(rect: Rect, lighting: Lighting | None) -> Rect:
    """Returns what must be read to show a rectangle."""
    return rect if lighting is None else rect.grown(RIM)


def pictured(root: Group | Planned, level: int, rect: Rect, read: Read, lighting: Lighting | None = None) -> np.ndarray:
    """Returns the picture of `rect`, lit if there is a light: float32 (4, h, w), premultiplied and clamped for display.
    `read` gives layers within `needed`.  A pixel's value does not depend on `rect`."""
    if lighting is None:
        return composite(root, level, rect, read)
    around = needed(rect, lighting)
    planes = composite(root, level, around, read)
    if lighting.heaped is not None:
        heights = height_of_thickness(thickness(lighting.heaped, level, around, read=read))
    elif lighting.relief is not None:
        heights = luminance(composite(lighting.relief, level, around, read))
    else:
        heights = planes[3] if lighting.light.height == BY_ALPHA else luminance(planes)
    return lit(planes, heights, lighting.light)
