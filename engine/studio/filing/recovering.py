"""A painting as its journal tells it: from a checkpoint, or from what it began with, by the commands since.

What was asked for and has no answer is carried out last, a stroke without its end as far as it went.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from engine.archive.manifest import RECORDING
from engine.archive.members import PIECE
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.files.zip_reader import ZipArchive
from engine.journal.checkpoints import read_checkpoint
from engine.journal.entries import lock_entry, unlock_entry
from engine.journal.heads import header_of, renamed_head
from engine.journal.kept import kept_file, kept_sources, stamp_of
from engine.journal.records import NUMBER, Kind, Touch, told_command
from engine.journal.story import COMMAND, Story, Unanswered, read_story
from engine.journal.volume import continued_entry
from engine.keeping import memory
from engine.painting import commands as c
from engine.painting.recording import Header, Recording, read_from, undo_reach
from engine.painting.select_commands import Line
from engine.painting.times import members
from engine.painting.value import Painting, Refusal, first_painting
from engine.session import replay
from engine.session.apply import STEPS
from engine.session.history import History
from engine.session.session import Session
from engine.studio.filing import documents
from engine.studio.filing.document import Document, Reopened, held_by

_CAUSES = (Refusal, FileError, FieldError)
_GONE = "the file that was opened, {name}: it is gone, or another one by now"
Tell = Callable[[float], object]


@dataclass(eq=False, slots=True)
class Recovered:
    """A painting that was recovered.  `known`: whether the session's log leads from nothing to it; `missing`: what
    could not be had, a line each; `settled`: what became of all that had no answer, for the journal; `story`: what the
    journal told; `count`: how many commands that makes."""

    session: Session
    known: bool
    name: str
    story: Story
    missing: list[str] = field(default_factory=list)
    settled: list[tuple[Kind, bytes]] = field(default_factory=list)
    count: int = 0


@dataclass(frozen=True, slots=True)
class _Start:
    """Where to begin: a session after the first `index` commands."""

    session: Session
    known: bool
    index: int


@dataclass(frozen=True, slots=True)
class _Begins:
    """Who is told how far the file or the checkpoint is that a recovery begins with: it is the first half."""

    hears: Tell
    cancelled = False

    def tell(self, part: float) -> None:
        self.hears(0.5 * part)


def recovered(folder: Path, tell: Tell = lambda part: None) -> Recovered:
    """Returns the painting of an entry, as far as its journal is whole; `tell` hears of the part that is done, and what
    it raises ends that.  FileError if there is nothing to begin with."""
    story = read_story(folder, lambda: tell(0.0))
    if not story.head:
        raise FileError(folder, "found no journal that can be read")
    missing = list(story.faults)
    start = _start(folder, story, missing, _Begins(tell))
    name = story.head.get("name")
    found = Recovered(start.session, start.known, _called(name if isinstance(name, str) else ""), story, missing)
    tail, failed = story.commands[start.index :], list[str]()
    for number, command in enumerate(tail):
        _do(found.session, folder, command, failed)
        tell(0.5 + 0.5 * (number + 1) / len(tail))
    if failed:
        missing.append(f"{len(failed)} of {len(tail)} commands could not be carried out, the first: {failed[0]}")
    found.count = len(story.commands)
    for asked in story.asked.values():
        _answer(found, folder, asked)
    found.session.pictures = {}
    return found


def reopened(folder: Path, progress: documents.Progress) -> Document:
    """Returns the painting of an entry that is taken again, and whose journal goes on with it.  FileError if another
    program has it, or there is nothing to begin with; Cancelled if nobody wants it any more."""
    lock: int | None = None
    try:
        lock = lock_entry(folder)
        found = recovered(folder, progress.tell)
        continued = continued_entry(folder, lock, found.story, found.settled)
    except BaseException as error:
        unlock_entry(lock)
        if isinstance(error, BlockingIOError):
            raise FileError(folder, "is open in another window") from None
        raise
    again = Reopened(renamed_head(found.story.head, found.name), continued, found.count)
    held = held_by(found.session, found.known)
    return replace(held, name=found.name, unsaved=True, notes=tuple(found.missing), reopened=again)


def _called(name: str) -> str:
    """Returns the name of a recovered painting: "lake, recovered"."""
    stem = Path(name).stem if name else "untitled"
    return stem if stem.endswith(", recovered") else f"{stem}, recovered"


def _do(session: Session, folder: Path, command: c.Command, failed: list[str]) -> None:
    if isinstance(command, c.DefineTexture):
        session.pictures = kept_sources(folder, _shas(command))
    try:
        session.do(command)
    except _CAUSES as error:
        failed.append(str(error).partition("\n")[0])


def _shas(command: c.DefineTexture) -> Iterator[str]:
    """Yields the shas of all pictures that a definition names."""
    shapes = command.arguments.get("shapes", ())
    for told in (command.arguments, *(shapes if isinstance(shapes, tuple) else ())):
        for name in ("sha", "mask_sha", "maps_sha", "control_sha"):
            sha = told.get(name) if hasattr(told, "get") else None
            if isinstance(sha, str) and sha.isalnum():
                yield sha


def _drawn(touch: Touch, points: np.ndarray) -> c.Command:
    """Returns the command that a stroke comes to which began so."""
    if touch.selects:
        return c.Select(Line(touch.level, touch.origin, points, touch.brush, touch.copies), touch.selects, touch.level)
    about = touch.level, touch.origin, points, touch.brush, touch.layer
    return c.Stroke(*about, extra=members(touch.time), copies=touch.copies, onto=touch.onto, seen=touch.seen)


def _answer(found: Recovered, folder: Path, asked: Unanswered) -> None:
    """Carries out what had no answer, and keeps what came of it for the journal."""
    number, command = NUMBER.pack(asked.number), asked.command
    if asked.touch is not None:
        points = asked.fitted()[asked.taken :]
        if len(points):
            points.flags.writeable = False
            command = _drawn(asked.touch, points)
        if not asked.finished:
            found.missing.append(f"the end of the last stroke: {len(points)} of its points are there")
    before = len(found.session.log)
    if command is not None:
        _do(found.session, folder, command, [])  # the engine would have refused it, too
    if len(found.session.log) > before:
        found.settled.append((Kind.DONE, number + COMMAND + told_command(found.session.log[-1])))
        found.count += 1
    else:
        found.settled.append((Kind.REFUSED, number))


# --- where to begin --------------------------------------------------------------------------------------------------


def _start(folder: Path, story: Story, missing: list[str], begins: _Begins) -> _Start:
    """Returns the latest state that there is from which all undo and redo since can be done."""
    base = _Base(folder, story)
    for checkpoint in reversed(story.checkpoints):
        tail = story.commands[checkpoint.commands :]
        if checkpoint.commands > len(story.commands) or not replay.stays_within(tail):
            continue
        painting = read_checkpoint(folder, checkpoint, base.header.frame, begins.tell)
        if painting is not None:
            return base.continued(painting, checkpoint.commands)
    if replay.stays_within(story.commands):
        found = base.opened(begins)
        if found is not None:
            return found
    elif base.log is not None:  # it was leapt back behind the opening
        whole = Recording(base.header, (*base.log, *story.commands), folder=base.folder)
        session = replay.opened(whole)
        for command in base.log:
            _do(session, folder, command, [])
        return _Start(session, True, 0)
    missing.append(_GONE.format(name=base.name))
    return _Start(Session(first_painting(base.header), folder=base.folder), False, 0)


class _Base:
    """What a painting began with.  `log`: the commands that led to it, None if they are not known; `header`: of its
    recording; `folder`: what paths are relative to."""

    def __init__(self, folder: Path, story: Story) -> None:
        told = story.head.get("base")
        base = told if isinstance(told, dict) else {}
        self._commands = story.commands
        self._file: Path | None = None
        self.log: Sequence[c.Command] | None = None
        self.header = header_of(base)
        self.folder: Path | None = None
        self.name = ""
        if "file" not in base:
            self.log, self.folder = (), Path(str(base["folder"])) if base.get("folder") else None
            return
        stamp = stamp_of(base)
        self._file = kept_file(folder, stamp, (story.base or {}).get("sha"))
        self.folder, self.name = stamp.path.parent, stamp.path.name
        self.log = None if self._file is None or self._file.suffix.lower() != ".ora" else _commands(self._file)

    def opened(self, begins: _Begins) -> _Start | None:
        """Returns it as it was when nothing was done yet; None if it is gone."""
        if self._file is None and self.log is not None:
            session = replay.opened(Recording(self.header, tuple(self._commands), folder=self.folder))
            return _Start(session, True, 0)
        if self._file is None:
            return None
        found = documents.opened(self._file, progress=begins)
        session = self._session(found.painting, found.log, found.header, 0)
        return _Start(session, found.known, 0)

    def continued(self, painting: Painting, index: int) -> _Start:
        """Returns a painting that a checkpoint holds, after the first `index` commands."""
        log = (*self.log, *_folded(self._commands[:index])) if self.log is not None else ()
        return _Start(self._session(painting, log, self.header, index), self.log is not None, index)

    def _session(self, painting: Painting, log: Sequence[c.Command], header: Header, index: int) -> Session:
        history = History(memory.history_share(), undo_reach(self._commands[index:], STEPS))
        return Session(painting, log=log, folder=self.folder, history=history, extra=header.extra)


def _commands(path: Path) -> Sequence[c.Command] | None:
    """Returns the commands that led to a painting's file; None if it tells none, or not all."""
    try:
        with open(path, "rb") as file:
            archive = ZipArchive(file, str(path))
            if RECORDING not in archive:
                return None
            return read_from(io.BufferedReader(archive.open(RECORDING), PIECE), str(path)).commands
    except (OSError, FileError, FieldError):
        return None


def _folded(commands: Sequence[c.Command]) -> Iterator[c.Command]:
    """Yields commands as a log holds them: of definitions of one name in a row, the last."""
    for number, command in enumerate(commands):
        after = commands[number + 1] if number + 1 < len(commands) else None
        same = isinstance(command, c.DefineTexture) and isinstance(after, c.DefineTexture)
        if not (same and command.name == after.name):  # type: ignore[union-attr]
            yield command
