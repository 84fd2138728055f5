"""Files as the window opens and writes them, whatever their kind: paintings, pictures, recordings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from engine.archive import export, saving
from engine.archive.imports import open_image
from engine.archive.plot_files import Mark
from engine.keeping.fingerprint import Fingerprint, fingerprint
from engine.painting.recording import Recording, read_torn
from engine.painting.value import Painting
from engine.session import replay
from engine.session.damaged import open_or_salvage
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio.filing.playing import Playing


@dataclass(frozen=True, slots=True)
class Document:
    """A session with what the file held.

    `path`: where to save it, None for what is no painting of ours; `known`: whether the session's log leads from
    nothing to the painting; `script`: a recording still to be played; `notes`: what was lost or replaced;
    `marks`: of what is to be grown again; `seen`: what the file was before it was read.
    """

    session: Session
    path: Path | None = None
    known: bool = True
    script: Playing | None = None
    notes: tuple[str, ...] = ()
    marks: tuple[Mark, ...] = ()
    seen: Fingerprint | None = None


def opened(path: Path, live: bool = False, untitled: bool = False) -> Document:
    """Returns what a file holds: a recording, a painting of ours or of another program, or a picture; an `untitled` one
    is not saved there again.

    Of a damaged file, what can be had.  FileError if that is nothing.
    """
    ending = path.suffix.lower()
    if ending == ".jsonl":
        recording, torn = read_torn(path)
        notes = () if torn is None else (f"{torn.message}: what comes before is played, the rest is missing",)
        return Document(replay.opened(recording), script=Playing(recording, live), notes=notes)
    seen = _seen(path) if ending == ".ora" else None
    found = open_or_salvage(path) if ending == ".ora" else open_image(path)
    told = found.recording
    session = Session(
        found.painting,
        log=told.commands if told else (),
        folder=told.folder if told else path.parent,
        extra=told.header.extra if told else None,
    )
    own = path if found.native and not untitled else None
    return Document(session, own, told is not None, None, found.notes, found.marks, seen)


def _seen(path: Path) -> Fingerprint | None:
    try:
        return fingerprint(path)
    except OSError:
        return None  # nor can it be opened, which says more


def save(
    path: Path, painting: Painting, recording: Recording | None, ready: Callable[[Path], None] | None = None
) -> None:
    """Writes the painting, grown to its end, as .ora, with its recording if that is known, replaced in one step, after
    `ready` has had the new file; WriteError if that failed."""
    saving.save(path, saving.Snapshot(painting, recording), ready=ready)


def write_picture(request: q.Export, painting: Painting) -> None:
    """Writes the frame, or the rectangle asked for, of a painting grown to its end, as a picture; WriteError if that
    failed."""
    export.export(request.path, export.Picture(painting, request.level, request.area))
