"""How the integers of a tile become bytes: differences, and of those no more bits than each row needs.

Of each plane, unless all of it is -2 to 1, the differences are taken that leave least, by a sample: none, from the
left, from above, or from the plane through those two and the pixel between them (as in ISO/IEC 15948, section 9,
without its choice of neighbour).  They wrap at the 16 or 32 bits of the tile, and are zigzag-coded: 0, -1, 1, -2, ...
become 0, 1, 2, 3, ...

A row takes 0, 2, 4, 8, 16 or 32 bits a pixel, the fewest that hold all of it.  Rows of the same width lie together,
those of several bytes apart by byte, so that deflate, which comes after, finds like with like.  A run of tiles is

    for every plane of every tile: one byte naming the differences, one byte per row naming its width;
    then the streams: all rows of 2 bits, of 4 bits, of 8 bits, low bytes, next bytes, third and fourth bytes of wider.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from engine.numeric.kernel import inlined, inner, kernel, short

STREAMS = 7
_CODES = 6  # widths of a row
_KINDS = 4  # of differences
SAMPLED = 4  # of the rows, by which those are chosen


@inlined
def _abs(value: np.int32) -> np.int32:
    """|value| of an int32, as one."""
    sign = np.int32(value >> np.int32(31))
    return np.int32(np.int32(value ^ sign) - sign)


@inner
def _small(plane: np.ndarray) -> bool:
    """Tells whether all values are -2 to 1: then they are roundings, and differences would make more of them."""
    for y in range(plane.shape[0]):
        row = plane[y]
        bits = np.int32(0)
        for i in range(row.size):
            v = np.int32(row[i])
            bits = np.int32(bits | np.int32(v ^ np.int32(v >> np.int32(31))))
        if bits > 1:
            return False
    return True


@inner
def _kind(plane: np.ndarray) -> int:
    """0 to 3: which differences of a plane (h, w) have the smallest sum of absolute values on every `SAMPLED`-th row;
    0 if all are -2 to 1."""
    height = plane.shape[0]
    if _small(plane):
        return 0
    sums = np.zeros(_KINDS, np.int64)
    for y in range(min(1, height - 1), height, SAMPLED):
        none, left, above, both = _sums(plane[y], plane[max(y - 1, 0)])
        sums[0] += none
        sums[1] += left
        sums[2] += above
        sums[3] += both
    return np.argmin(sums)  # type: ignore[return-value]


@inner
def _sums(row: np.ndarray, before: np.ndarray) -> tuple[np.int32, np.int32, np.int32, np.int32]:
    """Returns the sums of a row's absolute differences, of each kind.

    They are cast to int32 at every step, since sums of it are int64 otherwise, which takes twice as long; where that
    wraps, beyond all values of pixels, another kind is chosen than the best.
    """
    v, u = np.int32(row[0]), np.int32(before[0])
    none, left, above, both = _abs(v), _abs(v), _abs(np.int32(v - u)), _abs(np.int32(v - u))
    width = row.size
    here, beside, up, corner = row[1:], row[: width - 1], before[1:], before[: width - 1]
    for i in range(width - 1):
        v, u = np.int32(here[i]), np.int32(up[i])
        step = np.int32(v - np.int32(beside[i]))
        none = np.int32(none + _abs(v))
        left = np.int32(left + _abs(step))
        above = np.int32(above + _abs(np.int32(v - u)))
        both = np.int32(both + _abs(np.int32(np.int32(step - u) + np.int32(corner[i]))))
    return none, left, above, both


@inner
def _difference(plane: np.ndarray, y: int, kind: int, line: np.ndarray) -> None:
    """Writes row `y` of a plane less what `kind` names, wrapping, into `line`."""
    row = plane[y]
    width = row.size
    if kind >= 2 and y > 0:
        before = plane[y - 1]
        for i in range(width):
            line[i] = row[i] - before[i]
        if kind == 3:
            for i in range(width - 1, 0, -1):
                line[i] -= row[i - 1] - before[i - 1]
        return
    for i in range(width):
        line[i] = row[i]
    if kind == 1 or kind == 3:
        here, beside = row[1:], row[: width - 1]
        rest = line[1:]
        for i in range(width - 1):
            rest[i] = here[i] - beside[i]


@inner
def _zigzag(line: np.ndarray, z: np.ndarray) -> np.uint32:
    """`line` (w,) zigzag-coded into `z` uint32 (>= w,); all its bits together."""
    bits = np.uint32(0)
    for i in range(line.size):
        v = np.int32(line[i])
        z[i] = np.uint32(np.int32(v << np.int32(1)) ^ np.int32(v >> np.int32(31)))
        bits = np.uint32(bits | z[i])
    return bits


@inner
def _put(z: np.ndarray, width: int, bits: np.uint32, streams: np.ndarray, at: np.ndarray) -> int:
    """Appends a row to its stream, `at` (STREAMS,) being where each ends; the code of its width."""
    if bits == 0:
        return 0
    if bits < 4:
        n = (width + 3) // 4
        out = streams[0, at[0] : at[0] + n]
        for i in range(n):
            out[i] = z[4 * i] | (z[4 * i + 1] << 2) | (z[4 * i + 2] << 4) | (z[4 * i + 3] << 6)
        at[0] += n
        return 1
    if bits < 16:
        n = (width + 1) // 2
        out = streams[1, at[1] : at[1] + n]
        for i in range(n):
            out[i] = z[2 * i] | (z[2 * i + 1] << 4)
        at[1] += n
        return 2
    count, first = 1, 2
    if bits >= 256:
        count, first = (2, 3) if bits < 65536 else (4, 3)
    for b in range(count):
        out = streams[first + b, at[first + b] : at[first + b] + width]
        for i in range(width):
            out[i] = np.uint8(z[i] >> np.uint32(8 * b))
        at[first + b] += width
    return 3 if count == 1 else 3 + count // 2


@kernel
def _encode(data: np.ndarray, codes: np.ndarray, streams: np.ndarray, at: np.ndarray) -> None:
    """`data` int16 or int32 (planes, h, w): its codes (planes * (1 + h),), its rows into the streams."""
    planes, height, width = data.shape
    line = np.empty(width, data.dtype)
    z = np.zeros(width + 3, np.uint32)
    for p in range(planes):
        kind = _kind(data[p])
        codes[p * (1 + height)] = kind
        for y in range(height):
            _difference(data[p], y, kind, line)
            bits = _zigzag(line, z)
            codes[p * (1 + height) + 1 + y] = _put(z, width, bits, streams, at)


@short
def _lengths(codes: np.ndarray, planes: int, height: int, width: int, lengths: np.ndarray) -> bool:
    """Adds what a tile takes of each stream to `lengths` (STREAMS,); False if a code is unknown."""
    for p in range(planes):
        if codes[p * (1 + height)] >= _KINDS:
            return False
        for y in range(height):
            code = codes[p * (1 + height) + 1 + y]
            if code >= _CODES:
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


@kernel
def _take(raw: np.ndarray, at: np.ndarray, code: np.uint8, z: np.ndarray) -> None:
    """Takes the next row of width `code` into `z` uint32 (w + 3,)."""
    width = z.size - 3
    if code == 1:
        n = (width + 3) // 4
        source = raw[at[0] : at[0] + n]
        for i in range(n):
            v = np.uint32(source[i])
            z[4 * i], z[4 * i + 1] = v & np.uint32(3), (v >> np.uint32(2)) & np.uint32(3)
            z[4 * i + 2], z[4 * i + 3] = (v >> np.uint32(4)) & np.uint32(3), v >> np.uint32(6)
        at[0] += n
    elif code == 2:
        n = (width + 1) // 2
        source = raw[at[1] : at[1] + n]
        for i in range(n):
            v = np.uint32(source[i])
            z[2 * i], z[2 * i + 1] = v & np.uint32(15), v >> np.uint32(4)
        at[1] += n
    elif code == 3:
        source = raw[at[2] : at[2] + width]
        for i in range(width):
            z[i] = source[i]
        at[2] += width
    else:
        z[:] = 0
        for b in range(2 if code == 4 else 4):
            source = raw[at[3 + b] : at[3 + b] + width]
            for i in range(width):
                z[i] |= np.uint32(source[i]) << np.uint32(8 * b)
            at[3 + b] += width


@inner
def _add_before(row: np.ndarray, before: np.ndarray, kind: np.uint8, first: bool) -> None:
    """Turns a row of differences to the row itself, wrapping."""
    if kind == 1 or kind == 3:
        for i in range(1, row.size):
            row[i] += row[i - 1]
    if kind >= 2 and not first:
        for i in range(row.size):
            row[i] += before[i]


@kernel
def _decode(raw: np.ndarray, codes: np.ndarray, at: np.ndarray, out: np.ndarray) -> np.int32:
    """Returns the inverse of `_encode`, `at` (STREAMS,) being where in `raw` the next row of each width lies; gives the
    largest |value|."""
    planes, height, width = out.shape
    z = np.zeros(width + 3, np.uint32)
    largest = np.int32(0)
    for p in range(planes):
        kind = codes[p * (1 + height)]
        for y in range(height):
            code = codes[p * (1 + height) + 1 + y]
            row = out[p, y]
            if code == 0:
                row[:] = 0
            else:
                _take(raw, at, code, z)
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


def encoded(tiles: Sequence[np.ndarray]) -> bytes:
    """Returns a run of tiles, each int16 or int32 (planes, h, w), as bytes."""
    samples = sum(data.size for data in tiles)
    rows = sum(data.shape[0] * data.shape[1] for data in tiles)
    codes = np.empty(sum(code_size(data.shape) for data in tiles), np.uint8)
    streams = np.empty((STREAMS, samples + rows), np.uint8)
    at = np.zeros(STREAMS, np.int64)
    filled = 0
    for data in tiles:
        _encode(data, codes[filled:], streams, at)
        filled += code_size(data.shape)
    return b"".join([codes.data, *(streams[k, : at[k]].data for k in range(STREAMS))])


def decoded(raw: np.ndarray, tiles: Sequence[np.ndarray]) -> int:
    """Fills `tiles`, of known shapes, from the bytes of a run, uint8; gives a bound of |value|, less than twice the
    largest, or -1 if the bytes are not those of such tiles."""
    count = sum(code_size(data.shape) for data in tiles)
    if raw.size < count:
        return -1
    lengths = np.zeros(STREAMS, np.int64)
    filled = 0
    for data in tiles:
        planes, height, width = data.shape
        if not _lengths(raw[filled:count], planes, height, width, lengths):
            return -1
        filled += code_size(data.shape)
    if count + int(lengths.sum()) != raw.size:
        return -1
    at = count + np.cumsum(lengths) - lengths
    filled = largest = 0
    for data in tiles:
        largest |= int(_decode(raw, raw[filled:count], at, data))
        filled += code_size(data.shape)
    return largest
