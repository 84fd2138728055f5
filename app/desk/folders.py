"""What is in a folder, read on the thread for files: names, sizes and dates of files with certain endings."""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from app.desk.desk import Desk, FileWork
from app.desk.previews import FileRow

_UNITS = "bytes", "kB", "MB", "GB", "TB"


Listed = Callable[[Path, tuple[FileRow, ...], str], None]  # a folder, what is in it, or why that is not known


@dataclass(frozen=True, slots=True)
class ReadFolder(FileWork):
    """Lists the folders in a folder, and its files with one of `endings`; `listed` hears what was found."""

    folder: Path
    endings: tuple[str, ...]
    listed: Listed

    def carry_out(self) -> tuple[FileRow, ...]:
        """Reads the folder; OSError where that cannot be."""
        with os.scandir(self.folder) as entries:
            found = [_row(entry) for entry in entries if not entry.name.startswith(".")]
        shown = [row for row in found if row.folder or row.name.lower().endswith(self.endings)]
        return tuple(sorted(shown, key=lambda row: (not row.folder, row.name.lower())))

    def arrive(self, desk: Desk, found: tuple[FileRow, ...]) -> None:
        """Hands the list on."""
        self.listed(self.folder, found, "")

    def fail(self, desk: Desk, fault: str) -> None:
        """Hands on why there is none."""
        self.listed(self.folder, (), fault)


A_FOLDER, A_FILE, NO_FILE = "folder", "file", ""  # what a path leads to
Seen = Callable[[Path, str], None]  # a path, and what it leads to


@dataclass(frozen=True, slots=True)
class LookAt(FileWork):
    """Finds what a path leads to; `seen` hears it."""

    path: Path
    seen: Seen

    def carry_out(self) -> str:
        """Returns A_FOLDER, A_FILE for all else that is there, or NO_FILE; OSError where it cannot be looked at."""
        try:
            status = self.path.stat()
        except (FileNotFoundError, NotADirectoryError):
            return NO_FILE
        return A_FOLDER if stat.S_ISDIR(status.st_mode) else A_FILE

    def arrive(self, desk: Desk, found: str) -> None:
        """Hands it on."""
        self.seen(self.path, found)


def _row(entry: os.DirEntry[str]) -> FileRow:
    try:
        about = entry.stat()
    except OSError:  # a link to nothing
        return FileRow(entry.name, False)
    date = time.strftime("%Y-%m-%d %H:%M", time.localtime(about.st_mtime))
    return FileRow(entry.name, entry.is_dir(), about.st_size, about.st_mtime_ns, date)


def size_text(size: int) -> str:
    """Returns a number of bytes as it is shown: at most three digits before the unit."""
    shown, unit = float(size), 0
    while round(shown) >= 1000 and unit < len(_UNITS) - 1:
        shown, unit = shown / 1000, unit + 1
    return f"{shown:.1f} {_UNITS[unit]}" if unit and shown < 9.95 else f"{shown:.0f} {_UNITS[unit]}"
