"""Pictures as files hold them: straight RGBA of 8 or 16 bits, made into planes part by part, where they are read.

A picture of 8 bits takes a quarter of what its planes take.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.colour import from_rgba8, from_rgba16, to_rgba8, to_rgba16
from engine.numeric.parted import Raster, Room

AT_ONCE = 1 << 20  # pixels that are converted at a time
_WAYS = ((np.uint8, to_rgba8, from_rgba8), (np.uint16, to_rgba16, from_rgba16))


def planes_of(pixels: np.ndarray) -> np.ndarray:
    """Returns the planes of straight RGBA, uint8 or uint16 (h, w, 4): float32 (4, h, w), premultiplied, on the grid."""
    return from_rgba16(pixels) if pixels.dtype == np.uint16 else from_rgba8(pixels)


def row_bands(width: int, height: int) -> Iterator[Rect]:
    """Yields the rows of a picture from the top, some at a time."""
    rows = max(AT_ONCE // width, 1)
    for top in range(0, height, rows):
        yield Rect(0, top, width, min(top + rows, height))


def straight_of(planes: np.ndarray) -> np.ndarray | None:
    """Returns the pixels of 8, else of 16 bits whose planes these are, bit for bit, float32 (4, h, w); None where
    neither tells them.  They are all zero where alpha is."""
    _, height, width = planes.shape
    for kind, to_pixels, to_planes in _WAYS:
        out = np.empty((height, width, 4), kind)
        for band in row_bands(width, height):
            part = planes[:, band.y0 : band.y1]
            out[band.y0 : band.y1] = pixels = to_pixels(part)
            if not np.array_equal(to_planes(pixels).view(np.uint32), part.view(np.uint32)):
                break
        else:
            return out
    return None


def _fits_8_bits(pixels: Raster) -> bool:
    for band in row_bands(pixels.shape[1], pixels.shape[0]):
        planes = planes_of(pixels[band.slices(Rect(0, 0, *pixels.shape[1::-1]))])
        if not np.array_equal(from_rgba8(to_rgba8(planes)), planes):
            return False
    return True


def put_plainly(pixels: Raster, room: Room = np.empty) -> Raster:
    """Puts what `straight_of` gives of a picture's planes in the place of its pixels, or into `room` of its shape and
    type: where 8 bits tell all that 16 say, and where an array is too large for that."""
    height, width, _ = pixels.shape
    kind, to_pixels, _ = _WAYS[0 if pixels.dtype == np.uint8 or _fits_8_bits(pixels) else 1]
    into = room(pixels.shape, kind)
    if pixels.dtype == kind and type(into) is type(pixels):
        into = pixels
    for band in row_bands(width, height):
        into[band.y0 : band.y1] = to_pixels(planes_of(pixels[band.y0 : band.y1, 0:width]))
    return into
