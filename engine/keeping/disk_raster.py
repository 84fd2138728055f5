"""Pictures that are put away on disk for as long as somebody holds them: each in a file of its own, which nobody else
can open, beside what else is put away.

Where the system allows it the file has no name, so that nothing is left of it however the program ends.
"""

from __future__ import annotations

import io
import os
import tempfile
import threading
from math import prod
from pathlib import Path
from typing import IO, TYPE_CHECKING
from weakref import finalize

import numpy as np

from engine.keeping import memory
from engine.keeping.spill import spill_folder

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer, WriteableBuffer

_PART = 8  # of the budget of memory, that a picture may take before it is put away


class DiskRaster:
    """Pixels (h, w, channels) of any type, read and written part by part.  Safe for several threads.

    OSError where the disk is full, or what was written cannot be read.
    """

    __slots__ = ("__weakref__", "_file", "_lock", "dtype", "shape")

    def __init__(self, shape: tuple[int, ...], kind: type | np.dtype, folder: Path | None = None) -> None:
        self.shape, self.dtype = shape, np.dtype(kind)
        self._lock = threading.Lock()
        self._file = _nameless(folder)
        finalize(self, self._file.close)
        self._file.truncate(prod(shape) * self.dtype.itemsize)

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes: none, as they are on disk."""
        return 0

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, part: tuple[slice, slice]) -> np.ndarray:
        """Returns the pixels of some rows and columns, a new array."""
        height, width, channels = self.shape
        (top, bottom, _), (left, right, _) = part[0].indices(height), part[1].indices(width)
        out = np.empty((max(bottom - top, 0), max(right - left, 0), channels), self.dtype)
        if not out.size:
            return out
        runs = [out] if out.shape[1] == width else list(out)
        with self._lock:
            for row, run in enumerate(runs, top):
                self._file.seek((row * width + left) * channels * self.dtype.itemsize)
                _fill(self._file, _bytes_of(run))
        return out

    def __setitem__(self, rows: slice, pixels: np.ndarray) -> None:
        """Puts whole rows in their place."""
        top, bottom, _ = rows.indices(self.shape[0])
        if pixels.shape != (bottom - top, *self.shape[1:]):
            raise ValueError(f"rows {pixels.shape}; expected {(bottom - top, *self.shape[1:])}")
        left = _bytes_of(np.ascontiguousarray(pixels, self.dtype))
        with self._lock:
            self._file.seek(top * prod(self.shape[1:]) * self.dtype.itemsize)
            while left:
                left = left[self._file.write(left) :]


def _bytes_of(pixels: np.ndarray) -> memoryview:
    return pixels.reshape(-1).view(np.uint8).data


def _fill(file: IO[bytes], room: memoryview) -> None:
    while room:
        count = file.readinto(room)  # type: ignore[attr-defined]
        if not count:
            raise OSError("a picture that was put away on disk: its file is shorter than it was")
        room = room[count:]


def _nameless(folder: Path | None = None) -> IO[bytes]:
    """Returns a new file without a name, unbuffered."""
    return tempfile.TemporaryFile(dir=spill_folder() if folder is None else folder, buffering=0)


def room(shape: tuple[int, ...], kind: type | np.dtype) -> np.ndarray | DiskRaster:
    """Returns room for a picture: an array, or a file if it took much of what a painting may take."""
    large = prod(shape) * np.dtype(kind).itemsize > memory.budget() // _PART
    return DiskRaster(shape, kind) if large else np.empty(shape, kind)


class DiskBytes:
    """Bytes written one after the other into such a file, and read when they are all there.  Safe for several threads
    from then on."""

    __slots__ = ("__weakref__", "_file", "_lock", "_size")

    def __init__(self) -> None:
        self._lock, self._size = threading.Lock(), 0
        self._file = _nameless()
        finalize(self, self._file.close)

    def __len__(self) -> int:
        return self._size

    def write(self, piece: ReadableBuffer) -> int:
        """Adds bytes."""
        left = memoryview(piece).cast("B")
        size = len(left)
        while left:
            left = left[self._file.write(left) :]
        self._size += size
        return size

    def piece(self, at: int, room: memoryview) -> int:
        """Reads bytes from a place on into `room`; tells how many there were."""
        with self._lock:
            self._file.seek(at)
            return int(self._file.readinto(room))  # type: ignore[attr-defined]

    def opened(self) -> IO[bytes]:
        """Returns them as a file to be read from its beginning."""
        return io.BufferedReader(_Reader(self), 1 << 20)


class _Reader(io.RawIOBase):
    def __init__(self, read: DiskBytes) -> None:
        self._read, self._at = read, 0

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        self._at = offset + {os.SEEK_SET: 0, os.SEEK_CUR: self._at, os.SEEK_END: len(self._read)}[whence]
        return self._at

    def readinto(self, room: WriteableBuffer) -> int:
        count = self._read.piece(self._at, memoryview(room))
        self._at += count
        return count
