"""What a file held that was opened, as values that go from one thread to another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from engine.archive.plot_files import Mark
from engine.journal.entries import unlock_entry
from engine.journal.heads import FileStamp
from engine.journal.volume import Continued
from engine.keeping import memory
from engine.keeping.fingerprint import Fingerprint
from engine.painting import commands as c
from engine.painting.recording import Header, Recording
from engine.painting.value import Painting
from engine.session.history import HeldSteps, History
from engine.session.session import Session


@dataclass(frozen=True, slots=True, eq=False)
class Reopened:
    """The entry that a recovered painting goes on in: what it begins with now, where its journal goes on, and how many
    commands it has."""

    head: Mapping[str, object]
    continued: Continued
    count: int


@dataclass(frozen=True, slots=True, eq=False)
class Document:
    """What a file held: values alone, so any thread may make it.

    `name`: the file's; `path`: where to save it, None for what is no painting of ours; `log`: the commands that led to
    the painting; `folder`: what paths in it are relative to; `header`: of their recording; `base`: what the log begins
    with, if that is not nothing; `known`: there was nothing before that; `steps`: that can be undone, `leapt`: and
    beyond them;
    `played`: the commands are news to the journal; `unsaved`: the painting is in no file yet; `live`: a recording still
    to be played, stroke by stroke; `notes`: what was lost or replaced; `marks`: of what is to be grown again; `view`:
    where a recording looked last; `seen`, `stamp`: what the file was before it was read, None for a painting that
    begins with nothing; `reopened`: the entry of a recovered one, which is held until it is shown or dropped.
    """

    painting: Painting
    name: str = ""
    path: Path | None = None
    log: Sequence[c.Command] = ()
    folder: Path | None = None
    header: Header = field(default_factory=Header)
    base: Painting | None = None
    known: bool = True
    steps: HeldSteps = field(default_factory=HeldSteps)
    leapt: bool = False
    played: bool = False
    unsaved: bool = False
    live: Recording | None = None
    notes: tuple[str, ...] = ()
    marks: tuple[Mark, ...] = ()
    view: c.View | None = None
    seen: Fingerprint | None = None
    stamp: FileStamp | None = None
    reopened: Reopened | None = None

    def drop(self) -> None:
        """Gives back what is held for it: nobody wants it any more."""
        if self.reopened is not None:
            unlock_entry(self.reopened.continued.lock)

    def session(self) -> Session:
        """Returns a session with the painting, for the thread that calls this."""
        history = History(memory.history_share(), steps=self.steps)
        made = Session(self.painting, log=self.log, folder=self.folder, history=history, extra=self.header.extra)
        made.base, made.leapt = self.base or made.base, self.leapt
        return made


def held_by(session: Session, known: bool = True) -> Document:
    """Returns what a session holds; `known`: its log leads from nothing to the painting."""
    history, steps = session.history, session.history.steps
    return Document(
        session.painting,
        log=session.log.now(),
        folder=session.folder,
        header=session.recording().header,
        base=session.base,
        known=known,
        steps=steps,
        leapt=session.leapt or len(steps.done) + len(steps.undone) < history.undo_count + history.redo_count,
    )
