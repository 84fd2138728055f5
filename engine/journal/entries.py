"""Entries: the paintings whose journals lie in the user's state folder, one folder each.

An entry's folder holds `about.json`, `journal-N`, `lock`, `picture.png`, `checkpoint-0.ora` and `checkpoint-1.ora`, and
`kept/` with what the journal needs that lies elsewhere.  Each is looked at by itself: whatever is wrong with one keeps
no other from being listed.
"""

from __future__ import annotations

import os
import re
import secrets
import shutil
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

import platformdirs

from engine.checks.field_error import FieldError
from engine.files.atomic import replacing
from engine.files.fault import WriteError
from engine.files.strict_json import dumps, loads
from engine.journal.records import Members
from engine.journal.story import glance

try:
    import fcntl
except ImportError:  # Windows: no advisory locks, so nothing is deleted there
    fcntl = None  # type: ignore[assignment]

_TRIES, _AGAIN = 10, 0.01  # to lock an entry, and seconds between two
DAYS_KEPT = 30  # days of use after which what is in the bin is deleted
_IDENT = re.compile("[a-z][a-z0-9]{5}")
_LETTERS, _SIGNS = "abcdefghjkmnpqrstuvwxyz", "abcdefghjkmnpqrstuvwxyz23456789"
ABOUT_FILE, LOCK_FILE, PICTURE_FILE = "about.json", "lock", "picture.png"


@dataclass(frozen=True, slots=True)
class Entry:
    """A painting that was not closed, or, `in_bin`, one that was closed without being saved or was discarded.

    `number`: its place in the list, from 1; `ident`: its short name, which stays; `path`: the file it was opened from
    or saved as; `when`: it was last painted on (seconds since 1970); `seconds`: spent painting; `alive`: a program
    has it open; `faults`: what is damaged, a line each; `picture`: a small one, if there is one;
    `program`: the ident of the one that had it open last, by which a crash of it is known ("": unknown).
    """

    ident: str
    number: int
    name: str
    path: Path | None
    when: float
    strokes: int
    seconds: float
    alive: bool
    faults: tuple[str, ...]
    folder: Path
    in_bin: bool
    picture: Path | None
    program: str = ""


def paintings_folder() -> Path:
    """Returns the folder of all entries, whether it exists or not."""
    return platformdirs.user_state_path("inkfall") / "paintings"


def listed(folder: Path | None = None, with_bin: bool = True) -> tuple[Entry, ...]:
    """Returns all entries that hold anything, those to be recovered before the bin, the newest first; or only those to
    be recovered, which takes no longer however much is in the bin.  It never fails."""
    places = [place for place in _places(folder or paintings_folder()) if with_bin or not _is_closed(place)]
    found = [entry for place in places if (entry := _entry(place)) is not None]
    found.sort(key=lambda entry: (entry.in_bin, -entry.when, entry.ident))
    return tuple(_numbered(entry, number) for number, entry in enumerate(found, 1))


def discard(entry: Entry) -> None:
    """Puts an entry into the bin; one that is there is deleted.  FileError if that cannot be done."""
    if entry.alive:
        raise WriteError(entry.folder, "is open in a program, and stays")
    if entry.in_bin:
        remove_entry(entry.folder)
    else:
        change_about(entry.folder, state="closed")


def remove_entry(folder: Path) -> None:
    """Deletes an entry's folder.  WriteError if that cannot be done."""
    try:
        with suppress(FileNotFoundError):
            (
                folder / ABOUT_FILE
            ).unlink()  # whatever is left then, after a power cut, is no entry that anybody asked for
        shutil.rmtree(folder)
    except OSError as error:
        raise WriteError(folder, f"cannot be deleted: {error.strerror or error}") from error


def new_entry(folder: Path) -> tuple[Path, int | None]:
    """Makes a folder for a new entry, which only its owner can read, and takes its lock (None where there are none).
    OSError if it cannot be made."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    while True:
        ident = secrets.choice(_LETTERS) + "".join(secrets.choice(_SIGNS) for _ in range(5))
        place, making = folder / ident, folder / f".{ident}.{os.getpid()}"  # nobody takes it for an abandoned one
        if place.exists():
            continue
        making.mkdir(mode=0o700)
        try:
            lock = lock_entry(making)
            making.rename(place)
        except OSError:
            shutil.rmtree(making, ignore_errors=True)
            raise
        return place, lock


def lock_entry(folder: Path) -> int | None:
    """Returns the descriptor of an entry's lock, which is held until `unlock_entry` or the end of the process; None
    where there are no locks.  BlockingIOError if another program holds it, OSError if the folder cannot be written to.
    """
    if fcntl is None:
        return None
    descriptor = os.open(folder / LOCK_FILE, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    try:
        _take(descriptor)
    except OSError:
        os.close(descriptor)
        raise
    return descriptor


def _take(descriptor: int) -> None:
    for tries in range(_TRIES, -1, -1):
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return
        except BlockingIOError:  # whoever lists entries has the lock, too, for some microseconds
            if not tries:
                raise
            time.sleep(_AGAIN)


def unlock_entry(descriptor: int | None) -> None:
    """Gives up an entry's lock, if it has one: also where a process that is just being started has a copy of it, which
    would hold it until its program is loaded."""
    if descriptor is not None:
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_UN)
            os.close(descriptor)


def is_alive(folder: Path) -> bool:
    """Tells whether a program has an entry open: by its lock, which ends with the process."""
    if fcntl is None:
        return False
    try:
        descriptor = os.open(folder / LOCK_FILE, os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    finally:
        os.close(descriptor)
    return False


def read_about(folder: Path) -> Members:
    """Returns what is told of an entry; nothing if that is damaged, or not there."""
    try:
        with open(folder / ABOUT_FILE, "rb") as file:
            found = loads(file.read(1 << 20))
    except (OSError, FieldError):
        return {}
    return found if isinstance(found, dict) else {}


def change_about(folder: Path, **members: object) -> None:
    """Changes what is told of an entry.  WriteError if it cannot be written."""
    told = {**read_about(folder), **members}
    with replacing(folder / ABOUT_FILE) as file:
        file.write(dumps(told).encode())


def tidy(folder: Path | None = None, today: int | None = None) -> None:
    """Deletes entries that hold nothing, and those that were in the bin for more than DAYS_KEPT days of use; journals
    in the bin, which may be large and many, are not read: what went there held something.  `today`: counted from 1970.
    """
    if fcntl is None:
        return
    places, today = list(_places(folder or paintings_folder())), int(time.time() // 86400) if today is None else today
    for place in places:
        with suppress(OSError, WriteError):
            if is_alive(place):
                continue
            if _count_day(place, today) > DAYS_KEPT if _is_closed(place) else not _worth(place):
                remove_entry(place)


def entry_bytes(folder: Path) -> int:
    """Returns the bytes that an entry has on disk."""
    found = 0
    for here, _, names in os.walk(folder):
        for name in names:
            with suppress(OSError):
                found += os.stat(os.path.join(here, name)).st_size
    return found


def _places(folder: Path) -> Iterator[Path]:
    try:
        found = sorted(os.scandir(folder), key=lambda item: item.name)
    except OSError:
        return
    for item in found:
        with suppress(OSError):
            if _IDENT.fullmatch(item.name) and item.is_dir(follow_symlinks=False):
                yield Path(item.path)


def _entry(folder: Path) -> Entry | None:
    """Returns an entry that is not in the list yet; None if it holds nothing."""
    seen, about = glance(folder), read_about(folder)
    picture = folder / PICTURE_FILE
    if not (seen.holds or seen.faults):
        return None
    told = {**seen.head, **about}
    path, name = told.get("path"), told.get("name")
    when = seen.last
    if not when:
        with suppress(OSError):
            when = folder.stat().st_mtime
    return Entry(
        folder.name,
        0,
        name if isinstance(name, str) and name else "Untitled",
        Path(path) if isinstance(path, str) else None,
        when,
        seen.strokes,
        seen.seconds,
        is_alive(folder),
        seen.faults,
        folder,
        _is_closed(folder),
        picture if picture.is_file() else None,
        program if isinstance(program := about.get("program"), str) else "",
    )


def _is_closed(folder: Path) -> bool:
    return read_about(folder).get("state") == "closed"


def _numbered(entry: Entry, number: int) -> Entry:
    return replace(entry, number=number)


def _worth(folder: Path) -> bool:
    seen = glance(folder)
    return seen.holds or bool(seen.faults)


def _count_day(folder: Path, today: int) -> int:
    """Counts a day of use of an entry in the bin; returns how many there were."""
    about = read_about(folder)
    days = about.get("days", 0)
    days = days if type(days) is int else 0
    if about.get("day") != today:
        days += 1
        change_about(folder, days=days, day=today)
    return days
