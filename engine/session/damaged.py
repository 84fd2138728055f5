"""A damaged painting, opened as far as it can be had, in the order of what gives most back.

All packs and pictures, where they are whole; else the recording, which gives every pixel when it is played; else each
layer as far as it is whole; else the pictures that other programs see; else the recording up to where it is torn.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace

from engine.archive.imports import Opened
from engine.archive.opening import open_painting
from engine.archive.salvage import ways
from engine.archive.salvage.remains import Remains
from engine.files.fault import FileError, TooMuch
from engine.files.limits import LIMITS, Limits
from engine.files.zip_salvage import SalvagedArchive
from engine.painting.recording import Recording
from engine.painting.rendering import Progress, Stop, check_cancelled
from engine.session.replay import replay_torn

PLAYED = "the file is damaged: its recording was played, which gives all of its paint, and this is a copy of it"
TORN = "{count} commands of its recording could be played, the rest is missing: {fault}"


def open_or_salvage(
    path: str | os.PathLike[str], progress: Progress = None, cancelled: Stop = None, limits: Limits = LIMITS
) -> Opened:
    """Returns the painting in an .ora file; of a damaged one what can be had, `native` False, with `notes` of what is
    missing.

    `progress` gets the part done, 0..1, and `cancelled` is asked between the commands of a recording that is played.
    FileError, one line, if nothing can be had; Cancelled if it was asked for.
    """
    try:
        return open_painting(path, progress, cancelled, limits)
    except TooMuch:
        raise
    except FileError as error:
        found = _salvaged(path, progress, cancelled, limits)
        if found is None:
            raise error from None
        return found


def _salvaged(path: str | os.PathLike[str], progress: Progress, cancelled: Stop, limits: Limits) -> Opened | None:
    """Returns what can be had of a damaged file, None for nothing."""
    if not os.path.isfile(path):
        return None
    try:
        with open(path, "rb") as file:
            remains = Remains(SalvagedArchive(file, os.fspath(path), limits, cancelled), limits, cancelled)
            return _best(remains, progress)
    except (OSError, ValueError) as error:
        raise FileError(path, f"cannot be read: {getattr(error, 'strerror', None) or error}") from error
    except MemoryError as error:
        raise TooMuch(path, "not enough memory to open it") from error


def _best(remains: Remains, progress: Progress) -> Opened | None:
    found = _led(ways.all_paint, remains)
    if found is not None:
        return found
    recording, fault = (None, None) if remains.overtaken else remains.recording
    played: Opened | None = None
    if recording is not None and fault is None:
        played, fault = _played(recording, remains, progress)
        if fault is None:
            return replace(played, notes=(PLAYED,))
    found = _led(ways.parts, remains) or _led(ways.as_seen, remains)
    if found is not None or recording is None:
        return found
    if played is None:
        played, later = _played(recording, remains, progress)
        fault = later or fault
    assert fault is not None
    assert played.recording is not None
    told = TORN.format(count=len(played.recording.commands), fault=fault.message)
    return replace(played, notes=(ways.IN_PART, told))


def _led(way: Callable[[Remains], Opened], remains: Remains) -> Opened | None:
    """Returns the painting to which a way leads, if it leads to one."""
    try:
        return way(remains)
    except TooMuch:
        raise
    except FileError:
        return None


def _played(recording: Recording, remains: Remains, progress: Progress) -> tuple[Opened, FileError | None]:
    """Returns what the recording gives, and what is wrong with the first command that cannot be done."""
    count = max(1, len(recording.commands))

    def tell(done: int) -> None:
        check_cancelled(remains.cancelled)
        if progress is not None:
            progress(done / count)

    tell(0)
    session, fault = replay_torn(recording, tell=tell, pictures=remains.pictures)
    return Opened(session.painting, (), False, session.recording(), remains.pictures), fault
