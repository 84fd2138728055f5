"""Many tiles in one member: how the residuals of a pyramid lie in a file.

A pack is little-endian: 8 bytes of magic, the length of the head (uint32), the head, and the blocks.  The head is one
JSON object: `inks`, the keys of all instances in the pack; `tiles`, one list each of
[level, x, y, x0, y0, x1, y1, bits, [indices of inks]], addresses in hexadecimal of any length; `blocks`, one list each
of [number of tiles, plain bytes, stored bytes].  A block is a zlib stream of its tiles one after another.

A tile is, for each of its planes, one byte naming the difference taken (0 none, 1 from the left, 2 from above), then
for each plane all low bytes, all next bytes, and so on, of the zigzag-coded differences (wrapping at 16 or 32 bits).
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
from isal import isal_zlib
from numba import njit

from engine.canvas.store import Record
from engine.numeric.address import TILE, Rect, TileKey
from engine.painting.commands import LEVEL_LIMIT, PLACE_LIMIT
from engine.painting.fault import FileError, shown
from engine.painting.inflate import DeflateError, Inflated
from engine.painting.strictjson import FormatError, dumps, loads
from engine.texture.planes import COLOURS
from engine.texture.record import Instance

MAGIC = b"inkfall\x01"
TILES = 256  # in a pack
BYTES = 32 << 20  # plain, of all tiles of a pack, about
BLOCK = 1 << 20  # plain, of all tiles of a block, about
HEAD_CAP = 24 << 20  # bytes of the head
BLOCK_CAP = 256 << 20  # what a block may claim: one tile of a thousand inks fits
LEVEL_CAP = LEVEL_LIMIT + 256  # a stroke changes some levels coarser than its own
DIGITS_CAP = PLACE_LIMIT.bit_length() // 4 + 3  # of an address, with its sign
RESIDUAL_CAP = 1 << 22  # |residual| in units of 2^-16: values lie within 16
KINDS: dict[int, Any] = {16: np.int16, 32: np.int32}
LEVEL = 1

Tile = tuple[TileKey, Record]


# ---- one tile ----


@njit(cache=True, nogil=True)
def _best_difference(plane):
    """0, 1 or 2: which differences of a plane (h, w) have the smallest sum of absolute values."""
    height, width = plane.shape
    as_is, left, above = np.int64(0), np.int64(0), np.int64(0)
    for y in range(height):
        row = plane[y]
        before = plane[max(y - 1, 0)]
        here = np.int64(0)
        for i in range(width):
            here += abs(np.int64(row[i]))
        as_is += here
        left += abs(np.int64(row[0]))
        for i in range(1, width):
            left += abs(np.int64(row[i]) - np.int64(row[i - 1]))
        if y == 0:
            above += here
        else:
            for i in range(width):
                above += abs(np.int64(row[i]) - np.int64(before[i]))
    if above < min(left, as_is):
        return 2
    return 1 if left < as_is else 0


@njit(cache=True, nogil=True)
def _difference(plane, y, kind, line):
    """Row `y` of a plane less what `kind` names, wrapping, into `line`."""
    row = plane[y]
    width = row.size
    if kind == 1:
        line[0] = row[0]
        for i in range(1, width):
            line[i] = row[i] - row[i - 1]
    elif kind == 2 and y > 0:
        before = plane[y - 1]
        for i in range(width):
            line[i] = row[i] - before[i]
    else:
        for i in range(width):
            line[i] = row[i]


@njit(cache=True, nogil=True)
def _encode(data, out):
    """`data` int16 or int32 (planes, h, w), bytes into `out`; gives the number of bytes."""
    planes, height, width = data.shape
    size = height * width
    count = data.itemsize
    top = 8 * count - 1
    line = np.empty(width, data.dtype)
    for p in range(planes):
        kind = _best_difference(data[p])
        out[p] = kind
        base = planes + p * size * count
        for y in range(height):
            _difference(data[p], y, kind, line)
            for b in range(count):
                place = out[base + b * size + y * width : base + b * size + (y + 1) * width]
                shift = 8 * b
                for i in range(width):
                    v = np.int64(line[i])
                    place[i] = np.uint8(((v << 1) ^ (v >> top)) >> shift)
    return planes + planes * size * count


@njit(cache=True, nogil=True)
def _whole_row(raw, start, size, row):
    """One row of differences from its bytes, which lie `size` apart from `start` on."""
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


@njit(cache=True, nogil=True)
def _decode(raw, out):
    """The inverse of `_encode`: bytes `raw` into `out`; gives the largest |value|, or -1 if a difference is unknown."""
    planes, height, width = out.shape
    size = height * width
    largest = np.int64(0)
    for p in range(planes):
        kind = raw[p]
        if kind > 2:
            return np.int64(-1)
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
    return largest


def encoded_size(shape: tuple[int, ...], bits: int) -> int:
    """Plain bytes of a tile of `shape` (planes, h, w)."""
    return shape[0] + shape[0] * shape[1] * shape[2] * bits // 8


# ---- writing ----


def grouped(tiles: Sequence[Tile]) -> Iterator[Sequence[Tile]]:
    """The tiles in runs of a pack's size."""
    start, size = 0, 0
    for stop, (_, record) in enumerate(tiles):
        if stop > start and (stop - start >= TILES or size + record.data.nbytes > BYTES):
            yield tiles[start:stop]
            start, size = stop, 0
        size += record.data.nbytes
    if tiles:
        yield tiles[start:]


def pack(tiles: Sequence[Tile]) -> bytes:
    """The pack of some tiles: the same tiles in the same order give the same bytes."""
    inks: dict[Instance, int] = {}
    lines, blocks, bodies = [], [], []
    for key, record in tiles:
        indices = [inks.setdefault(ink, len(inks)) for ink in record.inks]
        bits = 8 * record.data.itemsize
        lines.append([key.level, f"{key.x:x}", f"{key.y:x}", *record.rect, bits, indices])
    for run in _runs(tiles):
        plain = np.empty(sum(encoded_size(r.data.shape, 8 * r.data.itemsize) for _, r in run), np.uint8)
        filled = 0
        for _, record in run:
            filled += _encode(np.ascontiguousarray(record.data), plain[filled:])
        bodies.append(isal_zlib.compress(plain.data, LEVEL))
        blocks.append([len(run), plain.size, len(bodies[-1])])
    head = dumps({"inks": [ink.key for ink in inks], "tiles": lines, "blocks": blocks}).encode()
    return b"".join([MAGIC, struct.pack("<I", len(head)), head, *bodies])


def _runs(tiles: Sequence[Tile]) -> Iterator[Sequence[Tile]]:
    start, size = 0, 0
    for stop, (_, record) in enumerate(tiles):
        if stop > start and size + record.data.nbytes > BLOCK:
            yield tiles[start:stop]
            start, size = stop, 0
        size += record.data.nbytes
    if tiles:
        yield tiles[start:]


# ---- reading ----


def unpack(
    data: bytes, name: str, ink_of: Callable[[Any], Instance], announced: tuple[int, int] | None = None
) -> list[Tile]:
    """The tiles of a pack, with nothing pending.  `ink_of` makes an instance of a key and may raise ValueError.

    `announced`: the numbers of tiles and of plain bytes there must be.  FileError if anything is not as it should be,
    before memory is taken for it; `name` is the file's and the member's.
    """
    try:
        return _unpack(data, ink_of, announced)
    except (FormatError, _Fault, ValueError) as error:
        raise FileError(name, str(error)) from error


class _Fault(Exception):
    pass


def _need(right: bool, what: str, found: object) -> None:
    if not right:
        raise _Fault(f"{what}: found {shown(found)}")


def _unpack(data: bytes, ink_of: Callable[[Any], Instance], announced: tuple[int, int] | None) -> list[Tile]:
    _need(data[:8] == MAGIC and len(data) >= 12, "start of a pack of tiles", data[:8])
    (length,) = struct.unpack_from("<I", data, 8)
    start = 12 + length
    _need(start <= len(data), "length of the head", length)
    head = loads(data[12:start], cap=HEAD_CAP)
    _need(
        isinstance(head, dict) and all(isinstance(head.get(k), list) for k in ("inks", "tiles", "blocks")), "head", ""
    )
    inks = [ink_of(key) for key in head["inks"]]
    heads = [_tile_head(line, inks) for line in head["tiles"]]
    found = len(heads), sum(encoded_size(shape, bits) for _, _, shape, bits, _ in heads)
    _need(announced is None or found == announced, "tiles and bytes of a pack", found)
    tiles: list[Tile] = []
    for block in head["blocks"]:
        whole = isinstance(block, list) and len(block) == 3 and all(type(v) is int and v >= 0 for v in block)
        _need(whole, "block", block)
        count, plain, stored = block
        run = heads[len(tiles) : len(tiles) + count]
        expected = sum(encoded_size(shape, bits) for _, _, shape, bits, _ in run)
        _need(len(run) == count and plain == expected and plain <= BLOCK_CAP, "block", block)
        _need(start + stored <= len(data), "stored bytes of a block", stored)
        tiles.extend(_block(memoryview(data)[start : start + stored], plain, run))
        start += stored
    _need(start == len(data) and len(tiles) == len(heads), "end of a pack", (start, len(tiles)))
    return tiles


Head = tuple[TileKey, Rect, tuple[int, int, int], int, tuple[Instance, ...]]


def _tile_head(line: Any, inks: list[Instance]) -> Head:
    _need(isinstance(line, list) and len(line) == 9, "tile", line)
    level, x, y, *corners, bits, indices = line
    _need(type(level) is int and abs(level) <= LEVEL_CAP, "level of a tile", level)
    key = TileKey(level, _address(x), _address(y))
    _need(all(type(v) is int and 0 <= v <= TILE for v in corners), "rectangle of a tile", corners)
    rect = Rect(*corners)
    _need(not rect.empty, "rectangle of a tile", corners)
    _need(type(bits) is int and bits in KINDS, "bits of a tile", bits)
    sound = isinstance(indices, list) and all(type(i) is int and 0 <= i < len(inks) for i in indices)
    _need(sound and len(set(indices)) == len(indices), "inks of a tile", indices)
    there = tuple(inks[i] for i in indices)
    return key, rect, (COLOURS + 3 * len(there), rect.height, rect.width), bits, there


def _address(text: Any) -> int:
    _need(isinstance(text, str) and 0 < len(text) <= DIGITS_CAP, "address of a tile", text)
    digits = text.removeprefix("-")
    _need(bool(digits) and all(c in "0123456789abcdef" for c in digits), "address of a tile", text)
    return int(text, 16)


def _block(stored: memoryview, plain: int, run: Sequence[Head]) -> Iterator[Tile]:
    raw = np.empty(plain, np.uint8)
    stream = Inflated(iter([bytes(stored)]))
    try:
        filled = stream.readinto(raw.data)
        complete = filled == plain and stream.finish()
    except DeflateError as error:
        raise _Fault(f"block: damaged ({error})") from error
    _need(complete, "bytes in a block", filled)
    at = 0
    for key, rect, shape, bits, inks in run:
        data = np.empty(shape, KINDS[bits])
        size = encoded_size(shape, bits)
        largest = _decode(raw[at : at + size], data)
        _need(0 <= largest <= RESIDUAL_CAP, "largest residual of a tile", largest)
        at += size
        data.flags.writeable = False
        yield key, Record(rect, data, inks, 0)
