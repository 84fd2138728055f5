"""The journal of the painting that is open: any thread appends records, one frame and one write each.

That takes some microseconds; what cannot be written stays in memory, and is written as soon as that can be done.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from engine.journal import entries
from engine.journal.records import ASKED, NUMBER, Kind, told_points
from engine.journal.volume import Continued, End, Volume
from engine.journal.writing import SYNC_DOWN, Writing
from engine.painting.points import ALWAYS, like_first

CLOSING = 5.0  # seconds that closing waits for a disk, at most
BATCH = 0.04  # seconds that points wait for more of them; none is older than 50 ms when it is written


class Journal:
    """The journal of one painting after another.  Any thread may call it.

    `head`: what the first painting begins with; `folder`: of all entries.
    """

    def __init__(self, head: Mapping[str, object], folder: Path | None = None) -> None:
        self._folder = folder or entries.paintings_folder()
        self._asked: dict[int, list[tuple[Kind, bytes]]] = {}  # what has no answer
        self._points: list[np.ndarray] = []  # that wait for more
        self._stroke, self._since = 0, 0.0  # what they belong to, and since when the first waits
        self._count = 0
        self._writing = Writing(lambda guard: Volume(self._folder, head, guard), self._flush_late)

    @property
    def entry(self) -> Volume:
        """Returns the entry of the present painting, which may not have a folder yet."""
        return self._writing.now

    @property
    def settled(self) -> bool:
        """Tells whether all that was appended is on disk."""
        with self._writing.guard:
            return self._writing.now.settled and not self._points

    def hear(self, tell: Callable[[str | None], None], wake: Callable[[], None] = lambda: None) -> None:
        """Has `tell` called, on the journal's thread, with why it cannot be written, and None when it can again; and
        `wake`, as long as the present entry is lost and is not begun anew."""
        with self._writing.guard:
            self._writing.hear(tell, wake)

    # --- what is asked for --------------------------------------------------------------------------------------------

    def begin(self, touch: bytes) -> int:
        """The pen touches down, as `records.told_touch` tells; returns the stroke's number."""
        return self._number(Kind.BEGIN, touch)

    def ask(self, command: bytes) -> int:
        """A command is asked for, as `records.told_command` tells; returns its number."""
        return self._number(Kind.ASK, command)

    def points(self, stroke: int, points: np.ndarray) -> None:
        """More points of the stroke, float64 (n, 6): written with those that come within BATCH seconds."""
        with self._writing.guard:
            now = time.monotonic()
            if not self._points:
                self._stroke, self._since = stroke, now
            self._points.append(points)
            if now - self._since >= BATCH:
                self._flush()
            self._writing.look_at(self._since + BATCH if self._points else now + SYNC_DOWN)

    def end(self, stroke: int, kept: bool) -> None:
        """The pen lifts, or the stroke is dropped."""
        with self._writing.guard:
            self._flush()
            told = Kind.FINISH if kept else Kind.ABANDON, NUMBER.pack(stroke)
            self._writing.append(*told)
            if kept:
                self._asked.get(stroke, []).append(told)
            else:
                self._asked.pop(stroke, None)

    def _number(self, kind: Kind, told: bytes) -> int:
        with self._writing.guard:
            self._flush()
            self._count += 1
            payload = ASKED.pack(self._count, time.time()) + told
            self._asked[self._count] = [(kind, payload)]
            self._writing.append(kind, payload)
            return self._count

    def _flush(self) -> None:
        """Writes the points that wait."""
        if self._points:
            whole = like_first(self._points)
            told = (
                Kind.POINTS if whole.shape[1] == ALWAYS else Kind.TURNED,
                NUMBER.pack(self._stroke) + told_points(whole),
            )
            self._asked.get(self._stroke, []).append(told)
            self._points = []
            self._writing.append(*told)

    def _flush_late(self, now: bool) -> float | None:
        """Writes the points that have waited long enough, or wait `now`; returns when others will have."""
        if self._points and (now or time.monotonic() >= self._since + BATCH):
            self._flush()
        return self._since + BATCH if self._points else None

    # --- what became of it --------------------------------------------------------------------------------------------

    def answer(self, number: int, kind: Kind, told: bytes = b"", last: bool = True) -> bool:
        """Tells what became of what has a number: DONE or REFUSED; `last`: nothing more comes of it.  False if that is
        not waited for, and is not told."""
        with self._writing.guard:
            found = number in self._asked
            if found:
                self._writing.append(kind, NUMBER.pack(number) + told)
            if last:
                self._asked.pop(number, None)
            return found

    def note(self, kind: Kind, told: bytes, of: Volume | None = None) -> None:
        """Tells what nobody asked for; `of`: only if that is still the entry of the present painting."""
        with self._writing.guard:
            if of is None or of is self._writing.now:
                self._writing.append(kind, told)

    def turn(self, head: Mapping[str, object], end: End, continued: Continued | None = None) -> None:
        """Another painting is on the easel, which begins with `head`, or goes on where its entry stopped; what has no
        answer yet is asked of it.  `end`: what becomes of the one that was."""
        with self._writing.guard:
            self._flush()
            after = Volume(self._folder, head, self._writing.guard, continued)
            self._writing.turn(after, end, list(self._asked))
            for told in self._asked.values():
                for kind, payload in told:
                    self._writing.append(kind, payload)

    def close(self, end: End) -> None:
        """Brings all to disk, as far as that can be done now, and ends the thread, for which it waits CLOSING seconds
        at most."""
        with self._writing.guard:
            self._flush()
            thread: threading.Thread = self._writing.close(end)
        thread.join(CLOSING)
