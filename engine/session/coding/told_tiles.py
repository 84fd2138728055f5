"""Tiles of the far end of a step as one piece of bytes: records that are made of those at the near end stay so."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import islice

import numpy as np
from isal import isal_zlib

from engine.canvas.store import Record
from engine.numeric.address import Rect, TileKey
from engine.session.coding.coded_records import CodedData, CodedSheets, WholeSheets, coded_by
from engine.session.coding.sheets_within import SheetsWithin
from engine.session.coding.spanned import SpannedData
from engine.texture.planes import COLOURS, plane_map
from engine.texture.record import Instance

_FORMS = (CodedData, SpannedData, CodedSheets, WholeSheets, SheetsWithin)
_FACTS = 21  # int64 that are told of a tile, before what its record is made of
_FARTHEST = 1 << 62  # of a tile, which is told in such a number
_NONE = -1  # for the form of a tile that has no record,
_ALIKE = -1  # and for the count of inks that are those of the near end's record, or those of the record itself
_INTEGERS = np.dtype(np.int16), np.dtype(np.int32)

Inks = tuple[Instance, ...]
FarTile = tuple[TileKey, Record | None]


def tell(tiles: Sequence[tuple[TileKey, Record | None, Record | None]]) -> tuple[Inks, bytes] | None:
    """Returns some tiles, with the records of the far end and the near one, as one piece; and the inks of which no
    record of the near end tells.  None where a tile is too far away."""
    others: dict[Instance, int] = {}
    facts, numbers, parts = np.zeros((len(tiles), _FACTS), np.int64), list[int](), list[bytes]()
    for row, (key, record, near) in zip(facts, tiles, strict=True):
        if max(abs(key.x), abs(key.y)) >= _FARTHEST:
            return None
        row[:4] = *key, _NONE
        if record is None:
            continue
        coded, packed = _coded(record, near)
        known = () if near is None else near.inks
        counts = []
        for inks, alike in ((record.inks, known), (coded.inks, record.inks)):
            told = None if inks is alike or inks == alike else _numbers(inks, known, others)
            counts.append(_ALIKE if told is None else len(told))
            numbers += told or ()
        row[3:13] = _FORMS.index(type(coded)), *record.rect, record.depth, coded.edges, len(packed), *counts
        row[13:] = coded.other is not None, _INTEGERS.index(coded.dtype), *_own(coded)
        parts.append(packed)
    head = facts.tobytes() + np.diff(np.array(numbers, np.int64), prepend=0).tobytes()
    packed_head = isal_zlib.compress(head, 1)
    sizes = np.array([len(packed_head), len(tiles)], np.int64)
    return tuple(others), b"".join([sizes.tobytes(), packed_head, *parts])


def read(piece: bytes, others: Inks, near_at: Callable[[TileKey], Record | None]) -> Iterator[FarTile]:
    """Yields the tiles of such a piece; `near_at`: gives the record that a tile has at the near end."""
    length, count = np.frombuffer(piece, np.int64, 2).tolist()
    head = isal_zlib.decompress(piece[16 : 16 + length])
    facts = np.frombuffer(head, np.int64, count * _FACTS).reshape(count, _FACTS)
    numbers = iter(np.frombuffer(head, np.int64, offset=facts.nbytes).cumsum().tolist())
    start = 16 + length
    for row in facts.tolist():
        key = TileKey(*row[:3])
        if row[3] == _NONE:
            yield key, None
            continue
        near = near_at(key)
        size, depth, (stacked, counted) = row[10], row[8], row[11:13]
        known = () if near is None else near.inks
        stack = known if stacked == _ALIKE else _inks(numbers, stacked, known, others)
        inks = stack if counted == _ALIKE else _inks(numbers, counted, known, others)
        yield key, _record(row, (stack, inks), near, piece[start : start + size], depth)
        start += size


def _coded(record: Record, near: Record | None) -> tuple[CodedData, bytes]:
    """Returns a record's data, and what is packed of them: as they are coded already, where that is by themselves, so
    that no way to any is long, or by the record that the near end has there; else by that one, if both are sheets or
    neither is.  The record stays as it is."""
    held = record.held
    if isinstance(held, CodedData) and type(held) in _FORMS and (held.other is None or held.other is near):
        return held, held.packed if isinstance(held.packed, bytes) else held.packed.read()
    alike = near is not None and (near.sheets is None) == (record.sheets is None)
    return coded_by(record, near if alike else None)


def _own(coded: CodedData) -> tuple[int, ...]:
    """Returns what some forms tell beside the rest: six numbers."""
    if isinstance(coded, SpannedData):
        return coded.deflated, 0, coded.top, coded.rows, 0, 0
    if isinstance(coded, SheetsWithin):
        return coded.deflated | coded.coloured << 1, coded.size, *coded.at
    return (coded.coloured << 1, coded.size, 0, 0, 0, 0) if isinstance(coded, CodedSheets) else (0,) * 6


def _record(row: list[int], stacks: tuple[Inks, Inks], near: Record | None, packed: bytes, depth: int) -> Record:
    """Returns the record of which a row tells; `stacks`: its inks, and those of which anything is packed."""
    (form, *sides), edges, (by_near, kind, flags, size, *four) = row[3:8], row[9], row[13:]
    rect, (stack, inks) = Rect(*sides), stacks
    base = rect, inks, _INTEGERS[kind], near if by_near else None, edges, packed
    deflated, coloured, what = bool(flags & 1), bool(flags & 2), _FORMS[form]
    coded = CodedData(*base)
    if what is SpannedData:
        coded = SpannedData(*base, four[0], four[1], deflated)
    elif what is SheetsWithin:
        coded = SheetsWithin(*base, coloured, stack, size, Rect(*four), deflated)
    elif what is WholeSheets:
        coded = WholeSheets(*base, coloured, stack, size)
    elif what is CodedSheets:
        coded = CodedSheets(*base, coloured, stack, size)
    return Record(rect, coded, stack, depth)


def _numbers(inks: Inks, known: Inks, others: dict[Instance, int]) -> list[int]:
    """Returns the numbers of some inks: of `known` their places there, of others those behind."""
    places = ((plane_map(known, inks)[COLOURS::3] - COLOURS) // 3).tolist()
    return [
        place if place >= 0 else len(known) + others.setdefault(ink, len(others))
        for ink, place in zip(inks, places, strict=True)
    ]


def _inks(numbers: Iterator[int], count: int, known: Inks, others: Inks) -> Inks:
    """Takes the next numbers of so many inks, and returns these."""
    taken = islice(numbers, count)
    return tuple(known[number] if number < len(known) else others[number - len(known)] for number in taken)
