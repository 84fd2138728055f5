"""What sources of pens have in common that hear them on the window's own thread."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from app.input.events import PenEvent


class PenQueue:
    """Keeps events until they are asked for.  `near`: the pen moves the system's mouse too, whose events are not to
    count."""

    name = "pen"
    near = False

    def __init__(self, wake: Callable[[], None]) -> None:
        self._queue: deque[PenEvent] = deque()
        self._wake, self._heard = wake, False

    def hear(self, *events: PenEvent) -> None:
        """Takes in what a pen did."""
        self._queue.extend(events)
        self._heard = True
        self._wake()

    def events(self) -> list[PenEvent]:
        """Gives what came since the last call, in order."""
        out = list(self._queue)
        self._queue.clear()
        return out

    def tablets(self) -> list[str]:
        """Returns the name of what pens are heard by, once one was: no other name is known."""
        return [self.name] if self._heard else []
