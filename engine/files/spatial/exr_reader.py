"""Reading OpenEXR (2.0, scan lines, one part) of halves, floats or whole numbers, uncompressed or packed by RLE, ZIPS
or ZIP: what programs for land write.  Every number in it is a claim, compared before memory is spent on it."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from engine.files.fault import FileError
from engine.files.inflate import DeflateError, Inflated
from engine.files.limits import LIMITS, Limits

EXR_MAGIC = b"\x76\x2f\x31\x01"
_KINDS: dict[int, np.dtype[np.generic]] = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}
_NONE, _RLE, _ZIPS, _ZIP = range(4)
_NAMES = ("none", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A", "DWAA", "DWAB")
_ROWS = {_NONE: 1, _RLE: 1, _ZIPS: 1, _ZIP: 16}  # of a block
_NOT_SCAN_LINES = 0x200 | 0x800 | 0x1000  # bits of the version: tiles, no picture, several parts
_LONGEST_NAME, _MOST_ATTRIBUTES = 256, 4096


@dataclass(frozen=True)
class ExrHead:
    """What the head tells: `size` (width, height), the row of the first line, channels in the file's order, and how
    blocks are packed; `table`: where their places stand."""

    size: tuple[int, int]
    top: int
    channels: tuple[tuple[str, np.dtype[np.generic]], ...]
    packing: int
    table: int


def read_exr(data: bytes, name: str, limits: Limits = LIMITS) -> dict[str, np.ndarray]:
    """Returns the channels of a file's bytes by name, each float32 (h, w).  FileError, one line, on any fault."""
    head = read_head(data, name, limits)
    width, height = head.size
    out = {channel: np.empty((height, width), np.float32) for channel, _ in head.channels}
    rows = _ROWS[head.packing]
    at_once = sum(width * kind.itemsize for _, kind in head.channels)
    seen = np.zeros(-(-height // rows), bool)
    for y, packed in _blocks(data, head, len(seen), name):
        number, off = divmod(y - head.top, rows)
        if off or not 0 <= number < len(seen) or seen[number]:
            raise FileError(name, f"a block begins at row {y}, expected each of them once")
        seen[number] = True
        count = min(rows, height - number * rows)
        raw = _unpacked(packed, at_once * count, head.packing, f"block {number}", name)
        _place(raw.reshape(count, at_once), head, number * rows, out)
    return out


def read_head(data: bytes, name: str, limits: Limits = LIMITS) -> ExrHead:
    """Returns what the head tells; FileError if it is not sound, asks for too much, or is of a kind not read here."""
    if data[:4] != EXR_MAGIC or len(data) < 8:
        raise FileError(name, "not an EXR, or it ends after its first bytes")
    (version,) = struct.unpack("<I", data[4:8])
    if version & 0xFF != 2 or version & _NOT_SCAN_LINES:
        raise FileError(name, "an EXR of tiles, of several parts or of depths, expected one of scan lines")
    told, at = _attributes(data, name)
    box = struct.unpack("<4i", _told(told, "dataWindow", 16, name))
    width, height = box[2] - box[0] + 1, box[3] - box[1] + 1
    if not (0 < width <= limits.side and 0 < height <= limits.side and width * height <= limits.pixels):
        raise FileError(
            name, f"{width} x {height} pixels; expected at most {limits.side} each way, {limits.pixels} in all"
        )
    packing = _told(told, "compression", 1, name)[0]
    if packing not in _ROWS:
        found = _NAMES[packing] if packing < len(_NAMES) else str(packing)
        raise FileError(name, f"packed by {found}; expected ZIP, ZIPS, RLE or none")
    return ExrHead((width, height), box[1], tuple(_channels(told.get("channels", b""), name)), packing, at)


def _attributes(data: bytes, name: str) -> tuple[dict[str, bytes], int]:
    """Returns attributes by their names, and where they end."""
    out: dict[str, bytes] = {}
    at = 8
    for _ in range(_MOST_ATTRIBUTES):
        called, at = _text(data, at, name)
        if not called:
            return out, at
        _, at = _text(data, at, name)
        length = int.from_bytes(data[at : at + 4], "little")
        out[called] = data[at + 4 : at + 4 + length]
        at += 4 + length
        if at > len(data):
            break
    raise FileError(name, "its head has no end")


def _text(data: bytes, at: int, name: str) -> tuple[str, int]:
    end = data.find(b"\0", at, at + _LONGEST_NAME)
    if end < 0:
        raise FileError(name, f"found no name at byte {at} of its head")
    return data[at:end].decode("utf-8", "replace"), end + 1


def _told(told: dict[str, bytes], attribute: str, length: int, name: str) -> bytes:
    value = told.get(attribute, b"")
    if len(value) != length:
        raise FileError(name, f"found {len(value)} bytes of {attribute}, expected {length}")
    return value


def _channels(value: bytes, name: str) -> Iterator[tuple[str, np.dtype[np.generic]]]:
    at, before = 0, ""
    while value[at : at + 1] not in (b"", b"\0"):
        called, at = _text(value, at, name)
        if len(value) < at + 16:
            raise FileError(name, f"channel {called!a}: its description is cut off")
        kind, across, down = struct.unpack("<I4xII", value[at : at + 16])
        found = _KINDS.get(kind)
        if found is None or (across, down) != (1, 1):
            raise FileError(name, f"channel {called!a}: of another kind, or not of all pixels")
        if before and called <= before:
            raise FileError(name, "its channels are not in order")
        yield called, found
        at, before = at + 16, called
    if not before:
        raise FileError(name, "it has no channels")


def _blocks(data: bytes, head: ExrHead, count: int, name: str) -> Iterator[tuple[int, bytes]]:
    """Yields the first row of each block, and its bytes."""
    end = head.table + 8 * count
    if end > len(data):
        raise FileError(name, f"ends at byte {len(data)}, within the list of its blocks")
    for place in struct.unpack(f"<{count}Q", data[head.table : end]):
        if not end <= place <= len(data) - 8:
            raise FileError(name, f"a block lies at byte {place}, beyond the end of the file")
        y, length = struct.unpack("<iI", data[place : place + 8])
        if place + 8 + length > len(data):
            raise FileError(name, f"the block of row {y} is cut off")
        yield y, data[place + 8 : place + 8 + length]


def _unpacked(packed: bytes, length: int, packing: int, where: str, name: str) -> np.ndarray:
    """Returns the bytes of a block: uint8 (length,).  One that packing would not have made shorter is stored as it
    is."""
    if packing == _NONE or len(packed) == length:
        raw = np.frombuffer(packed, np.uint8)
    else:
        split = np.frombuffer(_run_out(packed, length) if packing == _RLE else _inflated(packed, length), np.uint8)
        raw = np.empty(len(split), np.uint8)
        ahead = split + np.uint8(128)
        ahead[:1] = split[:1]
        np.cumsum(ahead, dtype=np.uint8, out=ahead)
        half = (len(split) + 1) // 2
        raw[0::2], raw[1::2] = ahead[:half], ahead[half:]
    if len(raw) != length:
        raise FileError(name, f"{where}: found {len(raw)} bytes of pixels, expected {length}")
    return raw


def _inflated(packed: bytes, length: int) -> bytes:
    out = bytearray(length)
    try:
        filled = Inflated(iter([packed])).readinto(memoryview(out))
    except DeflateError:
        return b""
    return bytes(out[:filled])


def _run_out(packed: bytes, length: int) -> bytes:
    """Undoes RLE: a count below 0 for as many bytes as they are, else one byte count + 1 times."""
    out, at = bytearray(), 0
    while at < len(packed) and len(out) <= length:
        count = packed[at] - 256 if packed[at] > 127 else packed[at]
        if count < 0:
            out += packed[at + 1 : at + 1 - count]
            at += 1 - count
        else:
            out += packed[at + 1 : at + 2] * (count + 1)
            at += 2
    return bytes(out)


def _place(raw: np.ndarray, head: ExrHead, top: int, out: dict[str, np.ndarray]) -> None:
    """Writes rows of a block, uint8 (rows, bytes), into the channels."""
    at, width = 0, head.size[0]
    for channel, kind in head.channels:
        part = np.ascontiguousarray(raw[:, at : at + width * kind.itemsize])
        out[channel][top : top + len(raw)] = part.view(kind)
        at += width * kind.itemsize
