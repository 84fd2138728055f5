"""The thread that brings journals to disk: nobody else waits for a folder to be made, nor for a sync."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable

from engine.journal.records import NUMBER, Kind
from engine.journal.volume import End, Volume

_LOGGER = logging.getLogger("inkfall")
SYNC_UP, SYNC_DOWN = 0.4, 0.9  # seconds after which a sync begins: after what is whole, and of a stroke in progress
RETRY = 3.0  # seconds between two tries to write what could not be written
LOOK = 20.0  # seconds after which one looks whether the journal is still there, though nobody paints
_Tell = Callable[[str | None], None]
_Wake = Callable[[], None]
_PARTS = frozenset({Kind.BEGIN, Kind.POINTS, Kind.TURNED})  # of a stroke in progress


class Writing:
    """The volume that is written, and those that are closed and still to be brought to disk.  All is called with
    `guard` held; `make` makes the first volume.

    `flush` appends what waits to be, if it has waited long enough or is told that this is the end; it returns when it
    wants to be called again.
    """

    def __init__(self, make: Callable[[threading.Lock], Volume], flush: Callable[[bool], float | None]) -> None:
        self.guard = threading.Lock()
        self.now = make(self.guard)
        self._tell: _Tell = lambda why: None
        self._wake: _Wake = lambda: None
        self._flush = flush
        self._changed = threading.Condition(self.guard)
        self._closed: list[Volume] = []
        self._due: float | None = 0.0  # when the thread looks again; None: when it is woken
        self._closing = False
        self._told: str | None = None
        self._looked = time.monotonic()
        self._thread = threading.Thread(target=self._run, name="inkfall journal", daemon=True)
        self._thread.start()

    def hear(self, tell: _Tell, wake: _Wake) -> None:
        """Has `tell` called, on the thread, with why nothing can be written, and with None when it can again; and
        `wake`, as long as the present entry is lost."""
        self._tell, self._wake, self._told = tell, wake, None
        self.look_at(0.0)

    def append(self, kind: Kind, payload: bytes) -> None:
        """Writes a record of the present painting."""
        due = time.monotonic() + (SYNC_DOWN if kind in _PARTS else SYNC_UP)
        self.now.append(kind, payload)
        if self.now.sync_at is None or due < self.now.sync_at:
            self.now.sync_at = due
        self.look_at(due)

    def look_at(self, due: float) -> None:
        """Wakes the thread if it would look too late: each waking costs whoever appends some microseconds."""
        if self._due is None or due < self._due:
            self._due = due
            self._changed.notify()

    def turn(self, after: Volume, end: End, leaves: list[int]) -> None:
        """Goes on with another volume; the one before ends, and is told that the other has what it `leaves`."""
        before, self.now = self.now, after
        after.sync_at = 0.0  # what it begins with may be all that there is of a painting
        before.leaves = leaves
        before.end, before.sync_at = end, 0.0
        self._closed.append(before)
        self.look_at(0.0)

    def close(self, end: End) -> threading.Thread:
        """Ends the present volume, and the thread when all is on disk that can be brought there now; returns it."""
        self.now.end, self.now.sync_at, self._closing = end, 0.0, True
        self._changed.notify()
        return self._thread

    # --- on the thread ------------------------------------------------------------------------------------------------

    def _run(self) -> None:
        while True:
            closing = self._wait()
            with self.guard:
                volumes = [self.now, *self._closed]
            for volume in volumes:  # the present one first: the others wait for it
                try:
                    self._tend(volume)
                except Exception as error:
                    _LOGGER.error("a fault, while the journal was written", exc_info=error)
                    self._retry(volume)
            with self.guard:
                tell, before, self._told = self._tell, self._told, self.now.fault
            if self._told != before:
                tell(self._told)
            if self.now.lost:
                self._wake()
            if closing:
                return

    def _wait(self) -> bool:
        """Waits until there is something to do; tells whether this is the end."""
        with self.guard:
            while not self._closing and (self._due is None or (rest := self._due - time.monotonic()) > 0.0):
                self._changed.wait(None if self._due is None else rest)
            self._due = None
            again = self._flush(self._closing)
            if again is not None:
                self.look_at(again)
            return self._closing

    def _tend(self, volume: Volume) -> None:
        if volume is not self.now and self.now.held:
            return  # what had no answer is not yet written where it is asked now
        if not volume.open:
            volume.make()
        if volume.open and volume is self.now and time.monotonic() >= self._looked + LOOK:
            volume.sync_at = volume.sync_at or 0.0
        if volume.leaves:
            with self.guard:
                for number in volume.leaves:
                    volume.append(Kind.REFUSED, NUMBER.pack(number))
                volume.leaves = []
        volume.write_held()
        if volume.open and volume.sync_at is not None and (self._closing or volume.sync_at <= time.monotonic()):
            self._looked = time.monotonic()
            volume.sync()
            if not volume.open:
                volume.make()
                volume.write_held()
                volume.sync()
        self._go_on(volume)

    def _go_on(self, volume: Volume) -> None:
        """Ends a volume that is settled, or says when it is looked at again."""
        with self.guard:
            ends = volume.end is not None and (self._closing or volume.settled or volume.lacks)
            if not ends and volume.open and not volume.held:
                self.look_at(self._looked + LOOK if volume.sync_at is None else volume.sync_at)
        if ends:
            volume.finish()
            if volume in self._closed:
                self._closed.remove(volume)
        elif not volume.open or volume.held:
            self._retry(volume)

    def _retry(self, volume: Volume) -> None:
        with self.guard:
            volume.sync_at = volume.sync_at or 0.0
            self.look_at(time.monotonic() + RETRY)
