"""Records of what generators laid, packed as soon as they are there.

Its inks lie evenly over whole tiles, with steps at their edges alone: they take a twentieth of the bytes then.
"""

from __future__ import annotations

from engine.canvas.store import Record
from engine.session.coding.coded_records import encode
from engine.texture.record import Instance
from engine.texture.sparse_planes import SparsePlanes

_WORTH = 4 << 10  # bytes of a record that are worth it


def pack_laid(record: Record, before: Record | None) -> None:
    """Packs a new record where something lies that a generator laid; `before`: the one whose place it took."""
    held = record.held
    if not stays_packed(record):
        return
    if isinstance(held, SparsePlanes):  # whose sheets look by themselves whether they are worth it
        there = None if before is None else before.held
        held.pack(there if isinstance(there, SparsePlanes) else None, _is_laid)
    elif held.nbytes >= _WORTH:
        encode(record, None)


def stays_packed(record: Record) -> bool:
    """Tells whether a record of the present that is coded by itself is to stay so."""
    kinds = {type(ink): ink for ink in record.inks}  # one of each: there may be thousands
    return any(map(_is_laid, kinds.values()))


def _is_laid(ink: Instance) -> bool:
    return hasattr(ink, "laid")
