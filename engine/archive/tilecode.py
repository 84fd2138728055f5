"""How the integers of a tile become bytes: differences, less what other planes say of them, in no more bits than each
short piece of a row needs.

Of a tile the differences are taken that leave least, by a sample: none, from the left, from above, or from the plane
through those two and the pixel between them (as in ISO/IEC 15948, section 9, without its choice of neighbour).  Planes
follow one another in the order alpha, red, green, blue, amplitudes.  Where a stroke lies, the differences of its colour
are those of its alpha times a number, and where two colours mix in full cover, those of one channel are another's times
a number: so in squares of 16 x 16 pixels two gains are stored for each plane, of alpha's differences and of those of
the plane before, and what they give is taken away.  All of it wraps at 32 bits.  What is left is zigzag-coded: 0, -1,
1, -2, ... become 0, 1, 2, 3, ...

A piece, 32 pixels of a row, takes 0, 2, 4, 8, 16 or 32 bits a pixel, the fewest that hold all of it.  Pieces of the
same width lie together, those of several bytes apart by byte, so that deflate, which comes after, finds like with like.
A run of tiles is

    for every tile: one byte naming the differences, and for every plane and row one byte a piece naming its width;
    for every tile, for every plane but alpha, the low bytes of its gains, then the high bytes;
    then the streams: all pieces of 2 bits, of 4, of 8, low bytes, next bytes, third and fourth bytes of wider.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from engine.archive import tilecode_kernels as kernels

Stretch = bytes | memoryview


def code_size(shape: tuple[int, int, int]) -> int:
    """Returns bytes of the codes of a tile (planes, h, w)."""
    return 1 + shape[0] * shape[1] * -(-shape[2] // kernels.PIECE_WIDTH)


def gain_shape(shape: tuple[int, int, int]) -> tuple[int, int, int]:
    """Returns the shape of the gains of a tile (planes, h, w)."""
    return shape[0] - 1, kernels.GAINS, -(-shape[1] // kernels.SQUARE_SIDE) * -(-shape[2] // kernels.SQUARE_SIDE)


def gain_size(shape: tuple[int, int, int]) -> int:
    """Returns bytes of the gains of a tile (planes, h, w)."""
    return 2 * math.prod(gain_shape(shape))


def most(shape: tuple[int, int, int]) -> int:
    """Returns the most bytes that a tile (planes, h, w) takes."""
    return code_size(shape) + gain_size(shape) + 4 * math.prod(shape)


def _scratch(tiles: Sequence[np.ndarray]) -> np.ndarray:
    """Returns room for what the kernels keep of a tile while they are at it."""
    return np.empty(
        max(3 * math.prod(data.shape[1:]) + 4 * data.shape[2] for data in tiles) + kernels.PIECE_WIDTH + 3, np.int32
    )


def encoded(tiles: Sequence[np.ndarray]) -> list[Stretch]:
    """Returns a run of tiles, each int16 or int32 (planes, h, w), as bytes: the codes, the gains, each stream."""
    samples = sum(data.size for data in tiles)
    pieces = sum(code_size(data.shape) for data in tiles)
    codes = np.empty(pieces, np.uint8)
    streams = np.empty((kernels.STREAMS, samples + pieces), np.uint8)
    at = np.zeros(kernels.STREAMS, np.int64)
    gains, filled, scratch, sums = [], 0, _scratch(tiles), np.empty(kernels.DIFFERENCES, np.int64)
    for data in tiles:
        found = np.empty(gain_shape(data.shape), np.int16)
        kernels.encode(data.astype(np.int32), codes[filled:], found, streams, at, scratch, sums)
        gains.append(found.view(np.uint8).reshape(*found.shape, 2).transpose(0, 3, 1, 2).tobytes())
        filled += code_size(data.shape)
    return [codes.data, b"".join(gains), *(streams[k, : at[k]].data for k in range(kernels.STREAMS))]


def places(raw: np.ndarray, shapes: Sequence[tuple[int, int, int]]) -> np.ndarray | None:
    """Tells where each stream begins in the bytes of a run of tiles, uint8: int64 (7,); None if the bytes are not those
    of such tiles."""
    both = sum(code_size(shape) + gain_size(shape) for shape in shapes)
    if raw.size < both:
        return None
    lengths = np.zeros(kernels.STREAMS, np.int64)
    filled = 0
    for shape in shapes:
        size = code_size(shape)
        if not kernels.lengths_of(raw[filled : filled + size], shape[1], shape[2], lengths):
            return None
        filled += size
    if both + int(lengths.sum()) != raw.size:
        return None
    found: np.ndarray = both + np.cumsum(lengths) - lengths
    return found


def decoded(raw: np.ndarray, tiles: Sequence[np.ndarray]) -> int:
    """Fills `tiles`, of known shapes, from the bytes of a run, uint8; gives a bound of |value|, less than twice the
    largest, or -1 if the bytes are not those of such tiles."""
    at = places(raw, [data.shape for data in tiles])
    if at is None:
        return -1
    filled, place, largest, scratch = 0, sum(code_size(data.shape) for data in tiles), 0, _scratch(tiles)
    for data in tiles:
        size, shape = code_size(data.shape), gain_shape(data.shape)
        stop = place + gain_size(data.shape)
        apart = raw[place:stop].reshape(shape[0], 2, *shape[1:])
        gains = np.ascontiguousarray(np.ascontiguousarray(apart.transpose(0, 2, 3, 1)).view("<i2")[..., 0])
        whole = np.empty(data.shape, np.int32)  # of one type, for which the kernel is compiled
        largest |= int(
            kernels.decode(raw, raw[filled : filled + size], np.ascontiguousarray(gains), at, whole, scratch)
        )
        np.copyto(data, whole, casting="unsafe")
        filled, place = filled + size, stop
    return largest
