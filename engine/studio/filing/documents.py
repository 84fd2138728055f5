"""Files as the window opens and writes them, whatever their kind: paintings, pictures, recordings."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from engine.archive import export, saving
from engine.archive.imports import open_image
from engine.canvas import layers
from engine.canvas.layers import Group
from engine.canvas.tile_cache import TileCache
from engine.checks.roles import REFERENCE
from engine.files.fault import FileError, WriteError
from engine.journal.heads import FileStamp
from engine.keeping import memory
from engine.keeping.fingerprint import Fingerprint, fingerprint
from engine.painting import commands as c
from engine.painting.recording import Header, Recording, read_torn
from engine.painting.value import Painting, first_painting
from engine.session import replay
from engine.session.damaged import open_or_salvage
from engine.studio import faults
from engine.studio import requests as q
from engine.studio.filing.document import Document, held_by

READING = 0.2  # the part of opening a recording that reading it takes
MOST_NOTES = 100  # that a list of what is missing has
_FORBIDDEN = frozenset('/\\:*?"<>|')  # in names of files, on one system or another
_LONGEST = 120  # characters of a layer's name that such a name has


class Progress(Protocol):
    """Who is told how far an opening is."""

    @property
    def cancelled(self) -> bool:
        """Tells whether nobody wants the file any more."""
        ...

    def tell(self, part: float) -> None:
        """Tells the part that is done, 0..1; raises Cancelled if nobody wants the rest."""
        ...


class _Nobody:
    """Is told nothing, and waits to the end."""

    cancelled = False

    def tell(self, part: float) -> None:
        """Hears how far it is."""


NOBODY: Progress = _Nobody()


def opened(path: Path, live: bool = False, untitled: bool = False, progress: Progress | None = None) -> Document:
    """Returns what a file holds: a recording, a painting of ours or of another program, or a picture; an `untitled` one
    is not saved there again.

    `live`: a recording is not played, but is to be.  Of a damaged file, what can be had.  FileError if that is nothing,
    Cancelled if nobody wants it any more.
    """
    progress = progress or NOBODY
    size = _size(path)
    ending = path.suffix.lower()
    if ending == ".jsonl":
        reading = 1.0 if live else READING
        recording, torn = read_torn(path, tell=lambda done: progress.tell(reading * done / max(1, size)))
        notes = () if torn is None else (f"{torn.message}: what comes before is played, the rest is missing",)
        document = _begun(recording) if live else _played(recording, progress)
        return replace(document, name=path.name, notes=(*notes, *document.notes))
    stamp, seen = FileStamp.of(path), _seen(path) if ending == ".ora" else None

    def stop() -> bool:
        return progress.cancelled

    if ending == ".ora":
        found = open_or_salvage(path, progress.tell, stop)
    else:
        found = open_image(path, progress=progress.tell, cancelled=stop)
    told = found.recording
    return Document(
        found.painting,
        path.name,
        path if found.native and not untitled else None,
        told.commands if told else (),
        told.folder if told else path.parent,
        told.header if told else Header(),
        known=told is not None,
        notes=found.notes,
        marks=found.marks,
        seen=seen,
        stamp=stamp,
    )


def _seen(path: Path) -> Fingerprint | None:
    try:
        return fingerprint(path)
    except OSError:
        return None  # nor can it be opened, which says more


def _size(path: Path) -> int:
    """Returns a file's size, bytes; FileError if it is no file: of a pipe, nobody knows when it ends."""
    try:
        about = os.stat(path)
    except FileNotFoundError:
        raise FileError(path, "no such file") from None
    except (OSError, ValueError) as error:
        raise FileError(path, f"cannot be read: {getattr(error, 'strerror', None) or error}") from error
    if stat.S_ISDIR(about.st_mode):
        raise FileError(path, "a folder, expected a file")
    if not stat.S_ISREG(about.st_mode):
        raise FileError(path, "not a regular file")
    return about.st_size


def _begun(recording: Recording) -> Document:
    """Returns the painting that a recording begins with, nothing done yet."""
    header = recording.header
    return Document(first_painting(header), folder=recording.folder, header=header, live=recording)


def _played(recording: Recording, progress: Progress) -> Document:
    """Returns the painting that a recording leads to.  What cannot be done is left out, and told in the notes."""
    session = replay.opened(recording, TileCache(memory.cache_share() // 4))
    count, view, notes = len(recording.commands), None, list[str]()
    for i, command in enumerate(recording.commands):
        progress.tell(READING + (1.0 - READING) * i / count)
        try:
            session.do(command)
        except Exception as error:  # the painting is a value: whatever failed left it as it was
            why = faults.told(faults.stated(error), "while a recording was played").text
            notes.append(recording.fault(i, why).message)
        if isinstance(command, c.View):
            view = command
    more = len(notes) - MOST_NOTES
    told = (*notes[:MOST_NOTES], *([f"and {more} more like these"] if more > 0 else ()))
    held, header = held_by(session), recording.header
    return replace(held, header=header, played=True, unsaved=bool(session.log), notes=told, view=view)


def save(
    path: Path, painting: Painting, recording: Recording | None, ready: Callable[[Path], None] | None = None
) -> None:
    """Writes the painting, grown to its end, as .ora, with its recording if that is known, replaced in one step, after
    `ready` has had the new file; WriteError if that failed."""
    saving.save(path, saving.Snapshot(painting, recording), ready=ready)


def write_picture(request: q.Export, painting: Painting) -> None:
    """Writes the frame, or the rectangle asked for, of a painting grown to its end, as a picture, or one of each layer;
    WriteError if that failed."""
    whole = export.Picture(
        painting, request.level, request.area, None, request.depth, request.transparent, request.light
    )
    if not request.apart:
        export.export(request.path, whole)
        return
    names = [node.name for node in layers.walk(painting.root) if not isinstance(node, Group) and node.role != REFERENCE]
    paths = beside(request.path, names)
    there = next((path for path in paths if path.exists()), None)
    if there is not None:
        raise WriteError(there, "found a file of that name, expected one that is free for each layer")
    for name, path in zip(names, paths, strict=True):
        export.export(path, replace(whole, layer=name, transparent=True))


def beside(path: Path, names: Sequence[str]) -> list[Path]:
    """Returns paths of files for layers of these names, each another one: what a file's name cannot have is `_`."""
    found: dict[str, Path] = {}
    for name in names:
        plain = (
            "".join("_" if c in _FORBIDDEN or not c.isprintable() else c for c in name[:_LONGEST]).strip(" .") or "_"
        )
        stem, number = f"{path.stem} {plain}", 2
        while stem.casefold() in found:
            stem, number = f"{path.stem} {plain} {number}", number + 1
        found[stem.casefold()] = path.with_name(stem + path.suffix)
    return list(found.values())
