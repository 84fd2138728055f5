"""What goes wrong with files, in one line each: the file, the place in it, what was found, what was expected."""

from __future__ import annotations

import errno
import os


class FileError(Exception):
    """A file that cannot be used: `str()` is one line that starts with the file's name."""

    def __init__(self, path: str | os.PathLike[str], message: str) -> None:
        self.path = os.fspath(path)
        self.message = " ".join(message.split())
        super().__init__(f"{self.path}: {self.message}")

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.path, self.message)


class WriteError(FileError):
    """The work failed while writing; what was there before is untouched and nothing half-written is left."""


class TooMuch(FileError):
    """A file that asks for more than is let: nothing of it is opened, and it is not for being damaged."""


class Cancelled(Exception):
    """The one who asked no longer wants the result; nothing was written."""


def system_words(error: OSError) -> str:
    """Returns what the system says of a file, in one line: the file, if it names one, and the reason."""
    return f"{error.filename}: {reason_of(error)}" if error.filename else reason_of(error)


def reason_of(error: Exception) -> str:
    """Returns why something could not be read or written, in words that everybody uses."""
    if isinstance(error, OSError) and error.errno in _FULL:
        return "the disk is full"
    return getattr(error, "strerror", None) or str(error) or type(error).__name__


_FULL = errno.ENOSPC, errno.EDQUOT


def shown(text: object, limit: int = 60) -> str:
    """Returns text found in a file, fit for one line of a message: printable ASCII in quotes, cut at `limit`."""
    plain = ascii(text[: limit + 1] if isinstance(text, bytes) else str(text)[: limit + 1])
    return plain if len(plain) <= limit + 2 else plain[:limit] + "..."
