"""Brushes of Photoshop, `.abr`: of versions 1 and 2, one record a brush; from 6 on, tips in one block, and in another
what is painted with them.

After "Adobe Photoshop File Formats Specification" and the layout of later versions as their readers have it.
"""

from __future__ import annotations

import numpy as np

from engine.files.big_endian import BigEndian
from engine.files.brushes.descriptor import descriptor
from engine.files.brushes.found_brush import (
    ALL_PIXELS,
    LONGEST_TIP,
    MOST_BRUSHES,
    TIP_PIXELS,
    FoundBrush,
    FoundBrushes,
    called,
    encircled,
    radius_of,
    spacing_of,
    stamp_settings,
)
from engine.files.brushes.photoshop_settings import SampledTip, painted_with
from engine.files.fault import FileError

_COMPUTED, _SAMPLED = 1, 2
_BLOCKS = (6, 7, 9, 10)  # versions whose files consist of blocks
_TIP = "a tip"
_RAW, _PACKED = 0, 1
_CHANNELS = 1024  # of a tip, at most


def read_abr(data: bytes, file: str) -> FoundBrushes:
    """Returns the brushes of a file, without those that cannot be read, which are told of; FileError if there is no
    other."""
    reader = BigEndian(data, file)
    version, count = reader.number("H", "its version"), reader.number("H", "its version")
    if version in (1, 2):
        found = _records(reader, file, version, count)
    elif version in _BLOCKS:
        found = _blocks(reader, file, count)
    else:
        raise FileError(file, f"byte 0: found version {version}, expected 1, 2, 6, 7, 9 or 10")
    if not found.brushes:
        raise FileError(file, found.left[0] if found.left else "found no brush in it")
    return found


def _records(reader: BigEndian, file: str, version: int, count: int) -> FoundBrushes:
    found = FoundBrushes()
    if count > MOST_BRUSHES:
        raise reader.fault(f"found {count} brushes, expected at most {MOST_BRUSHES}")
    for number in range(1, count + 1):
        try:
            kind, size = reader.number("H", "a brush"), reader.number("I", "a brush")
            record = reader.part(size, "a brush")
        except FileError as error:
            _lost(found, f"brushes {number} to {count}", error)
            break
        try:
            if kind == _COMPUTED:
                found.brushes.append(_computed(record, called("", file, number)))
            elif kind == _SAMPLED:
                found.brushes.append(_sampled(record, file, version, number))
            else:
                raise record.fault(f"found a brush of kind {kind}, expected 1 or 2")
        except FileError as error:
            _lost(found, f"brush {number}", error)
    return found


def _lost(found: FoundBrushes, what: str, error: FileError) -> None:
    found.left.append(f"{what} ({error.message})")


def _computed(record: BigEndian, name: str) -> FoundBrush:
    """Returns a round brush, told by numbers alone."""
    record.take("I", "a brush")
    spacing, diameter, roundness, angle, hardness = record.take("HHHhH", "a brush")
    settings = {
        "radius": radius_of(float(diameter) / 2.0),
        "spacing": spacing_of(float(spacing) / 50.0),
        "hardness": min(float(hardness), 100.0) / 100.0,
        "shape": {"ratio": min(max(float(roundness) / 100.0, 0.01), 1.0), "angle": -float(angle) % 360.0},
    }
    return FoundBrush(name, settings)


def _sampled(record: BigEndian, file: str, version: int, number: int) -> FoundBrush:
    record.take("I", "a brush")
    spacing = record.number("H", "a brush")
    name = record.text(record.number("I", "a name"), "a name") if version == 2 else ""
    record.take("B4h", "a brush")  # whether it is smooth, and the tip's sides once more
    pixels = _pixels(record, [int(v) for v in record.take("4i", _TIP)])
    tip = encircled(pixels)
    if tip is None:
        raise record.fault("found a tip that covers nothing")
    settings = stamp_settings(tip, 1.0, min(spacing, 1000) / 100.0 * max(pixels.shape))
    return FoundBrush(called(name, file, number), settings, tip[0])


def _pixels(reader: BigEndian, sides: list[int]) -> np.ndarray:
    """Returns the pixels that follow, uint8 (h, w); `sides`: top, left, bottom, right."""
    height, width = sides[2] - sides[0], sides[3] - sides[1]
    if not (0 < height <= LONGEST_TIP and 0 < width <= LONGEST_TIP and height * width <= TIP_PIXELS):
        raise reader.fault(f"found a tip of {width} x {height} pixels, expected 1 to {LONGEST_TIP} along a side")
    depth, packed = reader.number("H", _TIP), reader.number("B", _TIP)
    if depth not in (8, 16) or packed not in (_RAW, _PACKED):
        raise reader.fault(f"found a tip of {depth} bits, packed in way {packed}, expected 8 or 16 bits, 0 or 1")
    row = width * depth // 8
    body = _unpacked(reader, height, row) if packed == _PACKED else reader.raw(height * row, _TIP)
    samples = np.frombuffer(body, np.uint8).reshape(height, width, depth // 8)
    return np.ascontiguousarray(samples[..., 0])  # the higher byte


def _unpacked(reader: BigEndian, height: int, row: int) -> bytes:
    """Returns rows packed by PackBits, after the lengths of all of them."""
    lengths = [int(n) for n in reader.take(f"{height}H", _TIP)]
    out = bytearray()
    for number, length in enumerate(lengths):
        packed, at, begun = reader.raw(length, f"row {number} of a tip"), 0, len(out)
        while at < length and len(out) - begun < row:
            head = packed[at]
            if head < 128:
                out += packed[at + 1 : at + 2 + head]
                at += 2 + head
            else:
                out += packed[at + 1 : at + 2] * (257 - head if head > 128 else 0)
                at += 2 if head > 128 else 1
        if len(out) - begun != row:
            raise reader.fault(f"found {len(out) - begun} bytes in row {number} of a tip, expected {row}")
    return bytes(out)


def _blocks(reader: BigEndian, file: str, minor: int) -> FoundBrushes:
    if minor not in (1, 2):
        raise reader.fault(f"found its tips in form {minor}, expected 1 or 2")
    found, tips, told = FoundBrushes(), dict[str, SampledTip](), list[object]()
    while reader.left >= 12:
        mark, kind = reader.raw(4, "a block"), reader.raw(4, "a block")
        if mark != b"8BIM":
            raise reader.fault("found no block 8BIM")
        size = reader.number("I", "a block")
        if size > reader.left:
            found.left.append(f"its last {size - reader.left} bytes, which are missing")
        block = reader.part(min(size, reader.left), "a block")
        reader.raw(min(-size % 4, reader.left), "a block")
        if kind == b"samp":
            _gather(block, minor, tips, found)
        elif kind == b"desc":
            try:
                block.take("I", "the settings of its brushes")
                listed = descriptor(block).get("Brsh", [])
                told += listed if isinstance(listed, list) else []
            except FileError as error:
                _lost(found, "the settings of its brushes", error)
    painted_with(tips, told, file, found)
    return found


def _gather(block: BigEndian, minor: int, tips: dict[str, SampledTip], found: FoundBrushes) -> None:
    """Adds the tips of a block by what they are called in the other one."""
    pixels_read = 0
    while block.left >= 4:
        if len(tips) >= MOST_BRUSHES or pixels_read > ALL_PIXELS:
            found.left.append(f"all but {len(tips)} tips")
            return
        try:
            size = block.number("I", _TIP)
            item = block.part(size, _TIP)
        except FileError as error:
            _lost(found, "the tips after the first " + str(len(tips)), error)
            return
        block.raw(min(-size % 4, block.left), _TIP)
        try:
            name = item.raw(item.number("B", _TIP), _TIP).decode("latin-1")
            pixels = _first_channel(item) if minor == 2 else _after(item, 10)
            pixels_read += pixels.size
            tip = encircled(pixels)
            if tip is None:
                raise item.fault("found a tip that covers nothing")
            tips[name] = SampledTip(*tip, max(pixels.shape))
        except FileError as error:
            _lost(found, f"tip {len(tips) + 1}", error)


def _after(item: BigEndian, count: int) -> np.ndarray:
    item.raw(count, _TIP)
    return _pixels(item, [int(v) for v in item.take("4i", _TIP)])


def _first_channel(item: BigEndian) -> np.ndarray:
    """Returns the first channel that is there, of a list of many."""
    item.take("2H2I4I", _TIP)
    channels = item.number("I", _TIP)
    if channels > _CHANNELS:
        raise item.fault(f"found a tip of {channels} channels, expected at most {_CHANNELS}")
    for _ in range(channels + 2):
        if item.number("I", _TIP):
            item.take("2I", _TIP)  # its length, its depth
            return _pixels(item, [int(v) for v in item.take("4i", _TIP)])
    raise item.fault("found a tip without pixels")
