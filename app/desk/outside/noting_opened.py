"""What was opened and saved last is read and noted beside the window."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from app.desk.desk import Desk, FileWork


@dataclass(frozen=True, slots=True)
class TellOpened(FileWork):
    """Finds them; `path`: one that was opened or saved now."""

    path: Path | None

    def carry_out(self) -> tuple[tuple[Path, ...], Path]:
        """Returns them, and the folder to begin in."""
        from engine.keeping.opened_before import folder_to_begin, opened_before, remember_opened  # here, on the thread

        paths = opened_before() if self.path is None else remember_opened(self.path)
        return paths, folder_to_begin(paths)

    def arrive(self, desk: Desk, found: tuple[tuple[Path, ...], Path]) -> None:
        """Puts them on the desk."""
        desk.opened.paths = found[0]
        if desk.opened.folder is None or self.path is not None:
            desk.opened.folder = found[1]

    def fail(self, desk: Desk, fault: str) -> None:
        """Leaves them as they are: nobody asked for them."""


def follow_opened(desk: Desk) -> None:
    """Notes the painting's file where that is another one now, and finds those before at the start."""
    path = desk.known.path
    if not desk.opened.asked or (path is not None and path != desk.opened.noted):
        desk.opened.asked, desk.opened.noted = True, path
        desk.work(TellOpened(path))
