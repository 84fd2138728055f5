"""The files of one entry as they are written: frames in order, to disk as soon as that takes them."""

from __future__ import annotations

import errno
import os
import shutil
import threading
from collections import deque
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from engine.files.atomic import sync_folder
from engine.files.fault import WriteError, reason_of
from engine.journal import entries
from engine.journal.frames import Frame, framed, frames_in
from engine.journal.records import Kind, told_object
from engine.journal.story import JOURNAL, Story, journal_files
from engine.keeping.program import program_ident

_AT_ONCE = 64  # frames that are written before another thread has its turn
_GONE = "the folder of the journal is gone"


class End(Enum):
    """What becomes of an entry when its painting is closed: it stays to be recovered, lies in the bin, or is deleted
    because its file holds all of it."""

    STAYS = "stays"
    BIN = "bin"
    DELETED = "deleted"


@dataclass(frozen=True, slots=True)
class Continued:
    """An entry that is opened again: its folder and lock, the highest number of its files, that of the last frame that
    is good, and the records that come first: of what became of all that had no answer, or, where there is no file yet,
    of all that was done."""

    folder: Path
    lock: int | None
    files: int
    last: int
    first: tuple[tuple[Kind, bytes], ...] = ()


def continued_entry(folder: Path, lock: int | None, story: Story, settled: Iterable[tuple[Kind, bytes]]) -> Continued:
    """Returns an entry that goes on after what its journal tells, and what became of all that had no answer there."""
    number = max((int(path.name.removeprefix(JOURNAL)) for path in journal_files(folder)), default=0)
    return Continued(folder, lock, number, story.last, tuple(settled))


class Volume:
    """The journal of one painting.  `open`, `write_held`, `sync` and `finish` are called by one thread, the others with
    `guard` held, a lock that no one holds while waiting for a disk to sync.

    `folder`: None before it is made; `held`: frames that could not be written yet; `fault`: why, None if all is well;
    `sync_at`: when a sync is due, by the monotonic clock; `end`: nothing more comes, and what becomes of the entry;
    `leaves`: numbers of what is asked of the next painting instead; `lost`: its folder was removed, so that it is to be
    begun anew; `lacks`: with its beginning, so that nothing more is written; `head`: what the painting began with.
    """

    def __init__(
        self, parent: Path, head: Mapping[str, object], guard: threading.Lock, continued: Continued | None = None
    ) -> None:
        self.parent, self.head, self._guard = parent, dict(head), guard
        self.folder = None if continued is None else continued.folder
        self._lock = None if continued is None else continued.lock
        self._number = 1 if continued is None else continued.files + 1
        self._sequence = -1 if continued is None else max(continued.last, 0) - 1
        self._path: Path | None = None
        self._files: list[Path] = []  # that there were when it was made, itself among them
        self._remnants: list[Path] = []  # folders that somebody removed, or began to
        self._file: int | None = None
        self._first, self._after = self._sequence + 1, -1 if continued is None else continued.last  # of this file
        self._good = 0  # bytes of whole frames in it
        self._torn = self._durable = False
        self._recent: deque[bytes] = deque()  # written, but not synced for sure
        self.held: deque[bytes] = deque()
        self.fault: str | None = None
        self.sync_at: float | None = None
        self.end: End | None = None
        self.leaves: list[int] = []
        self.lost = self.lacks = self._unsure = False  # and whether a disk refused to sync
        self._syncing = False
        self.append(Kind.HEAD, _told_head(self.head, self._after))
        for kind, payload in () if continued is None else continued.first:
            self.append(kind, payload)

    @property
    def settled(self) -> bool:
        """Tells whether all that was appended is on disk."""
        return self.open and not self.held and self.sync_at is None and not self._syncing

    @property
    def is_whole(self) -> bool:
        """Tells whether its file is where it was made, with those before it, if it has one: they may have been deleted,
        or their disk taken away."""
        file = self._file
        if file is None:
            return not self.lost
        assert self._path is not None
        try:
            is_same = os.path.samestat(os.fstat(file), os.stat(self._path))
            return is_same and all(path.exists() for path in self._files)
        except OSError:
            return False

    @property
    def open(self) -> bool:
        """Tells whether there is a file to write to."""
        return self._file is not None

    def append(self, kind: Kind, payload: bytes) -> None:
        """Writes a record, or keeps it in memory behind those that could not be written."""
        self._sequence += 1
        if self.lacks:
            return
        data = framed(Frame(self._sequence, kind, payload))
        if self._file is None or self.held or not self._write(data):
            self.held.append(data)

    def _write(self, data: bytes) -> bool:
        assert self._file is not None
        try:
            count = os.write(self._file, data)
        except OSError as error:
            self._torn = True  # some of it may be there
            self._fail(error)
            return False
        if count < len(data):  # the disk has become full within the frame
            self._torn, self.fault = True, reason_of(OSError(errno.ENOSPC, ""))
            return False
        self._good += count
        self._recent.append(data)
        return True

    def _fail(self, error: OSError) -> None:
        self.fault = reason_of(error)

    # --- by one thread, without the lock ------------------------------------------------------------------------------

    def write_held(self) -> None:
        """Writes what is kept in memory, from a whole frame on, as far as that can be done."""
        while self._write_some():
            pass

    def _write_some(self) -> bool:
        with self._guard:
            if self._file is None or not self.held:
                return False
            if self._torn:
                try:
                    os.ftruncate(self._file, self._good)
                except OSError as error:
                    self._fail(error)
                    return False
                self._torn = False
            for _ in range(min(_AT_ONCE, len(self.held))):
                if not self._write(self.held[0]):
                    return False
                self.held.popleft()
            self.fault = self.fault if self._unsure else None
            return True

    def make(self) -> None:
        """Makes the folder, unless it is there, and the file."""
        if self.lacks:
            return
        try:
            if self.folder is None:
                self.folder, self._lock = entries.new_entry(self.parent)
            path = self.folder / f"{JOURNAL}{self._number}"
            flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_APPEND | getattr(os, "O_CLOEXEC", 0)
            file = os.open(path, flags | getattr(os, "O_BINARY", 0), 0o600)
        except OSError as error:
            self._fail(error)
            if self.folder is not None and not self.folder.exists():
                self._lose()
            return
        with self._guard:
            self._path, self._file, self._good, self._torn, self._durable = path, file, 0, False, False
            self._files = journal_files(self.folder)
        self.write_held()
        with suppress(WriteError):  # the head tells it, too
            about = {name: self.head.get(name) for name in ("name", "path", "clock")}
            entries.change_about(self.folder, **about, state="open", program=program_ident())

    def sync(self) -> None:
        """Brings what is written to disk.  What a disk refused once is written again, to another file: it may have
        dropped it, and say otherwise when it is asked again."""
        with self._guard:
            file, count, self.sync_at = self._file, len(self._recent), None
            self._syncing = file is not None
        if file is None:
            return
        try:
            if not self.is_whole:
                self._start_again(file)
                return
            if count or not self._durable:
                (os.fdatasync if hasattr(os, "fdatasync") else os.fsync)(file)
            if not self._durable:
                assert self._path is not None
                for folder in (self._path.parent, self._path.parent.parent, self._path.parent.parent.parent):
                    sync_folder(folder)
                self._durable = True
        except OSError as error:
            with self._guard:
                self._fail(error)
                self._unsure = True
                self._go_on_in_another()
            return
        finally:
            self._syncing = False
        with self._guard:
            if self._unsure:
                self._unsure, self.fault = False, None
            for _ in range(count):
                self._recent.popleft()

    def finish(self) -> None:
        """Closes the files of an entry that is ended, and keeps it in the bin, or deletes it."""
        with suppress(OSError, WriteError):
            if self.folder is None or self.end is End.STAYS:
                pass
            elif self.end is End.BIN:
                entries.change_about(self.folder, state="closed", days=0)
            else:
                entries.remove_entry(self.folder)
        for remnant in self._remnants if self.end is End.DELETED else ():
            shutil.rmtree(remnant, ignore_errors=True)
        if self._file is not None:
            with suppress(OSError):
                os.close(self._file)
        entries.unlock_entry(self._lock)
        self._file = self._lock = None

    def _start_again(self, file: int) -> None:
        """Writes all again that the file held which is gone; if others came before it, only the engine can tell what
        those held."""
        try:
            again = [framed(frame) for frame in frames_in(os.pread(file, self._good, 0))[0]]
        except OSError:
            again = list(self._recent)
        with self._guard:
            os.close(file)
            self._file = None
            self.held.extendleft(reversed(again))
        self._lose()

    def _lose(self) -> None:
        """Does without the folder.  Where it held more than what is in memory, nothing can be written until all is told
        anew."""
        with self._guard:
            entries.unlock_entry(self._lock)
            if self.folder is not None:
                self._remnants.append(self.folder)
            self._lock = self.folder = None
            self._recent.clear()
            self.lost, self.fault = True, _GONE
            self.lacks = self._after >= 0
            if self.lacks:
                self.held.clear()

    def _go_on_in_another(self) -> None:
        """What is not synced for sure is written again to the next file, which goes on after what is."""
        assert self._file is not None
        os.close(self._file)
        self._file = None
        again = [*self._recent, *self.held]
        first = self._sequence + 1 - len(again)
        if first == self._first:  # nothing of this file is sure
            again.pop(0)
        else:
            self._first = self._after = first - 1
        head = framed(Frame(self._first, Kind.HEAD, _told_head(self.head, self._after)))
        self._number, self.held = self._number + 1, deque([head, *again])
        self._recent.clear()


def _told_head(head: Mapping[str, object], after: int) -> bytes:
    return told_object({**head, "after": after})
