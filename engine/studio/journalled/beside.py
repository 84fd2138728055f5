"""What lies beside a journal: checkpoints, a small picture, the pictures that definitions name, the file that was
opened.

A thread writes it that has less of the processor than what paints.  What it cannot write is done without: the journal
tells all that was painted.
"""

from __future__ import annotations

import logging
import os
import threading
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from engine.checks.field_error import FieldError
from engine.checks.owned import Owned
from engine.files.atomic import replacing
from engine.files.fault import Cancelled, FileError
from engine.files.png_writer import write_png
from engine.journal.checkpoints import write_checkpoint
from engine.journal.entries import PICTURE_FILE
from engine.journal.heads import FileStamp
from engine.journal.journal import Journal
from engine.journal.kept import keep_file, keep_source, stamp_of
from engine.journal.records import Kind, told_object
from engine.journal.volume import End, Volume
from engine.numeric.colour import to_rgba8
from engine.painting.grown import waiting
from engine.painting.rendering import strips
from engine.painting.textures import Texture
from engine.painting.value import Painting

_LOGGER = logging.getLogger("inkfall")
SMALL = 256  # pixels: the picture's sides at most
LIMIT = 1.0  # seconds of carrying out after which a checkpoint is written: more comes until it is on disk
PATIENCE = 3.0  # times that long one waits until what is painted with examples has grown by itself
PAUSE_FACTOR = 1.0  # times as long as a checkpoint took until the next is begun, at least
PICTURE_PAUSE = 5.0  # seconds between two small pictures, at least
FOLDER_PATIENCE = 10.0  # seconds that what lies beside a journal waits for its folder, at most
_POLL = 0.01  # seconds
_NICE = 10


class Beside(Owned):
    """It belongs to the engine's thread, and gives its own nothing but values.

    `is_compiling` tells whether kernels are being compiled in other processes: until they are there, nothing is begun
    that needs any, as nobody else could load one while this thread compiled it.
    `spent`: seconds that what came after the last checkpoint took to be carried out.
    """

    def __init__(self, journal: Journal, is_compiling: Callable[[], bool] = lambda: False) -> None:
        self._journal, self._entry = journal, journal.entry
        self._pool = ThreadPoolExecutor(1, "inkfall beside", initializer=_yield)
        self._closing, self._urgent = threading.Event(), threading.Event()
        self._is_compiling = is_compiling
        self._stamp: FileStamp | None = None  # of the file that was opened, before it is kept
        self._keeping: tuple[Path, Future[None]] | None = None  # that file, and what ends when it is kept
        self._writing: Future[float] | None = None  # gives how long it took
        self._generation = int(time.time())  # none that an entry had before
        self._next, self._pictured = 0.0, 0.0  # when a checkpoint may be begun, and a picture was
        self._seen = True  # the small picture shows the painting as it is
        self.spent = 0.0

    def changed(self) -> None:
        """A command was carried out."""
        self._seen = False
        self._keep_opened()

    def replaces(self, path: Path) -> Callable[[], None]:
        """A file is going to be written: has what was opened kept; returns what waits for that on any thread, if this
        is the file that was opened."""
        self._keep_opened()
        keeping = self._keeping

        def wait() -> None:
            if keeping is not None and os.path.realpath(keeping[0]) == os.path.realpath(path):
                keeping[1].exception()

        return wait

    def keep(self, texture: Texture) -> None:
        """A texture was defined: its pictures are kept."""
        for source in (texture.source, texture.mask):
            if source is not None:
                self.do(partial(_in_folder, self._entry, partial(keep_source, source=source)))

    def rest(self, painting: Painting, count: int) -> None:
        """Nothing is being painted: writes what is due of the painting after `count` commands."""
        now = time.monotonic()
        if self._entry.lost or self._urgent.is_set():  # what lay there is gone, or will be
            self._entry.lost, self.spent = False, max(self.spent, PATIENCE * LIMIT)
            self._urgent.clear()
        if self._writing is not None and self._writing.done():
            self._next, self._writing = now + PAUSE_FACTOR * self._writing.result(), None
        if self._is_compiling():
            return
        if self._writing is None and self.spent >= LIMIT and now >= self._next:
            if not waiting(painting.root) or self.spent >= PATIENCE * LIMIT:
                self.spent, self._generation = 0.0, self._generation + 1
                about = _Generation(self._generation, painting, count, self._closing.is_set)
                self._writing = self._pool.submit(_checkpoint, self._journal, self._entry, about)
        elif not self._seen and now - self._pictured >= PICTURE_PAUSE:
            self._pictured = now
            self._picture(painting)

    def leave(self, painting: Painting) -> None:
        """The painting is closed, or another one comes: the small picture shows it as it is."""
        if not self._seen:
            self._picture(painting)

    def turn(self, head: Mapping[str, object]) -> None:
        """Another painting is there, which began with `head`."""
        self._entry, self._stamp, self.spent, self._seen = self._journal.entry, None, 0.0, True
        self._keeping = None
        base = head.get("base")
        if isinstance(base, Mapping) and "file" in base:
            with suppress(FieldError):
                self._stamp = stamp_of(base)

    def do(self, job: Callable[[], None]) -> Future[None] | None:
        """Has a job done on the thread, after those that wait; returns what ends with it, None if it is closed."""
        with suppress(RuntimeError):
            return self._pool.submit(_tried, job)
        return None

    def close(self) -> None:
        """Does what waits; a checkpoint that is being written is given up."""
        self._closing.set()
        self._pool.shutdown()

    def _keep_opened(self) -> None:
        """Has the file kept that was opened, once."""
        if self._stamp is not None:
            stamp, self._stamp = self._stamp, None
            ended = self.do(partial(_keep_file, self._journal, self._entry, stamp, self._urgent))
            self._keeping = None if ended is None else (stamp.path, ended)

    def _picture(self, painting: Painting) -> None:
        self._seen = True
        self.do(partial(_in_folder, self._entry, partial(write_picture, painting=painting)))


# --- on the thread ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class _Generation:
    """A checkpoint to be written: its number, the painting after `count` commands, and what asks whether it is still
    wanted."""

    number: int
    painting: Painting
    count: int
    cancelled: Callable[[], bool]


def write_picture(folder: Path, painting: Painting) -> None:
    """Writes the frame at most SMALL pixels wide and high.  WriteError if that cannot be done."""
    level, frame = 0, painting.frame
    while max(frame.width, frame.height) > SMALL:
        level -= 1
        frame = painting.frame.zoomed(level)
    planes = np.concatenate([strip.copy() for strip in strips(painting.root, level, frame)], axis=1)
    with replacing(folder / PICTURE_FILE) as file:
        write_png(file, to_rgba8(planes))


def _checkpoint(journal: Journal, entry: Volume, about: _Generation) -> float:
    """Returns seconds that it took."""
    start = time.monotonic()

    def write(folder: Path) -> None:
        told = write_checkpoint(folder, about.number, about.painting, about.cancelled)
        journal.note(Kind.CHECKPOINT, told_object({**told, "commands": about.count}), entry)

    _tried(partial(_in_folder, entry, write))
    return time.monotonic() - start


def _keep_file(journal: Journal, entry: Volume, stamp: FileStamp, urgent: threading.Event) -> None:
    """Keeps the file that was opened; where it is another one already, only the painting itself is left."""
    folder = _folder(entry)
    if folder is None:
        return
    try:
        sha = keep_file(folder, stamp)
    except FileError:
        urgent.set()
        raise
    journal.note(Kind.BASE, told_object({"sha": sha}), entry)


def _in_folder(entry: Volume, job: Callable[[Path], None]) -> None:
    folder = _folder(entry)
    if folder is not None and entry.end is not End.DELETED:
        job(folder)


def _folder(entry: Volume) -> Path | None:
    """Returns an entry's folder, which the journal's thread is about to make; None where it cannot, or is late."""
    end = time.monotonic() + FOLDER_PATIENCE
    while entry.folder is None and entry.fault is None and entry.end is None and time.monotonic() < end:
        time.sleep(_POLL)
    return entry.folder


def _yield() -> None:
    """Lets threads that paint go first, where the system can tell threads apart."""
    with suppress(OSError, AttributeError):
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), _NICE)


def _tried(job: Callable[[], None]) -> None:
    try:
        job()
    except (Cancelled, FileError, OSError, MemoryError) as error:
        _LOGGER.info("beside the journal: %s", error)
    except Exception as error:
        _LOGGER.error("a fault, beside the journal", exc_info=error)
