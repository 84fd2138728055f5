"""What was opened and saved last, and where one looks for files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(slots=True)
class OpenedFiles:
    """`paths`: the newest first; `folder`: where the next dialog begins, where the painting has no file; `asked`:
    whether they were asked for yet; `noted`: the file of the painting that was told last."""

    paths: tuple[Path, ...] = ()
    folder: Path | None = None
    asked: bool = False
    noted: Path | None = None

    def begin(self, painting: Path | None) -> Path:
        """Returns the folder in which a dialog begins; `painting`: the file of the painting."""
        return painting.parent if painting is not None else self.folder or Path.cwd()
