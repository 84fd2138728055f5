"""The kernels of plain paint in NumPy, with the same bits: they stand in until those are compiled.

Arguments and results are those of the functions of the same names in module `kernels`.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.grid import SNAP
from engine.numeric.kernel import Array
from engine.numeric.pyramid import expanded_rows

UNIT, COUNT = np.float32(2.0**-16), np.float32(2.0**16)
_ZERO, _ONE, QUARTER = np.float32(0.0), np.float32(1.0), np.float32(0.25)
# A coarse pixel that differs from the mean of its children by no more than this is taken to equal it: the rounding
# lag of many strokes, each below the grid at the coarse level, heals instead of adding up.
LAG = np.float32(2.0 * 2.0**-16)

Span = tuple[int, int, int, int, int]
Extent = tuple[int, int, int, int]
Pair = tuple[Array, Array]
Corner = tuple[int, int]
Window = tuple[int, int, int, int, int, int]


def any_nonzero(data: np.ndarray, first_plane: int, last_plane: int, first: int, last: int) -> bool:
    """Does what the kernel of that name in `kernels` does."""
    return bool(data[first_plane:last_plane, first:last].any())


def clamp_alpha(out: np.ndarray, first: int, last: int) -> None:
    """Does what the kernel of that name in `kernels` does."""
    out[3, first:last] = np.minimum(np.maximum(out[3, first:last], _ZERO), _ONE)


def add_residual(
    out: Array, top: int, left: int, data: Array, row: int, column: int, height: int, width: int, planes: Array
) -> None:
    """Does what the kernel of that name in `kernels` does."""
    for c, source in enumerate(planes.tolist()):
        if source >= 0:
            part = data[source, row : row + height, column : column + width]
            out[c, top : top + height, left : left + width] += part.astype(np.float32) * UNIT


def apply_stamp(
    old: Array, keep: Array, add: Array, planes: Array, plain: bool, spares_alpha: bool, new: Array, changed: Array
) -> Extent:
    """Does what the kernel of that name in `kernels` does."""
    for c, source in enumerate(planes.tolist()):
        if c == 3 and spares_alpha:
            new[c] = old[c]
        else:
            new[c] = (keep * old[c] + SNAP) - SNAP
            if source >= 0:
                new[c] += add[source]
    clamp_alpha(new, 0, new.shape[1])
    changed[...] = keep != _ONE
    if not plain:
        changed |= (old != new).any(axis=0)
    return _extent(changed)


def halve(fine: np.ndarray, planes: np.ndarray, out: np.ndarray, top: int, left: int) -> None:
    """Does what the kernel of that name in `kernels` does."""
    height, width = fine.shape[1] // 2, fine.shape[2] // 2
    for c, source in enumerate(planes.tolist()):
        part = out[c, top : top + height, left : left + width]
        if source < 0:
            part[...] = _ZERO
            continue
        upper, lower = fine[source, 0 : 2 * height : 2], fine[source, 1 : 2 * height : 2]
        total = (upper[:, : 2 * width : 2] + upper[:, 1::2]) + (lower[:, : 2 * width : 2] + lower[:, 1::2])
        part[...] = (total * QUARTER + SNAP) - SNAP


def lower(
    sources: Pair, maps: Pair, keep: Array, changed: Array, window: Window, means: Array, kept: Array, parents: Array
) -> None:
    """Does what the kernel of that name in `kernels` does."""
    row, column, height, width, top, left = window
    inner = slice(row, row + 2 * height), slice(column, column + 2 * width)
    for source, planes, out in zip(sources, maps, means, strict=True):
        halve(source[:, *inner], planes, out, top, left)
    halve(keep[None, *inner], np.zeros(1, np.int64), kept[None], top, left)
    marks = changed[inner] != 0
    rows = marks[::2] | marks[1::2]
    parents[top : top + height, left : left + width] = rows[:, ::2] | rows[:, 1::2]


def climb(
    means: Array,
    keep: Array,
    parents: Array,
    spares: bool,
    around: Array,
    corner: Corner,
    values: Array,
    changed: Array,
) -> Extent:
    """Does what the kernel of that name in `kernels` does."""
    top, left = corner
    old, new = values
    old[...] = around[:, top : top + keep.shape[0], left : left + keep.shape[1]]
    on = parents != 0
    keep[~on] = _ONE
    rest = old - means[0]
    rest[np.abs(rest) <= LAG] = _ZERO
    new[...] = np.where(on, means[1] + ((keep * rest + SNAP) - SNAP), old)
    if spares:
        new[3] = old[3]
    else:
        clamp_alpha(new, 0, new.shape[1])
    changed[...] = (keep != _ONE) + 2 * (new != old).any(axis=0)
    return _extent(changed)


def spread(parents: np.ndarray, top: int, left: int, out: np.ndarray) -> bool:
    """Does what the kernel of that name in `kernels` does."""
    y = np.arange(out.shape[0])
    row, columns = top + 1 + y // 2, slice(left, left + out.shape[1] // 2 + 2)
    both = (parents[row, columns] | parents[row + 2 * (y & 1) - 1, columns]) & 2
    out[:, ::2] |= both[:, 1:-1] | both[:, :-2]
    out[:, 1::2] |= both[:, 1:-1] | both[:, 2:]
    return bool(out.any())


def residual(
    value: Array, start: Corner, predicted: Array, touched: Array, corner: Corner, out: Array, used: Array
) -> tuple[bool, int, int, int, int, int]:
    """Does what the kernel of that name in `kernels` does."""
    (row, column), (top, left) = start, corner
    height, width = touched.shape
    part = out[:, top : top + height, left : left + width]
    there = value[: len(out), row : row + height, column : column + width]
    new = np.where(touched != 0, ((there - predicted) * COUNT).astype(np.int32), part)
    if not (new != part).any():
        return False, 0, 0, 0, 0, 0
    part[...] = new
    return True, *extent(out, used)


def first_residual(
    value: Array, start: Corner, coarse: Array, corner: Corner, planes: Array, touched: Array, out: Array, used: Array
) -> Span:
    """Does what the kernel of that name in `kernels` does."""
    (line, column), (top, left) = start, corner
    height, width = touched.shape
    there = value[:, line : line + height, column : column + width]
    for c, source in enumerate(planes.tolist()):
        predicted = expanded_rows(coarse, top, left, source, 0, height, width) if source >= 0 else _ZERO
        out[c] = np.where(touched != 0, ((there[c] - predicted) * COUNT).astype(np.int32), 0)
    return extent(out, used)


def extent(data: np.ndarray, used: np.ndarray) -> Span:
    """Does what the kernel of that name in `kernels` does."""
    sizes = np.abs(data)
    rows = np.bitwise_or.reduce(sizes, axis=2)
    used[...] = np.bitwise_or.reduce(rows, axis=1)
    return _span(np.bitwise_or.reduce(rows, axis=0), np.bitwise_or.reduce(sizes, axis=(0, 1)))


def _span(rows: np.ndarray, columns: np.ndarray) -> Span:
    """Returns the bits of all rows, and the extent y0, y1, x0, x1 of rows and columns that are not zero."""
    ys, xs = np.flatnonzero(rows), np.flatnonzero(columns)
    bits = int(np.bitwise_or.reduce(rows)) if len(rows) else 0
    y0, y1 = (int(ys[0]), int(ys[-1]) + 1) if len(ys) else (len(rows), 0)
    x0, x1 = (int(xs[0]), int(xs[-1]) + 1) if len(xs) else (len(columns), 0)
    return bits, y0, y1, x0, x1


def _extent(marks: np.ndarray) -> Extent:
    """Returns the extent y0, y1, x0, x1 of what is not zero in `marks`, uint8 (h, w)."""
    used = marks != 0
    return _span(np.atleast_1d(used.any(axis=1)), np.atleast_1d(used.any(axis=0)))[1:]
