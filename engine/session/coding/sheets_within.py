"""Many inks of the state before a commit: where the commit may have changed them as they were, and else those that came
after."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from isal import isal_zlib

from engine.canvas.store import Record
from engine.numeric.address import Rect
from engine.session.coding.byte_planes import joined_bytes, split_bytes
from engine.session.coding.coded_records import CodedData, CodedSheets, sheets_of
from engine.texture.planes import COLOURS
from engine.texture.sparse_planes import SparsePlanes

_LESS = 2  # the sheets' own bytes are such a multiple of what is kept of them, at least: else they stay whole


@dataclass(frozen=True, eq=False, slots=True)
class SheetsWithin(CodedSheets):
    """The sheets of a record: in the rectangle `at` of the tile, of colour and of `inks`, its own, and else those of
    `other`.

    `packed`: the values that lie there, plane by plane; `deflated`, the low bytes of these before the high ones, or as
    they are.
    """

    at: Rect
    deflated: bool

    def smaller(self) -> CodedData | None:
        """Returns the same in fewer bytes; None where there is no such form."""
        raw = self.packed
        if self.deflated or not isinstance(raw, bytes):
            return None
        packed = isal_zlib.compress(split_bytes(np.frombuffer(raw, self.dtype)).data, 1)
        return replace(self, packed=packed, deflated=True) if len(packed) < len(raw) else None

    def _unpacked(self) -> SparsePlanes:
        """Makes the sheets."""
        packed = self.packed if isinstance(self.packed, bytes) else self.packed.read()
        if self.deflated:
            raw = np.frombuffer(isal_zlib.decompress(packed), np.uint8)
            values = joined_bytes(raw.reshape(self.dtype.itemsize, -1), self.dtype)
        else:
            values = np.frombuffer(packed, self.dtype)
        data = values.reshape(COLOURS + 3 * len(self.inks), self.at.height, self.at.width)
        assert self.other is not None
        base = sheets_of(self.other)
        made = base.replaced(self.at, data, self.inks, base.over(self.at, self.inks, np.int32))
        assert made is not None
        return made


def sheets_within(record: Record, other: Record) -> SheetsWithin | None:
    """Returns the sheets that a record holds by those that `other`, which took its place, holds; None where that is
    not known to differ in a small part, or the record holds no sheets."""
    since, held = other.since, record.held
    if since is None or since.of() is not record or not isinstance(held, SparsePlanes):
        return None
    beside = sheets_of(other)
    inks = held.inks_apart(beside)
    inks = (*inks, *(ink for ink in beside.inks_apart(held) if ink not in held.inks))
    dtype = np.dtype(held.kind)
    if since.at.area * (COLOURS + 3 * len(inks)) * dtype.itemsize * _LESS > held.alone(beside):
        return None
    packed = held.over(since.at, inks, held.kind).tobytes()
    return SheetsWithin(record.rect, inks, dtype, other, 0, packed, True, record.inks, held.itemsize, since.at, False)
