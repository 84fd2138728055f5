"""Writing heights as a GeoTIFF (OGC 19-008r4): float32, tiled, deflate, with their scale and place."""

from __future__ import annotations

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

TILE_SIDE = 256
_SCALE, _TIE_POINT, _KEYS = 33550, 33922, 34735
# Keys: a version; of a projected model, of pixels that are areas, in metres; of no known projection, but our own.
_PLAIN = (1, 1, 0, 4, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32767, 3076, 0, 1, 9001)


def write_geotiff(file: BinaryIO, heights: np.ndarray, pixel: float, corner: tuple[float, float]) -> None:
    """Writes heights (h, w) in metres, north first, kept as float32.

    `pixel`: metres of its side; `corner`: metres east and north of the upper left corner of the first pixel.
    """
    import tifffile

    height, width = heights.shape
    tags = [
        (_SCALE, "d", 3, (pixel, pixel, 0.0), True),
        (_TIE_POINT, "d", 6, (0.0, 0.0, 0.0, *corner, 0.0), True),
        (_KEYS, "H", len(_PLAIN), _PLAIN, True),
    ]
    with tifffile.TiffWriter(file, byteorder="<") as writer:
        writer.write(
            _tiles(heights),
            shape=(height, width),
            dtype=np.float32,
            tile=(TILE_SIDE, TILE_SIDE),
            photometric="minisblack",
            compression="adobe_deflate",
            metadata=None,
            software=False,
            maxworkers=1,
            extratags=tags,
        )


def _tiles(heights: np.ndarray) -> Iterator[np.ndarray]:
    """Yields the tiles row by row; those at the rim are filled up with what lies at it."""
    height, width = heights.shape
    for y in range(0, height, TILE_SIDE):
        for x in range(0, width, TILE_SIDE):
            part = heights[y : y + TILE_SIDE, x : x + TILE_SIDE].astype(np.float32)
            around = (0, TILE_SIDE - part.shape[0]), (0, TILE_SIDE - part.shape[1])
            yield np.pad(part, around, mode="edge")
