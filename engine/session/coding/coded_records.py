"""Records of old states, made smaller: only what differs from the record that took their place, compressed.

A record keeps its value and its identity; the data of a coded one are made when they are asked for.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol
from weakref import WeakKeyDictionary

import numpy as np
from isal import isal_zlib

from engine.canvas.store import Record
from engine.keeping.spill import PLACE_OVERHEAD, Spilled, spill
from engine.numeric.address import Rect
from engine.numeric.recent import Recent
from engine.session.coding.byte_planes import joined_bytes, split_bytes
from engine.texture.even_planes import EvenPlanes
from engine.texture.planes import COLOURS, plane_map
from engine.texture.record import Instance
from engine.texture.sparse_planes import OfSheets, SparsePlanes, SparseSheet, integers_up_to

WAY = 8  # records of a tile that are coded one by the next, then one by itself: so that no way to one is long
_MADE = 32 << 20  # bytes of data kept that were asked for
_AT_ONCE = 64  # inks that are compared at once
_DENSE = 16 << 20  # bytes of planes over all of their rectangle, from which on sheets are coded one by one
_OVERHEAD = 150  # bytes of a coded record's own objects, roughly


class Packed(Protocol):
    """What is told by something packed."""

    @property
    def packed(self) -> bytes | Spilled:
        """Gives it, or where on disk it is."""
        ...


@dataclass(frozen=True, eq=False, slots=True)
class CodedData:
    """The data of a record, less what the record `other` of the same tile predicts (None: nothing).

    `rect`, `inks`: the record's; `dtype`: of its data; `edges`: the rows and columns of the data in which anything
    differs, as one number (`_told`): there may be millions; `packed`: these, low bytes before high ones, deflated; or
    where on disk that is.
    """

    rect: Rect
    inks: tuple[Instance, ...]
    dtype: np.dtype
    other: Record | None
    edges: int
    packed: bytes | Spilled

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return _OVERHEAD + (len(self.packed) if isinstance(self.packed, bytes) else PLACE_OVERHEAD)

    @property
    def itemsize(self) -> int:
        """Counts the bytes of each of the data."""
        return self.dtype.itemsize

    def plain(self) -> np.ndarray | SparsePlanes:
        """Returns what the record held."""
        return self.made()

    def smaller(self) -> CodedData | None:
        """Returns the same in fewer bytes; None where there is no such form."""
        return None

    def made(self) -> np.ndarray:
        """Returns the data, read-only."""
        known = RECORDS_MADE.get(self)
        if known is not None:
            return known
        way = [self]  # to the nearest record whose data are there
        while (other := way[-1].other) is not None and isinstance(held := other.held, CodedData):
            if isinstance(held, CodedSheets) or RECORDS_MADE.get(held) is not None:
                break
            way.append(held)
        first = way.pop()
        data = first._added(first._predicted(None if first.other is None else first.other.data))
        for before, coded in pairwise((first, *reversed(way))):
            alike = coded.rect == before.rect and coded.inks == before.inks and coded.dtype == before.dtype
            data = coded._added(data if alike else coded._predicted(data))
        data.flags.writeable = False
        RECORDS_MADE.keep(self, data, data.nbytes)
        return data

    def _predicted(self, data: np.ndarray | None) -> np.ndarray:
        return _predicted((self.rect, self.inks, self.dtype), self.other, data)

    def _added(self, out: np.ndarray) -> np.ndarray:
        """Adds to what is predicted, in place."""
        packed = self.packed if isinstance(self.packed, bytes) else self.packed.read()
        if packed:
            part = out[:, *_window(self.edges)]
            raw = np.frombuffer(isal_zlib.decompress(packed), np.uint8).reshape(self.dtype.itemsize, part.size)
            part += joined_bytes(raw, self.dtype).reshape(part.shape)
        return out


@dataclass(frozen=True, eq=False, slots=True)
class CodedSheets(CodedData, OfSheets):
    """The same of the sheets of many inks, the record's `stack`: of colour where `coloured`, and of those `inks` whose
    sheets are not the very ones that the other record has.  `size`: bytes of each of the data."""

    coloured: bool
    stack: tuple[Instance, ...]
    size: int

    @property
    def itemsize(self) -> int:
        """Counts the bytes of each of the data."""
        return self.size

    def plain(self) -> SparsePlanes:
        """Returns the sheets."""
        known = SHEETS_MADE.get(self)
        if known is not None:
            return known
        made = self._unpacked()
        SHEETS_MADE.keep(self, made, made.nbytes)
        return made

    def _unpacked(self) -> SparsePlanes:
        """Makes the sheets."""
        base = sheets_of(self.other) if self.other is not None else None
        out = self._added(_sheets_over(base, self.rect, self.inks, self.dtype, self.coloured))
        new = SparsePlanes.of(self.rect, out, self.inks)
        shared = base.inks if base is not None else {}
        inks = {ink: new.inks[ink] if ink in new.inks else shared[ink] for ink in self.stack}
        colours = new.colours if self.coloured or base is None else base.colours
        return SparsePlanes(self.rect, colours, inks)

    def made(self) -> np.ndarray:
        """Returns the data, read-only."""
        return self.plain().made()


@dataclass(frozen=True, eq=False, slots=True)
class WholeSheets(CodedSheets):
    """The sheets of many inks by themselves, each only as far as anything lies in it.

    `packed`: of each its edges and its largest value, int32, then the values of each, low bytes before high ones;
    deflated.
    """

    def _unpacked(self) -> SparsePlanes:
        """Makes the sheets."""
        packed = self.packed if isinstance(self.packed, bytes) else self.packed.read()
        raw, count = np.frombuffer(isal_zlib.decompress(packed), np.uint8), self.coloured + len(self.stack)
        told, at = raw[: 20 * count].view(np.int32).reshape(count, 5).tolist(), 20 * count
        sheets = []
        for number, (x0, y0, x1, y1, most) in enumerate(told):
            rect, kind = Rect(x0, y0, x1, y1), np.dtype(integers_up_to(most))
            planes = COLOURS if self.coloured and number == 0 else 3
            size = planes * rect.area * kind.itemsize
            data = joined_bytes(raw[at : at + size].reshape(kind.itemsize, -1), kind)
            data.flags.writeable = False
            sheets.append(SparseSheet(rect, data.reshape(planes, rect.height, rect.width), most))
            at += size
        colours = sheets.pop(0) if self.coloured else None
        return SparsePlanes(self.rect, colours, dict(zip(self.stack, sheets, strict=True)))


RECORDS_MADE: Recent[np.ndarray] = Recent(lambda: _MADE)
SHEETS_MADE: Recent[SparsePlanes] = Recent(lambda: _MADE)


class Ways:
    """Codes records of a line of history, the farthest first, so that the ways to their data stay short."""

    def __init__(self) -> None:
        # Of records, how many are made of them one by the next.
        self._behind: WeakKeyDictionary[Record, int] = WeakKeyDictionary()

    def lead(self, record: Record, other: Record) -> bool:
        """Tells whether a record may be made of another one, and notes that it is from now on."""
        ahead = list(links_of(other)) if isinstance(other.held, CodedData) else [other]
        behind = self._behind.get(record, 0)
        if record in ahead or behind + len(ahead) > WAY - 1:
            return False
        for number, one in enumerate(ahead, behind + 1):
            self._behind[one] = max(self._behind.get(one, 0), number)
        return True

    def encode(self, record: Record, other: Record | None) -> int:
        """Makes a record smaller; `other`: the one that took its place, None for none.  Returns the bytes that it takes
        less."""
        if other is not None and not isinstance(record.held, CodedData) and not self.lead(record, other):
            other = None
        saved = encode(record, other)
        self._behind.pop(record, None)
        return saved

    def forget(self) -> None:
        """Holds none of the records any more: the next ways may be longer."""
        self._behind.clear()


def encode(record: Record, other: Record | None) -> int:
    """Makes a record smaller; `other`: the one that took its place, None for none.  Returns the bytes that it takes
    less than before, and would not share with the other: 0 if it is coded already, or not worth it."""
    held = record.held
    if isinstance(held, CodedData):
        smaller = held.smaller()
        if smaller is None:
            return 0
        record.exchange(smaller)
        return held.nbytes - smaller.nbytes
    if not isinstance(held, np.ndarray | EvenPlanes | SparsePlanes):
        return 0
    if other is not None and leads_to(other, record):
        other = None
    if isinstance(held, np.ndarray | EvenPlanes):
        coded, taken = _coded(record, other), held.nbytes
    elif other is None and 4 * record.rect.area * (COLOURS + 3 * len(record.inks)) > _DENSE:
        coded, taken = whole_sheets(record, held), held.nbytes
    else:
        coded, taken = _coded_sheets(record, held, other)
    if coded.nbytes >= held.nbytes:
        return 0
    record.exchange(coded)
    return max(taken - coded.nbytes, 1)


def put_away(coded: Packed, spare: bool = False) -> int:
    """Puts what is packed away on disk; `spare`: only where others have room there, too.  Returns the bytes of memory
    that it takes less: 0 where it lies there already, is so small that its place there is told in as many, or has no
    room."""
    packed = coded.packed
    if not isinstance(packed, bytes) or len(packed) <= PLACE_OVERHEAD:
        return 0
    put = spill().put_spare(packed) if spare else spill().put(packed)
    if put is None:
        return 0
    object.__setattr__(coded, "packed", put)
    return put.size - PLACE_OVERHEAD


def coded_alone(record: Record) -> tuple[CodedData, bytes]:
    """Returns a record's data by themselves, and what is packed of them; the record stays as it is."""
    held = record.held
    alone = isinstance(held, CodedData) and not isinstance(held, CodedSheets) and held.other is None
    coded = held if isinstance(held, CodedData) and alone else _coded(record, None)
    return coded, coded.packed if isinstance(coded.packed, bytes) else coded.packed.read()


def coded_by(record: Record, other: Record | None) -> tuple[CodedData, bytes]:
    """Returns a record's data by those of another one, which are sheets as well or neither are, by themselves where
    there is none; and what is packed of them.  The records stay as they are."""
    sheets = record.sheets
    if sheets is None:
        coded = _coded(record, other)
    elif other is None:
        coded = whole_sheets(record, sheets)
    else:
        coded, _ = _coded_sheets(record, sheets, other)
    assert isinstance(coded.packed, bytes)
    return coded, coded.packed


def decode(record: Record) -> None:
    """Makes a record as it was."""
    held = record.held
    if isinstance(held, CodedData):
        record.exchange(held.plain())
        RECORDS_MADE.forget(held)
        SHEETS_MADE.forget(held)


def _coded(record: Record, other: Record | None) -> CodedData:
    data = record.data
    wanted = record.rect, record.inks, data.dtype
    left = data - _predicted(
        wanted, other, None if other is None else other.data
    )  # wraps round, and back when it is added
    return CodedData(record.rect, record.inks, data.dtype, other, *_packed(left))


def _coded_sheets(record: Record, held: SparsePlanes, other: Record | None) -> tuple[CodedSheets, int]:
    """Returns many inks coded, and the bytes of the sheets that are not shared with the other record."""
    base = None if other is None else sheets_of(other)
    shared, rect = {} if base is None else base.inks, record.rect
    inks = tuple(ink for ink in record.inks if held.inks[ink] is not shared.get(ink))
    coloured = base is None or held.colours is not base.colours
    sheets = [held.inks[ink] for ink in inks] + ([held.colours] if coloured and held.colours is not None else [])
    dtype = np.dtype(np.int16 if all(sheet.most < 1 << 15 for sheet in sheets) else np.int32)
    edges, packed = _edges(_marked(held, base, rect, inks, coloured)), b""
    if edges:
        down, across = _window(edges)
        part = Rect(rect.x0 + across.start, rect.y0 + down.start, rect.x0 + across.stop, rect.y0 + down.stop)
        # wraps round, and back when it is added
        left = _sheets_over(held, part, inks, dtype, coloured) - _sheets_over(base, part, inks, dtype, coloured)
        packed = isal_zlib.compress(split_bytes(left).data, 1)
    coded = CodedSheets(rect, inks, dtype, other, edges, packed, coloured, record.inks, held.itemsize)
    return coded, sum(sheet.nbytes for sheet in sheets)


def whole_sheets(record: Record, held: SparsePlanes) -> WholeSheets:
    """Returns many inks coded by themselves."""
    coloured, inks = held.colours is not None, record.inks
    sheets = [*([] if held.colours is None else [held.colours]), *(held.inks[ink] for ink in inks)]
    told = np.array([(*sheet.rect, sheet.most) for sheet in sheets], np.int32)
    deflating = isal_zlib.compressobj(1)
    parts = [deflating.compress(told.tobytes())]
    parts += [deflating.compress(split_bytes(sheet.data).data) for sheet in sheets]
    packed = b"".join([*parts, deflating.flush()])
    return WholeSheets(record.rect, inks, np.dtype(held.kind), None, 0, packed, coloured, inks, held.itemsize)


def _marked(
    held: SparsePlanes, base: SparsePlanes | None, rect: Rect, inks: tuple[Instance, ...], coloured: bool
) -> np.ndarray:
    """Tells where in a rectangle sheets differ from others, in colour or some inks: bool (h, w).  Some inks at a time:
    the planes of all of thousands, over a whole tile, would take gigabytes."""
    marked = np.zeros((rect.height, rect.width), bool)
    for first in range(0, max(len(inks), 1), _AT_ONCE):
        some, told = inks[first : first + _AT_ONCE], coloured and first == 0
        one, other = (_sheets_over(sheets, rect, some, np.dtype(np.int32), told) for sheets in (held, base))
        marked |= (one != other).any(axis=0)
    return marked


def sheets_of(record: Record) -> SparsePlanes:
    """Returns what a record holds as sheets."""
    found = record.sheets
    return SparsePlanes.of(record.rect, record.data, record.inks) if found is None else found


def _sheets_over(
    sheets: SparsePlanes | None, rect: Rect, inks: tuple[Instance, ...], dtype: np.dtype, coloured: bool
) -> np.ndarray:
    """Returns planes of some inks over a rectangle, those of colour zero where they are not asked for: new."""
    if sheets is None:
        return np.zeros((COLOURS + 3 * len(inks), rect.height, rect.width), dtype)
    some = {ink: sheet for ink in inks if (sheet := sheets.inks.get(ink)) is not None}
    return SparsePlanes(rect, sheets.colours if coloured else None, some).over(rect, inks, dtype.type)


def _packed(left: np.ndarray) -> tuple[int, bytes]:
    """Returns the rows and columns in which planes of integers tell anything, as one number, and these, packed."""
    edges = _edges(np.asarray(left.any(axis=0)))
    return edges, isal_zlib.compress(split_bytes(left[:, *_window(edges)]).data, 1) if edges else b""


def _edges(marked: np.ndarray) -> int:
    """Returns the rows and columns that hold all that is marked, (h, w), as one number; 0 where nothing is."""
    rows, columns = np.flatnonzero(marked.any(axis=1)), np.flatnonzero(marked.any(axis=0))
    if not len(rows):
        return 0
    return _told(int(rows[0]), int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1)


def _told(top: int, bottom: int, left: int, right: int) -> int:
    """Returns the edges of a part of a tile, each of at most a byte, as one number."""
    return top | bottom << 8 | left << 16 | right << 24


def _window(edges: int) -> tuple[slice, slice]:
    """Returns the rows and columns between such edges."""
    return slice(edges & 255, edges >> 8 & 255), slice(edges >> 16 & 255, edges >> 24)


def _predicted(
    wanted: tuple[Rect, tuple[Instance, ...], np.dtype], other: Record | None, data: np.ndarray | None
) -> np.ndarray:
    """Returns what another record of the tile, of these data, has at the places of the one that is wanted: new, in its
    integers."""
    rect, inks, dtype = wanted
    out = np.zeros((COLOURS + 3 * len(inks), rect.height, rect.width), dtype)
    common = Rect(0, 0, 0, 0) if other is None else rect.intersect(other.rect)
    if other is not None and data is not None and not common.empty:
        here, there = common.slices(rect), common.slices(other.rect)
        for plane, source in enumerate(plane_map(other.inks, inks).tolist()):
            if source >= 0:
                out[plane, *here] = data[source, *there].astype(dtype, copy=False)
    return out


def leads_to(other: Record, record: Record) -> bool:
    """Tells whether another record's data are made from this one's."""
    return record in links_of(other)


def links_of(record: Record) -> Iterator[Record]:
    """Yields a record and those of which it is made, one by the next."""
    here: Record | None = record
    while here is not None:
        yield here
        here = here.held.other if isinstance(here.held, CodedData) else None
