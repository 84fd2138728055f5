"""The studio before its brushes are ready: what needs a kernel that is not compiled waits, and keeps its place.

The engine's thread compiles nothing while processes do (`preparing`).  A stroke or a command that comes to a kernel
that is not there waits with all that is asked for after it; it is tried again whenever a kernel has come, and as the
first of those that wait.  What waits is seen as a sketch.  Swatches wait for their brushes, behind everything else.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable

from engine.brush.settings import Brush
from engine.kernel_cache import NotCompiled, refusing
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.preparing.preparing import Job, Preparing, expected, job_of
from engine.studio.preparing.sketch import Sketch
from engine.studio.studio import Studio

POLL = 0.03  # seconds from one look at what has been compiled to the next
PATIENCE = 3.0  # seconds that a picture waits for kernels which no brush may need, before they are compiled here
STROKE = (q.Begin, q.Points, q.Finish, q.Abandon)
THUMBNAIL = (104, 44)


class Waiting:
    """The studio's requests, in their order.  All calls come from one thread."""

    def __init__(self, studio: Studio, preparing: Preparing, send: Callable[[results.Result], None]) -> None:
        self._studio, self._preparing, self._send = studio, preparing, send
        self._queue: deque[q.Request] = deque()  # what waits, in order
        self._laid: list[q.Request] = []  # of the stroke on the easel, if it must be begun anew
        self._swatches: dict[str, q.Swatch] = {}
        self._expected: tuple[Job, ...] = ()
        self._examples: Job | None = None  # what GetReady waits for
        self._tried = -1  # `count` when the first that waits was last tried
        self._unseen: float | None = None  # since when pictures wait
        self._told = (0, 0)
        self._sketch, self._levels = Sketch(), set[int]()  # of what waits, and the levels of its strokes
        studio.easel.viewer.above = self._sketch.over

    # --- requests ----------------------------------------------------------------------------------------------------

    def do(self, request: q.Request) -> None:
        """Carries out a request, or lets it wait."""
        if isinstance(request, q.Begin | q.Finish | q.Abandon):
            self._preparing.painting(isinstance(request, q.Begin))
        match request:
            case q.Swatch():
                self._swatch(request)
            case q.Prepare():
                self._expect(request)
            case q.GetReady() if self._preparing.busy:
                self._examples = job_of(q.Swatch("", Brush(mode="example", example="a"), THUMBNAIL))
                self._preparing.want((self._examples,), soon=True)
            case q.FileGrown() | q.Written():
                self._studio.do(request)
            case _ if self._queue:
                self._queue.append(request)
                grown = self._sketch.add(request)
                if grown is not None and not grown[1].empty:
                    self._studio.easel.viewer.grew(*grown)
            case _:
                self._attempt(request)

    def look(self, request: q.Look) -> None:
        """Takes over what is wanted on the screen."""
        self._studio.look(request)

    def _attempt(self, request: q.Request, compiling: bool = False) -> bool:
        """Carries out a request; False if it has to wait, which is then the first that does."""
        refuses = isinstance(request, (*STROKE, q.Do)) and not compiling and self._preparing.busy
        live = self._studio.easel.live
        try:
            with refusing(refuses):
                self._studio.do(request)
        except NotCompiled:
            self._tried = self._preparing.count
            if isinstance(request, q.Begin | q.Points):
                self._take_back(request)
            else:
                self._studio.easel.live = live  # as it was: the stroke stays in sight, and is committed later
                self._queue.appendleft(request)
            self._preparing.want((self._needed(),), soon=True)
            self._draw()
            return False
        if isinstance(request, STROKE):
            self._laid = [*self._laid, request] if self._studio.easel.live is not None else []
        return True

    def _take_back(self, *more: q.Request) -> None:
        """The stroke on the easel waits, to be begun anew."""
        self._queue.extendleft(reversed((*self._laid, *more)))
        self._laid = []
        self._studio.do(q.Abandon())

    def _needed(self) -> Job:
        """What compiles the kernels of the first that waits."""
        stroke = next((r for r in (*self._laid, *self._queue) if isinstance(r, q.Begin)), None)
        defined = tuple(
            r.command for r in self._queue if isinstance(r, q.Do) and isinstance(r.command, c.DefineTexture)
        )
        return job_of(q.Swatch("", stroke.brush if stroke else Brush(), THUMBNAIL, textures=defined))

    def _again(self) -> None:
        """Tries the first that wait, if a kernel has come since, or their brush is as ready as it will be."""
        if self._examples is not None and self._preparing.ready(self._examples):
            self._examples = None
            self._studio.do(q.GetReady())
        if self._tried == self._preparing.count and self._preparing.busy:
            return
        self._tried = self._preparing.count
        self._tell()
        while self._queue:
            compiling, self._tried = self._preparing.ready(self._needed()), -1  # also where the next line raises
            if not self._attempt(self._queue.popleft(), compiling):
                return
            if not self._queue:
                self._draw()
        self._tried = self._preparing.count

    def _draw(self) -> None:
        """Sketches what waits now."""
        before = self._sketch.rects
        known = {level: before(level) for level in self._levels}
        self._sketch.begin(self._queue)
        self._levels = {request.level for request in self._queue if isinstance(request, q.Begin)}
        after = {level: self._sketch.rects(level) for level in self._levels}
        self._studio.easel.viewer.changed(lambda level: known.get(level, []) + after.get(level, []))

    # --- what is seen ------------------------------------------------------------------------------------------------

    @property
    def pending(self) -> int:
        """Pieces of open work that can be done now."""
        return self._seen() + (self._next_swatch() is not None)

    def _seen(self) -> int:
        waits = self._unseen is not None and self._tried == self._preparing.count and self._preparing.busy
        return 0 if waits and time.monotonic() - (self._unseen or 0.0) < PATIENCE else self._studio.pending

    def step(self) -> bool:
        """The most urgent piece of open work, swatches last."""
        self._again()
        if self._seen():
            return self._stepped()
        ident = self._next_swatch()
        if ident is not None:
            self._paint(self._swatches.pop(ident))
        return ident is not None

    def _stepped(self) -> bool:
        easel, now = self._studio.easel, time.monotonic()
        looks = easel.viewer.pending and not (easel.behind or self._studio.lab.pending)
        late = self._unseen is not None and now - self._unseen >= PATIENCE
        try:
            with refusing(bool(looks) and not late and self._preparing.busy):
                done = self._studio.step()
        except NotCompiled:
            self._tried = self._preparing.count
            self._unseen = self._unseen or now
            if easel.live is not None:
                self._take_back()
                self._draw()
            easel.viewer.changed(lambda level: [])  # nothing has, but all is to be looked at again
            return True
        self._unseen = None if looks else self._unseen
        return done

    # --- swatches ----------------------------------------------------------------------------------------------------

    def _expect(self, request: q.Prepare) -> None:
        """Brushes are to be made ready."""
        self._preparing.want(expected(request.swatches))
        self._expected = tuple(map(job_of, request.swatches))
        self._tell()

    def _swatch(self, request: q.Swatch) -> None:
        if self._preparing.ready(job_of(request)):
            self._swatches.pop(request.ident, None)
            self._paint(request)
        else:
            self._swatches[request.ident] = request
            self._preparing.want((job_of(request),), request.soon)

    def _next_swatch(self) -> str | None:
        """A swatch whose brush has become ready."""
        if not self._swatches:
            return None
        return next((i for i, swatch in self._swatches.items() if self._preparing.ready(job_of(swatch))), None)

    def _paint(self, request: q.Swatch) -> None:
        try:
            with refusing(self._preparing.busy):
                self._studio.do(request)
        except NotCompiled:
            self._studio.do(request)  # its exercise left something out, and it should be small

    def _tell(self) -> None:
        """Sends how many of the expected brushes are ready, when that has changed."""
        ready = sum(map(self._preparing.ready, self._expected))
        if (ready, len(self._expected)) != self._told:
            self._told = ready, len(self._expected)
            self._send(results.Prepared(*self._told))

    # --- time --------------------------------------------------------------------------------------------------------

    @property
    def waits(self) -> bool:
        """Whether commands wait that were taken from the post."""
        return bool(self._queue)

    @property
    def due(self) -> float | None:
        """When to look again at what was compiled, or the studio's recording goes on."""
        due = self._studio.due
        if not (self._queue or self._swatches or self._unseen or self._told[0] < self._told[1] or self._examples):
            return due
        soon = time.monotonic() + POLL
        return soon if due is None else min(due, soon)

    def play(self) -> None:
        """Plays the next piece of a recording, unless commands wait."""
        self._again()
        if self._studio.due is not None and self._studio.due <= time.monotonic() and not self._queue:
            self._studio.play()

    def close(self) -> None:
        """Does all that still waits."""
        self._preparing.close()
        while self._queue:
            self._studio.do(self._queue.popleft())
        self._studio.close()
