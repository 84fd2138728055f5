"""Files of the painting on the easel: opening, playing, saving, exporting; and whether it is as its file has it."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

from engine.archive.plot_files import OTHERWISE, Mark, otherwise
from engine.painting.value import Painting
from engine.session.session import Session
from engine.strokes.example_stroke import Live
from engine.studio import documents, results
from engine.studio import requests as q
from engine.studio.playing import PIECE, Playing, Stage
from engine.studio.writers import Writers


class Host(Stage, Protocol):
    """What filing needs of the easel."""

    session: Session
    live: Live | None

    def show(self, session: Session, path: Path | None) -> None: ...
    def tell(self) -> None: ...


class Filing:
    """`path`: the file of the painting; `serial`: another number, another painting; `due`: when a recording that plays
    goes on, by the monotonic clock, None when none plays."""

    def __init__(self, host: Host) -> None:
        self.host = host
        self.path: Path | None = None
        self.serial = 0
        self.due: float | None = None
        self._saved: object = host.session.state  # as the file has it; None for none
        self._script: Playing | None = None
        self._marks: tuple[Mark, ...] = ()  # of what is grown again
        self._known = True  # whether the session's log leads from nothing to the painting
        self._writers = Writers(host.send)
        self.handlers: dict[type, Callable[[Any], None]] = {
            q.New: self._new,
            q.Open: self._open,
            q.Save: self._save,
            q.Export: self._export,
        }

    @property
    def modified(self) -> bool:
        return self.host.session.state is not self._saved

    def shown(self, session: Session, path: Path | None) -> None:
        """Another painting is on the easel."""
        self._script, self.due, self._known, self._marks = None, None, True, ()
        self.path, self._saved = path, session.state
        self.serial += 1

    def close(self) -> None:
        """Waits for files that are being written."""
        self._writers.close()

    def comes_between(self, request: q.Request) -> bool:
        """Lets a request wait for the stroke of a recording that plays; False if it is to be passed over."""
        if self._script is None or not self._script.drawing:
            return True
        if isinstance(request, q.Points | q.Finish | q.Abandon):
            return False  # of a stroke that was refused
        if isinstance(request, q.Begin | q.Do | q.Save):
            self._script.complete(self.host)  # what is asked for comes after the recording's stroke, not into it
        return True

    def grown(self) -> None:
        """All that was painted with examples is grown: tells if it is not what it was in the file."""
        marks, self._marks = self._marks, ()
        if otherwise(marks, self.host.session.painting.root):
            self.host.send(results.Note(OTHERWISE, bad=True))

    def play(self) -> None:
        """The next piece of a recording that plays."""
        assert self._script is not None
        if self.host.live is not None and not self._script.drawing:  # a hand draws: its stroke comes first
            self.due = time.monotonic() + PIECE
            return
        self.due = self._script.advance(self.host)
        if self.due is None:
            self._script = None
            self._saved = None if self.host.session.log else self.host.session.state
            self.host.tell()
            self.host.send(results.Note("The recording has ended"))

    def _new(self, request: q.New) -> None:
        self.host.show(Session(Painting(frame=request.frame, seed=request.seed)), None)

    def _open(self, request: q.Open) -> None:
        found = documents.opened(request.path, request.live)
        self.host.show(found.session, found.path)
        self._known, self._script, self._marks = found.known, found.script, found.marks
        self.due = None if found.script is None else 0.0
        if found.script is not None:
            self.host.send(results.Note(f"Playing {request.path.name}"))
        elif found.notes:
            self.host.send(results.Note(f"{request.path.name}: {found.notes[0]}", bad=True))

    def _save(self, request: q.Save) -> None:
        """Writes on a thread of its own, from the painting as it is now; painting goes on meanwhile."""
        if self.host.live is not None:
            self.host.finish()
        painting, state = self.host.session.painting, self.host.session.state
        recording = self.host.session.recording() if self._known else None
        serial = self.serial

        def write(grown: Painting) -> None:
            documents.save(request.path, grown, recording)
            if serial == self.serial:  # the same painting is still on the easel
                self.path, self._saved = request.path, state
                self.host.tell()
            self.host.send(results.Saved(request.path))

        self._writers.start(write, painting, True)

    def _export(self, request: q.Export) -> None:
        painting = self.host.session.painting

        def write(grown: Painting) -> None:
            documents.write_picture(request, grown)
            self.host.send(results.Note(f"Wrote {request.path.name}"))

        self._writers.start(write, painting, False)
