"""One painting is written at a time: a save takes a hundred megabytes and more while it runs, two take them twice.

Who asks for a file waits for its turn, and what is written on its own account gives way to that.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from engine.files.fault import Cancelled
from engine.painting.rendering import Stop, check_cancelled

_LOOK = 0.1  # seconds from one look at whether a save is still wanted to the next


class SavingTurn:
    """Whose turn it is to write a painting.  Safe for several threads; who has it may take it again."""

    def __init__(self) -> None:
        self._turn, self._counting = threading.RLock(), threading.Lock()
        self._taken = self._waiting = 0

    @property
    def wanted(self) -> bool:
        """Tells whether somebody waits for it."""
        return self._waiting > 0

    @property
    def free(self) -> bool:
        """Tells whether nobody has it, and nobody waits."""
        return not (self._taken or self._waiting)

    @contextmanager
    def taken(self, cancelled: Stop = None) -> Iterator[None]:
        """Has it, after all who had it before.  Cancelled if that was asked for meanwhile."""
        self._count(waiting=1)
        try:
            while not self._turn.acquire(timeout=_LOOK):
                check_cancelled(cancelled)
        finally:
            self._count(waiting=-1)
        with self._had():
            yield

    @contextmanager
    def taken_if_free(self) -> Iterator[None]:
        """Has it at once.  Cancelled if somebody has it, or waits."""
        if self.wanted or not self._turn.acquire(blocking=False):
            raise Cancelled
        with self._had():
            yield

    @contextmanager
    def _had(self) -> Iterator[None]:
        self._count(taken=1)
        try:
            yield
        finally:
            self._count(taken=-1)
            self._turn.release()

    def _count(self, waiting: int = 0, taken: int = 0) -> None:
        with self._counting:
            self._waiting += waiting
            self._taken += taken


SAVING = SavingTurn()
