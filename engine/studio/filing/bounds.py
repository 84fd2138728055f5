"""What is kept besides the paintings themselves, earlier versions and the bin, has its bounds together."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from engine.files.fault import WriteError
from engine.journal.entries import entry_bytes, is_alive, paintings_folder, read_about, remove_entry
from engine.keeping.preferences import Preferences
from engine.keeping.versions import Kept, let_go


def bound_kept(preferences: Preferences) -> None:
    """Deletes what is too much, the oldest first; the newest version of a file stays."""
    with suppress(OSError):  # without a state folder, nothing is kept
        for one in let_go(preferences, _binned()):
            with suppress(WriteError):
                remove_entry(one.path)


def _binned() -> list[Kept]:
    """Returns the entries in the bin, each of the time when it was last painted on."""
    found = []
    with suppress(OSError):
        for folder in paintings_folder().iterdir():
            with suppress(OSError, ValueError):
                if read_about(folder).get("state") == "closed" and not is_alive(folder):
                    found.append(Kept(_painted(folder), entry_bytes(folder), folder))
    return found


def _painted(folder: Path) -> float:
    return max(path.stat().st_mtime for path in folder.glob("journal-*"))
