"""The saves of the painting on the easel: one at a time, in the order in which they were asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from engine.checks.owned import Owned
from engine.keeping.on_disk import OnDisk, Overtaken, Replacement
from engine.keeping.preferences import Preferences
from engine.painting.guiding.guides import Guide, guides_after
from engine.painting.recording import Recording
from engine.painting.value import Painting
from engine.studio import requests as q
from engine.studio import results
from engine.studio.easel import Easel
from engine.studio.filing import documents
from engine.studio.filing.bounds import bound_kept
from engine.studio.filing.document import Document
from engine.studio.filing.writers import Writers

ELSEWHERE = "{} is open in another window: each saves over what the other has saved"
MISSING = "{} had been moved or deleted: it is there again"
LINKED = "{} is saved; the other names of the file that was there (hard links) still have what it was"
LOST = "{} is saved; its earlier version could not be kept ({})"


@dataclass(frozen=True, eq=False, slots=True)
class _Asked:
    """A save that was asked for: references to the painting as it was then.  `state`: that of the session; `serial`: of
    the easel; `mark`: hears of it when it is saved; `replaces`: waits until what is there is not needed any more."""

    request: q.Save
    painting: Painting
    state: object
    recording: Recording | None
    serial: int
    files: OnDisk
    mark: Callable[[Path], None]
    replaces: Callable[[], None]
    preferences: Preferences

    def write(self, grown: Painting) -> results.Result:
        """Writes it, on a thread of its own; returns what the window is to know."""
        path = self.request.path
        bound_kept(self.preferences)  # a disk that is nearly full has room for the painting first
        try:
            with self.files.saving(path, self.request.sure) as one:
                documents.save(path, grown, self.recording, partial(self._ready, one))
            bound_kept(self.preferences)
        except Overtaken as reason:
            return results.Overtaken(path, reason.elsewhere)
        return results.Saved(path, _told(path, one))

    def _ready(self, one: Replacement, part: Path) -> None:
        self.replaces()
        one.ready(part)


def _told(path: Path, one: Replacement) -> str:
    if one.lost:
        return LOST.format(path.name, one.lost)
    if one.linked:
        return LINKED.format(path.name)
    return MISSING.format(path.name) if one.missing else ""


def _with_symmetry(painting: Painting, symmetry: Guide | None) -> Painting:
    """Returns a painting with another symmetry: no pixel depends on it, and what was undone can still be done again."""
    return painting if symmetry is None else replace(painting, guides=guides_after(painting.guides, symmetry))


class Saves(Owned):
    """What is saved, and what waits for it: of each file the newest that was asked for.  It belongs to the engine's
    thread."""

    def __init__(self, easel: Easel, writers: Writers, preferences: Preferences) -> None:
        self._easel, self._writers, self._preferences = easel, writers, preferences
        self._files = OnDisk(preferences)
        self._known = True  # whether the session's log leads from nothing to the painting
        self._running = self._closing = False
        self._waiting: dict[Path, _Asked] = {}
        easel.aside.append(lambda: [asked.painting.root for asked in self._waiting.values()])
        self.mark: Callable[[], Callable[[Path], None]] = lambda: lambda path: None  # what hears that it is saved
        self.replaces: Callable[[Path], Callable[[], None]] = lambda path: lambda: None  # what waits before that
        self.handlers: dict[type, Callable[[q.Save], None]] = {q.Save: self._save}

    def show(self, document: Document) -> None:
        """Turns to another painting, which is on the easel now."""
        self._files.release()
        self._files, self._known = OnDisk(self._preferences), document.known
        path = document.path
        if path is not None and not self._files.opened(path, document.seen):
            text = ELSEWHERE.format(path.name)
            note = results.Note(text, bad=True, stays=True, offers=("save_as",), about="elsewhere", path=path)
            self._easel.send(note)

    def close(self) -> None:
        """Waits until all is saved, and gives up the painting's file."""
        self._closing = True
        self._writers.close()
        while self._waiting:  # what is on its way has ended, but is still to be told
            self._start()
            self._writers.close()
        self._files.release()

    def making(self) -> Recording | None:
        """Returns how the painting was made, if that is known."""
        return self._easel.session.recording() if self._known else None

    def _save(self, request: q.Save) -> None:
        """Saves the painting as it is now; painting goes on meanwhile."""
        easel = self._easel
        if easel.live is not None:
            easel.finish()
        recording = self.making()
        asked = _Asked(
            request,
            _with_symmetry(easel.session.painting, request.symmetry),
            easel.session.state,
            recording,
            easel.serial,
            self._files,
            self.mark(),
            self.replaces(request.path),
            self._preferences,
        )
        self._waiting.pop(request.path, None)  # it is older
        self._waiting[request.path] = asked
        if not self._running:
            self._start()

    def _start(self) -> None:
        asked = self._waiting.pop(next(iter(self._waiting)))
        self._running = True
        self._writers.start(asked.write, asked.painting, lambda told: self._ended(asked, told), saving=True)

    def _ended(self, asked: _Asked, told: results.Result | None) -> None:
        """Hears what came of a save, None if it failed, and begins the next."""
        self._running = False
        same = asked.serial == self._easel.serial  # the same painting is still on the easel
        if isinstance(told, results.Saved):
            asked.mark(told.path)
            if same:
                self._easel.path, self._easel.saved = told.path, asked.state
                self._easel.tell()
        elif isinstance(told, results.Overtaken):
            self._waiting.pop(told.path, None)  # it would be asked about twice
            if not same or self._closing:  # there is nothing left to ask about, or nobody
                told = results.Note(f"{told.path.name} was not saved: {told.words}", bad=True, stays=True, about="save")
        if told is not None:
            self._easel.send(told)
        if self._waiting:
            self._start()
