"""The background worker: one thread on which the engine lives.

The window posts frozen requests and drains read-only results; it never waits.  Commands and strokes are carried out in
the order of posting; between them the thread works off the newest view request, tile by tile, most urgent first,
so that anything newer is seen after at most one tile; in turns with the window where that wants the processor, too.
"""

from __future__ import annotations

import logging
import math
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from engine.studio.requests import Look, Request, Swatch
from engine.studio.results import Note, Patch, Pending, Result, Same, Stopped

if TYPE_CHECKING:
    from engine.studio.journalled.posts import Posts


class Bench(Protocol):
    """What the thread works at: a `Studio`, or a stand-in for tests."""

    def do(self, request: Request) -> None:
        """Carries out a request that changes something; sends its results."""
        ...

    def look(self, request: Look) -> None:
        """Takes over what is wanted on the screen."""
        ...

    def step(self) -> bool:
        """Returns the most urgent piece of open work; False when there is none."""
        ...

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        ...

    @property
    def due(self) -> float | None:
        """When `play` is to be called next, by the monotonic clock; None when nothing plays."""
        ...

    def secure(self) -> None:
        """Has the journal whole: a fault ends the thread."""
        ...

    @property
    def waits(self) -> bool:
        """Tells whether requests that it took over are still to be carried out."""
        ...

    @property
    def unseen(self) -> bool:
        """Tells whether pictures wait for what nobody can do now."""
        ...

    def play(self) -> None:
        """Plays the next piece."""
        ...

    def close(self) -> None:
        """Waits for its threads; what they have posted is carried out afterwards."""
        ...


_LOGGER = logging.getLogger("inkfall")
_NOT_LOADED = Note(
    "The paint engine did not load", True, fault=True, stays=True, offers=("copy_details",), about="engine"
)
PASSING, _SHARE = 0.2, 4.0  # seconds of work on tiles after which they let a swatch pass; and times what the last took
_PATIENCE, LONGER = 0.05, 1.0  # seconds that open work waits for its turn, at most; and that a swatch does
_Maker = Callable[[Callable[[Result], None], Callable[[Request], None]], Bench]  # of `send` and `post`


def _studio(send: Callable[[Result], None], post: Callable[[Request], None], posts: Posts | None = None) -> Bench:
    from engine.studio.preparing.job_queue import PLAIN_PAINT
    from engine.studio.preparing.processes import Preparing

    preparing = Preparing()
    preparing.want(PLAIN_PAINT, soon=True)  # its processes load while the studio does

    from engine.keeping.spill import spill
    from engine.studio.filing.beginning import begun
    from engine.studio.held.holding import Holding
    from engine.studio.preparing.waiting import Waiting
    from engine.studio.studio import Studio  # here, on the thread: it loads numba
    from engine.texture.expression.kept_squares import SQUARES

    if posts is not None:
        posts.is_compiling = lambda: preparing.busy
    SQUARES.put = spill().put_spare
    studio = Studio(send, post, posts, begun(send))
    studio.holding = Holding(studio.easel)
    return Waiting(studio, preparing, send)


class Worker:
    """The thread.  `wake` is called from it whenever results lie ready; it must be safe to call from any thread.
    `posts`: takes what is posted to the journal; `before`: the worker that has stopped and this one takes the place of,
    whose journal is closed first; `journal`: what keeps what is painted, None where nothing does."""

    def __init__(
        self,
        wake: Callable[[], None],
        make: _Maker = _studio,
        posts: Posts | None = None,
        before: Worker | None = None,
    ) -> None:
        self._before, self._stopped = before, False
        self._wake, self._make, self._posts = wake, make if posts is None else partial(_studio, posts=posts), posts
        self.journal = None if posts is None else posts.journal
        self._stays = True  # whether the painting is to be recovered
        if posts is not None:
            posts.hear(self._send, self.post)
        self._posted: deque[Request] = deque()
        self._look: Look | None = None
        self._swatches: dict[str, Swatch] = {}
        self._passing = 0.0  # until when tiles let none pass
        self._turn: float | None = None  # when it ends; None: it does not
        self._worked = 0.0  # when a piece of work was last begun that waits for its turn
        self._asked = 0.0  # when the first of the swatches was
        self._results: deque[Result] = deque()
        self._signal = threading.Condition()
        self._closing = False
        self._doing = False  # a command
        self._waiting = False  # commands that the bench has taken over
        self._open = False  # work of the bench, when it was last looked at
        self._told = -1
        self._thread = threading.Thread(target=self._run, name="inkfall engine", daemon=True)
        self._thread.start()

    def post(self, request: Request) -> None:
        """Leaves a request; returns at once."""
        if self._posts is not None:
            self._posts.tell(request)
        with self._signal:
            if isinstance(request, Look):
                self._look = request
            elif isinstance(request, Swatch):
                self._asked = self._asked if self._swatches else time.monotonic()
                self._swatches[request.ident] = request
            else:
                self._posted.append(request)
            self._signal.notify()

    def turn(self, end: float | None) -> None:
        """Open work, and what plays, is begun until `end`, by the monotonic clock, then after the next call; None: at
        any time.  Swatches, which take longer, wait until then.  For a window that wants the processor now and then: no
        piece waits longer than `_PATIENCE`, and no swatch than `LONGER`.  Commands are not held up; what they have to
        show is not later than it would be, if the turn begins as a frame ends."""
        if end == self._turn:
            return
        with self._signal:
            self._turn = end
            self._signal.notify()

    @property
    def ready(self) -> bool:
        """Tells whether results lie ready."""
        return bool(self._results)

    @property
    def entry(self) -> Path | None:
        """Returns the folder that keeps what is painted; None if there is none."""
        return None if self.journal is None else self.journal.entry.folder

    def results(self, seen: bool = False) -> list[Result]:
        """Returns what came since the last call, in order; `seen`: only what is to be seen of the painting, as far as
        nothing else came before it."""
        out: list[Result] = []
        while self._results and not (seen and not isinstance(self._results[0], Patch | Same | Pending)):
            out.append(self._results.popleft())
        return out

    @property
    def behind(self) -> bool:
        """Tells whether commands are still to be carried out, or their results to be taken."""
        with self._signal:
            return bool(self._posted) or self._doing or self._waiting or bool(self._results)

    @property
    def settled(self) -> bool:
        """Tells whether all that was posted is carried out, and all that is to be seen of it was made and taken."""
        with self._signal:
            return self._look is None and not self._open and not self.behind

    def close(self, timeout: float | None = 10.0, by_choice: bool = True) -> bool:
        """Ends the thread after what was posted before is done and files are written; waits so many seconds for it,
        at most, and tells whether it has ended.  `by_choice`: the artist closed the painting as it is; else it is to be
        recovered."""
        with self._signal:
            self._closing, self._stays = True, not by_choice
            self._signal.notify()
        self._thread.join(timeout)
        if self._stopped and self._posts is not None:
            self._posts.close(stays=True)
        return not self._thread.is_alive()

    def _send(self, result: Result) -> None:
        self._results.append(result)
        self._wake()

    def _next(self, bench: Bench) -> Callable[[], None] | None:
        """Does the next piece of work: commands first, then the newest look, then its tiles, which let a swatch pass
        now and then, then swatches; None to end."""
        with self._signal:
            while True:
                self._doing, self._waiting = bool(self._posted), bench.waits
                self._open = self._look is not None or bench.pending > 0 or bench.unseen
                if self._posted:
                    request = self._posted.popleft()
                    return lambda: bench.do(request)
                if self._closing:
                    return None
                if self._look is not None:
                    look, self._look = self._look, None
                    return lambda: bench.look(look)
                now = time.monotonic()
                open_in, swatch_in, play_in = self._waits(bench, now)
                if bench.pending and open_in <= 0.0 and not (swatch_in <= 0.0 and now > self._passing):
                    self._worked = now
                    return lambda: (bench.step(), None)[1]
                if swatch_in <= 0.0:
                    self._worked = self._asked = now
                    swatch = self._swatches.pop(_foremost(self._swatches))

                    def paint(swatch: Swatch = swatch, begun: float = now) -> None:
                        bench.do(swatch)
                        ended = time.monotonic()
                        self._passing = ended + max(PASSING, _SHARE * (ended - begun))

                    return paint
                if play_in <= 0.0:
                    self._worked = now
                    return bench.play
                rest = min(open_in, swatch_in, play_in)
                self._signal.wait(None if rest == math.inf else rest)

    def _waits(self, bench: Bench, now: float) -> tuple[float, float, float]:
        """Returns seconds until open work, a swatch, and what plays, may be begun; endless where there is none."""
        turn = swatch_in = 0.0
        if self._turn is not None:
            if now >= self._turn:
                turn = max(0.0, self._worked + _PATIENCE - now)
            swatch_in = max(0.0, self._asked + LONGER - now)
        open_in = turn if bench.pending else math.inf
        play_in = math.inf if bench.due is None else max(turn, bench.due - now)
        return open_in, swatch_in if self._swatches else math.inf, play_in

    def _run(self) -> None:
        before, self._before = self._before, None
        if before is not None and before._posts is not None:
            before._posts.close(stays=True)
        try:
            bench = self._make(self._send, self.post)
        except Exception as error:
            _LOGGER.error("the paint engine did not load", exc_info=error)
            self._send(_NOT_LOADED)
            return
        try:
            self._work(bench)
            bench.close()
            self._work(bench)  # what the threads that wrote files have posted
        except BaseException as error:
            _LOGGER.critical("a fault that ends the engine's thread", exc_info=error)
            with suppress(Exception):
                bench.secure()
            self._stopped = True
            self._send(Stopped())
            return
        if self._posts is not None:
            self._posts.close(self._stays)

    def _work(self, bench: Bench) -> None:
        """Does what is to be done, until the worker is closed and nothing posted is left."""
        while (work := self._next(bench)) is not None:
            try:
                work()
            except Exception as error:  # the painting is a value: whatever failed left it as it was
                self._send(_told(error))
            self._tell(bench)

    def _tell(self, bench: Bench) -> None:
        """Sends how much waits, when that has changed and the work is done or long."""
        pending = bench.pending
        if pending != self._told and (pending == 0 or pending % 8 == 0):
            self._told = pending
            self._send(Pending(pending))


def _foremost(swatches: Mapping[str, Swatch]) -> str:
    """Returns the swatch that is painted next: of those that are wanted soon, or of all, the one that waits longest."""
    soon = (ident for ident, swatch in swatches.items() if swatch.soon)
    return next(soon, None) or next(iter(swatches))


def _told(error: Exception) -> Note:
    """Returns what the window is told of an error."""
    from engine.studio.faults import told  # here, on the thread: it loads what the errors are of

    return told(error, "on the engine's thread")
