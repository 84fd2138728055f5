"""What was opened and saved last, and where one looks for files."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

OF_PAINTINGS = "Open", "Save as"  # dialogs for the painting itself


@dataclass(slots=True)
class OpenedFiles:
    """`paths`: the newest first; `folder`: where the next dialog begins, where the painting has no file; `folders`:
    where something was chosen last, by the dialogs' titles; `saves`: how often each file was saved in this session;
    `asked`: whether they were asked for yet; `noted`: the file of the painting that was told last."""

    paths: tuple[Path, ...] = ()
    folder: Path | None = None
    saves: dict[Path, int] = field(default_factory=dict)
    folders: dict[str, Path] = field(default_factory=dict)
    asked: bool = False
    noted: Path | None = None

    def begin(self, title: str, painting: Path | None) -> Path:
        """Returns the folder in which a dialog begins: the one in which it ended; those for the painting itself begin
        beside its file, `painting`."""
        beside = None if painting is None else painting.parent
        if title in OF_PAINTINGS:
            return beside or self.folder or Path.cwd()
        return self.folders.get(title) or beside or self.folder or Path.cwd()
