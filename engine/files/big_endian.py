"""Values of a file one after another, most significant byte first; no byte beyond its end is believed to be there."""

from __future__ import annotations

import struct

from engine.files.fault import FileError


class BigEndian:
    """Takes one value after another, from `at` to `end`; FileError where these end inside what is taken."""

    def __init__(self, data: bytes, file: str, at: int = 0, end: int | None = None) -> None:
        self._data, self._file, self.at = data, file, at
        self.end = len(data) if end is None else end

    def take(self, form: str, what: str) -> tuple[int | float | bytes, ...]:
        """Returns the values of a `struct` form; `what` they are of, for messages."""
        size = struct.calcsize(f">{form}")
        if size > self.left:
            raise self.fault(f"the file ends inside {what}")
        found = struct.unpack_from(f">{form}", self._data, self.at)
        self.at += size
        return found

    def number(self, form: str, what: str) -> int:
        """Returns one whole number."""
        return int(self.take(form, what)[0])

    def raw(self, count: int, what: str) -> bytes:
        """Returns so many bytes."""
        if not 0 <= count <= self.left:
            raise self.fault(f"found {what} of {count} bytes, {self.left} are left")
        self.at += count
        return self._data[self.at - count : self.at]

    def text(self, units: int, what: str) -> str:
        """Returns a text of so many units of UTF-16, up to its first null."""
        if 2 * units > self.left:
            raise self.fault(f"the file ends inside {what}")
        return self.raw(2 * units, what).decode("utf-16-be", "replace").split("\0")[0]

    def part(self, count: int, what: str) -> BigEndian:
        """Returns a reader of the next bytes alone, and goes on after them."""
        self.raw(count, what)
        return BigEndian(self._data, self._file, self.at - count, self.at)

    def fault(self, found: str) -> FileError:
        """Makes the error that tells what was found here."""
        return FileError(self._file, f"byte {self.at}: {found}")

    @property
    def left(self) -> int:
        """Returns how many bytes follow."""
        return self.end - self.at
