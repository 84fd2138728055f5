"""Palettes of Krita, `.kpl`: a ZIP archive with `colorset.xml`."""

from __future__ import annotations

import io
from xml.etree.ElementTree import Element, ParseError

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import fromstring

from engine.files.fault import FileError, shown
from engine.files.limits import Limits
from engine.files.swatches.colour_list import MOST_COLOURS, ColourList, NamedColour, plain_name
from engine.files.zip_reader import ZipArchive

_TOLD = "colorset.xml"
_LIMITS = Limits(file=16 << 20, entries=256, directory=1 << 20)
_XML_CAP = 8 << 20
_COLUMNS = 64


def read_kpl(data: bytes, file: str) -> ColourList:
    """Returns the palette, its groups one after another, each in the order of its rows."""
    text = ZipArchive(io.BytesIO(data), file, _LIMITS).read(_TOLD, _XML_CAP)
    try:
        root = fromstring(text, forbid_dtd=True)
    except (ParseError, DefusedXmlException, ValueError) as error:
        raise FileError(file, f"{_TOLD}: {error}") from None
    if root.tag != "Colorset":
        raise FileError(file, f"{_TOLD}: found <{shown(root.tag)}>, expected <Colorset>")
    columns = root.get("columns", "0")
    found: list[NamedColour] = []
    for group in (root, *root.findall("Group")):
        entries = [entry for entry in group if entry.tag in ("ColorSetEntry", "entry")]
        if len(found) + len(entries) > MOST_COLOURS:
            raise FileError(file, f"more than {MOST_COLOURS} colours")
        entries.sort(key=_place)
        found += [NamedColour(_colour(entry, file), plain_name(entry.get("name", ""))) for entry in entries]
    wide = int(columns) if columns.isascii() and columns.isdigit() and len(columns) < 6 else 0
    return ColourList(plain_name(root.get("name", "")), tuple(found), min(wide, _COLUMNS))


def _place(entry: Element) -> tuple[int, int]:
    at = entry.find("Position")
    row, column = ("0", "0") if at is None else (at.get("row", "0"), at.get("column", "0"))
    return _whole(row), _whole(column)


def _whole(text: str) -> int:
    return int(text) if text.isascii() and text.isdigit() and len(text) < 10 else 0


def _colour(entry: Element, file: str) -> tuple[float, float, float]:
    """Returns an entry's colour: RGB, or grey, 0..1; others as their members tell, without a profile."""
    for part in entry:
        if part.tag in ("RGB", "sRGB"):
            return _number(part, "r", file), _number(part, "g", file), _number(part, "b", file)
        if part.tag == "Gray":
            return (_number(part, "g", file),) * 3
        if part.tag == "CMYK":
            c, m, y, k = (_number(part, name, file) for name in "cmyk")
            return (1 - c) * (1 - k), (1 - m) * (1 - k), (1 - y) * (1 - k)
    raise FileError(file, f"{_TOLD}: found a colour that is neither RGB, Gray nor CMYK")


def _number(part: Element, name: str, file: str) -> float:
    text = part.get(name, "")
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not -1e3 < value < 1e3:
        raise FileError(file, f"{_TOLD}: <{part.tag}> {name}: found {shown(text)}, expected a number 0..1")
    return min(1.0, max(0.0, value))
