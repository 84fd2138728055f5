"""Earlier versions of the painting's file, read on the thread for files."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from app.desk.desk import Desk, FileWork
from app.desk.previews import FileRow
from engine.keeping.versions import kept_versions, versions_folder

Versions = tuple[Path, tuple[FileRow, ...]]  # their folder, and the newest first


@dataclass(frozen=True, slots=True)
class ReadVersions(FileWork):
    """Lists what is kept of a file; `listed` hears it."""

    path: Path
    listed: Callable[[Versions], None]

    def carry_out(self) -> Versions:
        """Reads the folder of versions; OSError where that cannot be."""
        folder = versions_folder(Path(os.path.realpath(self.path)))
        rows = []
        for path in kept_versions(folder):
            with suppress(FileNotFoundError):  # another window has let it go
                about = path.stat()
                date = date_text(about.st_mtime, time.time())
                rows.append(FileRow(path.name, False, about.st_size, about.st_mtime_ns, date))
        return folder, tuple(rows)

    def arrive(self, desk: Desk, found: Versions) -> None:
        """Hands the list on."""
        self.listed(found)


def date_text(when: float, now: float) -> str:
    """Returns a time as one says it, local: today's and yesterday's by their names.  Both in seconds since 1970."""
    then, today, yesterday = (time.localtime(one) for one in (when, now, now - 86400))
    hour = time.strftime("%H:%M", then)
    for word, day in (("Today", today), ("Yesterday", yesterday)):
        if then[:3] == day[:3]:
            return f"{word}, {hour}"
    return time.strftime("%Y-%m-%d, ", then) + hour
