"""Writing OpenEXR (2.0, scan lines) of 32-bit floats, in constant memory: never halves, which err by half a metre in a
kilometre.  Compression ZIP: sixteen rows at a time, bytes split by significance, differences, deflate."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import BinaryIO

import numpy as np
from isal import isal_zlib

_MAGIC, _SCAN_LINES = 20000630, 2
_FLOAT, _ZIP = 2, b"\x03"
_ROWS = 16  # of a compressed block, as the format says
_LEVEL = 2


def write_exr(
    file: BinaryIO,
    size: tuple[int, int],
    channels: Sequence[str],
    strips: Iterable[np.ndarray],
    attributes: Mapping[str, float | str] | None = None,
) -> None:
    """Writes a picture of `size` (width, height) from strips of its rows: (n, width, channels), kept as float32.

    `file` can seek.  `channels`: their names, in the order of the strips; `attributes` go into the header.  ValueError
    if the strips do not add up to the height.
    """
    width, height = size
    order = sorted(range(len(channels)), key=lambda i: channels[i])
    file.write(_header(size, sorted(channels), attributes or {}))
    table, offsets, y = file.tell(), [], 0
    count = -(-height // _ROWS)
    file.write(bytes(8 * count))
    for block in _blocks(strips, (height, width, len(channels))):
        lines = block[:, :, order].transpose(0, 2, 1)
        raw = np.ascontiguousarray(lines, "<f4").tobytes()
        packed = _zipped(raw)
        offsets.append(file.tell())
        file.write(struct.pack("<iI", y, len(packed)) + packed)
        y += len(block)
    end = file.tell()
    file.seek(table)
    file.write(struct.pack(f"<{count}Q", *offsets))
    file.seek(end)


def _header(size: tuple[int, int], names: Sequence[str], attributes: Mapping[str, float | str]) -> bytes:
    width, height = size
    channels = b"".join(name.encode() + b"\0" + struct.pack("<IB3xII", _FLOAT, 0, 1, 1) for name in names) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    parts = [
        struct.pack("<II", _MAGIC, _SCAN_LINES),
        _attribute("channels", "chlist", channels),
        _attribute("compression", "compression", _ZIP),
        _attribute("dataWindow", "box2i", window),
        _attribute("displayWindow", "box2i", window),
        _attribute("lineOrder", "lineOrder", b"\0"),
        _attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        _attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0)),
        _attribute("screenWindowWidth", "float", struct.pack("<f", 1.0)),
    ]
    for name, value in attributes.items():
        if isinstance(value, str):
            parts.append(_attribute(name, "string", value.encode()))
        else:
            parts.append(_attribute(name, "float", struct.pack("<f", value)))
    return b"".join(parts) + b"\0"


def _attribute(name: str, kind: str, value: bytes) -> bytes:
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value


def _zipped(raw: bytes) -> bytes:
    """Returns a block as stored: as it is where that is not longer."""
    plain = np.frombuffer(raw, np.uint8)
    split = np.concatenate([plain[0::2], plain[1::2]])
    ahead = split.copy()
    ahead[1:] -= split[:-1] + np.uint8(128)
    packed: bytes = isal_zlib.compress(ahead.tobytes(), _LEVEL)
    return packed if len(packed) < len(raw) else raw


def _blocks(strips: Iterable[np.ndarray], shape: tuple[int, int, int]) -> Iterator[np.ndarray]:
    """Yields the rows in groups of exactly sixteen, the last may be fewer."""
    left: np.ndarray | None = None
    done = 0
    for strip in strips:
        if strip.shape[1:] != shape[1:] or done + len(strip) > shape[0]:
            raise ValueError(f"rows {strip.shape} after {done} of {shape}")
        done += len(strip)
        rows = strip if left is None else np.concatenate([left, strip])
        whole = len(rows) // _ROWS * _ROWS
        for y in range(0, whole, _ROWS):
            yield rows[y : y + _ROWS]
        left = rows[whole:].copy()
    if done != shape[0]:
        raise ValueError(f"EXR ended with {shape[0] - done} of {shape[0]} rows missing")
    if left is not None and len(left):
        yield left
