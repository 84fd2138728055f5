"""What is chosen of a picture that is to be exported: what of the painting, how fine, in which format."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from engine.light.light import Light
from engine.numeric.address import Rect

FINER = (-4, 8)  # levels from that of what is exported
FRAME_AREA = "frame"  # the area that is always there
PAINTED_AREA = "painted"  # the one that is asked for


class Format(NamedTuple):
    """A row: its `title` and `hint`, the ending of its files, the bits of each channel that files have, and the depth
    that is asked for: what floats are made of has none."""

    title: str
    hint: str
    ending: str
    bits: int
    depth: int


EXPORT_FORMATS = {
    "png": Format("PNG", "For screens and the web", ".png", 8, 8),
    "png16": Format("PNG, 16 bit", "To go on working with in another program", ".png", 16, 16),
    "tiff": Format("TIFF", "For print", ".tif", 8, 8),
    "tiff16": Format("TIFF, 16 bit", "For print, and to go on working with", ".tif", 16, 16),
    "exr": Format("EXR", "Linear light in floats, for rendering and compositing", ".exr", 32, 8),
}


EXPORT_CHOICES = "area", "finer", "format", "transparent", "apart", "lit"  # what is remembered of it


@dataclass(slots=True)
class ExportState:
    """`area`: a row of `export_areas.AREAS`; `finer`: how many levels finer than that; `format`: a row of
    EXPORT_FORMATS; `transparent`: without the paper; `apart`: each layer by itself, in a file of its own; `lit`: as it
    is in the light, `light`: in which; `painted`: how far reaches what is seen of the paint, pixels of level 0, None
    until the engine has told it."""

    area: str = FRAME_AREA
    finer: int = 0
    format: str = "png"
    transparent: bool = False
    apart: bool = False
    lit: bool = False
    light: Light | None = None
    painted: Rect | None = None
