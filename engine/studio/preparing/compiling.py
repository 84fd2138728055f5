"""A process that fills the cache of kernels: it does what it is told to exercise, and tells what it compiles.

It reads lines of JSON: jobs (`exercise.run`), and answers to its own questions.  It writes {"missing": NAME}, and goes
on when it may compile that kernel; where another process does, the job is left for later; {"saved": NAME}; and after
each job {"done": true}, with "blocked": NAME if it was left, or "fault": what went wrong.  It ends when nothing can be
read any more: its parent is gone.
"""

from __future__ import annotations

import gc
import json
import os
import threading
import traceback
from queue import SimpleQueue
from typing import Any, TextIO

_RARELY = (
    50_000,
    20,
    50,
)  # objects, and rounds: what a kernel is compiled with is hundreds of thousands that stay a while


class Elsewhere(Exception):
    """Another process compiles this kernel now."""


class Post:
    """The lines from and to the parent."""

    def __init__(self, source: TextIO, target: TextIO) -> None:
        self._source, self._target = source, target
        self._lines: SimpleQueue[dict[str, Any]] = SimpleQueue()
        threading.Thread(target=self._read, name="inkfall post", daemon=True).start()

    def next(self) -> dict[str, Any]:
        """Returns the next line, when it comes."""
        return self._lines.get()

    def tell(self, **told: object) -> None:
        """Writes one line of JSON to the program that started this one, if it still listens."""
        try:
            self._target.write(json.dumps(told) + "\n")
            self._target.flush()
        except OSError:
            os._exit(0)

    def missing(self, name: str) -> None:
        """Asks whether to compile a kernel; Elsewhere if another process does."""
        self.tell(missing=name)
        if not self.next()["yours"]:
            raise Elsewhere(name)

    def _read(self) -> None:
        for line in self._source:
            self._lines.put(json.loads(line))
        os._exit(0)  # also in the midst of a kernel: files are written in one step


def main(niceness: int) -> None:
    """Works until the parent has gone."""
    gc.set_threshold(*_RARELY)  # else a seventh of the time goes into looking for garbage
    if hasattr(os, "nice"):
        os.nice(niceness)
    target = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # nothing that is printed gets between the lines
    post = Post(os.fdopen(os.dup(0), encoding="utf-8"), target)

    from engine.checks.field_error import FieldError
    from engine.files.fault import FileError
    from engine.kernel_cache import Watch, watched
    from engine.studio.preparing import exercise

    watch = Watch(post.missing, lambda name: post.tell(saved=name))
    while True:
        job = post.next()
        try:
            with watched(watch):
                exercise.run(job)
        except Elsewhere as error:
            post.tell(done=True, blocked=str(error))
        except (FieldError, FileError) as error:  # a brush of the artist's own that names what is not there
            post.tell(done=True, fault=str(error))
        except Exception:
            post.tell(done=True, fault=traceback.format_exc(limit=-3))
        else:
            post.tell(done=True)
