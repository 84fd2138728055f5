"""The commands that wait for kernels, in their order, and what is seen of them meanwhile.

A stroke or a command that comes to a kernel that is not there waits with all that is asked for after it; it is tried
again whenever a kernel has come, and as the first of those that wait.
"""

from __future__ import annotations

from collections import deque

from engine.brush.settings import Brush
from engine.canvas.selecting.selection import Selection
from engine.kernel_cache import NotCompiled, refusing
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio.preparing.job_queue import Job
from engine.studio.preparing.named_textures import job_within
from engine.studio.preparing.processes import Preparing
from engine.studio.preparing.sketch import Sketch
from engine.studio.studio import Studio

STROKE = (q.Begin, q.Points, q.Finish, q.Abandon)
THUMBNAIL = (104, 44)


class WaitingLine:
    """Carries out commands on a studio, or keeps them in line.  All calls come from one thread."""

    def __init__(self, studio: Studio, preparing: Preparing) -> None:
        self._studio, self._preparing = studio, preparing
        self._queue: deque[q.Request] = deque()  # what waits, in order
        self._laid: list[q.Request] = []  # of the stroke on the easel, if it must be begun anew
        self._tried = -1  # `count` when the first that waits was last tried
        self._sketch, self._levels = Sketch(self._selected), set[int]()  # of what waits, and the levels of its strokes
        studio.easel.viewer.above = self._sketch.over

    def _selected(self) -> Selection | None:
        return self._studio.easel.session.painting.selection

    @property
    def waits(self) -> bool:
        """Tells whether commands are in line."""
        return bool(self._queue)

    @property
    def stalled(self) -> bool:
        """Tells whether nothing has been compiled since the last try, and something will be."""
        return self._tried == self._preparing.count and self._preparing.busy

    def do(self, request: q.Request) -> None:
        """Carries out a request, or lets it wait."""
        if not self._queue:
            self._attempt(request)
            return
        self._queue.append(request)
        grown = self._sketch.add(request)
        if grown is not None and not grown[1].empty:
            level, area = grown
            self._studio.easel.viewer.grew(level, [area])

    def again(self) -> None:
        """Tries the first that wait, or compiles what they lack where their brush is as ready as it will be."""
        while self._queue:
            compiling, self._tried = self._preparing.ready(self._needed()), -1  # also where the next line raises
            if not self._attempt(self._queue.popleft(), compiling):
                return
            if not self._queue:
                self._draw()
        self._tried = self._preparing.count

    def restart(self) -> bool:
        """Returns the stroke on the easel cannot be shown: it waits, to be begun anew; False if there is none."""
        self._tried = self._preparing.count
        if self._studio.easel.live is None:
            return False
        self._take_back()
        self._preparing.want((self._needed(),), soon=True)
        self._draw()
        return True

    def finish(self) -> None:
        """Does all that waits, and compiles what it lacks."""
        while self._queue:
            self._studio.do(self._queue.popleft())

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
        """Returns what compiles the kernels of the first that waits."""
        stroke = next((r for r in (*self._laid, *self._queue) if isinstance(r, q.Begin)), None)
        defined = tuple(
            r.command for r in self._queue if isinstance(r, q.Do) and isinstance(r.command, c.DefineTexture)
        )
        brush = stroke.brush if stroke else Brush()
        painting = self._studio.easel.session.painting
        return job_within(painting, q.Swatch("", brush, THUMBNAIL, textures=defined))

    def _draw(self) -> None:
        """Sketches what waits now."""
        before = self._sketch.rects
        known = {level: before(level) for level in self._levels}
        self._sketch.begin(self._queue)
        self._levels = {request.level for request in self._queue if isinstance(request, q.Begin)}
        after = {level: self._sketch.rects(level) for level in self._levels}
        self._studio.easel.viewer.changed(lambda level: known.get(level, []) + after.get(level, []))
