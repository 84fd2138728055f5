"""The table of other programs' files of brushes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from engine.files.brushes.found_brush import FoundBrushes
from engine.files.brushes.gimp_tips import read_gbr, read_gih
from engine.files.brushes.krita_presets import Beside, read_kpp
from engine.files.brushes.mypaint_brushes import read_myb
from engine.files.brushes.photoshop_tips import read_abr
from engine.files.fault import FileError, TooMuch

_BYTES_MOST = 256 << 20
_TIP_MOST = 64 << 20
_FOLDERS = (".", "brushes", "../brushes")  # where tips that are named lie
_OTHERS: dict[str, Callable[[bytes, str], FoundBrushes]] = {
    ".myb": read_myb,
    ".gbr": read_gbr,
    ".gih": read_gih,
    ".abr": read_abr,
}
ENDINGS = (*_OTHERS, ".kpp")


def read_brushes(path: Path) -> FoundBrushes:
    """Returns the brushes of a file, by its ending.  FileError or OSError."""
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise FileError(path.name, f"found no brush, expected one of {', '.join(ENDINGS)}")
    data = _whole(path, _BYTES_MOST)
    if ending == ".kpp":
        return read_kpp(data, path.name, _beside(path.parent))
    return _OTHERS[ending](data, path.name)


def _whole(path: Path, most: int) -> bytes:
    if path.exists() and not path.is_file():
        raise FileError(path.name, "not a regular file")  # no pipe is waited for
    with path.open("rb") as file:
        data = file.read(most + 1)
    if len(data) > most:
        raise TooMuch(path.name, f"more than {most >> 20} MiB")
    return data


def _beside(folder: Path) -> Beside:
    """Returns what reads a file of a name in the folder of a preset, or where Krita keeps tips beside that."""

    def give(name: str) -> bytes | None:
        if not name.strip(".") or "/" in name or "\\" in name or "\0" in name:
            return None
        for where in _FOLDERS:
            try:
                return _whole(folder / where / name, _TIP_MOST)
            except (OSError, FileError):
                continue
        return None

    return give
