"""Files of the painting on the easel: opening, playing, saving, exporting."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from engine.archive.plot_files import OTHERWISE, Mark, otherwise
from engine.checks.owned import Owned
from engine.files.fault import FileError
from engine.journal.entries import lock_entry
from engine.journal.heads import FileStamp, head_of_file, head_of_new, renamed_head
from engine.journal.volume import Continued, continued_entry
from engine.keeping.preferences import Preferences
from engine.keeping.unfinished import unfinished
from engine.painting.value import Painting
from engine.session.session import Session
from engine.studio import faults, results
from engine.studio import requests as q
from engine.studio.easel import Easel
from engine.studio.filing import documents
from engine.studio.filing.documents import Document
from engine.studio.filing.playing import PIECE, Playing
from engine.studio.filing.recovering import recovered
from engine.studio.filing.saves import Saves
from engine.studio.filing.writers import Post, Writers

# Hears that another painting comes on the easel: what it began with, the entry that goes on, and its commands so far.
Turned = Callable[[Mapping[str, object], Continued | None, int], None]


class Filing(Owned):
    """The files of the painting on the easel.  It belongs to the engine's thread.

    `due`: when a recording that plays goes on, by the monotonic clock, None when none plays.
    """

    def __init__(self, easel: Easel, post: Post, preferences: Preferences) -> None:
        self._easel = easel
        self.due: float | None = None
        self._script: Playing | None = None
        self._marks: tuple[Mark, ...] = ()  # of what is grown again
        self._writers = Writers(easel.send, post)
        self.saves = Saves(easel, self._writers, preferences)
        self.turned: Turned = lambda head, continued, count: None
        self.handlers: dict[type, Callable[[Any], None]] = {
            q.New: self._new,
            q.Open: self._open,
            q.Recover: self._recover,
            q.Export: self._export,
            **self.saves.handlers,
            **self._writers.handlers,
        }

    def close(self) -> None:
        """Waits for files that are being written."""
        self.saves.close()

    def comes_between(self, request: q.Request) -> bool:
        """Lets a request wait for the stroke of a recording that plays; False if it is to be passed over."""
        if self._script is None or not self._script.drawing:
            return True
        if isinstance(request, q.Points | q.Finish | q.Abandon):
            return False  # of a stroke that was refused
        if isinstance(request, q.Begin | q.Do | q.Save):
            self._script.complete(self._easel)  # what is asked for comes after the recording's stroke, not into it
        return True

    def grown(self) -> None:
        """Tells, once all that was painted with examples is grown, if it is not what it was in the file."""
        marks, self._marks = self._marks, ()
        if otherwise(marks, self._easel.session.painting.root):
            self._easel.send(results.Note(OTHERWISE, bad=True, stays=True, about="grown"))

    def play(self) -> None:
        """Plays the next piece of a recording."""
        assert self._script is not None
        if self._easel.live is not None and not self._script.drawing:  # a hand draws: its stroke comes first
            self.due = time.monotonic() + PIECE
            return
        self.due = self._script.advance(self._easel)
        if self.due is None:
            self._script = None
            self._easel.saved = None if self._easel.session.log else self._easel.session.state
            self._easel.tell()
            self._easel.send(results.Note("The recording has ended"))

    def _new(self, request: q.New) -> None:
        session = Session(Painting(frame=request.frame, seed=request.seed))
        self._show(Document(session), head_of_new(session.recording().header))

    def _open(self, request: q.Open) -> None:
        stamp = FileStamp.of(request.path)
        try:
            found = documents.opened(request.path, request.live, request.untitled)
        except Exception as error:
            self._easel.send(faults.told(error, "while a file was opened", "open", request.path))
            return
        self._show(found, _head(request.path, stamp, found))
        if found.script is not None and not found.notes:
            self._easel.send(results.Note(f"Playing {request.path.name}"))
        elif found.notes:
            self._easel.send(_losses(request.path.name, found.notes))

    def _recover(self, request: q.Recover) -> None:
        """Opens an entry, whose journal goes on with it: as a painting without a file, and not saved."""
        lock: int | None = None
        try:
            lock = lock_entry(request.folder)
            found = recovered(request.folder)
            continued = continued_entry(request.folder, lock, found.story, found.settled)
        except Exception as error:
            if lock is not None:
                os.close(lock)
            taken = isinstance(error, BlockingIOError)
            told = FileError(request.folder, "is open in another window") if taken else error
            self._easel.send(faults.told(told, "while a painting was recovered", "open", request.folder))
            return
        document = Document(found.session, known=found.known)
        self._show(document, renamed_head(found.story.head, found.name), continued, found.count)
        self._easel.saved, self._easel.name = None, found.name
        self._easel.tell()
        if found.missing:
            self._easel.send(_losses(found.name, tuple(found.missing)))

    def _show(
        self,
        document: Document,
        head: Mapping[str, object],
        continued: Continued | None = None,
        count: int = 0,
    ) -> None:
        self.turned(head, continued, count)
        self._script, self._marks = document.script, document.marks
        self.due = None if document.script is None else 0.0
        self._easel.show(document.session, document.path)
        self.saves.show(document)

    def _export(self, request: q.Export) -> None:
        def write(grown: Painting) -> results.Result:
            with unfinished(request.path):
                documents.write_picture(request, grown)
            return results.Note(f"Wrote {request.path.name}", about="export")

        self._writers.start(write, self._easel.session.painting, self._exported)

    def _exported(self, told: results.Result | None) -> None:
        if told is not None:
            self._easel.send(told)


def _losses(name: str, lines: tuple[str, ...]) -> results.Note:
    """Returns what is told of a file that does not give all that it held: one line of it, or how many there are."""
    if len(lines) == 1:
        return results.Note(f"{name}: {lines[0]}", bad=True, stays=True, about="painting")
    text = f"{name}: {len(lines)} things are not as they were"
    return results.Note(text, bad=True, stays=True, about="painting", lines=lines)


def _head(path: Path, stamp: FileStamp | None, found: Document) -> Mapping[str, object]:
    """Returns what the journal says a painting began with that was opened: its file, or nothing and what plays."""
    if found.script is not None or stamp is None:
        return head_of_new(found.session.recording().header, path.name, found.session.folder)
    return head_of_file(stamp, found.path is not None, found.session.recording().header)
