"""Files on their way: each is written on a thread of its own, from a painting as it was, and the window hears of it.

The threads share nothing with the studio.  What they have to say they post to it as requests.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from engine.canvas.layers import Group
from engine.checks.owned import Owned
from engine.keeping import memory
from engine.painting.grown import settled
from engine.painting.value import Painting
from engine.studio import faults, results
from engine.studio import requests as q

TELL = 0.1  # seconds between two posts about one file, at least
Send = Callable[[results.Result], None]
Post = Callable[[q.Request], None]
Write = Callable[[Painting], results.Result | None]  # gives what there is to tell
Ended = Callable[[results.Result | None], None]  # hears that, None if it failed


@dataclass(eq=False, slots=True)
class _File:
    """A file on its way, of a `painting` as it was.  `saving`: it is the painting's own; `ended` is called when it is
    written or has failed; `grown`: how far its painting is, 0..1."""

    thread: threading.Thread
    painting: Painting
    saving: bool
    ended: Ended
    grown: float = 1.0


class Writers(Owned):
    """The files that are being written.  It belongs to the engine's thread.  `post` is called from those that write."""

    def __init__(self, send: Send, post: Post) -> None:
        self._send, self._post = send, post
        self._files: dict[int, _File] = {}
        self._count = 0
        self.handlers: dict[type, Callable[[Any], None]] = {q.FileGrown: self._grown, q.Written: self._written}

    def start(self, write: Write, painting: Painting, ended: Ended, saving: bool = False) -> None:
        """Has a painting grown to its end and given to `write` on a thread of its own; calls `ended` here after it."""
        self._count += 1
        about = "save" if saving else "export"
        thread = threading.Thread(
            target=_run, args=(self._count, write, painting, self._post, about), name="inkfall file", daemon=False
        )
        self._files[self._count] = _File(thread, painting, saving, ended)
        self._tell()
        thread.start()

    def roots(self) -> list[Group]:
        """Returns the layers of all that is being written."""
        return [file.painting.root for file in self._files.values()]

    def close(self) -> None:
        """Waits until all files are written; what their threads posted is still to be carried out."""
        for file in self._files.values():
            file.thread.join()

    def _grown(self, request: q.FileGrown) -> None:
        self._files[request.file].grown = request.part
        self._tell()

    def _written(self, request: q.Written) -> None:
        file = self._files.pop(request.file)
        if request.fault is not None:
            self._send(request.fault)
        file.ended(request.told)
        self._tell()

    def _tell(self) -> None:
        files = self._files.values()
        saving, grown = any(file.saving for file in files), min((file.grown for file in files), default=1.0)
        self._send(results.Writing(len(files), saving, grown))


def _run(file: int, write: Write, painting: Painting, post: Post, about: str) -> None:
    """Writes a file, on a thread of its own.  `about`: "save" or "export"."""
    told = 0.0

    def tell(part: float) -> None:
        nonlocal told
        now = time.monotonic()
        if part >= 1.0 or now - told >= TELL:
            told = now
            post(q.FileGrown(file, part))

    try:
        outcome = write(settled(painting, tell=tell))
    except Exception as error:
        post(q.Written(file, faults.told(error, "while a file was written", about)))
    else:
        post(q.Written(file, told=outcome))
    memory.settle()
