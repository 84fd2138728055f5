"""Reading a ZIP archive of a stranger (APPNOTE 6.3): the directory is checked whole before any member is believed.

Nothing is ever extracted to disk.  The number of members is read from the end record before the directory is; no two
members may share a name or a byte; a member gives exactly the bytes that the directory promises, or FileError.
"""

from __future__ import annotations

import io
import stat
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, BinaryIO

from isal import isal_zlib

from engine.files.fault import FileError, TooMuch, shown
from engine.files.inflate import PIECE, RAW, DeflateError, Inflated
from engine.files.limits import LIMITS, Limits

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer

STORED, DEFLATED = 0, 8
END = struct.Struct("<4s4H2LH")
END64_PLACE = struct.Struct("<4sLQL")
END64 = struct.Struct("<4sQ2H2L4Q")
ENTRY = struct.Struct("<4s6H3L5H2L")
LOCAL = struct.Struct("<4s5H3L2H")
ENCRYPTED = 0x2041  # bits 0, 6 and 13 of the flags
DESCRIPTOR = 0x8  # bit 3: checksum and sizes follow the bytes
UTF8 = 0x800
FULL16, FULL32 = 0xFFFF, 0xFFFFFFFF


@dataclass(frozen=True)
class Member:
    """One entry of the directory; sizes in bytes."""

    name: str
    raw_name: bytes
    method: int
    flags: int
    crc: int
    stored: int
    size: int
    offset: int  # of its local header


class ZipArchive:
    """The members of an archive, by name.  `file` must be seekable; `name` stands in the messages."""

    def __init__(self, file: BinaryIO, name: str, limits: Limits = LIMITS) -> None:
        self._measure(file, name, limits)
        count, size, self._directory = self._end_record()
        self.members: Mapping[str, Member] = MappingProxyType(self._read_directory(count, size))
        self._check_overlap()

    def _measure(self, file: BinaryIO, name: str, limits: Limits) -> None:
        self._file = file
        self.name = name
        self._limits = limits
        self._size = file.seek(0, io.SEEK_END)
        if self._size > limits.file:
            raise TooMuch(name, f"{self._size} bytes; expected at most {limits.file}")

    # ---- the directory ----

    def _at(self, offset: int, count: int, what: str) -> bytes:
        if offset < 0 or offset + count > self._size:
            raise FileError(self.name, f"{what} lies outside the file of {self._size} bytes")
        self._file.seek(offset)
        data = self._file.read(count)
        if len(data) != count:
            raise FileError(self.name, f"{what}: the file ends inside it")
        return data

    def _end_record(self) -> tuple[int, int, int]:
        """(number of members, bytes of the directory, its offset)."""
        start = max(0, self._size - END.size - FULL16)
        tail = self._at(start, self._size - start, "the end record")
        place = len(tail)
        while True:
            place = tail.rfind(b"PK\5\6", 0, place)
            if place < 0:
                raise FileError(self.name, "not a ZIP archive, or cut short: no end record")
            if place + END.size <= len(tail):
                fields = END.unpack_from(tail, place)
                if place + END.size + fields[7] == len(tail):
                    break
        _, disk, first_disk, here, count, size, offset, _ = fields
        at = start + place
        if FULL16 in (here, count) or FULL32 in (size, offset):
            disk, first_disk, here, count, size, offset, at = self._end_record_64(at, fields)
        if disk or first_disk or here != count:
            raise FileError(self.name, "an archive of several parts; expected one")
        if count > self._limits.entries:
            raise FileError(self.name, f"{count} members; expected at most {self._limits.entries}")
        if size > self._limits.directory or offset + size != at:
            raise FileError(self.name, f"directory of {size} bytes at {offset}; expected it to end at {at}")
        return count, size, offset

    def _end_record_64(self, at: int, fields: tuple[int, ...]) -> tuple[int, ...]:
        if at < END64_PLACE.size + END64.size:
            return (*fields[1:7], at)  # no room for one: the numbers mean themselves
        mark, disk, place, disks = END64_PLACE.unpack(self._at(at - END64_PLACE.size, END64_PLACE.size, "ZIP64 mark"))
        if mark != b"PK\6\7":
            return (*fields[1:7], at)
        record = END64.unpack(self._at(place, END64.size, "the ZIP64 end record"))
        if record[0] != b"PK\6\6" or disk or disks > 1 or place + 12 + record[1] != at - END64_PLACE.size:
            raise FileError(self.name, "the ZIP64 end record is not sound")
        return (*record[4:], place)

    def _read_directory(self, count: int, size: int) -> dict[str, Member]:
        table = self._at(self._directory, size, "the directory")
        members: dict[str, Member] = {}
        place = 0
        for number in range(count):
            if place + ENTRY.size > size:
                raise FileError(self.name, f"the directory ends at member {number} of {count}")
            fields = ENTRY.unpack_from(table, place)
            stop = place + ENTRY.size + fields[10] + fields[11] + fields[12]
            if fields[0] != b"PK\1\2" or stop > size:
                raise FileError(self.name, f"member {number} of the directory is not sound")
            member = self._member(fields, table[place + ENTRY.size : stop])
            if member.name in members:
                raise FileError(self.name, f"two members of the name {shown(member.name)}")
            members[member.name] = member
            place = stop
        if place != size:
            raise FileError(self.name, f"{size - place} bytes in the directory belong to no member")
        return members

    def _member(self, fields: tuple[int, ...], rest: bytes) -> Member:
        flags, method, crc, stored, size = fields[3], fields[4], fields[7], fields[8], fields[9]
        raw_name, extra = rest[: fields[10]], rest[fields[10] : fields[10] + fields[11]]
        name = self._checked_name(raw_name, flags)
        size, stored, offset = _wide((size, stored, fields[16]), extra, self.name, name)
        if fields[1] >> 8 == 3 and stat.S_ISLNK(fields[15] >> 16):
            raise FileError(self.name, f"member {shown(name)} is a symbolic link")
        if method == STORED and size != stored and not flags & ENCRYPTED:
            raise FileError(self.name, f"member {shown(name)}: {size} bytes stored as {stored}")
        if size > self._limits.ratio * stored + 64:
            raise FileError(self.name, f"member {shown(name)}: {size} bytes out of {stored} cannot be")
        return Member(name, raw_name, method, flags, crc, stored, size, offset)

    def _checked_name(self, raw: bytes, flags: int) -> str:
        if not 0 < len(raw) <= self._limits.name:
            raise FileError(self.name, f"a member's name of {len(raw)} bytes; expected 1 to {self._limits.name}")
        try:
            name = raw.decode("utf-8" if flags & UTF8 else "cp437")
        except UnicodeDecodeError as error:
            raise FileError(self.name, f"member {shown(raw)}: its name is not UTF-8") from error
        if not safe_name(name):
            raise FileError(self.name, f"member {shown(name)}: a name that points outside the archive")
        return name.removeprefix("/")

    def _check_overlap(self) -> None:
        end, before = 0, ""
        for member in sorted(self.members.values(), key=lambda m: m.offset):
            if member.offset < end:
                raise FileError(self.name, f"members {shown(before)} and {shown(member.name)} share bytes")
            end, before = member.offset + LOCAL.size + len(member.raw_name) + member.stored, member.name
        if end > self._directory:
            raise FileError(self.name, f"member {shown(before)} reaches into the directory")

    # ---- the members ----

    def __contains__(self, name: str) -> bool:
        return name in self.members

    def open(self, name: str, at_once: bool = False) -> MemberStream:
        """Returns the bytes of a member, inflated as they are read.  FileError if it is not there or not readable.

        `at_once`: all of it will be asked for in one call.
        """
        member = self.members.get(name)
        if member is None:
            raise FileError(self.name, f"no member {shown(name)}")
        if member.flags & ENCRYPTED:
            raise FileError(self.name, f"member {shown(name)} is encrypted")
        if member.method not in (STORED, DEFLATED):
            raise FileError(self.name, f"member {shown(name)}: method {member.method}; expected 0 or 8")
        start = self._start(member)
        if start + member.stored > self._directory:
            raise FileError(self.name, f"member {shown(name)} reaches into the directory")
        whole = at_once and member.method == STORED
        pieces = pieces_of(self._file, start, member.stored, member.stored if whole else PIECE)
        return MemberStream(self.name, member, pieces)

    def _start(self, member: Member) -> int:
        """Returns where a member's bytes begin; FileError if its own header is not the one of the directory."""
        local = LOCAL.unpack(self._at(member.offset, LOCAL.size, f"member {shown(member.name)}"))
        start = member.offset + LOCAL.size
        named = self._at(start, len(member.raw_name), f"member {shown(member.name)}")
        if (local[0], local[3], local[9]) != (b"PK\3\4", member.method, len(named)) or named != member.raw_name:
            raise FileError(self.name, f"member {shown(member.name)}: its header differs from the directory")
        return int(start + local[9] + local[10])

    def agrees(self, member: Member) -> bool:
        """Tells whether a member's own header says of it what the directory does; True where it leaves that open."""
        start = self._start(member)
        local = LOCAL.unpack(self._at(member.offset, LOCAL.size, f"member {shown(member.name)}"))
        told = local[6:9]  # checksum, stored size, size
        open_ = bool(local[2] & DESCRIPTOR) or FULL32 in told or start > self._directory
        return open_ or told == (member.crc, member.stored, member.size)

    def read(self, name: str, most: int) -> bytes:
        """Returns a whole member of at most `most` bytes."""
        if name in self.members and self.members[name].size > most:
            found = self.members[name].size
            raise FileError(self.name, f"member {shown(name)}: {found} bytes; expected at most {most}")
        stream = self.open(name, at_once=True)
        data = stream.read(stream.member.size)
        stream.finish()
        return data

    def check(self) -> None:
        """Reads every member to its end; FileError at the first that does not give what the directory promises."""
        for name in self.members:
            if not name.endswith("/"):
                self.open(name).finish()


def _wide(values: tuple[int, int, int], extra: bytes, archive: str, name: str) -> list[int]:
    """Size, stored size and offset, from the ZIP64 field where the short ones are full."""
    wide = b""
    while len(extra) >= 4:
        kind, length = struct.unpack_from("<2H", extra)
        if kind == 1:
            wide = extra[4 : 4 + length]
        extra = extra[4 + length :]
    result = []
    for value in values:
        if value == FULL32:
            if len(wide) < 8:
                raise FileError(archive, f"member {shown(name)}: its ZIP64 field is missing")
            value, wide = int.from_bytes(wide[:8], "little"), wide[8:]
        result.append(value)
    return result


def pieces_of(file: BinaryIO, start: int, count: int, most: int) -> Iterator[bytes]:
    """Yields `count` bytes of a file from `start` on, at most `most` at a time; fewer where it ends."""
    stop = start + count
    while start < stop:
        file.seek(start)
        piece = file.read(min(most, stop - start))
        if not piece:
            return
        start += len(piece)
        yield piece


class MemberStream(io.RawIOBase):
    """A member being read; `read(n)` gives n bytes unless it ends before."""

    def __init__(self, archive: str, member: Member, pieces: Iterator[bytes]) -> None:
        self.member = member
        self._archive = archive
        self._source: Inflated | _Plain = Inflated(pieces, RAW) if member.method == DEFLATED else _Plain(pieces)
        self._left = member.size
        self._crc = 0

    def readable(self) -> bool:
        """Tells that the stream can be read, as io.RawIOBase asks."""
        return True

    def read(self, count: int = -1) -> bytes:
        """Reads `count` bytes, fewer at the end only; all that is left if `count` is negative."""
        count = self._left if count < 0 else min(count, self._left)
        piece = self._source.piece(count) if isinstance(self._source, _Plain) else None
        if piece is None:
            data = bytearray(count)
            self.readinto(data)
            return bytes(data)
        self._left -= count
        self._crc = isal_zlib.crc32(piece, self._crc)
        return piece

    def readinto(self, buffer: WriteableBuffer) -> int:
        """Fills `buffer`; fewer bytes only where the member ends."""
        view = memoryview(buffer).cast("B")[: self._left]
        try:
            filled = self._source.readinto(view)
        except DeflateError as error:
            raise self._fail(f"damaged ({error})") from error
        if filled != len(view):
            raise self._fail(f"ends {self._left - filled} bytes short of {self.member.size}")
        self._left -= filled
        self._crc = isal_zlib.crc32(view, self._crc)
        return filled

    def finish(self) -> None:
        """Reads what is left and compares length and checksum with the directory."""
        while self._left:
            self.read(min(self._left, 1 << 20))
        more = bytearray(1)
        try:
            longer = self._source.readinto(memoryview(more))
        except DeflateError as error:
            raise self._fail(f"damaged ({error})") from error
        if longer:
            raise self._fail(f"goes on beyond its {self.member.size} bytes")
        if self._crc != self.member.crc:
            raise self._fail(f"checksum found {self._crc:08x}, expected {self.member.crc:08x}")

    def _fail(self, message: str) -> FileError:
        return FileError(self._archive, f"member {shown(self.member.name)}: {message}")


class _Plain:
    """Stored bytes, read the way deflated ones are."""

    def __init__(self, pieces: Iterator[bytes]) -> None:
        self._pieces = pieces
        self._rest = memoryview(b"")

    def piece(self, count: int) -> bytes | None:
        """Returns the next piece as it is, if it has so many bytes."""
        if not self._rest:
            self._rest = memoryview(next(self._pieces, b""))
        whole = self._rest.obj
        if count == 0 or len(self._rest) != count or not isinstance(whole, bytes) or len(whole) != count:
            return None
        self._rest = memoryview(b"")
        return whole

    def readinto(self, view: memoryview) -> int:
        filled = 0
        while filled < len(view):
            if not self._rest:
                piece = next(self._pieces, None)
                if piece is None:
                    break
                self._rest = memoryview(piece)
            count = min(len(self._rest), len(view) - filled)
            view[filled : filled + count] = self._rest[:count]
            self._rest = self._rest[count:]
            filled += count
        return filled


def safe_name(name: str) -> bool:
    """Tells whether a member's name stays inside the archive.  One leading slash is let through: PyORA writes it."""
    inner = name.removeprefix("/")
    parts = inner.removesuffix("/").split("/")
    return (
        bool(inner)
        and not any(part in ("", ".", "..") for part in parts)
        and "\\" not in name
        and ":" not in parts[0]
        and all(ord(c) >= 32 and ord(c) != 127 for c in name)
    )
