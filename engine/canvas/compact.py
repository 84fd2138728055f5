"""The smallest record that holds a residual."""

from __future__ import annotations

import numpy as np

from engine.canvas import kernels
from engine.canvas.store import Record
from engine.numeric.address import Rect
from engine.texture.planes import COLOURS
from engine.texture.record import Instance
from engine.texture.sparse_planes import MANY, SparsePlanes

Extent = tuple[int, int, int, int, int]


def compact(
    rect: Rect,
    data: np.ndarray,
    inks: tuple[Instance, ...],
    depth: int,
    measured: tuple[Extent, np.ndarray] | None = None,
) -> Record | None:
    """Returns a residual in int32 units of 2^-16 (4 + 3n, h, w) over `rect` of its tile, as a record: cropped to
    what is not zero, without empty inks, in the smaller integer that holds it.  None where all is zero.

    `measured`: what `kernels.extent` tells of `data`, where that is known.
    """
    if measured is None:
        used = np.empty(len(data), np.int32)
        measured = kernels.extent(data, used), used
    (bits, y0, y1, x0, x1), used = measured
    if bits == 0:
        return None
    filled = used.tolist()
    kept = [i for i in range(len(inks)) if any(filled[COLOURS + 3 * i : COLOURS + 3 * i + 3])]
    if len(kept) < len(inks):
        planes = [*range(COLOURS), *(COLOURS + 3 * i + c for i in kept for c in range(3))]
        data, inks = data[planes], tuple(inks[i] for i in kept)
    smaller = np.int16 if bits < 1 << 15 else np.int32
    at = Rect(rect.x0 + x0, rect.y0 + y0, rect.x0 + x1, rect.y0 + y1)
    if len(inks) >= MANY:
        return Record(at, SparsePlanes.of(at, data[:, y0:y1, x0:x1], inks), inks, depth)
    cropped = data[:, y0:y1, x0:x1].astype(smaller)
    cropped.flags.writeable = False
    return Record(at, cropped, inks, depth)
