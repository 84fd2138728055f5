"""Writing TIFF (TIFF 6.0, Adobe deflate) strip by strip in constant memory; BigTIFF where 4 GB may not do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import BinaryIO

import numpy as np
from isal import isal_zlib

from engine.files.png_writer import srgb_profile

_STRIP = 1 << 19  # bytes of pixels in a strip, about
CLASSIC = (1 << 32) - (1 << 25)  # what classic TIFF can address, less room for the tags
_LEVEL = 1


def write_tiff(file: BinaryIO, size: tuple[int, int], depth: int, strips: Iterable[np.ndarray]) -> None:
    """Writes an RGBA image (alpha not premultiplied) of `size` (width, height) from strips of its rows.

    `strips`: uint8 or uint16 (n, width, 4) matching `depth`, n as they come; ValueError if they do not add up to the
    height.  Horizontal predictor (TIFF 6.0, section 14), sRGB profile.
    """
    import tifffile

    width, height = size
    rows = max(1, min(height, _STRIP // (width * depth // 2)))
    dtype = np.dtype(np.uint8 if depth == 8 else np.uint16)
    big = width * height * depth // 2 * 1.01 > CLASSIC
    with tifffile.TiffWriter(file, bigtiff=big, byteorder="<") as writer:
        writer.write(
            (deflated(block) for block in regrouped(strips, (height, width), rows)),
            shape=(height, width, 4),
            dtype=dtype,
            photometric="rgb",
            extrasamples=["unassalpha"],
            rowsperstrip=rows,
            compression="adobe_deflate",
            predictor="horizontal",
            iccprofile=srgb_profile(),
            metadata=None,
            software=False,
            maxworkers=1,
        )


def deflated(block: np.ndarray) -> bytes:
    """Returns one strip as stored: each sample less its left neighbour, little-endian, zlib."""
    ahead = block.copy()
    ahead[:, 1:] -= block[:, :-1]
    return isal_zlib.compress(np.ascontiguousarray(ahead, ahead.dtype.newbyteorder("<")), _LEVEL)


def regrouped(strips: Iterable[np.ndarray], shape: tuple[int, int], rows: int) -> Iterator[np.ndarray]:
    """Yields the same rows (n, width, 4) in groups of exactly `rows`, the last may be fewer; `shape` is (height,
    width)."""
    height, width = shape
    block = None
    filled = done = 0
    for strip in strips:
        if strip.shape[1:] != (width, 4) or done + filled + len(strip) > height:
            raise ValueError(f"rows {strip.shape} after {done + filled} of {height}, {width} wide")
        used = 0
        while used < len(strip):
            if block is None:
                block = np.empty((min(rows, height - done), width, 4), strip.dtype)
            count = min(len(block) - filled, len(strip) - used)
            block[filled : filled + count] = strip[used : used + count]
            filled += count
            used += count
            if filled == len(block):
                yield block
                done += filled
                filled, block = 0, None
    if done != height:
        raise ValueError(f"TIFF ended with {height - done - filled} of {height} rows missing")
