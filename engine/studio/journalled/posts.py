"""What the window asks for, told to the journal before the engine hears of it."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

from engine.journal.journal import Journal
from engine.journal.records import Touch, told_brush, told_command, told_touch
from engine.journal.volume import End
from engine.painting.times import timed
from engine.studio import requests as q
from engine.studio.journalled.tend_request import Tend
from engine.studio.results import Note, Result
from engine.studio.selecting.tint_records import MaskBegin, MaskEnd, MaskPoints

_LOGGER = logging.getLogger("inkfall")


class Posts:
    """The strokes and commands that were posted, by the numbers that the journal gave them.  `tell` is called by the
    thread that posts, the others by the engine's.  `is_modified`: whether the painting's file lacks any of it;
    `is_compiling`: whether kernels are being compiled in processes of their own; `wake`, on any thread, has the engine
    look after the journal."""

    def __init__(self, journal: Journal) -> None:
        self.journal = journal
        self._lock = threading.Lock()
        self._open: dict[int, q.Request] = {}  # by their numbers: strokes and commands without an answer
        self._stroke = 0
        self.is_modified: Callable[[], bool] = lambda: True
        self.is_compiling: Callable[[], bool] = lambda: False
        self.wake: Callable[[], None] = lambda: None
        self._brush: tuple[object, str] = (None, "")  # the last one, and its text

    def tell(self, request: q.Request) -> None:
        """Tells the journal of a request, if it is a stroke's or a command."""
        match request:
            case q.Points() | MaskPoints():
                self.journal.points(self._stroke, request.points)
            case q.Begin() | q.Do() | MaskBegin():
                try:
                    self._number(request)
                except (ValueError, TypeError) as error:  # it will be told when it is done, if it can be
                    self._stroke = 0
                    _LOGGER.error("a fault, while the journal was told", exc_info=error)
            case q.Finish() | q.Abandon():
                self.journal.end(self._stroke, isinstance(request, q.Finish))
            case MaskEnd():  # a command tells the journal, if it was not dropped
                self.journal.end(self._stroke, False)

    def hear(self, send: Callable[[Result], None], post: Callable[[q.Request], None]) -> None:
        """Has the window told when the journal cannot be written, and when it can again; the engine, when there is
        something to be done for it."""
        self.wake = lambda: post(Tend())
        self.journal.hear(lambda why: send(_note(why)), self.wake)

    def number(self, request: q.Request) -> int | None:
        """Returns the number of a request that has no answer yet; None if it has none."""
        with self._lock:
            return next((number for number, posted in self._open.items() if posted is request), None)

    def settle(self, number: int) -> None:
        """Forgets what has its answer."""
        with self._lock:
            self._open.pop(number, None)

    def close(self, stays: bool) -> None:
        """Closes the journal; the painting `stays` to be recovered, or was closed as it is."""
        self.journal.close(End.STAYS if stays else End.BIN if self.is_modified() else End.DELETED)

    def _number(self, request: q.Begin | q.Do | MaskBegin) -> None:
        if isinstance(request, MaskBegin):  # nothing of it is carried out before its end
            selects = "subtract" if request.takes else "add"
            self._begin(Touch(request.level, request.origin, request.brush, None, request.copies, selects=selects))
            return
        if isinstance(request, q.Do):
            number = self.journal.ask(told_command(timed(request.command, request.time)))
        else:
            about = request.level, request.origin, request.brush, request.time
            number = self._begin(Touch(*about, request.copies, request.layer, request.onto, seen=request.seen))
        with self._lock:
            self._open[number] = request

    def _begin(self, touch: Touch) -> int:
        if self._brush[0] is not touch.brush:
            self._brush = touch.brush, told_brush(touch.brush)
        self._stroke = self.journal.begin(told_touch(touch, self._brush[1]))
        return self._stroke


def _note(why: str | None) -> Note:
    if why is None:
        return Note("What you paint is on disk again", about="journal")
    text = f"What you paint is kept in memory only: {why}"
    return Note(text, bad=True, stays=True, offers=("free_space", "save_as"), about="journal")
