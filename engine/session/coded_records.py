"""Records of old states, made smaller: only what differs from the record that took their place, compressed.

A record keeps its value and its identity; the data of a coded one are made when they are asked for.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from isal import isal_zlib

from engine.canvas.store import Record
from engine.keeping.recent import Recent
from engine.keeping.spill import Spilled, spill
from engine.numeric.address import Rect
from engine.texture.planes import COLOURS, plane_map
from engine.texture.record import Instance

WAY = 8  # records of a tile that are coded one by the next, then one by itself: so that no way to one is long
_MADE = 32 << 20  # bytes of data kept that were asked for
_OVERHEAD = 300  # bytes of a coded record's own objects, roughly


@dataclass(frozen=True, eq=False, slots=True)
class CodedData:
    """The data of a record, less what the record `other` of the same tile predicts (None: nothing).

    `rect`, `inks`: the record's; `dtype`: of its data; `window`: the rows and columns of the data in which anything
    differs, `packed`: these, low bytes before high ones, deflated; or where on disk that is.
    """

    rect: Rect
    inks: tuple[Instance, ...]
    dtype: np.dtype
    other: Record | None
    window: tuple[slice, slice]
    packed: bytes | Spilled

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return _OVERHEAD + (len(self.packed) if isinstance(self.packed, bytes) else 0)

    @property
    def spared(self) -> int:
        """Counts the bytes that the data would take beside these."""
        size = (COLOURS + 3 * len(self.inks)) * self.rect.height * self.rect.width * self.dtype.itemsize
        return size - self.nbytes

    def made(self) -> np.ndarray:
        """Returns the data, read-only."""
        known = _KEPT.get(self)
        if known is not None:
            return known
        way = [self]  # to the nearest record whose data are there
        while (other := way[-1].other) is not None and isinstance(held := other.held, CodedData):
            if _KEPT.get(held) is not None:
                break
            way.append(held)
        first = way.pop()
        data = first._added(first._predicted(None if first.other is None else first.other.data))
        for before, coded in pairwise((first, *reversed(way))):
            alike = coded.rect == before.rect and coded.inks == before.inks and coded.dtype == before.dtype
            data = coded._added(data if alike else coded._predicted(data))
        data.flags.writeable = False
        _KEPT.keep(self, data, data.nbytes)
        return data

    def _predicted(self, data: np.ndarray | None) -> np.ndarray:
        return _predicted((self.rect, self.inks, self.dtype), self.other, data)

    def _added(self, out: np.ndarray) -> np.ndarray:
        """Adds to what is predicted, in place."""
        packed = self.packed if isinstance(self.packed, bytes) else self.packed.read()
        if packed:
            part = out[:, *self.window]
            raw = np.frombuffer(isal_zlib.decompress(packed), np.uint8).reshape(self.dtype.itemsize, part.size)
            part += np.ascontiguousarray(raw.T).view(self.dtype).reshape(part.shape)
        return out


_KEPT: Recent[np.ndarray] = Recent(lambda: _MADE)


class Ways:
    """Codes records of a line of history, the farthest first, so that the ways to their data stay short."""

    def __init__(self) -> None:
        self._behind: dict[Record, int] = {}  # records that one not coded yet is to be made before

    def encode(self, record: Record, other: Record | None) -> None:
        """Makes a record smaller; `other`: the one that took its place, None for none."""
        behind = self._behind.pop(record, 0)
        if other is not None and (behind >= WAY - 1 or leads_to(other, record)):
            other = None
        if encode(record, other) and other is not None:
            self._behind[other] = max(self._behind.get(other, 0), behind + 1)

    def forget(self) -> None:
        """Holds none of the records any more: the next ways may be longer."""
        self._behind.clear()


def encode(record: Record, other: Record | None) -> int:
    """Makes a record smaller; `other`: the one that took its place, None for none.  Returns the bytes that it takes
    less than before: 0 if it is coded already."""
    if not isinstance(record.held, np.ndarray):
        return 0
    if other is not None and leads_to(other, record):
        other = None
    coded = _coded(record, other)
    if coded.spared <= 0:
        return 0
    record.exchange(coded)
    return coded.spared


def put_away(coded: CodedData) -> int:
    """Puts what is packed away on disk.  Returns the bytes of memory that it takes less: 0 where it lies there already,
    or has no room."""
    packed = coded.packed
    put = spill().put(packed) if isinstance(packed, bytes) and packed else None
    if put is None:
        return 0
    object.__setattr__(coded, "packed", put)
    return put.size


def decode(record: Record) -> None:
    """Makes a record as it was."""
    held = record.held
    if isinstance(held, CodedData):
        record.exchange(held.made())
        _KEPT.forget(held)


def _coded(record: Record, other: Record | None) -> CodedData:
    data = record.data
    wanted = record.rect, record.inks, data.dtype
    left = data - _predicted(
        wanted, other, None if other is None else other.data
    )  # wraps round, and back when it is added
    marked = left.any(axis=0)
    rows, columns = (np.flatnonzero(marked.any(axis=axis)) for axis in (1, 0))
    if not len(rows):
        return CodedData(record.rect, record.inks, data.dtype, other, (slice(0, 0), slice(0, 0)), b"")
    window = slice(int(rows[0]), int(rows[-1]) + 1), slice(int(columns[0]), int(columns[-1]) + 1)
    raw = np.ascontiguousarray(left[:, *window]).view(np.uint8).reshape(-1, data.itemsize)
    packed = isal_zlib.compress(np.ascontiguousarray(raw.T).data, 1)
    return CodedData(record.rect, record.inks, data.dtype, other, window, packed)


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
    here: Record | None = other
    while here is not None and here is not record:
        here = here.held.other if isinstance(here.held, CodedData) else None
    return here is record
