"""A recording that plays on the easel, live: at the pace of a hand."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Protocol

import numpy as np

from engine.checks.owned import Owned
from engine.painting import commands as c
from engine.painting.recording import Recording
from engine.painting.value import Leak, Unclosed
from engine.strokes.live_stroke import POINTS_CAP
from engine.studio import faults, results

LIVE_SECONDS = 70.0  # that the strokes of a recording take at most when it plays live
SLOWEST = 0.004  # seconds a point: no slower than a hand
PIECE = 0.02  # seconds of work between two looks at the screen
FLIGHT, A_LEVEL = 0.7, 0.35  # seconds that moving the view takes, and each level of zoom


class Stage(Protocol):
    """What a recording plays on: an easel."""

    def carry_out(self, command: c.Command) -> None:
        """Carries out a command."""
        ...

    def begin(self, stroke: c.Stroke) -> None:
        """Begins a stroke."""
        ...

    def extend(self, points: np.ndarray) -> None:
        """Goes on with it."""
        ...

    def finish(self) -> None:
        """Ends it."""
        ...

    def send(self, result: results.Result) -> None:
        """Sends a result to the window."""
        ...


class Playing(Owned):
    """A recording that is being played.  It belongs to the engine's thread.

    Strokes grow as the pen drew them and views move the screen.
    """

    def __init__(self, recording: Recording) -> None:
        self._commands: Iterator[c.Command] = iter(recording.commands)
        points = sum(len(command.points) for command in recording.commands if isinstance(command, c.Stroke))
        self._pace = min(SLOWEST, LIVE_SECONDS / max(1, points))
        self._of, self._done = max(1, len(recording.commands)), 0
        self._clock = 0.0  # when, by the pace, the next point is due
        self._rest: np.ndarray | None = None
        self._level: float | None = None

    def advance(self, stage: Stage) -> float | None:
        """Plays some pieces; returns when the next is due (seconds of the monotonic clock), None at the end."""
        now = time.monotonic()
        self._clock = max(self._clock, now - 1.0)  # behind: hurry, but do not make up for a long wait
        end = now + PIECE
        try:
            while self._clock <= now < end:
                if not self._next(stage):
                    return None
                now = time.monotonic()
        except (Leak, Unclosed) as error:
            raise faults.stated(error) from None
        return max(self._clock, now)

    @property
    def part(self) -> float:
        """Gives the part of its commands that are carried out, or begun."""
        return self._done / self._of

    @property
    def drawing(self) -> bool:
        """Tells whether the stroke in progress is the recording's."""
        return self._rest is not None

    def complete(self, stage: Stage) -> None:
        """Draws the stroke that grows to its end at once."""
        assert self._rest is not None
        rest, self._rest = self._rest, None
        stage.extend(rest)
        stage.finish()

    def _next(self, stage: Stage) -> bool:
        if self._rest is not None:
            self._grow(stage)
            return True
        command = next(self._commands, None)
        if command is None:
            return False
        self._done += 1
        if isinstance(command, c.View):
            stage.carry_out(command)
            self._look(stage, command)
        elif isinstance(command, c.Stroke) and len(command.points) < POINTS_CAP:
            stage.begin(command)
            self._rest = command.points
        else:
            stage.carry_out(command)
        return True

    def _look(self, stage: Stage, view: c.View) -> None:
        """Has the screen fly there; the next command waits for it."""
        levels = 0.0 if self._level is None else abs(view.level - self._level)
        seconds = FLIGHT + A_LEVEL * levels
        stage.send(looked(view, seconds))
        self._clock = time.monotonic() + seconds
        self._level = view.level

    def _grow(self, stage: Stage) -> None:
        """Draws the points that are due: one at least, and all that would be late."""
        assert self._rest is not None
        due = max(1, int((time.monotonic() - self._clock + PIECE) / self._pace))
        points, rest = self._rest[:due], self._rest[due:]
        self._rest = rest if len(rest) else None
        self._clock += self._pace * len(points)
        stage.extend(points)
        if self._rest is None:
            stage.finish()


def looked(view: c.View, seconds: float = 0.0) -> results.Looked:
    """Returns what has the screen go where a view looks, in some seconds."""
    return results.Looked(view.level, view.origin, view.size, seconds)
