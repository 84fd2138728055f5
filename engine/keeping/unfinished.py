"""Files that are being written: a record of each lies in the state folder, so that the next start finds what is left of
those that were not finished."""

from __future__ import annotations

import json
import os
import secrets
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from engine.files.atomic import sweep
from engine.keeping.state_folder import state_folder

try:
    import fcntl
except ImportError:  # Windows: nothing tells whether a process is still at it
    fcntl = None  # type: ignore[assignment]

FORGET = 30 * 86400.0  # seconds after which a folder that is not there is waited for no longer
MOST_BYTES = 1 << 16  # bytes of a record


@contextmanager
def unfinished(path: Path) -> Iterator[None]:
    """Keeps the record of a file, which is locked, while it is written; without one where that cannot be."""
    try:
        record, descriptor = _recorded(Path(os.path.realpath(path)))
    except (OSError, ValueError):
        yield
        return
    try:
        yield
    finally:
        with suppress(OSError):
            record.unlink()
        os.close(descriptor)


def _recorded(target: Path) -> tuple[Path, int]:
    record = state_folder("writing") / f"{os.getpid()}-{secrets.token_hex(4)}.json"
    descriptor = os.open(record, os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_CLOEXEC", 0), 0o600)
    if fcntl is not None:
        with suppress(OSError):  # some folders have no locks
            fcntl.flock(descriptor, fcntl.LOCK_EX)
    try:
        os.write(descriptor, json.dumps({"path": str(target), "process": os.getpid()}).encode())
        os.fsync(descriptor)
    except OSError:
        os.close(descriptor)
        record.unlink()
        raise
    return record, descriptor


def sweep_unfinished() -> int:
    """Removes what processes that are gone left beside the files that they were writing; gives their number."""
    if fcntl is None:
        return 0
    removed = 0
    for record in sorted(state_folder("writing").glob("*.json")):
        with suppress(OSError):
            descriptor = os.open(record, os.O_RDWR)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)  # else one is still at it
                removed += _swept(record, descriptor)
            finally:
                os.close(descriptor)
    return removed


def _swept(record: Path, descriptor: int) -> int:
    """Removes what one record tells of, and the record, unless the folder may still come back."""
    target, process = _told(os.read(descriptor, MOST_BYTES))
    away = target is not None and not target.parent.is_dir()
    if away and time.time() - os.fstat(descriptor).st_mtime < FORGET:
        return 0
    removed = 0 if target is None else sweep(target, process)
    record.unlink()
    return removed


def _told(record: bytes) -> tuple[Path | None, int]:
    """Returns the file and the process; no file if the record is torn."""
    try:
        told = json.loads(record)
        path = str(told["path"])
        return None if "\0" in path else Path(path), int(told["process"])
    except (ValueError, KeyError, TypeError, RecursionError):
        return None, 0
