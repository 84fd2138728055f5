"""Packs of the first format, which are still read.

There, a block is a zlib stream of its tiles one after another.  A tile is, for each of its planes, one byte naming the
difference taken (0 none, 1 from the left, 2 from above), then for each plane all low bytes, all next bytes, and so on,
of the zigzag-coded differences (wrapping at 16 or 32 bits).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from engine.numeric.kernel import inner, kernel

MAGIC = b"inkfall\x01"


@inner
def _whole_row(raw: np.ndarray, start: int, size: int, row: np.ndarray) -> None:
    """Reads one row of differences from its bytes, which lie `size` apart from `start` on."""
    width = row.size
    low = raw[start : start + width]
    high = raw[start + size : start + size + width]
    if row.itemsize == 2:
        for i in range(width):
            z = np.int32(low[i]) | (np.int32(high[i]) << 8)
            row[i] = (z >> 1) ^ -(z & 1)
        return
    third = raw[start + 2 * size : start + 2 * size + width]
    fourth = raw[start + 3 * size : start + 3 * size + width]
    for i in range(width):
        wide = np.int64(low[i]) | (np.int64(high[i]) << 8) | (np.int64(third[i]) << 16) | (np.int64(fourth[i]) << 24)
        row[i] = (wide >> 1) ^ -(wide & 1)


@kernel
def _decode(raw: np.ndarray, out: np.ndarray) -> int:
    """Returns the tile that bytes `raw` hold into `out`; gives the largest |value|, or -1 if a difference is
    unknown."""
    planes, height, width = out.shape
    size = height * width
    largest = np.int64(0)
    for p in range(planes):
        kind = raw[p]
        if kind > 2:
            return np.int64(-1)  # type: ignore[return-value]
        base = planes + p * size * out.itemsize
        for y in range(height):
            row = out[p, y]
            _whole_row(raw, base + y * width, size, row)
            if kind == 1:
                for i in range(1, width):
                    row[i] += row[i - 1]
            elif kind == 2 and y > 0:
                before = out[p, y - 1]
                for i in range(width):
                    row[i] += before[i]
            for i in range(width):
                largest = max(largest, abs(np.int64(row[i])))
    return largest  # type: ignore[return-value]


def encoded_size(shape: tuple[int, ...], bits: int) -> int:
    """Plain bytes of a tile of `shape` (planes, h, w)."""
    return shape[0] + shape[0] * shape[1] * shape[2] * bits // 8


def decoded(raw: np.ndarray, tiles: Sequence[np.ndarray]) -> int:
    """Fills `tiles`, of known shapes, from the bytes of a block, uint8; gives the largest |value|, or -1 if the bytes
    are not those of such tiles."""
    filled, largest = 0, 0
    for data in tiles:
        size = encoded_size(data.shape, 8 * data.itemsize)
        found = _decode(raw[filled : filled + size], data)
        if found < 0:
            return -1
        filled, largest = filled + size, max(largest, found)
    return largest
