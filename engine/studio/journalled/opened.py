"""The file that was opened, kept beside the journal before anything is done with the painting.

Where there is no room for it, it is tried again; where it is another one by now, nobody can keep it any more.
"""

from __future__ import annotations

import math
import os
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from engine.checks.field_error import FieldError
from engine.checks.owned import Owned
from engine.files.fault import FileError, WriteError
from engine.journal.heads import FileStamp
from engine.journal.journal import Journal
from engine.journal.kept import keep_file, stamp_of
from engine.journal.records import Kind, told_object
from engine.journal.volume import End, Volume
from engine.journal.writing import RETRY

FOLDER_PATIENCE = 10.0  # seconds that what lies beside a journal waits for its folder, at most
_POLL = 0.01  # seconds
Do = Callable[[Callable[[], None]], Future[None] | None]  # has a job done beside the engine's thread


class Opened(Owned):
    """It belongs to the engine's thread.  `do` has a job done beside that; `wake` tells it that one has failed."""

    def __init__(self, journal: Journal, do: Do, wake: Callable[[], None]) -> None:
        self._journal, self._do = journal, do
        self._stamp: FileStamp | None = None  # before it is kept
        self._keeping: tuple[Path, Future[None]] | None = None  # the file, and what ends when it is kept
        self._unkept = unkept = deque[tuple[Volume, FileStamp]]()  # for which there was no room
        self._again = 0.0  # when that is tried again
        self._gone = threading.Event()
        self._failed = _Failed(unkept.append, self._gone.set, wake)

    def turn(self, head: Mapping[str, object]) -> None:
        """Another painting is there, which began with `head`."""
        self._stamp = self._keeping = None
        base = head.get("base")
        if isinstance(base, Mapping) and "file" in base:
            with suppress(FieldError):
                self._stamp = stamp_of(base)

    def keep(self) -> None:
        """Has the file kept, once."""
        if self._stamp is not None:
            stamp, self._stamp = self._stamp, None
            self._keep(stamp)

    def keep_late(self, now: float) -> float:
        """Has kept what there was no room for, if it is time to try; returns when it will be."""
        if self._unkept and now >= self._again:
            self._again = now + RETRY
            entry, stamp = self._unkept.popleft()
            if entry is self._journal.entry:
                self._keep(stamp)
        return self._again if self._unkept else math.inf

    def is_gone(self) -> bool:
        """Tells, once, that it is another file by now."""
        gone = self._gone.is_set()
        self._gone.clear()
        return gone

    def replaces(self, path: Path) -> Callable[[], None]:
        """Has it kept; returns what waits for that on any thread, if this is the file that is going to be written."""
        self.keep()
        keeping = self._keeping

        def wait() -> None:
            if keeping is not None and os.path.realpath(keeping[0]) == os.path.realpath(path):
                keeping[1].exception()

        return wait

    def _keep(self, stamp: FileStamp) -> None:
        ended = self._do(partial(_keep, self._journal, self._journal.entry, stamp, self._failed))
        self._keeping = None if ended is None else (stamp.path, ended)


# --- on the thread ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class _Failed:
    """Who hears that a file was not kept: it is to be tried again, or cannot be, any more."""

    later: Callable[[tuple[Volume, FileStamp]], None]
    never: Callable[[], None]
    wake: Callable[[], None]


def _keep(journal: Journal, entry: Volume, stamp: FileStamp, failed: _Failed) -> None:
    folder = _folder(entry)
    try:
        if folder is None:
            raise WriteError(stamp.path, "has no folder yet in which it can be kept")
        sha = keep_file(folder, stamp)
    except FileError as error:
        if isinstance(error, WriteError):
            failed.later((entry, stamp))
        else:
            failed.never()
        failed.wake()
        raise
    journal.note(Kind.BASE, told_object({"sha": sha}), entry)


def in_folder(entry: Volume, job: Callable[[Path], None]) -> None:
    """Does a job in an entry's folder, if there is one and it stays."""
    folder = _folder(entry)
    if folder is not None and entry.end is not End.DELETED:
        job(folder)


def _folder(entry: Volume) -> Path | None:
    """Returns an entry's folder, which the journal's thread is about to make; None where it cannot, or is late."""
    end = time.monotonic() + FOLDER_PATIENCE
    while entry.folder is None and entry.fault is None and entry.end is None and time.monotonic() < end:
        time.sleep(_POLL)
    return entry.folder
