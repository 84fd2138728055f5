"""The paintings that were opened or saved last, told in the state folder: the newest first."""

from __future__ import annotations

import json
from contextlib import suppress
from pathlib import Path

import platformdirs

from engine.files.atomic import replacing
from engine.files.fault import WriteError
from engine.keeping.state_folder import state_folder

MOST_OPENED = 12
_LARGEST = 1 << 16  # bytes


def opened_before() -> tuple[Path, ...]:
    """Returns them; none where that cannot be read."""
    try:
        told = json.loads(_place().read_bytes()[:_LARGEST])
    except (OSError, ValueError, RecursionError):
        return ()
    names = [name for name in told if isinstance(name, str) and name] if isinstance(told, list) else []
    return tuple(map(Path, names[:MOST_OPENED]))


def remember_opened(path: Path) -> tuple[Path, ...]:
    """Puts one first, and returns them all.  Where that cannot be written, it is known to this program alone."""
    path = path.absolute()
    paths = (path, *(one for one in opened_before() if one != path))[:MOST_OPENED]
    with suppress(OSError, WriteError, ValueError), replacing(_place()) as file:
        file.write(json.dumps([str(one) for one in paths]).encode())
    return paths


def folder_to_begin(paths: tuple[Path, ...]) -> Path:
    """Returns the folder where one looks for a file first: that of the last painting that is there, else the user's
    pictures, else their home."""
    folders = (*(path.parent for path in paths[:1]), platformdirs.user_pictures_path())
    return next((folder for folder in folders if folder.is_dir()), Path.home())


def _place() -> Path:
    return state_folder("recent") / "paintings.json"
