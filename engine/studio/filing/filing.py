"""Files of the painting on the easel: opening, playing, saving, exporting."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from engine.archive.plot_files import OTHERWISE, Mark, otherwise
from engine.checks.owned import Owned
from engine.journal.heads import head_of_file, head_of_new
from engine.journal.volume import Continued
from engine.keeping.preferences import Preferences
from engine.numeric.arithmetic import NEWEST
from engine.painting.recording import Header
from engine.painting.value import first_painting, header_for
from engine.studio import faults, results
from engine.studio import requests as q
from engine.studio.easel import Easel
from engine.studio.filing import documents
from engine.studio.filing.document import Document
from engine.studio.filing.exports import Exports
from engine.studio.filing.filming import Filming
from engine.studio.filing.opening_requests import CancelOpening, FileRead, FileWhole, Show, StopPlaying
from engine.studio.filing.openings import Openings, Wanted
from engine.studio.filing.playing import PIECE, Playing, looked
from engine.studio.filing.recovering import reopened
from engine.studio.filing.saves import Saves
from engine.studio.filing.writers import Post, Writers

# Hears that another painting comes on the easel: what it began with, the entry that goes on, and its commands so far.
Turned = Callable[[Mapping[str, object], Continued | None, int], None]


class Filing(Owned):
    """The files of the painting on the easel.  It belongs to the engine's thread.

    `due`: when a recording that plays goes on, by the monotonic clock, None when none plays; `openings`: what is being
    opened.
    """

    def __init__(self, easel: Easel, post: Post, preferences: Preferences) -> None:
        self._easel = easel
        self.due: float | None = None
        self._script: Playing | None = None
        self._marks: tuple[Mark, ...] = ()  # of what is grown again
        self._writers = Writers(easel.send, post)
        easel.aside.append(self._writers.roots)
        self.saves = Saves(easel, self._writers, preferences)
        self.turned: Turned = lambda head, continued, count: None
        self.openings = Openings(easel, post, self.replace)
        self._exports = Exports(easel, self._writers)
        self._filming = Filming(easel, self._writers, post, self.saves.making)
        self.handlers: dict[type, Callable[[Any], None]] = {
            q.New: self._new,
            q.Open: self._open,
            q.Recover: self._recover,
            q.Export: self._exports.export,
            **self.saves.handlers,
            **self._filming.handlers,
            **self._writers.handlers,
            FileRead: self.openings.read,
            FileWhole: self.openings.whole,
            Show: self.openings.show,
            CancelOpening: lambda request: self.openings.cancel(),
            StopPlaying: lambda request: self._stop(),
        }

    def close(self) -> None:
        """Waits for files that are being written; for one that is being read, nobody does; a film is given up."""
        self.openings.cancel()
        self._filming.close()
        self._exports.close()
        self.saves.close()

    def replace(self, document: Document) -> None:
        """Puts another painting on the easel, and tells what its file lost.

        The one place where that happens: for a new painting, for what was opened, once it is whole, for what comes
        from elsewhere.  Until then the painting before is there and can be painted on; from here on it is gone, but
        for files that are still being written of it.  The journal hears first: what the painting began with, and the
        entry that goes on; of a recording that was played, all its commands.  The saves hear last.
        """
        easel, live, again = self._easel, document.live, document.reopened
        if again is None:
            self.turned(_head(document), None, 0)
        else:
            self.turned(again.head, again.continued, again.count)
        if document.played:
            for command in document.log:
                easel.session.heard(command, None)
        self._script, self._marks = None if live is None else Playing(live), document.marks
        self.due = None if live is None else 0.0
        easel.send(results.Played(None if live is None else 0.0))
        easel.show(document.session(), document.path, modified=document.unsaved)
        if again is not None:
            easel.name = document.name
            easel.tell()
        self.saves.show(document)
        if document.view is not None:
            easel.send(looked(document.view))
        if document.notes:
            easel.send(_losses(document))
        elif live is not None:
            easel.send(results.Note(f"Playing {document.name}"))

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
        before = self._script.part
        self.due = self._script.advance(self._easel)
        if self.due is None:
            self._ended("The recording has ended")
        elif int(100 * self._script.part) > int(100 * before):
            self._easel.send(results.Played(self._script.part))

    def _stop(self) -> None:
        """Ends the recording that plays, with the stroke that it draws."""
        if self._script is not None:
            if self._script.drawing:
                self._script.complete(self._easel)
            self._ended("The recording was stopped")

    def _ended(self, told: str) -> None:
        self._script = self.due = None
        self._easel.saved = None if self._easel.session.log else self._easel.session.state
        self._easel.tell()
        self._easel.send(results.Played())
        self._easel.send(results.Note(told))

    def _new(self, request: q.New) -> None:
        self.openings.cancel()
        header = Header(request.frame, request.seed, arithmetic=NEWEST, grid=request.grid, paper=request.paper)
        self.replace(Document(first_painting(header), header=header))

    def _open(self, request: q.Open) -> None:
        read = partial(documents.opened, request.path, request.live, request.untitled)
        self.openings.start(Wanted(request.path.name, read, request.path))

    def _recover(self, request: q.Recover) -> None:
        """Opens an entry, whose journal goes on with it: as a painting without a file, and not saved."""
        if not request.at_once:
            self.openings.start(Wanted(request.name or request.folder.name, partial(reopened, request.folder)))
            return
        self.openings.cancel()
        try:
            document = reopened(request.folder, documents.NOBODY)
        except Exception as error:
            self._easel.send(faults.told(error, "while a painting was recovered", "recover"))
        else:
            self.replace(document)


def _losses(document: Document) -> results.Note:
    """Returns what is told of a file that does not give all that it held: the one line, or how many there are."""
    lines = document.notes
    text = f"{document.name}: {lines[0] if len(lines) == 1 else f'{len(lines)} things are not as they were'}"
    told = lines if len(lines) > 1 else ()
    return results.Note(text, bad=True, stays=True, about="painting", lines=told)


def _head(document: Document) -> Mapping[str, object]:
    """Returns what the journal says a painting began with: the file that was opened, or nothing."""
    header = document.header
    if document.stamp is None:
        return head_of_new(header, document.name, document.folder)
    told = replace(header_for(document.painting), extra=header.extra)
    return head_of_file(document.stamp, document.path is not None, told)
