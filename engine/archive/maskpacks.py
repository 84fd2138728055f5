"""Many tiles of a mask in one member: how the pixels that were painted with an example lie in a file, and what control
channels tell of them.

Such a pack is little-endian: 8 bytes of magic, the length of the head (uint32), the head, and one zlib stream.  The
head is a JSON list of runs of tiles that lie side by side, [row, column of the first, count], rows and columns in
hexadecimal of any length, row by row; the stream has 512 bytes for each tile, a bit a pixel, the leftmost the highest.
Where magic ends in 2, the list begins with the number of planes, and the stream has 4096 bytes for each of a tile's.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from immutables import Map
from isal import isal_zlib

from engine.archive.packfault import PackFault, need
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.files.inflate import DeflateError, Inflated
from engine.files.strict_json import dumps, loads
from engine.painting.commands import PLACE_LIMIT
from engine.texture.example.control import MOST_CHANNELS
from engine.texture.example.tiles import NONE, TILE_SIDE, Key, TilePlanes, Tiles, sealed

MAGIC = b"inkmask\x01"
TOLD_MAGIC = b"inkmask\x02"
TILES = 1 << 14  # in a pack
TOLD_TILES = 1 << 12  # of control channels in one
PLAIN = TILE_SIDE * TILE_SIDE // 8  # bytes of a tile in the stream
HEAD_CAP = 24 << 20  # bytes of the head
DIGITS_CAP = PLACE_LIMIT.bit_length() // 4 + 3  # of a row or column, with its sign
_LEVEL = 1
_ADDRESS = re.compile("-?[0-9a-f]+")
_FULL = sealed(np.ones((1, TILE_SIDE, TILE_SIDE), np.uint8))  # most tiles are: they are one


def grouped(masks: Tiles, most: int = 0) -> Iterator[list[Key]]:
    """Yields the tiles of a mask, row by row, `most` at a time, or as many as go into a pack."""
    keys, most = sorted(masks), most or TILES
    for start in range(0, len(keys), most):
        yield keys[start : start + most]


def pack(masks: Mapping[Key, TilePlanes], keys: Sequence[Key]) -> bytes:
    """Returns the pack of some tiles, in their order: the same tiles give the same bytes."""
    bits = np.packbits(np.concatenate([masks[key].data for key in keys]) > 0, axis=-1)
    return _packed(MAGIC, _runs(keys), bits)


def pack_told(told: Mapping[Key, TilePlanes], keys: Sequence[Key]) -> bytes:
    """Returns the pack of what control channels tell of some tiles, in their order."""
    planes = np.stack([told[key].data for key in keys])
    return _packed(TOLD_MAGIC, [planes.shape[1], *_runs(keys)], planes)


def _packed(magic: bytes, told: list[object], values: np.ndarray) -> bytes:
    head = dumps(told).encode()
    return b"".join([magic, struct.pack("<I", len(head)), head, isal_zlib.compress(values.tobytes(), _LEVEL)])


def _runs(keys: Sequence[Key]) -> list[Any]:
    runs: list[Any] = []
    for (row, column), before in zip(keys, [None, *keys], strict=False):
        if before == (row, column - 1):
            runs[-1][2] += 1
        else:
            runs.append([f"{row:x}", f"{column:x}", 1])
    return runs


def unpack(data: bytes, name: str, count: int) -> Tiles:
    """Returns the tiles of a pack, `count` as is known from elsewhere; FileError if it is none, before memory is
    taken for it: `name` is the file's and the member's."""
    try:
        return _unpacked(data, count)
    except (FieldError, DeflateError, PackFault) as error:
        raise FileError(name, str(error)) from error


def _unpacked(data: bytes, count: int) -> Tiles:
    tells = data[:8] == TOLD_MAGIC
    need((tells or data[:8] == MAGIC) and len(data) >= 12, "start of a pack of masks", data[:8])
    (length,) = struct.unpack_from("<I", data, 8)
    need(12 + length <= len(data), "length of the head", length)
    need(0 < count <= (TOLD_TILES if tells else TILES), "number of tiles", count)
    head, rest = loads(data[12 : 12 + length], cap=HEAD_CAP), data[12 + length :]
    if tells:
        return _told(head, rest, count)
    keys = _keys(head, count)
    bits = _inflated(rest, count * PLAIN).reshape(count, PLAIN)
    need(bool(bits.any(axis=1).all()), "a tile", "no pixel")
    found = NONE.mutate()
    for key, own in zip(keys, bits, strict=True):
        found[key] = _mask(own)
    return found.finish()


def _told(head: Any, rest: bytes, count: int) -> Tiles:
    """Returns what control channels tell of tiles, `count` of them."""
    sound = isinstance(head, list) and bool(head) and type(head[0]) is int and 0 < head[0] <= MOST_CHANNELS
    need(sound, "number of planes", head[:1] if isinstance(head, list) else head)
    size = head[0] * TILE_SIDE * TILE_SIDE
    planes = _inflated(rest, count * size).reshape(count, head[0], TILE_SIDE, TILE_SIDE)
    found = NONE.mutate()
    for key, own in zip(_keys(head[1:], count), planes, strict=True):
        found[key] = sealed(own.copy())
    return found.finish()


def _inflated(rest: bytes, size: int) -> np.ndarray:
    raw = np.empty(size, np.uint8)
    stream = Inflated(iter([rest]))
    filled = stream.readinto(raw.data)
    need(filled == raw.size and stream.finish(), "bytes of the tiles", filled)
    return raw


def _keys(runs: Any, count: int) -> list[Key]:
    """Returns the tiles of some runs, `count` of them."""
    need(isinstance(runs, list), "head", runs)
    keys: list[Key] = []
    for run in runs:
        sound = isinstance(run, list) and len(run) == 3 and type(run[2]) is int
        need(sound and 0 < run[2] <= count - len(keys), "run of tiles", run)
        row, column = _address(run[0]), _address(run[1])
        need(not keys or (row, column) > keys[-1], "order of the tiles", run)
        keys += [(row, column + n) for n in range(run[2])]
    need(len(keys) == count, "number of tiles", len(keys))
    return keys


def _address(text: Any) -> int:
    sound = isinstance(text, str) and len(text) <= DIGITS_CAP and _ADDRESS.fullmatch(text) is not None
    need(sound, "place of a tile", text)
    return int(text, 16)


def _mask(bits: np.ndarray) -> TilePlanes:
    if (bits == 255).all():
        return _FULL
    return sealed(np.unpackbits(bits).reshape(1, TILE_SIDE, TILE_SIDE))


def joined(parts: Sequence[Tiles], name: str) -> Tiles:
    """Returns the tiles of several packs, which follow one another; FileError if they do not."""
    for one, other in pairwise(parts):
        if max(one) >= min(other):
            raise FileError(name, "packs of masks: found tiles out of order, expected each once, row by row")
    return Map({key: mask for part in parts for key, mask in part.items()})
