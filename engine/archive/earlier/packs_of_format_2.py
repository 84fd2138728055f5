"""Packs of the second format, which are still read.

There, a block is a zlib stream of a run of tiles.  Of each plane the differences are taken that its code names: none,
from the left, from above, or from the plane through those two and the pixel between them (as in ISO/IEC 15948, section
9, without its choice of neighbour).  They wrap at the 16 or 32 bits of the tile, and are zigzag-coded: 0, -1, 1, -2
become 0, 1, 2, 3.  A row takes 0, 2, 4, 8, 16 or 32 bits a pixel.  A run of tiles is

    for every plane of every tile: one byte naming the differences, one byte per row naming its width;
    then the streams: all rows of 2 bits, of 4 bits, of 8 bits, low bytes, next bytes, third and fourth bytes of wider.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from engine.archive.tilecode_kernels import CODES, DIFFERENCES, STREAMS, take
from engine.numeric.kernel import Array, inner_uncounted, short, uncounted

SECOND = b"inkfall\x02"


@short
def _lengths_of_rows(codes: np.ndarray, planes: int, height: int, width: int, lengths: np.ndarray) -> bool:
    """Adds what a tile takes of each stream to `lengths` (STREAMS,); False if a code is unknown."""
    for p in range(planes):
        if codes[p * (1 + height)] >= DIFFERENCES:
            return False
        for y in range(height):
            code = codes[p * (1 + height) + 1 + y]
            if code >= CODES:
                return False
            if code == 1:
                lengths[0] += (width + 3) // 4
            elif code == 2:
                lengths[1] += (width + 1) // 2
            elif code == 3:
                lengths[2] += width
            elif code > 3:
                for b in range(2 if code == 4 else 4):
                    lengths[3 + b] += width
    return True


@inner_uncounted
def _add_before(row: np.ndarray, before: np.ndarray, kind: np.uint8, first: bool) -> None:
    """Turns a row of differences to the row itself, wrapping."""
    if kind == 1 or kind == 3:
        for i in range(1, row.size):
            row[i] += row[i - 1]
    if kind >= 2 and not first:
        for i in range(row.size):
            row[i] += before[i]


@uncounted
def _rows(raw: Array, codes: Array, at: Array, out: Array, z: Array) -> np.int32:
    """Fills a tile, `at` (STREAMS,) being where in `raw` the next row of each width lies; gives the bits of all
    |value|.  `z`, uint32 (w + 3,), is written to."""
    planes, height, width = out.shape
    largest = np.int32(0)
    for p in range(planes):
        kind = codes[p * (1 + height)]
        for y in range(height):
            code = codes[p * (1 + height) + 1 + y]
            row = out[p, y]
            if code == 0:
                row[:] = 0
            else:
                take(raw, at, code, z, width)
                for i in range(width):
                    v = np.int32(z[i] >> np.uint32(1))
                    row[i] = np.int32(v ^ np.int32(-np.int32(z[i] & np.uint32(1))))
            if kind:
                _add_before(row, out[p, max(y - 1, 0)], kind, y == 0)
            for i in range(width):
                v = np.int32(row[i])
                largest = np.int32(largest | np.int32(v ^ np.int32(v >> np.int32(31))))
    return largest


def code_size(shape: tuple[int, int, int]) -> int:
    """Returns bytes of the codes of a tile (planes, h, w)."""
    return shape[0] * (1 + shape[1])


def rows_decoded(raw: np.ndarray, tiles: Sequence[np.ndarray]) -> int:
    """Fills `tiles`, of known shapes, from the bytes of a run, uint8; gives a bound of |value|, less than twice the
    largest, or -1 if the bytes are not those of such tiles."""
    count = sum(code_size(data.shape) for data in tiles)
    if raw.size < count:
        return -1
    lengths = np.zeros(STREAMS, np.int64)
    filled = 0
    for data in tiles:
        planes, height, width = data.shape
        if not _lengths_of_rows(raw[filled:count], planes, height, width, lengths):
            return -1
        filled += code_size(data.shape)
    if count + int(lengths.sum()) != raw.size:
        return -1
    at = count + np.cumsum(lengths) - lengths
    filled = largest = 0
    for data in tiles:
        largest |= int(_rows(raw, raw[filled:count], at, data, np.zeros(data.shape[2] + 3, np.uint32)))
        filled += code_size(data.shape)
    return largest


def most(shape: tuple[int, int, int], bits: int) -> int:
    """Returns the most bytes that a tile (planes, h, w) of 16 or 32 bits takes."""
    return code_size(shape) + shape[0] * shape[1] * shape[2] * bits // 8
