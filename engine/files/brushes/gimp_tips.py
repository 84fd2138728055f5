"""Tips of GIMP: `.gbr`, one picture, and `.gih`, several of them in turn.

After GIMP's "devel-docs/gbr.txt" and "gih.txt": big-endian heads, names in UTF-8, one byte of coverage a pixel or four
of a colour and its alpha.
"""

from __future__ import annotations

import re

import numpy as np

from engine.files.big_endian import BigEndian
from engine.files.brushes.found_brush import (
    LONGEST_TIP,
    TIP_PIXELS,
    FoundBrush,
    FoundBrushes,
    called,
    encircled,
    stamp_settings,
)
from engine.files.fault import shown

_HEADS = {1: 20, 2: 28}  # bytes of a head without the name, by version
_MAGIC = b"GIMP"
_NAME_BYTES = 4096
_USUAL_SPACING, _MOST_SPACING = 20, 1000  # percent of the width
_CELLS = re.compile(rb"\s*(\d{1,6})\b")
_HEAD_LINE = 4096  # bytes of a line at the beginning of a .gih


def read_gbr(data: bytes, file: str) -> FoundBrushes:
    """Returns the brush whose tip a file holds."""
    reader = BigEndian(data, file)
    name, brush = _tip(reader, file)
    left = ("what follows its tip",) if reader.left and not _is_pattern(reader) else ()
    return FoundBrushes([_named(brush, called(name, file), left)])


def read_gih(data: bytes, file: str) -> FoundBrushes:
    """Returns the brush whose first tip is that of a file of several."""
    reader = BigEndian(data, file)
    name = _line(reader, "its name").decode("utf-8", "replace")
    told = _line(reader, "the number of its tips")
    count = _CELLS.match(told)
    if count is None or int(count[1]) < 1:
        raise reader.fault(f"line 2: found {shown(told)}, expected the number of its tips")
    _, brush = _tip(reader, file)
    left = (f"{int(count[1]) - 1} of its {int(count[1])} tips",) if int(count[1]) > 1 else ()
    return FoundBrushes([_named(brush, called(name, file), left)])


def _named(brush: FoundBrush, name: str, left: tuple[str, ...]) -> FoundBrush:
    return FoundBrush(name, brush.settings, brush.tip, (*brush.left, *left))


def _line(reader: BigEndian, what: str) -> bytes:
    out = bytearray()
    while (byte := reader.raw(1, what)) != b"\n":
        out += byte
        if len(out) > _HEAD_LINE:
            raise reader.fault(f"found no end of the line that tells {what}")
    return bytes(out)


def _is_pattern(reader: BigEndian) -> bool:
    """Tells whether a pattern follows, which older files hold the colours of the tip in."""
    return reader.left > 24 and reader.raw(24, "a pattern")[20:] == b"GPAT"


def _tip(reader: BigEndian, file: str) -> tuple[str, FoundBrush]:
    """Returns the name and the brush of the tip that follows."""
    size, version, width, height, channels = (int(n) for n in reader.take("5I", "the head of a tip"))
    if version not in _HEADS:
        raise reader.fault(f"found version {version} of a tip, expected 1 or 2")
    spacing: int | float | bytes = _USUAL_SPACING
    if version == 2:
        magic, spacing = reader.take("4sI", "the head of a tip")
        if magic != _MAGIC:
            raise reader.fault(f"found {shown(magic)} in the head of a tip, expected 'GIMP'")
    if not 0 <= size - _HEADS[version] <= _NAME_BYTES:
        raise reader.fault(f"found a head of {size} bytes, expected {_HEADS[version]} and a name")
    name = reader.raw(size - _HEADS[version], "the name of a tip").split(b"\0")[0].decode("utf-8", "replace")
    if not (0 < width <= LONGEST_TIP and 0 < height <= LONGEST_TIP and width * height <= TIP_PIXELS):
        raise reader.fault(f"found a tip of {width} x {height} pixels, expected 1 to {LONGEST_TIP} along a side")
    if channels not in (1, 4):
        raise reader.fault(f"found {channels} bytes a pixel, expected 1 or 4")
    body = reader.raw(width * height * channels, "the pixels of a tip")
    pixels = np.frombuffer(body, np.uint8).reshape(height, width, channels)
    tip = encircled(pixels[..., -1])
    if tip is None:
        raise reader.fault("found a tip that covers nothing")
    settings = stamp_settings(tip, 1.0, min(int(spacing), _MOST_SPACING) / 100.0 * max(width, height))
    left = ("its tip's own colours",) if channels == 4 and (pixels[..., :3] != pixels[0, 0, :3]).any() else ()
    return name, FoundBrush(name or file, settings, tip[0], left)
