"""Frames: how records lie in a journal's file, so that whatever is torn or damaged ends what is read, and no more.

A frame is a check sum (CRC-32 of all that follows), the payload's length, a number that rises by one from frame to
frame, the record's kind, and the payload; little-endian.
"""

from __future__ import annotations

import struct
import zlib
from typing import NamedTuple

_PREFIX = struct.Struct("<IIQB")
_SUM = 4  # bytes of the check sum
PREFIX_BYTES = _PREFIX.size
PAYLOAD_CAP = 1 << 28  # bytes


class Frame(NamedTuple):
    """One whole frame: `sequence` rises by one from frame to frame, `kind` tells what `payload` is."""

    sequence: int
    kind: int
    payload: bytes


def framed(frame: Frame) -> bytes:
    """Returns the bytes of a frame; ValueError if its payload is too long."""
    if len(frame.payload) > PAYLOAD_CAP:
        raise ValueError(f"frame: found {len(frame.payload)} bytes, expected at most {PAYLOAD_CAP}")
    prefix = _PREFIX.pack(0, len(frame.payload), frame.sequence, frame.kind)[_SUM:]
    total = zlib.crc32(frame.payload, zlib.crc32(prefix))
    return total.to_bytes(_SUM, "little") + prefix + frame.payload


def frames_in(data: bytes) -> tuple[list[Frame], int]:
    """Returns the whole frames that `data` begins with, and how many bytes they take.

    It never fails: the first frame that is cut short, damaged, or not the next in sequence ends them.
    """
    view, found, at = memoryview(data), list[Frame](), 0
    expected: int | None = None
    while at + PREFIX_BYTES <= len(view):
        total, length, sequence, kind = _PREFIX.unpack_from(view, at)
        end = at + PREFIX_BYTES + length
        if length > PAYLOAD_CAP or end > len(view) or sequence != (sequence if expected is None else expected):
            break
        if zlib.crc32(view[at + _SUM : end]) != total:
            break
        found.append(Frame(sequence, kind, bytes(view[at + PREFIX_BYTES : end])))
        at, expected = end, sequence + 1
    return found, at
