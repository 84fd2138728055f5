"""What lies beside a journal: checkpoints, a small picture, the pictures that definitions name, the file that was
opened.

A thread writes it that has less of the processor than what paints.  What it cannot write is done without: the journal
tells all that was painted.
"""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from engine.archive.saving_turn import SAVING
from engine.canvas.layers import Group, pictured
from engine.checks.owned import Owned
from engine.files.atomic import replacing
from engine.files.fault import Cancelled, FileError
from engine.files.png_writer import write_png
from engine.journal.checkpoints import write_checkpoint
from engine.journal.entries import PICTURE_FILE
from engine.journal.journal import Journal
from engine.journal.kept import keep_source
from engine.journal.records import Kind, told_object
from engine.journal.volume import Volume
from engine.journal.writing import RETRY
from engine.keeping import memory
from engine.keeping.giving_way import give_way
from engine.numeric.colour import to_rgba8
from engine.painting.grown import waiting
from engine.painting.rendering import strips
from engine.painting.textures import Texture
from engine.painting.value import Painting
from engine.studio.journalled.opened import Opened, in_folder

_LOGGER = logging.getLogger("inkfall")
SMALL = 256  # pixels: the picture's sides at most
LIMIT = 1.0  # seconds of carrying out after which a checkpoint is written: more comes until it is on disk
PATIENCE = 3.0  # times that long one waits until what is painted with examples has grown by itself
PAUSE_FACTOR = 1.0  # times as long as a checkpoint took until the next is begun, at least
PICTURE_PAUSE = 5.0  # seconds between two small pictures, at least
PREPARING = 0.25  # seconds from one look at whether kernels are still being compiled, or a file written, to the next
_MOST_FAILURES = 5  # each of which doubles the time until a checkpoint is tried again
LULL = 2.0  # seconds from when a checkpoint gave way to the next, at least


class Beside(Owned):
    """It belongs to the engine's thread, and gives its own nothing but values.

    `is_compiling` tells whether kernels are being compiled in other processes: until they are there, nothing is begun
    that needs any, as nobody else could load one while this thread compiled it.  `wake` has the engine's thread `rest`,
    as something has ended here.
    `spent`: seconds that what came after the last checkpoint took to be carried out; `due`: when there will be
    something to be done at `rest`, by the monotonic clock, None if that is not known.
    """

    def __init__(
        self,
        journal: Journal,
        is_compiling: Callable[[], bool] = lambda: False,
        wake: Callable[[], None] = lambda: None,
    ) -> None:
        self._journal, self._entry = journal, journal.entry
        self._pool = ThreadPoolExecutor(1, "inkfall beside", initializer=give_way)
        self._closing = threading.Event()
        self._is_compiling, self._wake = is_compiling, wake
        self._opened = Opened(journal, self.do, wake)
        self._writing: Future[_Ended] | None = None
        self._written_of: Group | None = None  # the layers of which that is
        self._gives_way = True  # whether the next checkpoint does, to a save
        self._owed = 0.0  # `spent` before that one
        self._failures = 0  # to write one, in a row
        self._generation = int(time.time())  # none that an entry had before
        self._next, self._pictured = 0.0, 0.0  # when a checkpoint may be begun, and a picture was
        self._seen = True  # the small picture shows the painting as it is
        self.spent = 0.0
        self.due: float | None = None

    def changed(self) -> None:
        """A command was carried out."""
        self._seen = False
        self._opened.keep()

    def roots(self) -> list[Group]:
        """Returns the layers of what is being written."""
        return [] if self._written_of is None else [self._written_of]

    def replaces(self, path: Path) -> Callable[[], None]:
        """A file is going to be written: has what was opened kept; returns what waits for that on any thread, if this
        is the file that was opened."""
        return self._opened.replaces(path)

    def keep(self, texture: Texture) -> None:
        """A texture was defined: its pictures are kept."""
        for source in texture.pictures:
            self.do(partial(in_folder, self._entry, partial(keep_source, source=source)))

    def rest(self, painting: Painting, count: int) -> None:
        """Nothing is being painted: writes what is due of the painting after `count` commands."""
        self.due, now = None, time.monotonic()
        if self._closing.is_set():
            return
        if self._opened.is_gone():  # only the painting itself is left
            self.spent = max(self.spent, PATIENCE * LIMIT)
        if self._writing is not None and self._writing.done():
            self._written(self._writing.result(), now)
        waits = [self._opened.keep_late(now)]
        if self._is_compiling():
            waits.append(now + PREPARING if self.spent >= LIMIT or not self._seen else math.inf)
        else:
            waits += [self._check(painting, count, now), self._depict(painting, now)]
        due = min(waits)
        self.due = None if due == math.inf else due

    def _written(self, ended: _Ended, now: float) -> None:
        """A checkpoint has ended.  One that gave way to a save, or as memory was short, is written after it, and then
        gives way to nothing."""
        self._writing, self._written_of, took = None, None, ended.took
        self._gives_way = not ended.gave_way
        if ended.gave_way:
            self._next, self.spent = now + LULL, max(self.spent, self._owed)
        elif took is None:
            self._next, self.spent = now + RETRY * 2**self._failures, max(self.spent, self._owed)
            self._failures = min(self._failures + 1, _MOST_FAILURES)
        else:
            self._next, self._failures = now + PAUSE_FACTOR * took, 0

    def _check(self, painting: Painting, count: int, now: float) -> float:
        """Begins a checkpoint, if one is due; returns when one will be."""
        if self._writing is not None or self.spent < LIMIT:
            return math.inf  # who ends it wakes this thread
        if now < self._next:
            return self._next
        if not SAVING.free:
            return now + PREPARING
        if waiting(painting.root) and self.spent < PATIENCE * LIMIT:
            return now + LIMIT
        self._owed, self.spent, self._generation = self.spent, 0.0, self._generation + 1
        about = _Generation(self._generation, painting, count, self._closing.is_set, self._gives_way)
        wake = self._wake
        self._written_of = painting.root
        self._writing = self._pool.submit(_checkpoint, self._journal, self._entry, about)
        self._writing.add_done_callback(lambda written: wake())
        return math.inf

    def _depict(self, painting: Painting, now: float) -> float:
        """Has the small picture written, if that is due; returns when it will be."""
        if not self._seen and now - self._pictured >= PICTURE_PAUSE and self._writing is None:
            if not SAVING.free:  # both together would take more memory than there may be
                return now + PREPARING
            self._pictured = now
            self._picture(painting)
        return math.inf if self._seen or self._writing is not None else self._pictured + PICTURE_PAUSE

    def leave(self, painting: Painting) -> None:
        """The painting is closed, or another one comes: the small picture shows it as it is."""
        if not self._seen:
            self._picture(painting)

    def turn(self, head: Mapping[str, object]) -> None:
        """Another painting is there, which began with `head`."""
        self._entry, self.spent, self._owed, self._seen = self._journal.entry, 0.0, 0.0, True
        self._opened.turn(head)

    def again(self) -> None:
        """The same painting goes on in another entry, with what it began with: all else is written again."""
        self._entry = self._journal.entry
        self._opened.turn({})
        self.spent, self._seen = max(self.spent, PATIENCE * LIMIT), False

    def do(self, job: Callable[[], None]) -> Future[None] | None:
        """Has a job done on the thread, after those that wait; returns what ends with it, None if it is closed."""
        with suppress(RuntimeError):
            return self._pool.submit(_tried, job)
        return None

    def close(self) -> None:
        """Does what waits; a checkpoint that is being written is given up."""
        self._closing.set()
        self._pool.shutdown()

    def _picture(self, painting: Painting) -> None:
        self._seen = True
        self.do(partial(in_folder, self._entry, partial(write_picture, painting=painting)))


# --- on the thread ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class _Generation:
    """A checkpoint to be written: its number, the painting after `count` commands, what tells whether it is given up,
    and whether it gives way to a save, and to a stroke for which memory is short."""

    number: int
    painting: Painting
    count: int
    given_up: Callable[[], bool]
    gives_way: bool


@dataclass(frozen=True, slots=True)
class _Ended:
    """What came of a checkpoint: seconds that it took, None if it was not written; whether it gave way."""

    took: float | None
    gave_way: bool


def write_picture(folder: Path, painting: Painting) -> None:
    """Writes the frame at most SMALL pixels wide and high.  WriteError if that cannot be done."""
    level, frame = 0, painting.frame
    while max(frame.width, frame.height) > SMALL:
        level -= 1
        frame = painting.frame.zoomed(level)
    planes = np.concatenate([strip.copy() for strip in strips(pictured(painting.root), level, frame)], axis=1)
    with replacing(folder / PICTURE_FILE) as file:
        write_png(file, to_rgba8(planes))


def _checkpoint(journal: Journal, entry: Volume, about: _Generation) -> _Ended:
    start, written, gave_way = time.monotonic(), list[int](), False

    def cancelled() -> bool:
        nonlocal gave_way
        gave_way = gave_way or (about.gives_way and (SAVING.wanted or memory.crowded()))
        return gave_way or about.given_up()

    def write(folder: Path) -> None:
        told = write_checkpoint(folder, about.number, about.painting, cancelled)
        journal.note(Kind.CHECKPOINT, told_object({**told, "commands": about.count}), entry)
        written.append(about.count)

    _tried(partial(in_folder, entry, write))
    memory.settle()
    return _Ended(time.monotonic() - start if written else None, not written and (gave_way or not SAVING.free))


def _tried(job: Callable[[], None]) -> None:
    try:
        job()
    except (Cancelled, FileError, OSError, MemoryError) as error:
        _LOGGER.info("beside the journal: %s", error)
    except Exception as error:
        _LOGGER.error("a fault, beside the journal", exc_info=error)
