"""The kernels of plain paint in NumPy, with the same bits: they stand in until those are compiled.

Arguments and results are those of the functions of the same names in module `kernels`.
"""

from __future__ import annotations

import numpy as np

from engine.canvas.rising.spans import Extent, Marks, extent_of, spans_of
from engine.numeric.grid import SNAP, snapped_to
from engine.numeric.kernel import Array

_ZERO, _ONE, QUARTER = np.float32(0.0), np.float32(1.0), np.float32(0.25)
# A coarse pixel that differs from the mean of its children by no more steps of the grid than this is taken to equal it:
# the rounding lag of many strokes, each below the grid at the coarse level, heals instead of adding up.
LAG = np.float32(2.0)

Pair = tuple[Array, Array]
Corner = tuple[int, int]
Window = tuple[int, ...]


def extent_in_rows(data: np.ndarray, first_plane: int, last_plane: int, first: int, last: int) -> Extent:
    """Does what the kernel of that name in `kernels` does."""
    there = np.any(data[first_plane:last_plane, first:last] != _ZERO, axis=0)
    rows, columns = np.flatnonzero(there.any(axis=1)), np.flatnonzero(there.any(axis=0))
    if not rows.size:
        return 0, 0, 0, 0
    return first + int(rows[0]), first + int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1


def clamp_alpha(out: np.ndarray, first: int, last: int) -> None:
    """Does what the kernel of that name in `kernels` does."""
    out[3, first:last] = np.minimum(np.maximum(out[3, first:last], _ZERO), _ONE)


def add_residual(
    out: Array, top: int, left: int, data: Array, row: int, column: int, height: int, width: int, planes: Array,
    step: np.float32,
) -> None:  # fmt: skip
    """Does what the kernel of that name in `kernels` does."""
    for c, source in enumerate(planes.tolist()):
        if source >= 0:
            part = data[source, row : row + height, column : column + width]
            out[c, top : top + height, left : left + width] += part.astype(np.float32) * step


def apply_stamp(
    old: Array, keep: Array, add: Array, colour: Array, planes: Array, plain: bool, spares_alpha: bool, new: Array,
    marks: Marks, step: np.float32, noise: Array,
) -> Extent:  # fmt: skip
    """Does what the kernel of that name in `kernels` does."""
    changed, spans = marks
    if colour.size:
        m = _ONE - keep
        add = np.stack([*((m * value + SNAP) - SNAP for value in colour), m])
    for c, source in enumerate(planes.tolist()):
        if c == 3 and spares_alpha:
            new[c] = old[c]
        elif noise.size:
            whole = keep * old[c] + add[source] if source >= 0 else keep * old[c]
            new[c] = snapped_to(whole + noise, step)
        else:
            new[c] = (keep * old[c] + SNAP) - SNAP
            if source >= 0:
                new[c] += add[source]
    if not spares_alpha:
        clamp_alpha(new, 0, new.shape[1])
    changed[...] = keep != _ONE
    if not plain:
        changed |= (old != new).any(axis=0)
    spans[...] = spans_of(changed)
    return extent_of(changed)


def halve(fine: np.ndarray, planes: np.ndarray, out: np.ndarray, top: int, left: int, step: np.float32) -> None:
    """Does what the kernel of that name in `kernels` does."""
    height, width = fine.shape[1] // 2, fine.shape[2] // 2
    for c, source in enumerate(planes.tolist()):
        part = out[c, top : top + height, left : left + width]
        if source < 0:
            part[...] = _ZERO
            continue
        upper, lower = fine[source, 0 : 2 * height : 2], fine[source, 1 : 2 * height : 2]
        total = (upper[:, : 2 * width : 2] + upper[:, 1::2]) + (lower[:, : 2 * width : 2] + lower[:, 1::2])
        part[...] = snapped_to(total * QUARTER, step)
