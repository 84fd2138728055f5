"""Bytes put away on disk for as long as the program runs: one file in the state folder, which nobody else can open.

Where the system allows it the file has no name, so that nothing is left of it however the program ends.
"""

from __future__ import annotations

import atexit
import shutil
import tempfile
import threading
import zlib
from collections import deque
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import IO
from weakref import ReferenceType

from engine.keeping.state_folder import state_folder

_FOLDER = "spill"
_LEAST = 512  # bytes that a piece takes of the file
_SPARE = 4 << 30  # bytes of the disk that are left to others by what can be made again
_ASKED = 16 << 20  # bytes that are written before it is asked again
PLACE_OVERHEAD = 350  # bytes of memory in which it is told where a piece lies, roughly


class Spilled:
    """A piece that was put away; its place is free for others when nobody holds it any more."""

    __slots__ = ("__weakref__", "_at", "_crc", "_spill", "size")

    def __init__(self, spill: Spill, at: int, piece: bytes) -> None:
        self._spill, self._at = spill, at
        self.size, self._crc = len(piece), zlib.crc32(piece)

    def read(self) -> bytes:
        """Returns the piece.  OSError if it cannot be read, or is not what was written."""
        piece = self._spill.piece(self._at, self.size)
        if zlib.crc32(piece) != self._crc:
            raise OSError(f"what was put away on disk: found other bytes than the {self.size} that were written")
        return piece


class _Place(ReferenceType[Spilled]):
    """Where a piece lies, and whether anybody holds it: what is told when nobody does is a function of the
    interpreter's own, in which no interrupt of the program can get lost."""

    __slots__ = ("at", "size")
    at: int
    size: int


class Spill:
    """A file of pieces.  Safe for several threads.

    `held`: bytes of the pieces; `length`: of the file, with what is free between them.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder
        self._file: IO[bytes] | None = None
        self._lock = threading.Lock()
        self._room: dict[int, list[int]] = {}  # by size: places that are free
        self._places: dict[int, _Place] = {}  # of the pieces
        self._freed: deque[ReferenceType[Spilled]] = deque()  # places that are to be added to those that are free
        self._tell = self._freed.append  # one for all places: each would have an object of its own else
        self._ask_from = 0  # bytes of the file at which it is asked how much room the disk has
        self.held = self.length = 0

    def put(self, piece: bytes, spare: bool = False) -> Spilled | None:
        """Puts a piece away; None where the disk is full, or has no folder for it; or, where it is to `spare` others,
        little room for them."""
        size = _rounded(len(piece))
        with self._lock:
            self._collect()
            free = self._room.get(size)
            if spare and not free and not self._is_roomy():
                return None
            at = free[-1] if free else self.length
            try:
                file = self._opened()
                file.seek(at)
                if file.write(piece) != len(piece):  # the disk is full
                    return None
            except OSError:
                return None
            if free:
                free.pop()
            else:
                self.length += size
            self.held += len(piece)
            spilled = Spilled(self, at, piece)
            place = self._places[at] = _Place(spilled, self._tell)
            place.at, place.size = at, spilled.size
        return spilled

    def put_spare(self, piece: bytes) -> Spilled | None:
        """As `put`, of what can be made again: None where the disk has little room for others."""
        return self.put(piece, spare=True)

    def piece(self, at: int, size: int) -> bytes:
        """Returns what lies at a place.  OSError if it cannot be read."""
        with self._lock:
            file = self._opened()
            file.seek(at)
            return file.read(size)

    def close(self) -> None:
        """Deletes the file."""
        with self._lock:
            if self._file is not None:
                self._file.close()

    def _is_roomy(self) -> bool:
        """Tells whether others have enough of the disk: it is asked from time to time."""
        if self.length >= self._ask_from:
            with suppress(OSError):
                folder = spill_folder() if self._folder is None else self._folder
                if shutil.disk_usage(folder).free >= _SPARE:
                    self._ask_from = self.length + _ASKED
        return self.length < self._ask_from

    def _collect(self) -> None:
        while self._freed:
            place = self._freed.popleft()
            assert isinstance(place, _Place)
            del self._places[place.at]
            self._room.setdefault(_rounded(place.size), []).append(place.at)
            self.held -= place.size

    def _opened(self) -> IO[bytes]:
        if self._file is None:
            folder = spill_folder() if self._folder is None else self._folder
            self._file = tempfile.TemporaryFile(dir=folder, buffering=0)  # noqa: SIM115
        elif self._file.closed:
            raise OSError("what was put away on disk: the file is closed")
        return self._file


def _rounded(size: int) -> int:
    """Returns a size a little larger, such that many pieces have the same."""
    step = max(_LEAST, 1 << max(size.bit_length() - 3, 0))
    return -(-max(size, 1) // step) * step


def spill_folder() -> Path:
    """Returns the folder of what is put away on disk.  OSError if it cannot be made."""
    return state_folder(_FOLDER)


@cache
def spill() -> Spill:
    """Returns the program's own file, which is closed when that ends."""
    made = Spill()
    atexit.register(made.close)
    return made
