"""Earlier versions of saved files: what a save is about to replace goes into the state folder first.

A version is the old file itself under another name where that can be, else a copy.  Each file has a folder of them,
`NAME, NUMBER.ora`, numbered from the oldest; the date of a version is when it was saved.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from engine.files.atomic import NAME_KEPT, replacing
from engine.keeping.preferences import Preferences
from engine.keeping.state_folder import key_of, state_folder

_FOLDER = "versions"
_NAME = re.compile(r".*, (\d{1,9})\.ora", re.DOTALL)


def versions_folder(target: Path) -> Path:
    """Returns where the versions of a file lie, by its real path, whether there are any or not."""
    return state_folder(_FOLDER) / key_of(target)


def kept_versions(folder: Path) -> list[Path]:
    """Returns the versions in a folder, the newest first."""
    found = [path for path in folder.iterdir() if _number(path)] if folder.is_dir() else []
    return sorted(found, key=_number, reverse=True)


def _number(path: Path) -> int:
    """Returns that of a version, from 1; 0 for what is none."""
    name = _NAME.fullmatch(path.name)
    return int(name[1]) if name else 0


def keep_version(target: Path, most: int) -> None:
    """Keeps the file that is there now as its newest version, and of the older ones so many that there are `most`;
    OSError, or WriteError, if it cannot be kept."""
    folder = versions_folder(target)
    folder.mkdir(mode=0o700, exist_ok=True)
    found = kept_versions(folder)
    if not (found and os.path.samefile(found[0], target)):  # else a save was stopped after it was kept
        number = _number(found[0]) + 1 if found else 1
        stem = os.fsdecode(os.fsencode(target.stem)[:NAME_KEPT])
        _kept(target, folder / f"{stem}, {number}.ora")
    for path in kept_versions(folder)[most:]:
        path.unlink(missing_ok=True)


def _kept(target: Path, version: Path) -> None:
    about = target.stat()
    if about.st_nlink == 1:  # a file of several names may be written to under another
        try:
            os.link(target, version)
            return
        except OSError:  # another disk, or a system that knows no links
            pass
    with target.open("rb") as old, replacing(version) as file:
        shutil.copyfileobj(old, file, 1 << 20)
    os.utime(version, ns=(about.st_atime_ns, about.st_mtime_ns))


class Kept(NamedTuple):
    """Something that is kept for a while: when it is of, seconds since 1970, its bytes, and the file or folder."""

    when: float
    size: int
    path: Path


def older_versions() -> list[Kept]:
    """Returns the versions of all files, without the newest of each."""
    out = []
    with suppress(OSError):
        for folder in state_folder(_FOLDER).iterdir():
            for path in kept_versions(folder)[1:]:
                with suppress(OSError):
                    about = path.stat()
                    out.append(Kept(about.st_mtime, about.st_size, path))
    return out


def newest_bytes() -> int:
    """Returns the bytes of the newest version of each file."""
    total = 0
    with suppress(OSError):
        for folder in state_folder(_FOLDER).iterdir():
            for path in kept_versions(folder)[:1]:
                with suppress(OSError):
                    total += path.stat().st_size
    return total


def most_bytes(preferences: Preferences) -> int:
    """Returns how many bytes may be kept on the disk of the state folder."""
    free = shutil.disk_usage(state_folder(_FOLDER)).free
    return round(min(preferences.gigabytes * 1e9, preferences.part_of_free * free))


def too_much(kept: Iterable[Kept], most: int) -> list[Kept]:
    """Returns what is to go, the oldest, so that what stays takes at most so many bytes."""
    found = sorted(kept)
    left, out = sum(one.size for one in found), []
    for one in found:
        if left <= most:
            break
        out.append(one)
        left -= one.size
    return out


def let_go(preferences: Preferences, others: Iterable[Kept] = ()) -> list[Kept]:
    """Removes the oldest versions while all that is kept takes too much; returns those of `others` that are to go."""
    found = older_versions()
    gone = too_much([*found, *others], most_bytes(preferences) - newest_bytes())
    own = {one.path for one in found}
    for one in gone:
        if one.path in own:
            with suppress(OSError):
                one.path.unlink()
    return [one for one in gone if one.path not in own]
