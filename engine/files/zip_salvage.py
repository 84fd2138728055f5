"""What is whole of a damaged ZIP archive: its members are found by their own headers and by what is left of the
directory, and only those are there whose bytes have the checksum and size that one of the two promises.

All limits of `zip_reader` hold.  How much is read is bounded, too: what the headers of a stranger claim may overlap.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from itertools import chain
from typing import BinaryIO

from engine.files.fault import Cancelled, FileError
from engine.files.inflate import PIECE, RAW, DeflateError, Inflated
from engine.files.limits import LIMITS, Limits
from engine.files.zip_reader import (
    DEFLATED,
    DESCRIPTOR,
    ENCRYPTED,
    ENTRY,
    FULL32,
    LOCAL,
    STORED,
    Member,
    MemberStream,
    ZipArchive,
    pieces_of,
)

LOCAL_MARK, ENTRY_MARK, END_MARK, END64_MARK = b"PK\3\4", b"PK\1\2", b"PK\5\6", b"PK\6\6"
WINDOW = 1 << 20  # bytes of the file that are searched at a time
CLAIMS = 4  # times the file's size: bytes that are read to find out what is whole
INFLATED = 2 << 30  # bytes that all members may have together when they are inflated
STEP = 4 << 10  # bytes that are inflated at a time where damage is expected
TRIES = 4  # places where the bytes of a member of one name are looked for
WIDE_EXTRA = 20  # bytes of the field that a header of a member of 4 GiB has in a file of ours

Stop = Callable[[], bool] | None


@dataclass(frozen=True, slots=True)
class Found:
    """A member as some header tells of it, and where its bytes begin."""

    member: Member
    start: int


class SalvagedArchive(ZipArchive):
    """The whole members of a damaged archive.

    `torn`: those that some header tells of, and that are not whole, by name.
    """

    def __init__(self, file: BinaryIO, name: str, limits: Limits = LIMITS, cancelled: Stop = None) -> None:
        self._measure(file, name, limits)
        self._cancelled = cancelled
        self._directory = self._size
        self._window = 0, b""  # the part of the file that is being searched, and where it begins
        self._claims, self._inflated = CLAIMS * self._size, INFLATED
        self._starts: dict[str, int] = {}
        self.torn: dict[str, Found] = {}
        members: dict[str, Member] = {}
        for called, found in self._candidates().items():
            whole = next((one for one in found if self._is_whole(one)), None)
            if whole is None:
                self.torn[called] = found[0]
            else:
                members[called], self._starts[called] = whole.member, whole.start
        self.members = members

    def _start(self, member: Member) -> int:
        return self._starts[member.name]

    def beginning(self, name: str, most: int) -> bytes:
        """Returns what comes before the damage in a torn member, at most `most` bytes; what follows a flipped bit may
        be among it."""
        found = self.torn[name]
        stored = pieces_of(self._file, found.start, found.member.stored, PIECE)
        if found.member.method == STORED:
            return b"".join(stored)[:most]
        stream, out = Inflated(stored, RAW), bytearray()
        piece = bytearray(STEP)
        with suppress(DeflateError):  # what came before is told
            while len(out) < most and (count := stream.readinto(memoryview(piece))):
                out += piece[:count]
        return bytes(out[:most])

    # ---- what there is ----

    def _candidates(self) -> dict[str, list[Found]]:
        """Returns by name where members may be: first what their own headers tell, then what the directory does."""
        out: dict[str, list[Found]] = {}
        for found in chain(self._by_headers(), self._by_entries()):
            name = found.member.name
            if name.endswith("/") or (name not in out and len(out) >= self._limits.entries):
                continue
            held = out.setdefault(name, [])
            if found not in held and len(held) < TRIES:
                held.append(found)
        return out

    def _by_headers(self) -> Iterator[Found]:
        """Yields the members whose own headers are sound.  What lies within a member, whose end another header marks,
        is not looked at."""
        place, count = 0, 0
        while count < 2 * self._limits.entries and (place := self._next(LOCAL_MARK, place)) >= 0:
            found = self._by_header(place)
            place += len(LOCAL_MARK)
            if found is not None:
                count += 1
                end = found.start + found.member.stored
                if self._marked(end):
                    place = end
                yield found

    def _by_entries(self) -> Iterator[Found]:
        """Yields the members that entries of the directory tell of; it lies at the end."""
        place, count = max(0, self._size - self._limits.directory - WINDOW), 0
        while count < 2 * self._limits.entries and (place := self._next(ENTRY_MARK, place)) >= 0:
            member = self._by_entry(place)
            place += len(ENTRY_MARK)
            if member is not None:
                count += 1
                first = member.offset + LOCAL.size + len(member.raw_name)
                for extra in {self._extra(member), 0, WIDE_EXTRA}:
                    yield Found(member, first + extra)

    def _by_header(self, place: int) -> Found | None:
        """Returns the member whose own header lies at `place`; None if it makes no sense, or does not tell the size."""
        if place + LOCAL.size > self._size:
            return None
        local = LOCAL.unpack(self._at(place, LOCAL.size, "a header"))
        start = place + LOCAL.size + local[9]
        if local[2] & (ENCRYPTED | DESCRIPTOR) or start + local[10] > self._size:
            return None
        rest = self._at(place + LOCAL.size, local[9] + local[10], "a header")
        entry = (b"", 0, 0, local[2], local[3], 0, 0, *local[6:9], local[9], local[10], 0, 0, 0, 0, place)
        member = self._believed(entry, rest)
        return None if member is None else Found(member, start + local[10])

    def _by_entry(self, place: int) -> Member | None:
        """Returns the member of which the entry at `place` tells; None if it makes no sense."""
        if place + ENTRY.size > self._size:
            return None
        fields = ENTRY.unpack(self._at(place, ENTRY.size, "an entry"))
        length = fields[10] + fields[11]
        if fields[3] & ENCRYPTED or place + ENTRY.size + length > self._size:
            return None
        return self._believed(fields, self._at(place + ENTRY.size, length, "an entry"))

    def _believed(self, fields: tuple[int, ...], rest: bytes) -> Member | None:
        try:
            member = self._member(fields, rest)
        except FileError:
            return None
        sound = member.method in (STORED, DEFLATED) and member.offset + LOCAL.size <= self._size
        return member if sound and FULL32 not in (member.stored, member.size) else None

    def _extra(self, member: Member) -> int:
        """Returns how long the extra field is, as the member's own header tells."""
        local = LOCAL.unpack(self._at(member.offset, LOCAL.size, "a header"))
        return int(local[10])

    # ---- looking through the file ----

    def _next(self, mark: bytes, place: int) -> int:
        """Returns where a mark is found next, -1 for nowhere."""
        while place + len(mark) <= self._size:
            start, window = self._window
            if not start <= place <= start + len(window) - len(mark):
                if self._cancelled is not None and self._cancelled():
                    raise Cancelled
                start, window = self._window = place, self._at(place, min(WINDOW, self._size - place), "a header")
            at = window.find(mark, place - start)
            if at >= 0:
                return start + at
            place = start + len(window) - len(mark) + 1
        return -1

    def _marked(self, place: int) -> bool:
        """Tells whether a header, or the end of the file, is at a place."""
        if place >= self._size - len(LOCAL_MARK):
            return place == self._size
        return self._at(place, 4, "a header") in (LOCAL_MARK, ENTRY_MARK, END_MARK, END64_MARK)

    def _is_whole(self, found: Found) -> bool:
        """Tells whether a member's bytes are those that its header promises."""
        member = found.member
        if found.start + member.stored > self._size:
            return False
        self._claims -= member.stored
        if self._claims < 0:
            return False
        if member.method == DEFLATED:
            self._inflated -= member.size
            if self._inflated < 0:
                return False
        stream = MemberStream(self.name, member, pieces_of(self._file, found.start, member.stored, PIECE))
        try:
            while stream.read(WINDOW):
                if self._cancelled is not None and self._cancelled():
                    raise Cancelled
            stream.finish()
        except FileError:
            return False
        return True


def is_consistent(archive: ZipArchive) -> bool:
    """Tells whether the directory and the members' own headers say the same, as programs write them: if they do not,
    what looks like another program's work is damage."""
    return all(archive.agrees(member) for member in archive.members.values())
