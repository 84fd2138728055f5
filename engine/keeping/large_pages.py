"""Large pages for what is painted next.

A stroke fills tens of megabytes that stay: in pages of 4 KB each of them costs a fault, and all together a third of
the stroke.  So memory is asked for ahead, told to come in pages of 2 MB, and freed again: what the thread allocates
next lies there.  glibc on Linux only; elsewhere nothing happens.
"""

from __future__ import annotations

import ctypes
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache

_HUGE, _NOT_HUGE = 14, 15  # MADV_HUGEPAGE, MADV_NOHUGEPAGE
_PAGE = 1 << 12
_BLOCK = 28 << 20  # bytes asked for at a time: below those of which the C library maps each block by itself
_BLOCKS = 2
_APART = 8 << 20  # bytes that the process grows by before more are asked for


@dataclass(frozen=True, slots=True)
class _Library:
    """The functions of the C library that are needed."""

    malloc: Callable[[int], int | None]
    free: Callable[[int], None]
    madvise: Callable[[int, int, int], int]


@dataclass(slots=True)
class _Asked:
    """What was asked for: first byte and length of each piece; and how many bytes were resident then."""

    pieces: list[tuple[int, int]] = field(default_factory=list)
    held: int = 0
    lock: threading.Lock = field(default_factory=threading.Lock)


_ASKED = _Asked()


def ask_ahead(held: int) -> None:
    """Has what this thread allocates next come in large pages, if the process, which holds so many bytes, grew."""
    library = _library()
    if library is None:
        return
    with _ASKED.lock:
        if abs(held - _ASKED.held) < _APART:
            return
        _ASKED.held = held
        blocks = [block for block in (library.malloc(_BLOCK) for _ in range(_BLOCKS)) if block]
        for block in blocks:
            first, last = -(-block // _PAGE) * _PAGE, (block + _BLOCK) // _PAGE * _PAGE
            if library.madvise(first, last - first, _HUGE) == 0:
                _ASKED.pieces.append((first, last - first))
        for block in reversed(blocks):
            library.free(block)


def forgo() -> None:
    """Has what is not in use come in small pages again: the system fills up large ones of which a part was given
    back."""
    library = _library()
    if library is not None:
        with _ASKED.lock:
            for first, length in _ASKED.pieces:
                library.madvise(first, length, _NOT_HUGE)
            _ASKED.pieces.clear()


@cache
def _library() -> _Library | None:
    if not sys.platform.startswith("linux"):
        return None
    try:
        found = ctypes.CDLL(None)
        malloc, free, madvise = found.malloc, found.free, found.madvise
        found.malloc_trim  # noqa: B018  it is glibc
    except (OSError, AttributeError):
        return None
    malloc.restype, malloc.argtypes = ctypes.c_void_p, (ctypes.c_size_t,)
    free.restype, free.argtypes = None, (ctypes.c_void_p,)
    madvise.argtypes = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int
    return _Library(malloc, free, madvise)
