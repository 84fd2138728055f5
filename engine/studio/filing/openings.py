"""The file that is being opened: read on a thread of its own, while painting goes on.

The thread shares nothing with the studio.  What it has to say it posts to it as requests.  It may hang for ever, on a
folder of a network that is gone: nobody waits for it, and a later opening has another one.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from engine.checks.owned import Owned
from engine.files.fault import Cancelled
from engine.studio import faults, results
from engine.studio.easel import Easel
from engine.studio.filing.document import Document
from engine.studio.filing.opening_requests import FileRead, FileWhole, Show
from engine.studio.filing.writers import TELL, Post


class Watch:
    """What a thread that opens a file tells of it, and hears: how far it is, and that nobody wants it any more.

    `tell` and `check` are called by that thread, `cancel` by the engine's.
    """

    def __init__(self, file: int, post: Post) -> None:
        self._file, self._post = file, post
        self._stop = threading.Event()
        self._told = time.monotonic()

    @property
    def cancelled(self) -> bool:
        """Tells whether nobody wants the file any more."""
        return self._stop.is_set()

    def cancel(self) -> None:
        """Has it given up, as soon as its thread looks."""
        self._stop.set()

    def tell(self, part: float) -> None:
        """Tells the part that is done, 0..1, not too often; raises Cancelled if nobody wants the rest."""
        self.check()
        now = time.monotonic()
        if now - self._told >= TELL:
            self._told = now
            self._post(FileRead(self._file, min(1.0, part)))

    def check(self) -> None:
        """Raises Cancelled if nobody wants the file any more."""
        if self.cancelled:
            raise Cancelled


Reader = Callable[[Watch], Document]


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is to be opened: how it is called, and what reads it.  `read` makes a document out of values alone, and
    looks at the watch that it is given now and then; whatever it raises is told.  `path`: its own, where it can be
    asked for again by that."""

    name: str
    read: Reader
    path: Path | None = None


@dataclass(eq=False, slots=True)
class _File:
    """The file on its way.  `state`: of the session when it was asked for; `document`: what it held, once it is
    whole."""

    number: int
    name: str
    watch: Watch
    state: object
    document: Document | None = None


class Openings(Owned):
    """The file that is being opened, at most one.  It belongs to the engine's thread.

    It is read beside the painting, which can be painted on meanwhile.  When it is whole the window hears `Whole`, and
    answers with `Show`, after all that it posted before: so no stroke that was begun on the one painting comes onto the
    other.  If the painting was changed meanwhile, and that is not saved, the window is to ask first.  `replace` is
    called with what the file held; `post` is called from the thread that reads.
    """

    def __init__(self, easel: Easel, post: Post, replace: Callable[[Document], None]) -> None:
        self._easel, self._post, self._replace = easel, post, replace
        self._file: _File | None = None
        self._count = 0

    def start(self, wanted: Wanted) -> None:
        """Has a file read on a thread of its own, instead of the one that is being read now."""
        self._drop()
        self._count += 1
        file = _File(self._count, wanted.name, Watch(self._count, self._post), self._easel.session.state)
        self._file = file
        self._easel.send(results.Opening(wanted.name))
        words = (file.number, wanted, file.watch, self._post)
        threading.Thread(target=_run, args=words, name="inkfall opening", daemon=True).start()

    def cancel(self) -> None:
        """Gives up what is being opened, if anything is; its thread ends when it looks, or never."""
        if self._file is not None:
            self._drop()
            self._easel.send(results.Opening())

    def _drop(self) -> None:
        if self._file is not None:
            self._file.watch.cancel()
            if self._file.document is not None:
                self._file.document.drop()
            self._file = None

    def _mine(self, number: int) -> _File | None:
        return self._file if self._file is not None and self._file.number == number else None

    def read(self, request: FileRead) -> None:
        """Tells the window how far the file is."""
        file = self._mine(request.file)
        if file is not None:
            self._easel.send(results.Opening(file.name, request.part))

    def whole(self, request: FileWhole) -> None:
        """Keeps what the file held until the window answers; or tells why it is refused."""
        file = self._mine(request.file)
        if file is None:
            if request.document is not None:
                request.document.drop()
            return
        if request.fault is not None:
            self._easel.send(request.fault)
            self.cancel()
        else:
            file.document = request.document
            self._easel.send(results.Whole(file.number, file.name))

    def show(self, request: Show) -> None:
        """Lets the file take the painting's place, unless that is to be asked about."""
        file = self._mine(request.file)
        if file is None or file.document is None:  # it was given up meanwhile
            return
        easel = self._easel
        changed = easel.live is not None or (easel.modified and easel.session.state is not file.state)
        if changed and not request.sure:
            easel.send(results.Whole(file.number, file.name, changed=True))
            return
        self._file = None
        self._replace(file.document)
        easel.send(results.Opening())


def _run(number: int, wanted: Wanted, watch: Watch, post: Post) -> None:
    """Reads a file, on a thread of its own."""
    try:
        document = wanted.read(watch)
    except Exception as error:
        if not watch.cancelled:
            about = "recover" if wanted.path is None else "open"
            post(FileWhole(number, fault=faults.told(error, "while a file was opened", about, wanted.path)))
    else:
        post(FileWhole(number, document))
