"""What notices offer: to try again, to make room on the disk, to copy what a fault left in the log."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from imgui_bundle import imgui

from app.desk.desk import Desk, FileWork
from app.desk.exporting.export_areas import export_wish
from app.desk.folders import size_text
from app.faults.log import log_file

COPIED = 8192  # bytes of the log that are copied, at most


def try_again(desk: Desk) -> None:
    """Does once more what did not work."""
    notice = desk.notices.offering("try_again")
    if notice is not None and notice.about in _AGAIN:
        desk.notices.close(notice)
        _AGAIN[notice.about](desk, notice.path)


def _open_again(desk: Desk, path: Path | None) -> None:
    if path is None:
        desk.asked.show("open")
    else:
        desk.guard(lambda: desk.open(path))


def _save_again(desk: Desk, path: Path | None) -> None:
    desk.save(path)


def _export_again(desk: Desk, path: Path | None) -> None:
    if path is None:
        desk.asked.show("export")
    else:
        desk.post(export_wish(desk, path))


# By what a notice is about: what to do, with the notice's file.
_AGAIN: dict[str, Callable[[Desk, Path | None], None]] = {
    "open": _open_again,
    "save": _save_again,
    "export": _export_again,
}


def can_try(desk: Desk) -> bool:
    """Tells whether there is something to try again."""
    return desk.known.ready and desk.notices.offering("try_again") is not None


@dataclass(frozen=True, slots=True)
class ShowRoom(FileWork):
    """Finds how much is free on the disk that a file or folder is on, and shows its folder in the file manager."""

    path: Path

    def carry_out(self) -> tuple[Path, int]:
        """Returns the folder, and bytes free; OSError where that is not known."""
        folder = next(found for found in (self.path, *self.path.parents) if found.is_dir())
        free = shutil.disk_usage(folder).free
        words = _file_manager(folder)
        if words:  # some stay until their window is closed
            threading.Thread(target=subprocess.run, args=(words,), kwargs=_QUIETLY, daemon=True).start()
        return folder, free

    def arrive(self, desk: Desk, found: tuple[Path, int]) -> None:
        """Tells it."""
        folder, free = found
        desk.say(f"{size_text(free)} free in {folder}")


_QUIETLY = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


def _file_manager(folder: Path) -> tuple[str, ...]:
    """Returns the words that show a folder; none where nothing is known that does."""
    name = {"win32": "explorer", "darwin": "open"}.get(sys.platform, "xdg-open")
    found = shutil.which(name)
    return (found, os.fspath(folder)) if found else ()


def free_space(desk: Desk) -> None:
    """Tells how much room is left where a file could not be written, or where the painting lies, and shows that
    folder."""
    notice = desk.notices.offering("free_space")
    path = notice.path if notice is not None else None
    desk.work(ShowRoom((path or desk.known.path or Path.cwd()).absolute()))


@dataclass(frozen=True, slots=True)
class CopyDetails(FileWork):
    """Puts on the clipboard what there is to tell of the last faults.  `graphics`: the card and its driver."""

    graphics: str

    def carry_out(self) -> str:
        """Returns the versions, the system, and the end of the log."""
        lines = (
            f"Inkfall {_version('inkfall')}",
            f"Python {platform.python_version()}, {platform.platform()}",
            f"OpenGL {self.graphics}",
            *(f"{name} {_version(name)}" for name in ("numpy", "numba", "glfw", "moderngl", "imgui-bundle")),
            "",
            _end_of_log(),
        )
        return "\n".join(lines)

    def arrive(self, desk: Desk, found: str) -> None:
        """Copies it."""
        imgui.set_clipboard_text(found)
        desk.say("Copied the details of the last faults")


def copy_details(desk: Desk) -> None:
    """Copies versions, system, graphics and the last faults, for whoever is to help."""
    desk.work(CopyDetails(desk.graphics))


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "of a checkout"


def _end_of_log() -> str:
    """Returns the last lines of the log, whole ones."""
    try:
        with log_file().open("rb") as file:
            file.seek(max(0, os.fstat(file.fileno()).st_size - COPIED))
            text = file.read(COPIED)
    except OSError:
        return "There is no log"
    if len(text) == COPIED:
        text = text.partition(b"\n")[2]
    return text.decode(errors="replace").strip() or "The log is empty"
