"""An entry is begun anew whose folder was removed: with what the painting began with, and all that was done since.

Both are in memory.  It is made beside the engine's thread, and the journal turns to it when it is there.
"""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from engine.checks.owned import Owned
from engine.files.fault import FileError
from engine.journal.entries import new_entry, unlock_entry
from engine.journal.heads import head_again
from engine.journal.kept import keep_painting, keep_source
from engine.journal.records import Kind, Members, told_command
from engine.journal.story import spent
from engine.journal.volume import Continued, Volume
from engine.journal.writing import RETRY
from engine.painting import commands as c
from engine.painting.recording import Header
from engine.painting.textures import Texture
from engine.painting.times import time_of
from engine.painting.value import Painting

Do = Callable[[Callable[[], None]], Future[None] | None]  # has a job done beside the engine's thread


@dataclass(frozen=True, eq=False, slots=True)
class Past:
    """How the painting on the easel came about.  `path`: its file, `name`: what it is called; `header`, `folder`: of
    its recording; `base`: what `commands` began with, None for nothing; `textures`: that it has; `unsaved`: it is in no
    file."""

    path: Path | None
    name: str
    header: Header
    folder: Path | None
    base: Painting | None
    commands: Sequence[c.Command]
    textures: tuple[Texture, ...]
    unsaved: bool


@dataclass(frozen=True, eq=False, slots=True)
class Begun:
    """An entry that tells of `commands` as soon as the journal goes on with it."""

    head: Members
    continued: Continued
    commands: Sequence[c.Command]

    def until(self, commands: Sequence[c.Command]) -> Continued:
        """Returns what tells of all `commands`, of which those that it has are the first; but for the last of those, if
        another one took its place."""
        first, count = self.continued.first, len(self.commands)
        if count and commands[count - 1] is not self.commands[-1]:
            first, count = first[:-1], count - 1
        return replace(self.continued, first=(*first, *_told(commands[count:])))

    def drop(self) -> None:
        """Gives it up: nobody wants it any more."""
        _drop(self.continued.folder, self.continued.lock)


class Anew(Owned):
    """It belongs to the engine's thread.  `do` has a job done beside that, whose end `wake` tells it."""

    def __init__(self, do: Do, wake: Callable[[], None]) -> None:
        self._do, self._wake = do, wake
        self._making: Future[None] | None = None
        self._begun: list[tuple[Volume, Begun]] = []
        self._next = 0.0  # when it may be tried again

    def begun(self, lost: Volume, past: Callable[[], Past]) -> Begun | None:
        """Returns an entry in place of one that is lost, of the past as it was when it was first asked for; None as
        long as there is none."""
        if self._making is not None and not self._making.done():
            return None
        now = time.monotonic()
        while self._begun:
            of, begun = self._begun.pop()
            if of is lost:
                self._next = 0.0
                return begun
            begun.drop()
        if now >= self._next:
            self._next, wake = now + RETRY, self._wake
            self._making = self._do(partial(_make, lost, past(), self._begun))
            if self._making is not None:
                self._making.add_done_callback(lambda made: wake())
        return None

    def begun_now(self, lost: Volume, past: Callable[[], Past]) -> Begun | None:
        """Returns the same, for which it waits; None if it cannot be."""
        if self._making is not None:
            self._making.exception()
        if not self._begun:
            with suppress(FileError, OSError):
                _make(lost, past(), self._begun)
        return self.begun(lost, past) if self._begun else None

    def drop(self) -> None:
        """Another painting comes, or none."""
        self._next = 0.0
        while self._begun:
            self._begun.pop()[1].drop()


def _make(lost: Volume, past: Past, out: list[tuple[Volume, Begun]]) -> None:
    begun = _made(lost.parent, past)
    if lost.end is None:
        out.append((lost, begun))
    else:
        begun.drop()


def _made(parent: Path, past: Past) -> Begun:
    """Returns a new entry, with all that lies beside its journal.  FileError or OSError if that cannot be written."""
    folder, lock = new_entry(parent)
    try:
        base = None if past.base is None else keep_painting(folder, past.base)
        for source in (source for texture in past.textures for source in texture.pictures):
            keep_source(folder, source)
        clocks = [clock for command in past.commands if (clock := time_of(command)) is not None]
        head = head_again(past.name, past.path, past.header, past.folder, base)
        head |= {"unsaved": past.unsaved, "seconds": spent(clocks)}
        return Begun(head, Continued(folder, lock, 0, -1, tuple(_told(past.commands))), past.commands)
    except BaseException:
        _drop(folder, lock)
        raise


def _told(commands: Sequence[c.Command]) -> list[tuple[Kind, bytes]]:
    return [(Kind.DID, told_command(command)) for command in commands]


def _drop(folder: Path, lock: int | None) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    unlock_entry(lock)
