"""Any rectangle of a painting at any level as PNG or TIFF of 8 or 16 bits or EXR of floats, in bounded memory."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import BinaryIO

import numpy as np

from engine.archive.held_levels import held_pixels
from engine.canvas.layers import Group, pictured
from engine.checks.picture_sides import PICTURE_SIDE
from engine.files.atomic import replacing
from engine.files.fault import WriteError
from engine.files.png_writer import PngWriter
from engine.files.spatial.exr_writer import write_exr
from engine.files.tiff_writer import write_tiff
from engine.light.light import BY_ALPHA, BY_IMPASTO, BY_PICTURE, Light
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8, to_rgba16
from engine.painting.grown import settled_alone, settled_root
from engine.painting.lighting import Lighting
from engine.painting.rendering import Progress, folded_layers, rows_of
from engine.painting.value import Painting


@dataclass(frozen=True, slots=True)
class Picture:
    """What to export: `rect` of `level` (None: the frame, seen at that level), of all layers or the one named;
    `transparent`: without the paper; `light`: that it is lit by."""

    painting: Painting
    level: int = 0
    rect: Rect | None = None
    layer: str | None = None
    depth: int = 8
    transparent: bool = False
    light: Light | None = None

    @property
    def area(self) -> Rect:
        """Gives the rectangle that is exported, in pixels of `level`."""
        return self.painting.frame.zoomed(self.level) if self.rect is None else self.rect


def shown_root(picture: Picture) -> Group:
    """Returns the layers that a picture shows, grown to the end and with nothing pending; LayerError if there is none
    of that name."""
    root = picture.painting.root
    root = replace(root, paper=None) if picture.transparent else root
    shown = settled_root(pictured(root)) if picture.layer is None else settled_alone(root, picture.layer)
    return folded_layers(shown)


def lighting_of(picture: Picture) -> Lighting | None:
    """Returns the light on a picture, with the heights that it names; LayerError if there is no layer of that name."""
    light = picture.light
    if light is not None and light.height == BY_IMPASTO:
        return Lighting(light, heaped=picture.painting.root)
    if light is None or light.height in (BY_PICTURE, BY_ALPHA):
        return None if light is None else Lighting(light)
    return Lighting(light, folded_layers(replace(settled_alone(picture.painting.root, light.height), paper=None)))


Write = Callable[[BinaryIO, tuple[int, int], int, Iterator[np.ndarray]], None]


def _png(file: BinaryIO, size: tuple[int, int], depth: int, rows: Iterator[np.ndarray]) -> None:
    writer = PngWriter(file, *size, channels=4, depth=depth)
    for strip in rows:
        writer.rows(strip)
    writer.close()


def _exr(file: BinaryIO, size: tuple[int, int], depth: int, rows: Iterator[np.ndarray]) -> None:
    write_exr(file, size, "RGBA", rows)


def _light(planes: np.ndarray) -> np.ndarray:
    """Returns pixels (h, w, 4) float32 as EXR has them: linear light, premultiplied."""
    alpha = planes[3]
    straight = planes[:3] / np.where(alpha > 0.0, alpha, np.float32(1.0))
    light = np.where(straight <= 0.04045, straight / 12.92, ((straight + 0.055) / 1.055) ** 2.4)
    return np.stack([*(light * alpha), alpha], axis=2).astype(np.float32)


FLOATS = ".exr"
FORMATS: dict[str, Write] = {".png": _png, ".tif": write_tiff, ".tiff": write_tiff, FLOATS: _exr}


def export(
    path: str | os.PathLike[str],
    picture: Picture,
    progress: Progress = None,
    cancelled: Callable[[], bool] | None = None,
) -> None:
    """Writes the picture; the ending of `path` decides the format.  The place holds the old file or the whole new one.

    `progress` gets the part done, 0..1.  WriteError on failure, LayerError for an unknown layer, Cancelled if
    `cancelled()` becomes true.
    """
    ending = PurePath(path).suffix.lower()
    write = FORMATS.get(ending)
    if write is None:
        raise WriteError(path, f"found the ending {PurePath(path).suffix!r}, expected one of {', '.join(FORMATS)}")
    if picture.depth not in (8, 16):
        raise WriteError(path, f"found {picture.depth} bits, expected 8 or 16")
    area = picture.area
    if area.empty or max(area.width, area.height) > PICTURE_SIDE:
        raise WriteError(
            path, f"found a picture of {area.width} x {area.height}, expected 1 to {PICTURE_SIDE} each way"
        )
    root, lighting = shown_root(picture), lighting_of(picture)
    to_pixels = _light if ending == FLOATS else to_rgba8 if picture.depth == 8 else to_rgba16

    def rows() -> Iterator[np.ndarray]:
        done = 0
        for strip in rows_of(root, picture.level, area, to_pixels, cancelled, lighting, held_pixels()):
            yield strip
            done += len(strip)
            if progress is not None:
                progress(done / area.height)

    with replacing(path) as file:
        write(file, (area.width, area.height), picture.depth, rows())
