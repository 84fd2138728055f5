"""Photoshop's descriptors: named values of many kinds, nested.

After "Adobe Photoshop File Formats Specification", Descriptor structure.
"""

from __future__ import annotations

from collections.abc import Callable

from engine.files.big_endian import BigEndian
from engine.files.brushes.found_brush import ByName
from engine.files.fault import shown

_DEEPEST = 12
_MOST_ITEMS = 100_000  # of one list or object
_LONGEST = 1 << 16  # of a text
_WHAT = "the settings of its brushes"
CLASS_TOLD = "kind"  # the member that tells of what class an object is


def descriptor(reader: BigEndian, depth: int = 0) -> ByName:
    """Returns an object as its members by name, and its class as CLASS_TOLD.  FileError for what is none."""
    if depth > _DEEPEST:
        raise reader.fault(f"found {_WHAT} nested deeper than {_DEEPEST}")
    _text(reader)
    found: ByName = {CLASS_TOLD: _name(reader)}
    for _ in range(_count(reader)):
        name = _name(reader)
        found[name] = _value(reader, depth)
    return found


def _value(reader: BigEndian, depth: int) -> object:
    kind = reader.raw(4, _WHAT)
    read = _READERS.get(kind)
    if read is None:
        raise reader.fault(f"found a value of kind {shown(kind)} in {_WHAT}")
    return read(reader, depth)


def _list(reader: BigEndian, depth: int) -> list[object]:
    if depth > _DEEPEST:
        raise reader.fault(f"found {_WHAT} nested deeper than {_DEEPEST}")
    return [_value(reader, depth + 1) for _ in range(_count(reader))]


def _count(reader: BigEndian) -> int:
    count = reader.number("I", _WHAT)
    if count > _MOST_ITEMS:
        raise reader.fault(f"found {count} members in {_WHAT}, expected at most {_MOST_ITEMS}")
    return count


def _text(reader: BigEndian) -> str:
    units = reader.number("I", _WHAT)
    if units > _LONGEST:
        raise reader.fault(f"found a text of {units} characters, expected at most {_LONGEST}")
    return reader.text(units, _WHAT)


def _name(reader: BigEndian) -> str:
    length = reader.number("I", _WHAT) or 4
    return reader.raw(length, _WHAT).decode("latin-1")


def _measured(reader: BigEndian, form: str) -> float:
    reader.raw(4, _WHAT)  # its unit
    return float(reader.take(form, _WHAT)[0])


def _class(reader: BigEndian) -> str:
    _text(reader)
    return _name(reader)


_READERS: dict[bytes, Callable[[BigEndian, int], object]] = {
    b"Objc": lambda reader, depth: descriptor(reader, depth + 1),
    b"GlbO": lambda reader, depth: descriptor(reader, depth + 1),
    b"VlLs": _list,
    b"doub": lambda reader, depth: float(reader.take("d", _WHAT)[0]),
    b"UntF": lambda reader, depth: _measured(reader, "d"),
    b"UnFl": lambda reader, depth: _measured(reader, "f"),
    b"TEXT": lambda reader, depth: _text(reader),
    b"enum": lambda reader, depth: (_name(reader), _name(reader)),
    b"long": lambda reader, depth: reader.number("i", _WHAT),
    b"comp": lambda reader, depth: reader.number("q", _WHAT),
    b"bool": lambda reader, depth: reader.number("B", _WHAT) != 0,
    b"type": lambda reader, depth: _class(reader),
    b"GlbC": lambda reader, depth: _class(reader),
    b"tdta": lambda reader, depth: reader.raw(reader.number("I", _WHAT), _WHAT),
    b"alis": lambda reader, depth: reader.raw(reader.number("I", _WHAT), _WHAT),
}
