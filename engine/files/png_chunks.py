"""The chunks of a PNG (ISO/IEC 15948, section 5), their sizes and checksums."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import BinaryIO

from isal import isal_zlib

from engine.files.fault import FileError, shown
from engine.files.inflate import PIECE
from engine.files.limits import Limits


class Chunks:
    """A PNG being read chunk by chunk.  `file` needs only `read`; `name` stands in the messages."""

    def __init__(self, file: BinaryIO, name: str, limits: Limits) -> None:
        self._file = file
        self._name = name
        self._limits = limits
        self._count = 0

    def fail(self, message: str) -> FileError:
        """Makes the error that names the file."""
        return FileError(self._name, message)

    def exactly(self, count: int, place: str) -> bytes:
        """Returns the next `count` bytes, which must be there."""
        data = self._file.read(count)
        if len(data) != count:
            raise self.fail(f"the file ends inside {place}; found {len(data)} bytes, expected {count}")
        return data

    def head(self) -> tuple[bytes, int]:
        """Returns the kind and length of the next chunk."""
        self._count += 1
        if self._count > self._limits.chunks:
            raise self.fail(f"more than {self._limits.chunks} chunks")
        length, kind = struct.unpack(">I4s", self.exactly(8, "the head of a chunk"))
        if not kind.isalpha() or length >= 1 << 31:
            raise self.fail(f"chunk {self._count}: found type {shown(kind)}, length {length}; expected four letters")
        return kind, length

    def body(self, kind: bytes, length: int) -> bytes:
        """Returns what a chunk holds, its checksum compared."""
        if length > self._limits.chunk:
            raise self.fail(f"chunk {kind.decode()}: found {length} bytes, expected at most {self._limits.chunk}")
        data = self.exactly(length, f"chunk {kind.decode()}")
        self._check(kind, isal_zlib.crc32(data, isal_zlib.crc32(kind)))
        return data

    def skip(self, kind: bytes, length: int) -> None:
        """Passes over what is left of a chunk, `length` bytes and the checksum."""
        left = length + 4
        while left:
            left -= len(self.exactly(min(left, PIECE), f"chunk {kind.decode()}"))

    def data(self, length: int) -> Iterator[bytes]:
        """Yields what the IDAT chunks hold, from inside the first, whose `length` is known, to the end of the file.

        The checksum of each is compared as it ends.
        """
        kind = b"IDAT"
        while kind == b"IDAT":
            check = isal_zlib.crc32(kind)
            while length:
                piece = self.exactly(min(length, PIECE), "chunk IDAT")
                check = isal_zlib.crc32(piece, check)
                length -= len(piece)
                yield piece
            self._check(kind, check)
            kind, length = self.head()
        while kind != b"IEND":
            self.skip(kind, length)
            kind, length = self.head()
        self.body(kind, length)

    def _check(self, kind: bytes, found: int) -> None:
        (expected,) = struct.unpack(">I", self.exactly(4, f"the checksum of chunk {kind.decode()}"))
        if found != expected:
            raise self.fail(f"chunk {kind.decode()}: checksum found {found:08x}, expected {expected:08x}")
