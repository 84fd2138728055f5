"""The kernels of module `counting` in NumPy, with the same bits; their arguments and results are the same."""

from __future__ import annotations

import numpy as np

from engine.canvas.plain import Corner, Window
from engine.canvas.rising.spans import Found, Marks, Span, span, within
from engine.numeric.kernel import Array
from engine.numeric.pyramid import expanded_rows
from engine.texture.planes import COLOURS

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)
_EDGES = np.s_[0, :], np.s_[-1, :], np.s_[:, 0], np.s_[:, -1]


def residual(
    value: Array, start: Corner, predicted: Array, touched: Array, corner: Corner, out: Array, used: Array,
    step: np.float32,
) -> tuple[bool, int, int, int, int, int]:  # fmt: skip
    """Does what the kernel of that name in `counting` does."""
    (row, column), (top, left) = start, corner
    height, width = touched.shape
    part = out[:, top : top + height, left : left + width]
    there = value[: len(out), row : row + height, column : column + width]
    new = np.where(touched != 0, _counted(there, predicted, step), part)
    if not (new != part).any():
        return False, 0, 0, 0, 0, 0
    part[...] = new
    return True, *extent(out, used)


def _counted(value: Array | np.float32, predicted: Array | np.float32, step: np.float32) -> np.ndarray:
    with np.errstate(invalid="ignore"):  # what is not touched may be anything
        return np.asarray((value - predicted) * (_ONE / step)).astype(np.int32)


def first_residual(
    value: Array, start: Corner, coarse: Array, corner: Corner, planes: Array, marks: Marks, out: Array, found: Found,
    step: np.float32,
) -> Span:  # fmt: skip
    """Does what the kernel of that name in `counting` does."""
    (line, column), (top, left) = start, corner
    height, width = marks[0].shape
    there = value[:, line : line + height, column : column + width]
    for c, source in enumerate(planes.tolist()):
        predicted = expanded_rows(coarse, top, left, source, 0, height, width, step) if source >= 0 else _ZERO
        out[c] = np.where(marks[0] != 0, _counted(there[c], predicted, step), 0)
    return extent(out, found[0])


def crop(data: Array, spans: Array, planes: Array, corner: Corner, out: Array) -> None:
    """Does what the kernel of that name in `counting` does."""
    top, left = corner
    part = slice(top, top + out.shape[1]), slice(left, left + out.shape[2])
    inside = within(spans, data.shape[2])
    for c, source in enumerate(planes.tolist()):
        out[c] = np.where(inside[part], data[source, *part], 0)


def renew(
    value: Array, start: Corner, coarse: Array, corner: Corner, planes: Array, marks: Marks, window: Window, row: Array,
    out: Array, told: Array, step: np.float32,
) -> tuple[bool, int, bool]:  # fmt: skip
    """Does what the kernel of that name in `counting` does."""
    (line, column), (top, left), (begin, height, tile, down, right, edge) = start, corner, window
    spans = marks[1][begin : begin + height, tile]
    told[...] = np.maximum(spans - np.int32(edge), 0)
    filled = spans[spans[:, 0] < spans[:, 1]]
    if not len(filled):
        return False, 0, _fills(out)
    first, last = int(filled[:, 0].min()), int(filled[:, 1].max())
    rows, columns = slice(begin, begin + height), slice(first, last)
    touched = marks[0][rows, columns] != 0
    there = value[:, line + begin : line + begin + height, column + first : column + last]
    part = out[:, down + begin : down + begin + height, right + first : right + last]
    bits, changed = 0, False
    for c, source in enumerate(planes.tolist()):
        at = top + begin // 2, left + first // 2
        predicted = expanded_rows(coarse, *at, source, 0, height, last - first, step) if source >= 0 else _ZERO
        new = np.where(touched, _counted(there[c], predicted, step), part[c])
        changed |= bool((new != part[c]).any())
        bits |= int(np.bitwise_or.reduce(np.abs(new[touched]), axis=None, initial=0))
        part[c] = new.astype(np.int16)
    return changed, bits, _fills(out)


def _fills(data: np.ndarray) -> bool:
    inks = (data[c : c + 3] for c in range(COLOURS, len(data), 3))
    return all(bool(data[:, *edge].any()) for edge in _EDGES) and all(bool(ink.any()) for ink in inks)


def edges(data: np.ndarray, used: np.ndarray) -> Span:
    """Does what the kernel of that name in `counting` does."""
    return extent(data.astype(np.int32) & 0xFFFF, used)


def extent(data: np.ndarray, used: np.ndarray) -> Span:
    """Does what the kernel of that name in `counting` does."""
    sizes = np.abs(data)
    rows = np.bitwise_or.reduce(sizes, axis=2)
    used[...] = np.bitwise_or.reduce(rows, axis=1)
    return span(np.bitwise_or.reduce(rows, axis=0), np.bitwise_or.reduce(sizes, axis=(0, 1)))
