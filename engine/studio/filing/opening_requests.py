"""What is asked while a file is opened, and posted by the thread that reads it: light, as `requests`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from engine.studio.results import Note

if TYPE_CHECKING:
    from engine.studio.filing.document import Document


@dataclass(frozen=True, slots=True)
class Show:
    """The file number `file` is whole: it takes the painting's place; `sure`: even if that was changed since it was
    asked for, and is not saved."""

    file: int
    sure: bool = False


@dataclass(frozen=True, slots=True)
class CancelOpening:
    """What is being opened is not wanted any more."""


@dataclass(frozen=True, slots=True)
class StopPlaying:
    """The recording that plays is to end where it is."""


@dataclass(frozen=True, slots=True)
class FileRead:
    """The file number `file` is read to the part `part`, 0..1; posted by the thread that opens it."""

    file: int
    part: float


@dataclass(frozen=True, slots=True)
class FileWhole:
    """The file number `file` is read, and was `document`, or cannot be: `fault` says why; posted by the thread that
    opened it."""

    file: int
    document: Document | None = None
    fault: Note | None = None


OpeningRequest = Show | CancelOpening | StopPlaying | FileRead | FileWhole
