"""When the next frame begins, and what the engine does meanwhile."""

from __future__ import annotations

import time
from typing import Protocol

import imgui_bundle  # before glfw, so that both use one libglfw

import glfw  # isort: skip

from app.canvas.renderers import fills_pixels
from app.trace import trace_frame

assert imgui_bundle
LINGER = 0.9  # seconds that frames go on after an event: hover delays, fading
IDLE, BLINK = 5.0, 0.3  # seconds to wait for an event when nothing moves, and where text is typed
PACE = 1 / 125  # seconds a frame takes at least, where the screen does not tell its own pace
STILL = 1 / 60  # and at most, where frames go on without an event: the engine wants the processor, too
CALM = 1 / 20  # where nothing came of the last frame, either
SOON = 0.1  # seconds after an event during which something may come even so
SPARING = 1 / 30  # where it makes what the screen lacks, the view stays, and the processor fills the pixels, too
AT_HAND = 0.25  # seconds after an event during which each frame counts
STEP = 0.003  # seconds that a piece of the engine's work takes, at most, nearly always
LEAST = 0.001  # seconds of a turn in which such pieces are begun, after frames that take nearly all of the time
SHARE = 0.25  # of a late frame's time, that the engine gets after it


class Worker(Protocol):
    """What it needs of the engine's thread."""

    @property
    def ready(self) -> bool:
        """Tells whether results lie ready."""
        ...

    def turn(self, end: float | None) -> None:
        """Lets open work begin until `end`, as engine.studio.worker.Worker has it."""
        ...


class Pace:
    """The rest between two frames of a window.

    Where the processor fills the pixels, too, examples would be grown at the cost of frames: then the engine's turn is
    in the rests, while something is moved by hand.
    """

    def __init__(self, renderer: str) -> None:
        self.worker: Worker | None = None
        self._shared = fills_pixels(renderer)
        self._last = self._moved = time.monotonic()
        self._busy_until = self._calm_from = 0.0
        self._took = 0.0  # seconds, by the last frame
        self._drawn = False
        self._resting = False  # until something happens
        self._growing = False
        self._by_turns = self._spares = False
        self._came = self._taken = 0  # times that the engine had news, by now and as the last frame began
        self._awaited = 0  # with which time all may be there that the screen lacks

    def event(self) -> None:
        """Something came from the artist or the window system."""
        self._moved = time.monotonic()
        self._busy_until, self._calm_from = self._moved + LINGER, self._moved + SOON
        if self._shared and self._growing:
            self._give(self._moved)

    def news(self, now: float) -> None:
        """Something came from the engine."""
        self._busy_until = max(self._busy_until, now + 0.05)
        self._calm_from = max(self._calm_from, now + 0.05)

    def told(self) -> None:
        """The engine has news; called from its thread.  Where frames go on anyway, the next one takes them in, unless
        that is far off and nothing is lacking any more."""
        self._came += 1
        if self._resting or self._came == self._awaited:
            glfw.post_empty_event()

    def begin(self, now: float) -> float:
        """A frame begins; seconds since the last one did, 0.1 at most."""
        seconds, self._last, self._taken = min(0.1, now - self._last), now, self._came
        return seconds

    def end(self, drawn: bool, moving: bool, growing: bool, lacks: int = 0) -> None:
        """It ends; whether anything was drawn, something moves by itself, and the engine grows examples; how much the
        screen lacks of a view that stays."""
        now = time.monotonic()
        trace_frame(self._last, now)
        self._took, self._drawn, self._growing = now - self._last, drawn, growing
        self._by_turns = self._shared and growing and (moving or now - self._moved < AT_HAND)
        self._spares = self._shared and lacks > 0 and not self._by_turns
        self._awaited = self._taken + lacks if self._spares else 0

    def wait(self, moving: bool, painting: bool = False, idle: float = IDLE) -> None:
        """Sleeps until an event, at most one frame while something moves or is about to, and `idle` seconds otherwise;
        while the pen paints, until the engine has more of the paint."""
        now = time.monotonic()
        if moving or self._by_turns or now < self._busy_until:
            calm = not (moving or painting or self._drawn or self._by_turns) and now >= self._calm_from
            step = SPARING if self._spares and not painting else PACE if moving and not self._by_turns else None
            until = self._last + (CALM if calm else step or self._still(painting))
            wakes = calm or (painting and not self._by_turns)
            self._doze(until - now) if wakes and until > now else self.rest(until - now)
        else:
            self._doze(idle)
            self._last = min(self._last + IDLE, time.monotonic() - PACE)

    def _doze(self, seconds: float) -> None:
        """Sleeps so long, or until an event or news from the engine."""
        self._resting = True
        if self.worker is None or not self.worker.ready:  # what comes from now on wakes
            self._give(None)
            glfw.wait_events_timeout(seconds)
        self._resting = False

    def rest(self, seconds: float) -> None:
        """Sleeps so long, or until an event; the engine's turn is no shorter than it has to be."""
        if self._by_turns:
            seconds = max(seconds, LEAST, SHARE * self._took if self._took > STILL else 0.0)
            self._give(time.monotonic() + max(LEAST, seconds - STEP))
            time.sleep(seconds)
            glfw.poll_events()
        else:
            self._give(None)
            glfw.wait_events_timeout(seconds) if seconds > 0 else glfw.poll_events()

    def _give(self, end: float | None) -> None:
        if self.worker is not None:
            self.worker.turn(end)

    def _still(self, painting: bool) -> float:
        """Returns seconds from one frame to the next where no event comes between: a slow one is followed by as long
        a rest."""
        if self._by_turns or (not self._drawn and not painting):
            return STILL
        return min(STILL, max(PACE, 2 * self._took))
