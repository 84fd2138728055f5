"""Records of the state before a commit: their values where the commit changed them, and else those that came after.

A commit knows where it changed a record.  So what is kept for undo need not be the whole tile until somebody rests.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from isal import isal_zlib

from engine.canvas.rising import span_values
from engine.canvas.store import Record
from engine.session.coding.byte_planes import joined_bytes, split_bytes
from engine.session.coding.coded_records import CodedData, Ways
from engine.session.coding.sheets_within import sheets_within

_LESS = 2  # a record's own bytes are such a multiple of what is kept of it, at least: else it stays whole
_SMALL = 64  # bytes that are not worth it to be compressed
_ROW = 2  # bytes of a row's span


@dataclass(frozen=True, eq=False, slots=True)
class SpannedData(CodedData):
    """The data of a record: in some columns of its `rows` rows from `top` on its own, and else those of `other`.

    `packed`: of each of these rows the first column and the one behind the last, a byte each, and then the values that
    lie there (`span_values.gather`); `deflated`, the low bytes of these before the high ones, or as they are.
    """

    top: int
    rows: int
    deflated: bool

    def smaller(self) -> CodedData | None:
        """Returns the same in fewer bytes; None where there is no such form."""
        raw = self.packed
        if self.deflated or not isinstance(raw, bytes) or len(raw) < _SMALL:
            return None
        spans, values = raw[: _ROW * self.rows], np.frombuffer(raw, self.dtype, offset=_ROW * self.rows)
        packed = isal_zlib.compress(spans + split_bytes(values).tobytes(), 1)
        return replace(self, packed=packed, deflated=True) if len(packed) < len(raw) else None

    def _added(self, out: np.ndarray) -> np.ndarray:
        """Puts what is the record's own in its place."""
        packed = self.packed if isinstance(self.packed, bytes) else self.packed.read()
        raw = np.frombuffer(isal_zlib.decompress(packed) if self.deflated else packed, np.uint8)
        spans, told = raw[: _ROW * self.rows].reshape(-1, _ROW).astype(np.int32), raw[_ROW * self.rows :]
        if self.deflated:
            values = joined_bytes(told.reshape(self.dtype.itemsize, -1), self.dtype)
        else:
            values = told.view(self.dtype).copy()
        span_values.scatter(values, spans, out, self.top)
        return out


def lessen(ways: Ways, record: Record, other: Record) -> None:
    """Keeps of a record no more than where `other`, which took its place now, differs: that is known now, and noted no
    longer."""
    coded = spanned(record, other) or sheets_within(record, other)
    if coded is not None and ways.lead(record, other):
        record.exchange(coded)
    other.came_from(None)


def spanned(record: Record, other: Record) -> SpannedData | None:
    """Returns what a record holds by what `other`, which took its place, holds; None where that is not known to differ
    in few places, or the record is coded."""
    since, data = other.since, record.held
    if since is None or since.of() is not record or not isinstance(data, np.ndarray):
        return None
    at, rect = since.at, record.rect
    first, last = max(at.y0, rect.y0), min(at.y1, rect.y1)
    told = since.spans[max(first - at.y0, 0) : max(last - at.y0, 0)]
    spans = np.empty(told.shape, np.uint8)
    values = np.empty(max(data.nbytes // _LESS - _ROW * len(spans), 0) // data.itemsize, data.dtype)
    count = span_values.pick(data, first - rect.y0, told, at.x0 - rect.x0, spans, values)
    if count < 0:
        return None
    packed = spans.tobytes() + values[:count].tobytes()
    return SpannedData(rect, record.inks, data.dtype, other, 0, packed, first - rect.y0, len(spans), False)
