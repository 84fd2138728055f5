"""Folders, and files that belong together, written so that nothing half-written is ever seen in their place."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from engine.files.atomic import part_folder, sweep, sync_folder
from engine.files.fault import WriteError

PARTIAL = ".partial"  # ends the name of what whoever was killed may have left in the folder
_OLD = "replaced"


@contextmanager
def put_in_place(
    path: str | os.PathLike[str], names: Sequence[str], replaceable: Callable[[Path], str]
) -> Iterator[Path]:
    """Hands out a folder beside `path`; when the block ends well, what is there under `names` takes the places beside
    it of what has these names, the last one last.

    `replaceable` gets each place that is taken already, before anything is done, and says what was found there and what
    was expected if it must stay.  Whatever is raised, what was there is there, and the folder is gone; an OSError comes
    out as WriteError.  A loss of power just afterwards may leave less: many files are not synced one by one.
    """
    target = Path(os.path.abspath(path))
    places = [target.with_name(name) for name in names]
    for place in places:
        why = replaceable(place) if os.path.lexists(place) else ""
        if why:
            raise WriteError(place, why)
    try:
        sweep(target)
        part = part_folder(target)
    except OSError as error:
        raise WriteError(path, f"cannot be written: {error.strerror or error}") from error
    try:
        yield part
        _clear(part)
        _exchange(part, places)
        sync_folder(target.parent)
    except OSError as error:
        raise WriteError(path, f"cannot be written: {error.strerror or error}") from error
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _clear(part: Path) -> None:
    """Removes what those that were killed left half-written."""
    for folder, _, names in os.walk(part):
        for name in names:
            if name.endswith(PARTIAL):
                (Path(folder) / name).unlink()


def _exchange(part: Path, places: Sequence[Path]) -> None:
    old = part / _OLD
    old.mkdir()
    moved: list[tuple[Path, Path]] = []
    try:
        for place in places:
            for source, target in ((place, old / place.name), (part / place.name, place)):
                if os.path.lexists(source):
                    os.rename(source, target)
                    moved.append((source, target))
    except OSError:
        for source, target in reversed(moved):
            with suppress(OSError):
                os.rename(target, source)
        raise
