"""Files as the window opens and writes them, whatever their kind: paintings, pictures, recordings."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from engine.archive import export, saving
from engine.archive.imports import open_image
from engine.archive.opening import open_painting
from engine.archive.plot_files import Mark
from engine.painting import commands as c
from engine.painting.recording import Recording, read
from engine.painting.value import Painting
from engine.session import replay
from engine.session.session import Session
from engine.strokes.live_stroke import POINTS_CAP
from engine.studio import requests as q
from engine.studio import results

LIVE_SECONDS = 70.0  # that the strokes of a recording take at most when it plays live
SLOWEST = 0.004  # seconds a point: no slower than a hand
PIECE = 0.02  # seconds of work between two looks at the screen
FLIGHT, A_LEVEL = 0.7, 0.35  # seconds that moving the view takes, and each level of zoom


class Stage(Protocol):
    """Where a recording plays: an easel."""

    def carry_out(self, command: c.Command) -> None: ...
    def begin(self, stroke: c.Stroke) -> None: ...
    def extend(self, points: np.ndarray) -> None: ...
    def finish(self) -> None: ...
    def send(self, result: results.Result) -> None: ...


class Playing:
    """A recording on its way.  Live, strokes grow as the pen drew them and views move the screen."""

    def __init__(self, recording: Recording, live: bool) -> None:
        self._commands: Iterator[c.Command] = iter(recording.commands)
        points = sum(len(command.points) for command in recording.commands if isinstance(command, c.Stroke))
        self._pace = min(SLOWEST, LIVE_SECONDS / max(1, points)) if live else 0.0
        self._clock = 0.0  # when, by the pace, the next point is due
        self._rest: np.ndarray | None = None
        self._level: float | None = None

    def advance(self, stage: Stage) -> float | None:
        """Some pieces of it; when the next is due (seconds of the monotonic clock), None at the end."""
        now = time.monotonic()
        self._clock = max(self._clock, now - 1.0)  # behind: hurry, but do not make up for a long wait
        end = now + PIECE
        while self._clock <= now < end:
            if not self._next(stage):
                return None
            now = time.monotonic()
        return max(self._clock, now)

    @property
    def drawing(self) -> bool:
        """Whether the stroke in progress is the recording's."""
        return self._rest is not None

    def complete(self, stage: Stage) -> None:
        """The stroke that grows, to its end at once."""
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
        if isinstance(command, c.View):
            stage.carry_out(command)
            self._look(stage, command)
        elif isinstance(command, c.Stroke) and self._pace and len(command.points) < POINTS_CAP:
            stage.begin(command)
            self._rest = command.points
        else:
            stage.carry_out(command)
        return True

    def _look(self, stage: Stage, view: c.View) -> None:
        """The screen flies there; the next command waits for it."""
        levels = 0.0 if self._level is None else abs(view.level - self._level)
        seconds = FLIGHT + A_LEVEL * levels if self._pace else 0.0
        stage.send(results.Looked(view.level, view.origin, view.size, seconds))
        self._clock = time.monotonic() + seconds
        self._level = view.level

    def _grow(self, stage: Stage) -> None:
        """The points that are due, one at least, all that would be late."""
        assert self._rest is not None
        due = max(1, int((time.monotonic() - self._clock + PIECE) / self._pace))
        points, rest = self._rest[:due], self._rest[due:]
        self._rest = rest if len(rest) else None
        self._clock += self._pace * len(points)
        stage.extend(points)
        if self._rest is None:
            stage.finish()


@dataclass(frozen=True, slots=True)
class Document:
    """A session with what the file held.

    `path`: where to save it, None for what is no painting of ours; `known`: whether the session's log leads from
    nothing to the painting; `script`: a recording still to be played; `notes`: what was lost or replaced;
    `marks`: of what is to be grown again.
    """

    session: Session
    path: Path | None = None
    known: bool = True
    script: Playing | None = None
    notes: tuple[str, ...] = ()
    marks: tuple[Mark, ...] = ()


def opened(path: Path, live: bool = False) -> Document:
    """What a file holds: a recording, a painting of ours or of another program, or a picture.

    FileError if it is none that can be read.
    """
    ending = path.suffix.lower()
    if ending == ".jsonl":
        recording = read(path)
        return Document(replay.opened(recording), script=Playing(recording, live))
    found = open_painting(path) if ending == ".ora" else open_image(path)
    told = found.recording
    session = Session(
        found.painting,
        log=told.commands if told else (),
        folder=told.folder if told else path.parent,
        extra=told.header.extra if told else None,
    )
    return Document(session, path if found.native else None, told is not None, None, found.notes, found.marks)


def save(path: Path, painting: Painting, recording: Recording | None) -> None:
    """The painting, grown to its end, as .ora, with its recording if that is known, replaced in one step; WriteError if
    that failed."""
    saving.save(path, saving.Snapshot(painting, recording))


def write_picture(request: q.Export, painting: Painting) -> None:
    """The frame, or the rectangle asked for, of a painting grown to its end, as a picture; WriteError if that
    failed."""
    export.export(request.path, export.Picture(painting, request.level, request.area))
