"""The files that the window reads and writes: a thread of their own carries it out, and the window goes on drawing."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.desk.desk import Desk, FileWork
from app.faults.log import LOGGER, fault_words
from engine.files.fault import system_words

HANGING = 20.0  # seconds that the end of the program waits for its files


@dataclass(frozen=True, slots=True)
class Done:
    """Work that was carried out, and what it found; or why it was not."""

    work: FileWork
    found: Any = None
    fault: str = ""

    def arrive(self, desk: Desk) -> None:
        """Puts it on the desk; for the window's thread."""
        if self.fault:
            self.work.fail(desk, self.fault)
        else:
            self.work.arrive(desk, self.found)


def carried_out(work: FileWork) -> Done:
    """Does the first half of some work, on the thread that calls it."""
    try:
        return Done(work, work.carry_out())
    except OSError as error:
        return Done(work, fault=system_words(error))
    except Exception as error:  # the others' files are still to be written
        return Done(work, fault=_told(error))


def _told(error: Exception) -> str:
    """Returns what the artist is told of an error, and logs it if it is a fault of the program's own."""
    from engine.studio.faults import EXPECTED, words  # here, on the thread: it loads what the errors are of

    if isinstance(error, EXPECTED):
        return words(error)
    LOGGER.error("a fault, while the window's files were read or written", exc_info=error)
    return fault_words()


class Files:
    """Carries out work in the order in which it is posted.  All calls come from the window's thread; `wake` is called
    from the other one whenever something is done."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._posted: deque[FileWork | None] = deque()
        self._done: deque[Done] = deque()
        self._open = 0  # what is posted and not taken
        self._signal = threading.Semaphore(0)
        self._thread = threading.Thread(target=self._run, name="inkfall files", daemon=True)
        self._thread.start()

    def post(self, work: FileWork) -> None:
        """Leaves some work; returns at once."""
        self._open += 1
        self._posted.append(work)
        self._signal.release()

    def take(self) -> list[Done]:
        """Returns what was done since the last call, in order."""
        found = []
        while self._done:
            found.append(self._done.popleft())
        self._open -= len(found)
        return found

    @property
    def busy(self) -> bool:
        """Tells whether work is to be done, or to be taken."""
        return self._open > 0

    def close(self) -> None:
        """Ends the thread when all that was posted is carried out; one that hangs, on a folder of a network that is
        gone, is left to itself after a while."""
        self._posted.append(None)
        self._signal.release()
        self._thread.join(HANGING)

    def _run(self) -> None:
        while True:
            self._signal.acquire()
            work = self._posted.popleft()
            if work is None:
                return
            self._done.append(carried_out(work))
            self._wake()
