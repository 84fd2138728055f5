"""A painting while it is made again: at any time of a film, as it was then, with the stroke that is being drawn."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from engine.brush.dynamics import evaluate
from engine.canvas import growth as growths
from engine.canvas.tile_cache import TileCache
from engine.files.fault import FileError
from engine.film.beats import Beat
from engine.painting import commands as c
from engine.painting.grown import settled, threads
from engine.painting.recording import Recording
from engine.painting.value import Painting, Refusal
from engine.strokes.example_stroke import Live

CACHE = 256 << 20  # bytes of evaluated tiles


@dataclass(frozen=True, slots=True)
class Tip:
    """Where the brush touches: (x, y) from the origin, and its radius, in pixels of a level."""

    level: int
    origin: tuple[int, int]
    x: float
    y: float
    radius: float


class Remaker(Protocol):
    """What carries commands out: a session."""

    painting: Painting

    def do(self, command: c.Command) -> Painting:
        """Carries out a command."""
        ...

    @property
    def begin(self) -> Callable[..., Live]:
        """Begins a stroke: level, origin, brush, layer, seed, copies."""
        ...

    def finish(self, live: Live) -> Painting:
        """Ends it."""
        ...

    def amend(self, painting: Painting) -> None:
        """Takes the same painting, further refined."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Making:
    """How a painting was made: its recording, the commands that undo takes back, and what begins to make it anew, with
    a cache for tiles."""

    recording: Recording
    steps: frozenset[type]
    begin: Callable[[TileCache], Remaker]


class Replaying:
    """A recording that is carried out once more.  `painting`: as it is seen now; `tip`: where the brush is, None when
    it is lifted.  FileError names the line of a command that cannot be done."""

    def __init__(self, making: Making, beats: tuple[Beat, ...]) -> None:
        self._recording, self._beats = making.recording, beats
        self._session = making.begin(TileCache(CACHE))
        self._next = 0
        self._live: Live | None = None
        self._laid = 0  # points of the stroke in progress
        self.painting: Painting = self._session.painting
        self.tip: Tip | None = None

    def go_to(self, time: float) -> None:
        """Goes on to a time, by the clock of the beats; never back."""
        while self._next < len(self._beats):
            beat = self._beats[self._next]
            if beat.begin > time or (beat.begin == time and beat.length > 0.0):
                break
            try:
                if beat.begin + beat.length > time and self._draw((time - beat.begin) / beat.length):
                    return
                self._finish(beat)
            except (Refusal, FileError) as error:
                raise self._recording.fault(self._next, str(error)) from None
            self._next += 1
        self.tip = None

    def end(self) -> None:
        """Carries out all that is left; the painting is the one that was made."""
        self.go_to(float("inf"))
        self.painting = self._session.painting

    def _draw(self, part: float) -> bool:
        """Draws the next stroke up to a part of its time; False if the next command is none."""
        stroke = self._recording.commands[self._next]
        if not isinstance(stroke, c.Stroke):
            return False
        points, last = _points_until(stroke.points, part)
        if self._live is None:
            self._live, self._laid = self._begun(stroke), 0
        if self._live.bed is not None:  # what grows goes on growing from what there is
            self._live.lay(points[self._laid :])
            self._laid = len(points)
            with threads() as pool:
                self._live.bed.follow(growths.settled(self._live.bed.growth, pool))
            self.painting = self._live.commit()
        else:
            live = self._begun(stroke)
            live.lay(np.concatenate([points, last]))
            self.painting = live.commit()
        self.tip = _tip(stroke, last[0])
        return True

    def _begun(self, stroke: c.Stroke) -> Live:
        about = stroke.layer, stroke.seed, stroke.copies, stroke.onto, stroke.seen
        live = self._session.begin(stroke.level, stroke.origin, stroke.brush, *about)
        live.extra = stroke.extra
        return live

    def _finish(self, beat: Beat) -> None:
        command = self._recording.commands[self._next]
        live, self._live = self._live, None
        if live is None or live.bed is None:
            self._session.do(command)
        else:
            assert isinstance(command, c.Stroke)
            live.lay(command.points[self._laid :])
            self._session.finish(live)
        painting = settled(self._session.painting)
        if painting is not self._session.painting:
            self._session.amend(painting)
        if beat.seen:
            self.painting = self._session.painting


def _points_until(points: np.ndarray, part: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns the points that are drawn after a part, 0..1, of a stroke's time, and where the pen is then, (1, 6): by
    their own times where they tell them, else by the way."""
    times = points[:, 5] - points[0, 5]
    if times[-1] <= 0.0:
        times = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points[:, :2], axis=0).T))])
    now = part * times[-1]
    count = min(max(1, int(np.searchsorted(times, now, side="right"))), len(points))
    last = points[count - 1 : count]
    if count < len(points) and times[count] > times[count - 1]:
        share = min(max((now - times[count - 1]) / (times[count] - times[count - 1]), 0.0), 1.0)
        last = last + share * (points[count : count + 1] - last)
    return points[:count], last


def _tip(stroke: c.Stroke, point: np.ndarray) -> Tip:
    x, y, pressure = point[:3].tolist()
    factor = float(evaluate(stroke.brush.dynamics.get("radius"), np.array([pressure]))[0])
    return Tip(stroke.level, stroke.origin, x, y, stroke.brush.radius * factor)
