"""Writing a ZIP archive (APPNOTE 6.3): members that are already small, stored; text, deflated; ZIP64 where needed.

The same members give the same bytes: no times, no places of origin.
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import BinaryIO

from isal import igzip_lib, isal_zlib

from engine.files.zip_reader import DEFLATED, END, END64, END64_PLACE, ENTRY, FULL16, FULL32, LOCAL, STORED

DATE = (1 << 5) | 1  # 1 January 1980, as MS-DOS has it
_WIDE = 20  # bytes of the local ZIP64 field


@dataclass(frozen=True)
class Written:
    """A member as it was written: its plain bytes' size, CRC-32 and SHA-256."""

    name: str
    size: int
    sha256: str
    crc: int
    method: int
    stored: int
    offset: int


class MemberSink:
    """Takes the bytes of one stored member."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self.size = 0
        self.crc = 0
        self.sha256 = hashlib.sha256()

    def write(self, data: bytes) -> int:
        """Writes all of `data` and reckons it into size, CRC and hash; returns how many bytes it has."""
        self._file.write(data)
        self.size += len(data)
        self.crc = isal_zlib.crc32(data, self.crc)
        self.sha256.update(data)
        return len(data)


class ZipWriter:
    """Members are added one after another; `close` writes the directory.  `file` must be seekable."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self.written: dict[str, Written] = {}

    def add(self, name: str, data: bytes, deflate: bool = False) -> Written:
        """Returns a whole member; deflated only if that makes it smaller."""
        body, method = data, STORED
        if deflate:
            packed = igzip_lib.compress(data, 3, igzip_lib.COMP_DEFLATE)
            body, method = (packed, DEFLATED) if len(packed) < len(data) else (data, STORED)
        offset = self._begin(name)
        entry = Written(
            name, len(data), hashlib.sha256(data).hexdigest(), isal_zlib.crc32(data), method, len(body), offset
        )
        self._file.write(self._local(entry, wide=len(data) >= FULL32))
        self._file.write(body)
        self.written[name] = entry
        return entry

    @contextmanager
    def stored(self, name: str, most: int) -> Iterator[MemberSink]:
        """Yields a member written bit by bit, at most `most` bytes, as they are."""
        offset = self._begin(name)
        wide = most >= FULL32
        blank = Written(name, 0, "", 0, STORED, 0, offset)
        self._file.write(self._local(blank, wide))
        sink = MemberSink(self._file)
        yield sink
        if sink.size >= FULL32 and not wide:
            raise ValueError(f"member {name}: {sink.size} bytes, {most} were announced")
        entry = Written(name, sink.size, sink.sha256.hexdigest(), sink.crc, STORED, sink.size, offset)
        end = self._file.tell()
        self._file.seek(offset)
        self._file.write(self._local(entry, wide))
        self._file.seek(end)
        self.written[name] = entry

    def reserve(self, name: str, size: int) -> None:
        """Leaves room for a member of `size` bytes that is made later: `fill` stores it there."""
        entry = Written(name, size, "", 0, STORED, size, self._begin(name))
        self._file.write(self._local(entry, wide=size >= FULL32))
        self._file.write(bytes(size))
        self.written[name] = entry

    def fill(self, name: str, data: bytes) -> None:
        """Stores the bytes of a member for which just as much room was left; ValueError if there are others."""
        entry = self.written[name]
        if len(data) != entry.size:
            raise ValueError(f"member {name}: {len(data)} bytes, room was left for {entry.size}")
        entry = replace(entry, sha256=hashlib.sha256(data).hexdigest(), crc=isal_zlib.crc32(data))
        end = self._file.tell()
        self._file.seek(entry.offset)
        self._file.write(self._local(entry, wide=entry.size >= FULL32))
        self._file.write(data)
        self._file.seek(end)
        self.written[name] = entry

    def close(self) -> None:
        """Writes the directory and the end records."""
        start = self._file.tell()
        for entry in self.written.values():
            self._file.write(self._entry(entry))
        stop = self._file.tell()
        count, size = len(self.written), stop - start
        if count >= FULL16 or start >= FULL32 or size >= FULL32:
            self._file.write(END64.pack(b"PK\6\6", END64.size - 12, 45, 45, 0, 0, count, count, size, start))
            self._file.write(END64_PLACE.pack(b"PK\6\7", 0, stop, 1))
        short = min(count, FULL16)
        self._file.write(END.pack(b"PK\5\6", 0, 0, short, short, min(size, FULL32), min(start, FULL32), 0))

    def _begin(self, name: str) -> int:
        if name in self.written or not name.isascii():
            raise ValueError(f"member {name!r}: a second one, or not ASCII")
        return self._file.tell()

    @staticmethod
    def _local(entry: Written, wide: bool) -> bytes:
        name = entry.name.encode()
        extra = struct.pack("<2H2Q", 1, 16, entry.size, entry.stored) if wide else b""
        sizes = (FULL32, FULL32) if wide else (entry.stored, entry.size)
        version = 45 if wide else 20
        head = LOCAL.pack(
            b"PK\3\4", version, 0, entry.method, 0, DATE, entry.crc, *sizes, len(name), len(extra)
        )  # fmt: skip
        return head + name + extra

    @staticmethod
    def _entry(entry: Written) -> bytes:
        name = entry.name.encode()
        wide = b"".join(struct.pack("<Q", v) for v in (entry.size, entry.stored, entry.offset) if v >= FULL32)
        extra = struct.pack("<2H", 1, len(wide)) + wide if wide else b""
        size, stored, offset = (min(v, FULL32) for v in (entry.size, entry.stored, entry.offset))
        version = 45 if wide else 20
        return (
            ENTRY.pack(
                b"PK\1\2", version, version, 0, entry.method, 0, DATE, entry.crc, stored, size,
                len(name), len(extra), 0, 0, 0, 0, offset,
            )
            + name
            + extra
        )  # fmt: skip
