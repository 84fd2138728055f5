"""Who holds the arrays and bytes of a process, and what the C library has of memory: what no holder tells of.

The look is taken by a copy of the process, which goes on meanwhile: it takes a minute.
"""

from __future__ import annotations

import ctypes
import gc
import json
import os
import sys
import threading
from collections import Counter, deque
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

_LEAST = 2048  # bytes of what is told
_STEPS = 6  # types on the way to it that are told, the last ones
_TOP = 60  # ways that are told
_NODES = {f"map_{kind}_node" for kind in ("bitmap", "array", "collision")}
_PLAIN = {"dict", "tuple", "list", "OrderedDict", "Map", "cell"} | _NODES
_OURS = ("engine", "app")
_FIELDS = "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost"


class _Told(ctypes.Structure):
    _fields_ = tuple((name, ctypes.c_size_t) for name in _FIELDS.split())


def allocated() -> dict[str, int]:
    """MB that the C library has of memory: in use, free between that, and mapped by themselves; glibc's alone."""
    found = getattr(ctypes.CDLL(None), "mallinfo2", None)
    if found is None:
        return {}
    found.restype = _Told
    told = found()
    return {"used": told.uordblks >> 20, "free": told.fordblks >> 20, "mapped": told.hblkhd >> 20}


def tell_holders(path: Path) -> None:
    """Has a copy of the process write down who holds what, as JSON."""
    frames = _frames()
    if os.fork():
        return
    try:
        gc.disable()
        gc.unfreeze()
        path.write_text(json.dumps(holders([_of_modules(), _of_frames(frames), _of_nobody()])))
    finally:
        os._exit(0)


def holders(rounds: Iterable[Iterable[tuple[str, Any]]]) -> dict[str, Any]:
    """MB of arrays and bytes by the way that leads to them, how many, and how many objects there are of each type: of
    what is named in one round, and all that it holds, the nearest first, before that of the next."""
    search = _Search()
    for roots in rounds:
        search.go(roots)
    return search.told()


def _of_modules() -> Iterator[tuple[str, Any]]:
    for name, module in sorted(sys.modules.items(), key=lambda item: not item[0].startswith(_OURS)):
        for word, held in list(getattr(module, "__dict__", {}).items()):
            if not word.startswith("__") and not isinstance(held, type(sys)):
                yield f"{name}.{word}" if name.startswith(_OURS) else name.partition(".")[0], held


def _frames() -> list[tuple[str, FrameType]]:
    """Returns all that runs now, with the names of threads and functions."""
    names = {thread.ident: thread.name for thread in threading.enumerate()}
    found = []
    for ident, inner in sys._current_frames().items():
        frame: FrameType | None = inner
        while frame is not None:
            found.append((f"{names.get(ident)}: {frame.f_code.co_name}", frame))
            frame = frame.f_back
    return found


def _of_frames(frames: list[tuple[str, FrameType]]) -> Iterator[tuple[str, Any]]:
    for name, frame in frames:
        for word, held in frame.f_locals.items():
            yield f"{name} {word}", held


def _of_nobody() -> Iterator[tuple[str, Any]]:
    for held in gc.get_objects():
        yield f"nobody's {type(held).__name__}", held


class _Search:
    """Goes from some objects to all that they hold."""

    def __init__(self) -> None:
        self._from: dict[int, tuple[int, str]] = {}  # by what: whence, and what it is called
        self._open: deque[Any] = deque()
        self._all: list[Any] = []  # so that no other object is taken for one that is gone
        self._sizes: Counter[str] = Counter()
        self._counts: Counter[str] = Counter()
        self._types: Counter[str] = Counter()
        for own in (self, self.__dict__, *self.__dict__.values()):
            self._from[id(own)] = 0, ""

    def told(self) -> dict[str, Any]:
        """Returns what was found."""
        top = [[way, round(size / 2**20, 1), self._counts[way]] for way, size in self._sizes.most_common(_TOP)]
        return {"total": self._sizes.total() >> 20, "top": top, "types": self._types.most_common(_TOP // 2)}

    def _reach(self, held: Any, whence: int, name: str) -> None:
        if id(held) not in self._from:
            self._from[id(held)] = whence, name
            self._all.append(held)
            self._open.append(held)

    def go(self, roots: Iterable[tuple[str, Any]]) -> None:
        """Goes through all that some objects hold."""
        for name, held in roots:
            self._reach(held, 0, name)
        while self._open:
            held = self._open.popleft()
            self._types[type(held).__name__] += 1
            size = _own_bytes(held)
            if size >= _LEAST:
                way = self._way(held)
                self._sizes[way] += size
                self._counts[way] += 1
            inner = [held.base] if isinstance(held, np.ndarray) and held.base is not None else gc.get_referents(held)
            for one in inner:
                if not isinstance(one, type(sys)):
                    self._reach(one, id(held), type(one).__name__)

    def _way(self, held: Any) -> str:
        names, at = list[str](), id(held)
        while at:
            at, name = self._from[at]
            names.append(name)
        first, *rest = reversed(names)
        return " > ".join([first, *[name for name in rest if name not in _PLAIN][-_STEPS:]])


def _own_bytes(held: Any) -> int:
    """Bytes that an object has of its own: none for a part of an array."""
    if isinstance(held, np.ndarray):
        return held.nbytes if held.base is None or not isinstance(held.base, np.ndarray | bytes | bytearray) else 0
    return sys.getsizeof(held) if isinstance(held, bytes | bytearray | str) else 0
