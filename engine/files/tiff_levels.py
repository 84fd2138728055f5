"""Writing BigTIFF in tiles, with the same picture at coarser levels beside it (SubIFDs, TIFF supplement 1)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import BinaryIO, NamedTuple

import numpy as np

from engine.files.png_writer import srgb_profile
from engine.files.tiff_writer import deflated

TIFF_TILE = 512  # pixels along a side


class TiffLevel(NamedTuple):
    """One of the pictures: its width and height, and its tiles as `tiff_tile` makes them, row by row."""

    size: tuple[int, int]
    tiles: Iterator[bytes]


def tiff_tile(pixels: np.ndarray) -> bytes:
    """Returns a tile as stored; `pixels`: straight RGBA (h, w, 4), less than a whole tile at the right and below."""
    height, width, _ = pixels.shape
    if (height, width) != (TIFF_TILE, TIFF_TILE):
        whole = np.zeros((TIFF_TILE, TIFF_TILE, 4), pixels.dtype)
        whole[:height, :width] = pixels
        pixels = whole
    return deflated(pixels)


def write_tiff_levels(file: BinaryIO, depth: int, levels: Iterable[TiffLevel], count: int) -> None:
    """Writes `count` levels of an RGBA image, the largest first; `depth`: 8 or 16 bits of a channel.

    Adobe deflate, horizontal predictor (TIFF 6.0, section 14), sRGB profile; the level sizes are the caller's.
    """
    import tifffile

    with tifffile.TiffWriter(file, bigtiff=True, byteorder="<") as writer:
        for number, level in enumerate(levels):
            width, height = level.size
            writer.write(
                level.tiles,
                shape=(height, width, 4),
                dtype=np.dtype(np.uint8 if depth == 8 else np.uint16),
                tile=(TIFF_TILE, TIFF_TILE),
                photometric="rgb",
                extrasamples=["unassalpha"],
                compression="adobe_deflate",
                predictor="horizontal",
                subifds=count - 1 if number == 0 else None,
                subfiletype=0 if number == 0 else 1,
                iccprofile=srgb_profile(),
                metadata=None,
                software=False,
                maxworkers=1,
            )
