"""The smallest record that holds a residual."""

from __future__ import annotations

import numpy as np

from engine.canvas.rising import counting
from engine.canvas.rising.spans import Found
from engine.canvas.store import Record
from engine.numeric.address import Rect
from engine.texture.planes import COLOURS, plane_map
from engine.texture.record import Instance
from engine.texture.sparse_planes import MANY, SparsePlanes

Extent = tuple[int, int, int, int, int]


def blank_found(data: np.ndarray) -> Found:
    """Returns what `counting.first_residual` tells of `data` in, before it does."""
    planes, rows, columns = (np.zeros(size, np.int32) for size in data.shape)
    return planes, rows, columns


def compact(
    rect: Rect,
    data: np.ndarray,
    inks: tuple[Instance, ...],
    depth: int,
    measured: tuple[Extent, np.ndarray] | None = None,
    spans: np.ndarray | None = None,
) -> Record | None:
    """Returns a residual in int32 steps of the grid (4 + 3n, h, w) over `rect` of its tile, as a record: cropped to
    what is not zero, without empty inks, in the smaller integer that holds it.  None where all is zero.

    `measured`: what `counting.extent` tells of `data`, where that is known; `spans`, int32 (h, 2): the columns of each
    row in which `data` tells anything; elsewhere it is zero, whatever stands there.
    """
    if measured is None:
        used = np.empty(len(data), np.int32)
        measured = counting.extent(data, used), used
    (bits, y0, y1, x0, x1), used = measured
    if bits == 0:
        return None
    planes, inks = filled_planes(inks, used)
    at = Rect(rect.x0 + x0, rect.y0 + y0, rect.x0 + x1, rect.y0 + y1)
    smaller = np.int16 if bits < 1 << 15 else np.int32
    cropped = np.empty((len(planes), y1 - y0, x1 - x0), smaller)
    if spans is None:
        spans = np.full((data.shape[1], 2), (0, data.shape[2]), np.int32)
    counting.crop(data, spans, planes, (y0, x0), cropped)
    if len(inks) >= MANY:
        return Record(at, SparsePlanes.of(at, cropped, inks), inks, depth)
    cropped.flags.writeable = False
    return Record(at, cropped, inks, depth)


def filled_planes(inks: tuple[Instance, ...], used: np.ndarray) -> tuple[np.ndarray, tuple[Instance, ...]]:
    """Returns the planes of colour and of those inks of which some plane is `used` (C,), and these inks."""
    filled = used.tolist()
    kept = tuple(ink for i, ink in enumerate(inks) if any(filled[COLOURS + 3 * i : COLOURS + 3 * i + 3]))
    return plane_map(inks, kept), kept


def trimmed(rect: Rect, data: np.ndarray, inks: tuple[Instance, ...], depth: int, full: bool) -> Record | None:
    """As `compact`, of int16, which is the record's own where nothing is to be left out.  `full`: whether something
    lies at each edge, and of each ink."""
    if full:  # what fills its rectangle is not gone through
        data.flags.writeable = False
        return Record(rect, data, inks, depth)
    used = np.empty(len(data), np.int32)
    bits, y0, y1, x0, x1 = counting.edges(data, used)
    if bits == 0:
        return None
    planes, kept = filled_planes(inks, used)
    at = Rect(rect.x0 + x0, rect.y0 + y0, rect.x0 + x1, rect.y0 + y1)
    if at != rect or len(kept) < len(inks):
        data = np.ascontiguousarray(data[planes, y0:y1, x0:x1] if len(kept) < len(inks) else data[:, y0:y1, x0:x1])
    data.flags.writeable = False
    return Record(at, data, kept, depth)
