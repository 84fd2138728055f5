"""The studio before its brushes are ready: what needs a kernel that is not compiled waits, and keeps its place.

The engine's thread compiles nothing while processes do (`processes`).  Strokes and commands that need a kernel wait in
line (`waiting_line`), and are seen as a sketch.  Swatches wait for their brushes, behind everything else.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from engine.brush.settings import Brush
from engine.kernel_cache import NotCompiled, refusing
from engine.studio import requests as q
from engine.studio import results
from engine.studio.filing.opening_requests import CancelOpening, FileRead, FileWhole
from engine.studio.grower import Grower
from engine.studio.journalled.tend_request import Tend
from engine.studio.preparing.job_queue import SEEN_DETAIL, Job, job_of
from engine.studio.preparing.processes import Preparing
from engine.studio.preparing.waiting_line import THUMBNAIL, WaitingLine
from engine.studio.preparing.waiting_swatches import WaitingSwatches
from engine.studio.studio import Studio

POLL = 0.03  # seconds from one look at what has been compiled to the next
_GROWTH = job_of(q.Swatch("", Brush(mode="example", example="a"), THUMBNAIL))  # what painting with examples needs
PATIENCE = 3.0  # seconds that a picture waits for kernels which no brush may need, before they are compiled here


class Waiting:
    """The studio's requests, in their order.  All calls come from one thread."""

    def __init__(self, studio: Studio, preparing: Preparing, send: Callable[[results.Result], None]) -> None:
        self._studio, self._preparing = studio, preparing
        self._line = WaitingLine(studio, preparing)
        self._swatches = WaitingSwatches(studio, preparing, send)
        self._examples: Job | None = None  # what GetReady waits for
        self._unseen: float | None = None  # since when pictures wait
        self._textures: object = None  # of the painting, as they were last looked through
        self._detail = False  # whether learnt detail may be seen, whose kernels are asked for
        self._looked = 0.0  # when what has been compiled was last looked at

    # --- requests ----------------------------------------------------------------------------------------------------

    def do(self, request: q.Request) -> None:
        """Carries out a request, or lets it wait."""
        if isinstance(request, q.Begin | q.Finish | q.Abandon):
            self._preparing.painting(isinstance(request, q.Begin))
        match request:
            case q.Swatch():
                self._swatches.ask(request)
            case q.Prepare():
                self._swatches.expect(request)
            case q.GetReady() if self._preparing.busy:
                self._examples = _GROWTH
                self._preparing.want((_GROWTH,), soon=True)
            case q.FileGrown() | q.Written() | FileRead() | FileWhole() | CancelOpening() | Tend():
                self._studio.do(request)
            case _:
                self._line.do(request)

    def look(self, request: q.Look) -> None:
        """Takes over what is wanted on the screen."""
        self._studio.look(request)
        textures = self._studio.easel.session.painting.textures
        if textures is not self._textures:
            self._textures = textures
            self._detail = self._preparing.busy and any(texture.maps is not None for texture in textures.values())
            self._preparing.want((SEEN_DETAIL,) if self._detail else (), soon=True)

    def play(self) -> None:
        """Plays the next piece of a recording, unless commands wait."""
        self._again()
        if self._studio.due is not None and self._studio.due <= time.monotonic() and not self.waits:
            self._studio.play()

    def secure(self) -> None:
        """Has the journal whole: a fault ends the engine's thread."""
        self._studio.secure()

    def close(self) -> None:
        """Does all that still waits."""
        self._preparing.close()
        self._line.finish()
        self._studio.close()

    # --- open work ---------------------------------------------------------------------------------------------------

    @property
    def waits(self) -> bool:
        """Tells whether commands wait that were taken from the post."""
        return self._line.waits

    @property
    def unseen(self) -> bool:
        """Tells whether pictures, or what grows, wait for kernels."""
        return self._unseen is not None or self._studio.grower.held

    @property
    def pending(self) -> int:
        """Pieces of open work that can be done now."""
        return self._seen + self._swatches.pending

    @property
    def due(self) -> float | None:
        """When to look again at what was compiled, or the studio's recording goes on."""
        due = None if self.waits else self._studio.due
        if not (self.waits or self._swatches.open or self.unseen or self._examples):
            return due
        soon = self._looked + POLL
        return soon if due is None else min(due, soon)

    def step(self) -> bool:
        """Returns the most urgent piece of open work, swatches last."""
        self._again()
        return self._stepped() if self._seen else self._swatches.step()

    def _again(self) -> None:
        """Tries what waits, if a kernel has come since."""
        self._looked = time.monotonic()
        if self._examples is not None and self._preparing.ready(self._examples):
            self._examples = None
            self._studio.do(q.GetReady())
        _hold(self._studio.grower, self._preparing)
        if not self._line.stalled:
            self._swatches.tell()
            self._line.again()

    @property
    def _seen(self) -> int:
        """Pieces of the studio's own work: none while pictures wait, and not for too long."""
        return 0 if self._unseen is not None and self._line.stalled and not self._late else self._studio.pending

    @property
    def _late(self) -> bool:
        """Tells whether pictures waited long enough: where a process is asked for their kernels, until it is done."""
        if self._detail:
            self._detail = not self._preparing.ready(SEEN_DETAIL)
        return self._unseen is not None and not self._detail and time.monotonic() - self._unseen >= PATIENCE

    def _stepped(self) -> bool:
        easel = self._studio.easel
        looks = easel.viewer.pending and not (easel.behind or self._studio.lab.pending)
        try:
            with refusing(bool(looks) and not self._late and self._preparing.busy):
                done = self._studio.step()
        except NotCompiled:
            if not self._line.restart():  # else the sketch, which lacks nothing, can be seen at once
                self._unseen = self._unseen or time.monotonic()
            easel.viewer.changed(lambda level: [])  # nothing has, but all is to be looked at again
            return True
        self._unseen = None if looks else self._unseen
        return done


def _hold(grower: Grower, preparing: Preparing) -> None:
    """What grows waits where a process is asked for its kernels: a painting may be opened that is still to grow."""
    if grower.held or (preparing.busy and grower.pending):
        lacks = not preparing.ready(_GROWTH)
        if lacks and not grower.held:
            preparing.want((_GROWTH,), soon=True)
        grower.held = lacks
