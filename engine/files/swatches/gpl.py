"""Palettes of GIMP, `.gpl`, which Krita, MyPaint and Inkscape use, too: lines of `red green blue name`, 0..255."""

from __future__ import annotations

import re

from engine.files.fault import FileError, shown
from engine.files.swatches.colour_list import MOST_COLOURS, ColourList, NamedColour, plain_name

_MAGIC = "GIMP Palette"
_ROW = re.compile(r"\s*(\d{1,3})\s+(\d{1,3})\s+(\d{1,3})(?:\s+(.*))?", re.ASCII)
_COUNT = re.compile(r"\s*\d{1,5}\s*", re.ASCII)
_COLUMNS = 64  # at most


def read_gpl(data: bytes, file: str) -> ColourList:
    """Returns the palette; FileError tells the line that is wrong."""
    lines = data.decode("utf-8-sig", "replace").splitlines()
    if not lines or lines[0].strip() != _MAGIC:
        raise FileError(file, f"line 1: found {shown(lines[0] if lines else '')}, expected {_MAGIC!r}")
    name, columns, colours = "", 0, list[NamedColour]()
    for number, line in enumerate(lines[1:], 2):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        told, colon, value = line.partition(":")
        if colon and told.strip() in ("Name", "Columns") and not colours:
            if told.strip() == "Name":
                name = plain_name(value)
            elif _COUNT.fullmatch(value):
                columns = int(value)
            continue
        row = _ROW.fullmatch(line)
        if row is None or max(map(int, row.groups()[:3])) > 255:
            raise FileError(file, f"line {number}: found {shown(line)}, expected three numbers 0..255 and a name")
        if len(colours) == MOST_COLOURS:
            raise FileError(file, f"more than {MOST_COLOURS} colours")
        r, g, b = (int(part) / 255 for part in row.groups()[:3])
        colours.append(NamedColour((r, g, b), plain_name(row[4] or "")))
    return ColourList(name, tuple(colours), min(columns, _COLUMNS))


def gpl_text(palette: ColourList) -> str:
    """Returns the file that `read_gpl` makes the same palette of, its colours to 8 bits."""
    head = [_MAGIC, f"Name: {plain_name(palette.name)}", f"Columns: {palette.columns}", "#"]
    rows = []
    for rgb, name in palette.colours:
        r, g, b = (round(255 * min(1.0, max(0.0, v))) for v in rgb)
        rows.append(f"{r:3d} {g:3d} {b:3d}\t{plain_name(name)}")
    return "\n".join([*head, *rows]) + "\n"
