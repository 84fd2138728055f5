"""The table of files of palettes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from engine.files.atomic import replacing
from engine.files.fault import FileError, TooMuch
from engine.files.swatches.adobe import read_aco, read_ase
from engine.files.swatches.colour_list import ColourList, plain_name
from engine.files.swatches.gpl import gpl_text, read_gpl
from engine.files.swatches.kpl import read_kpl

_BYTES_MOST = 16 << 20
READERS: dict[str, Callable[[bytes, str], ColourList]] = {
    ".gpl": read_gpl,
    ".aco": read_aco,
    ".ase": read_ase,
    ".kpl": read_kpl,
}


def read_palette(path: Path) -> ColourList:
    """Returns the palette of a file, by its ending, called as the file is if it has no name.  FileError or OSError."""
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise FileError(path.name, f"found no palette, expected one of {', '.join(READERS)}")
    with path.open("rb") as file:
        data = file.read(_BYTES_MOST + 1)
    if len(data) > _BYTES_MOST:
        raise TooMuch(path.name, f"more than {_BYTES_MOST >> 20} MiB")
    found = reader(data, path.name)
    if not found.colours:
        raise FileError(path.name, "found no colour in it")
    return replace(found, name=found.name or plain_name(path.stem) or "Palette")


def write_palette(palette: ColourList, path: Path) -> None:
    """Writes a palette as `.gpl`, in place of what is there."""
    with replacing(path) as file:
        file.write(gpl_text(palette).encode("utf-8"))
