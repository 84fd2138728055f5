"""Many tiles in one member: how the residuals of a pyramid lie in a file.

A pack is little-endian: 8 bytes of magic, the length of the head (uint32), the head, and the blocks.  The head is one
JSON object: `inks`, the keys of all instances in the pack; `tiles`, one list each of
[level, x, y, x0, y0, x1, y1, bits, [indices of inks]], addresses in hexadecimal of any length, and where ink implies
the tile's colour (engine/archive/implied.py) three entries more, [indices of those inks], [terms], CRC-32; `blocks`,
one list each of [number of tiles, plain bytes, stored bytes]; and `crc`, the CRC-32 of all that comes before, closed by
a bracket.  A block is a zlib stream of a run of tiles
(engine/archive/tilecode.py).
"""

from __future__ import annotations

import re
import struct
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby
from typing import Any, TypeVar

import numpy as np
from isal import isal_zlib

from engine.archive import tilecode
from engine.archive.earlier import packs_of_format_1, packs_of_format_2
from engine.archive.implied import ABOVE, MOST, TERM_CAP, Coded, Implied, Tile
from engine.archive.packfault import PackFault, need
from engine.archive.shelves.shelf import Block, Filed, block_at
from engine.canvas.store import Record
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.files.inflate import DeflateError, Inflated
from engine.files.strict_json import dumps, loads
from engine.numeric.address import TILE, Rect, TileKey
from engine.painting.commands import LEVEL_LIMIT, PLACE_LIMIT
from engine.texture.planes import COLOURS
from engine.texture.record import Instance

_MAGIC = b"inkfall\x03"
TILES = 256  # in a pack
BYTES = 32 << 20  # of all tiles of a pack, about
BLOCK = 1 << 22  # of all tiles of a block, about
HEAD_CAP = 24 << 20  # bytes of the head
FEW_BYTES = 1 << 14
# How the parts of a block are deflated closely, as zlib counts level, memory and strategy: the widths of pieces repeat
# those of rows above, of 2 bits a byte tells four pixels that runs say nothing of, of the rest one codes the bytes, and
# runs of them.
_WIDTHS, _FOURS, _BYTEWISE = (5, 8, zlib.Z_FILTERED), (1, 7, zlib.Z_HUFFMAN_ONLY), (1, 9, zlib.Z_RLE)
_CLOSELY = (_WIDTHS, _BYTEWISE, _FOURS)
_BEGIN, _END = b"\x78\x01", b"\x03\x00"  # of a zlib stream: its head, and a last block of nothing
BLOCK_CAP = 512 << 20  # what a block may claim: one tile of a thousand inks fits
LEVEL_CAP = LEVEL_LIMIT + 256  # a stroke changes some levels coarser than its own
DIGITS_CAP = PLACE_LIMIT.bit_length() // 4 + 3  # of an address, with its sign
RESIDUAL_CAP = 1 << 22  # |residual| in units of 2^-16: values lie within 16
T = TypeVar("T", bound=tuple[Any, ...])
KINDS: dict[int, Any] = {16: np.int16, 32: np.int32}
_LEVEL = 1
_OTHERS = "rows of a block", "others than its tiles have"
InkOf = Callable[[Any], Instance]  # makes an instance of a key
_CRC = b',"crc":'
_ADDRESS = re.compile("-?[0-9a-f]+")


# ---- writing ----


def grouped(tiles: Iterable[Tile]) -> Iterator[Sequence[Tile]]:
    """Yields the tiles in runs of a pack's size."""
    return _runs(tiles, BYTES, TILES)


def _runs(tiles: Iterable[T], most: int, count: int) -> Iterator[Sequence[T]]:
    """Runs of at most `count` tiles whose data take no more than `most` bytes, if they are several."""
    run: list[T] = []
    size = 0
    for tile in tiles:
        own = tile[1].plain_size
        if run and (len(run) >= count or size + own > most):
            yield run
            run, size = [], 0
        run.append(tile)
        size += own
    if run:
        yield run


def _blocks(tiles: Sequence[Coded]) -> Iterator[Sequence[Coded]]:
    """Yields the tiles in runs of a block's size, each of one level: a block that is damaged costs no coarser one.
    Those that a file holds as a block stay together."""
    for _, found in groupby(tiles, key=lambda tile: tile[0].level):
        level, start, stop = list(found), 0, 0
        while stop < len(level):
            block = block_at(level, stop)
            if block is None:
                stop += 1
                continue
            yield from _runs(level[start:stop], BLOCK, TILES)
            start = stop = stop + block.count
            yield level[start - block.count : start]
        yield from _runs(level[start:], BLOCK, TILES)


def pack(tiles: Sequence[Coded], closely: bool = False) -> bytes:
    """Returns the pack of some tiles: the same tiles in the same order give the same bytes.  `closely`: a ninth
    fewer, for three times the work of deflating."""
    inks: dict[Instance, int] = {}
    lines, blocks = [], []
    bodies: list[bytes | memoryview] = []

    def indices(found: Sequence[Instance]) -> list[int]:
        return [inks.setdefault(ink, len(inks)) for ink in found]

    for key, record, implied in tiles:
        line = [key.level, f"{key.x:x}", f"{key.y:x}", *record.rect, 8 * record.held.itemsize, indices(record.inks)]
        more = [] if implied is None else [indices(implied.inks), list(implied.terms), implied.crc]
        lines.append([*line, *more])
    for run in _blocks(tiles):
        block = block_at(run, 0)
        parts = tilecode.encoded([record.data for _, record, _ in run]) if block is None else []
        bodies.append(_deflated(parts, closely) if block is None else block.stored)
        blocks.append([len(run), sum(map(len, parts)) if block is None else block.plain, len(bodies[-1])])
    head = _with_crc(dumps({"inks": [ink.key for ink in inks], "tiles": lines, "blocks": blocks}).encode())
    return b"".join([_MAGIC, struct.pack("<I", len(head)), head, *bodies])


def _deflated(parts: Sequence[tilecode.Stretch], closely: bool) -> bytes:
    """Returns a zlib stream: the same bytes give the same stream, which of few bytes isal's does not."""
    plain = b"".join(parts)
    few = len(plain) < FEW_BYTES
    if not closely:
        return zlib.compress(plain, _LEVEL) if few else isal_zlib.compress(plain, _LEVEL)
    ways = zip([plain] if few else parts, [_BYTEWISE] if few else [*_CLOSELY, *[_BYTEWISE] * len(parts)], strict=False)
    found = [_begun(part, *way) for part, way in ways if len(part)]
    return b"".join([_BEGIN, *found, _END, struct.pack(">I", isal_zlib.adler32(plain))])


def _begun(plain: tilecode.Stretch, level: int, memory: int, strategy: int) -> bytes:
    """Returns deflated bytes that end with a whole one, so that others may follow in the same stream."""
    stream = zlib.compressobj(level, zlib.DEFLATED, -zlib.MAX_WBITS, memory, strategy)
    return stream.compress(plain) + stream.flush(zlib.Z_SYNC_FLUSH)


def _with_crc(head: bytes) -> bytes:
    """Returns a head that ends with its own CRC-32: of a damaged pack, one can tell whether it is the head."""
    return head[:-1] + b"%s%d}" % (_CRC, isal_zlib.crc32(head))


def _is_proven(data: bytes) -> bool | None:
    """Tells whether the head of a pack is whole; None where it does not say."""
    (length,) = struct.unpack_from("<I", data, 8)
    head, found, told = data[12 : 12 + length].rpartition(_CRC)
    return told == b"%d}" % isal_zlib.crc32(head + b"}") if found else None


# ---- reading ----


@dataclass(frozen=True, slots=True)
class _Format:
    """How blocks of tiles are read: `decoded` as `tilecode.decoded`; the plain bytes of a tile (planes, h, w) of 16 or
    32 bits as the manifest counts them; the most that it can take of a block, None where it takes just as many;
    `places` as `tilecode.places`, None where only decoding tells whether bytes are tiles."""

    decoded: Callable[[np.ndarray, Sequence[np.ndarray]], int]
    size: Callable[[tuple[int, int, int], int], int]
    most: Callable[[tuple[int, int, int], int], int] | None = None
    places: Callable[[np.ndarray, Sequence[tuple[int, int, int]]], np.ndarray | None] | None = None


def _data_size(shape: tuple[int, int, int], bits: int) -> int:
    return shape[0] * shape[1] * shape[2] * bits // 8


_FORMATS = {
    packs_of_format_1.MAGIC: _Format(packs_of_format_1.decoded, packs_of_format_1.encoded_size),
    packs_of_format_2.SECOND: _Format(packs_of_format_2.rows_decoded, _data_size, packs_of_format_2.most),
    _MAGIC: _Format(tilecode.decoded, _data_size, lambda shape, bits: tilecode.most(shape), tilecode.places),
}


def unpack(
    data: bytes, name: str, ink_of: InkOf, announced: tuple[int, int] | None = None, at_once: bool = True
) -> list[Coded]:
    """Returns the tiles of a pack, with nothing pending.  `ink_of` makes an instance of a key and may raise ValueError.

    Unless `at_once`, their data are decoded when they are asked for; the pack is kept for that.
    `announced`: the numbers of tiles and of bytes there must be.  FileError if anything is not as it should be, before
    memory is taken for it; `name` is the file's and the member's.
    """
    try:
        return _unpack(data, ink_of, announced, _block if at_once else _put_off)
    except (FieldError, PackFault, ValueError) as error:
        raise FileError(name, str(error)) from error


@dataclass(frozen=True, slots=True)
class _TileHead:
    """What the head of a pack tells of one tile; `shape` is that of its data."""

    key: TileKey
    rect: Rect
    shape: tuple[int, int, int]
    bits: int
    inks: tuple[Instance, ...]
    implied: Implied | None


def unpack_torn(data: bytes, ink_of: InkOf, announced: tuple[int, int]) -> tuple[list[Coded], list[TileKey]]:
    """Returns the tiles in whole blocks of a damaged pack, and the places of the others; nothing if its head is
    damaged, or may be, since no block is and it does not prove to be whole."""
    tiles: list[Coded] = []
    gone: list[TileKey] = []
    try:
        head = _announced(_head(data, ink_of), announced)
        proven = _is_proven(data)
        for block, run in _by_block(head):
            found = _whole_block(data, block, run, head.form)
            tiles += found or []
            gone += [] if found is not None else [tile.key for tile in run]
    except (FieldError, PackFault, ValueError):
        return [], []
    return (tiles, gone) if proven or (gone and proven is None) else ([], [])


def _whole_block(data: bytes, block: _Block, run: Sequence[_TileHead], form: _Format) -> list[Coded] | None:
    stored = memoryview(data)[block.start : block.stop]
    stream = isal_zlib.decompressobj()
    try:
        size = len(stream.decompress(stored, block.plain + 1))
        # Only a stream that ends where it should has had its checksum compared.
        return list(_block(stored, block.plain, run, form)) if size == block.plain and stream.eof else None
    except (PackFault, isal_zlib.error):  # type: ignore[misc]  # its stub lacks the base class
        return None


def _unpack(data: bytes, ink_of: InkOf, announced: tuple[int, int] | None, read: _Read) -> list[Coded]:
    head = _announced(_head(data, ink_of), announced)
    tiles: list[Coded] = []
    stop = head.start
    for block, run in _by_block(head):
        need(block.stop <= len(data), "stored bytes of a block", block.stop - block.start)
        tiles.extend(read(memoryview(data)[block.start : block.stop], block.plain, run, head.form))
        stop = block.stop
    need(stop == len(data) and len(tiles) == len(head.tiles), "end of a pack", (stop, len(tiles)))
    return tiles


@dataclass(frozen=True, slots=True)
class _Head:
    """The head of a pack: its tiles, what it says of its blocks, and where these begin."""

    form: _Format
    tiles: list[_TileHead]
    blocks: list[Any]
    start: int


@dataclass(frozen=True, slots=True)
class _Block:
    """Where a block lies in a pack, and its plain bytes."""

    start: int
    stop: int
    plain: int


def _head(data: bytes, ink_of: InkOf) -> _Head:
    need(data[:8] in _FORMATS and len(data) >= 12, "start of a pack of tiles", data[:8])
    (length,) = struct.unpack_from("<I", data, 8)
    start = 12 + length
    need(start <= len(data), "length of the head", length)
    head = loads(data[12:start], cap=HEAD_CAP)
    lists = isinstance(head, dict) and all(isinstance(head.get(k), list) for k in ("inks", "tiles", "blocks"))
    need(lists, "head", "")
    inks = [ink_of(key) for key in head["inks"]]
    return _Head(_FORMATS[data[:8]], [_tile_head(line, inks) for line in head["tiles"]], head["blocks"], start)


def _announced(head: _Head, announced: tuple[int, int] | None) -> _Head:
    """Returns a head that tells of so many tiles and bytes; else PackFault."""
    found = len(head.tiles), sum(head.form.size(tile.shape, tile.bits) for tile in head.tiles)
    need(announced is None or found == announced, "tiles and bytes of a pack", found)
    return head


def _by_block(head: _Head) -> Iterator[tuple[_Block, list[_TileHead]]]:
    """Yields the blocks with their tiles, as the head tells them."""
    done, start = 0, head.start
    for block in head.blocks:
        whole = isinstance(block, list) and len(block) == 3 and all(type(v) is int and v >= 0 for v in block)
        need(whole, "block", block)
        count, plain, stored = block
        run = head.tiles[done : done + count]
        size, most = head.form.size, head.form.most
        bound = sum((most or size)(tile.shape, tile.bits) for tile in run)
        need(len(run) == count and plain <= bound <= BLOCK_CAP, "block", block)
        need(most is not None or plain == bound, "block", block)
        yield _Block(start, start + stored, plain), run
        done, start = done + count, start + stored


def _tile_head(line: Any, inks: list[Instance]) -> _TileHead:
    need(isinstance(line, list) and len(line) in (9, 12), "tile", line)
    level, x, y, *corners, bits, indices = line[:9]
    need(type(level) is int and abs(level) <= LEVEL_CAP, "level of a tile", level)
    key = TileKey(level, _address(x), _address(y))
    need(_whole(corners, 0, TILE), "rectangle of a tile", corners)
    rect = Rect(*corners)
    need(not rect.empty, "rectangle of a tile", corners)
    need(type(bits) is int and bits in KINDS, "bits of a tile", bits)
    there = _chosen(indices, inks)
    implied = _implied(line[9:], level, inks) if len(line) == 12 else None
    return _TileHead(key, rect, (COLOURS + 3 * len(there), rect.height, rect.width), bits, there, implied)


def _chosen(indices: Any, inks: list[Instance]) -> tuple[Instance, ...]:
    sound = isinstance(indices, list) and _whole(indices, 0, len(inks) - 1)
    need(sound and len(set(indices)) == len(indices), "inks of a tile", indices)
    return tuple([inks[i] for i in indices])


def _whole(values: list[Any], low: int, high: int) -> bool:
    """Tells whether all are integers within the range: a loop, since a head has thousands of such lists."""
    for value in values:  # noqa: SIM110
        if type(value) is not int or not low <= value <= high:
            return False
    return True


def _implied(entries: list[Any], level: int, inks: list[Instance]) -> Implied:
    indices, terms, crc = entries
    chosen = _chosen(indices, inks)
    need(0 < len(chosen) <= MOST and all(ink.base - level <= ABOVE for ink in chosen), "inks that imply", indices)
    sound = isinstance(terms, list) and len(terms) == 3 * (1 + 2 * len(chosen))
    need(sound and _whole(terms, -TERM_CAP, TERM_CAP), "terms of a tile", terms)
    need(type(crc) is int and 0 <= crc < 1 << 32, "CRC of a tile", crc)
    return Implied(chosen, tuple(terms), crc)


def _address(text: Any) -> int:
    sound = isinstance(text, str) and len(text) <= DIGITS_CAP and _ADDRESS.fullmatch(text) is not None
    need(sound, "address of a tile", text)
    return int(text, 16)


_Read = Callable[[memoryview, int, Sequence[_TileHead], _Format], Iterator[Coded]]


def _block(stored: memoryview, plain: int, run: Sequence[_TileHead], form: _Format) -> Iterator[Coded]:
    for head, data in zip(run, _decoded(stored, plain, run, form), strict=True):
        data.flags.writeable = False
        yield head.key, Record(head.rect, data, head.inks, 0), head.implied


def _put_off(stored: memoryview, plain: int, run: Sequence[_TileHead], form: _Format) -> Iterator[Coded]:
    """As `_block`, but decoded when the data are asked for, if one can tell without that whether they are tiles."""
    if form.places is None:
        yield from _block(stored, plain, run, form)
        return
    need(form.places(_inflated(stored, plain), [head.shape for head in run]) is not None, *_OTHERS)
    kept = np.array([(*head.shape, head.bits) for head in run])
    kept = kept.astype(np.min_scalar_type(int(kept.max(initial=0))))  # there may be millions of tiles
    block = Block(partial(_clipped, plain, kept, form), len(run), plain, stored)
    for number, head in enumerate(run):
        held = Filed(block, number, head.bits)
        yield head.key, Record(head.rect, held, head.inks, 0), head.implied


def _clipped(plain: int, kept: np.ndarray, form: _Format, stored: bytes | memoryview) -> list[np.ndarray]:
    """Returns what a block holds that was checked but for the largest residual, within what may be; `kept`: planes,
    height, width and bits of each tile."""
    tiles = [np.empty(shape, KINDS[bits]) for *shape, bits in kept.tolist()]
    if form.decoded(_inflated(stored, plain), tiles) >= 2 * RESIDUAL_CAP:
        for data in tiles:
            np.clip(data, -RESIDUAL_CAP, RESIDUAL_CAP, out=data)
    return tiles


def _inflated(stored: bytes | memoryview, plain: int) -> np.ndarray:
    raw = np.empty(plain, np.uint8)
    stream = Inflated(iter([bytes(stored)]))
    try:
        filled = stream.readinto(raw.data)
        complete = filled == plain and stream.finish()
    except DeflateError as error:
        raise PackFault(f"block: damaged ({error})") from error
    need(complete, "bytes in a block", filled)
    return raw


def _decoded(stored: memoryview, plain: int, run: Sequence[_TileHead], form: _Format) -> list[np.ndarray]:
    """Returns what a block holds of its tiles."""
    raw = _inflated(stored, plain)
    tiles = [np.empty(head.shape, KINDS[head.bits]) for head in run]
    largest = form.decoded(raw, tiles)
    need(largest >= 0, *_OTHERS)
    need(largest < 2 * RESIDUAL_CAP, "largest residual of a block", largest)
    return tiles
