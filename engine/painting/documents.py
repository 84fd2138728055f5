"""Files as the window opens and writes them, whatever their kind: paintings, pictures, recordings."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from engine.painting import archive, export, replay
from engine.painting import commands as c
from engine.painting import requests as q
from engine.painting.imports import open_image
from engine.painting.opening import open_painting
from engine.painting.recording import Recording, read
from engine.painting.session import Session
from engine.painting.value import Painting

LIVE_POINTS = 6  # of a stroke shown at a time when a recording plays
LIVE_PAUSE = 0.012  # seconds between them


class Stage(Protocol):
    """Where a recording plays: an easel."""

    def carry_out(self, command: c.Command) -> None: ...
    def begin(self, stroke: c.Stroke) -> None: ...
    def extend(self, points: np.ndarray) -> None: ...
    def finish(self) -> None: ...
    def send(self, result: q.Result) -> None: ...


class Playing:
    """A recording on its way: strokes grow as the pen drew them, views move the screen."""

    def __init__(self, recording: Recording, live: bool) -> None:
        self._commands: Iterator[c.Command] = iter(recording.commands)
        self._live = live
        self._rest: np.ndarray | None = None

    def advance(self, stage: Stage) -> bool:
        """One piece of it; False at the end."""
        if self._rest is not None:
            self._grow(stage)
            return True
        command = next(self._commands, None)
        if command is None:
            return False
        if isinstance(command, c.View):
            stage.carry_out(command)
            stage.send(q.Looked(command.level, command.origin, command.size))
            time.sleep(LIVE_PAUSE * 20 if self._live else 0)
        elif isinstance(command, c.Stroke) and self._live:
            stage.begin(command)
            self._rest = command.points
        else:
            stage.carry_out(command)
        return True

    def _grow(self, stage: Stage) -> None:
        assert self._rest is not None
        stage.extend(self._rest[:LIVE_POINTS])
        self._rest = self._rest[LIVE_POINTS:]
        if len(self._rest):
            time.sleep(LIVE_PAUSE)
        else:
            self._rest = None
            stage.finish()


@dataclass(frozen=True, slots=True)
class Document:
    """A session with what the file held.

    `path`: where to save it, None for what is no painting of ours; `known`: whether the session's log leads from
    nothing to the painting; `script`: a recording still to be played; `notes`: what was lost or replaced.
    """

    session: Session
    path: Path | None = None
    known: bool = True
    script: Playing | None = None
    notes: tuple[str, ...] = ()


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
    return Document(session, path if found.native else None, told is not None, None, found.notes)


def save(path: Path, painting: Painting, recording: Recording | None) -> None:
    """The painting as .ora, with its recording if that is known, replaced in one step; WriteError if that failed."""
    archive.save(path, archive.Snapshot(painting, recording))


def write_picture(request: q.Export, painting: Painting) -> None:
    """The frame, or the rectangle asked for, as a picture; WriteError if that failed."""
    export.export(request.path, export.Picture(painting, request.level, request.area))
