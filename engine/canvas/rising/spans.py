"""Where anything is marked: columns of rows, and rectangles."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Array, inner_uncounted

Span = tuple[int, int, int, int, int]
Extent = tuple[int, int, int, int]
Marks = tuple[Array, Array]  # uint8 (h, w), and int32 (h, 2): the columns of each row outside which none is marked
Means = tuple[Array, tuple[int, int]]  # (2, C, h, w), and where in the level its first pixel lies
Lowered = tuple[Array, Array, Array]  # A and what is marked (h, w), and spans (h, S, 2) in strips of it
Spare = tuple[Array, Array]  # float32 (2, C, n) and uint8 (n,)
Found = tuple[Array, Array, Array]  # int32: bits of each plane, row and column
NO_COLUMNS = 1 << 30, 0  # columns of a row in which nothing lies
STRIP_WIDTH = 64  # columns of a level that have spans of their own: those above one tile of the next finer level


@inner_uncounted
def ends(marks: np.ndarray, found: np.uint8) -> tuple[int, int]:
    """Returns the first column with a mark, and the one behind the last; (n, 0) if none is `found`."""
    if not found:
        return marks.size, 0
    first, last = 0, marks.size
    while not marks[first]:
        first += 1
    while not marks[last - 1]:
        last -= 1
    return first, last


@inner_uncounted
def spanned(spans: np.ndarray, width: int) -> Extent:
    """Returns the extent y0, y1, x0, x1 of rows' spans, y1 = 0 where all are empty."""
    y0, y1, x0, x1 = spans.shape[0], 0, width, 0
    for y in range(spans.shape[0]):
        if spans[y, 0] < spans[y, 1]:
            y0, y1 = min(y0, y), y + 1
            x0, x1 = min(x0, int(spans[y, 0])), max(x1, int(spans[y, 1]))
    return y0, y1, x0, x1


def spans_of(marks: np.ndarray) -> np.ndarray:
    """Returns the columns of each row outside which nothing is marked: int32 (h, 2), (w, 0) for none."""
    columns = np.arange(marks.shape[1], dtype=np.int32)
    first = np.where(marks != 0, columns, marks.shape[1]).min(axis=1, initial=marks.shape[1])
    last = np.where(marks != 0, columns + 1, 0).max(axis=1, initial=0)
    return np.column_stack([first, last]).astype(np.int32)


def within(spans: np.ndarray, width: int) -> np.ndarray:
    """Returns which of the pixels lie in the columns that spans tell: bool (h, width)."""
    columns = np.arange(width)
    inside: np.ndarray = (columns >= spans[:, :1]) & (columns < spans[:, 1:])
    return inside


def span(rows: np.ndarray, columns: np.ndarray) -> Span:
    """Returns the bits of all rows, and the extent y0, y1, x0, x1 of rows and columns that are not zero."""
    ys, xs = np.flatnonzero(rows), np.flatnonzero(columns)
    bits = int(np.bitwise_or.reduce(rows)) if len(rows) else 0
    y0, y1 = (int(ys[0]), int(ys[-1]) + 1) if len(ys) else (len(rows), 0)
    x0, x1 = (int(xs[0]), int(xs[-1]) + 1) if len(xs) else (len(columns), 0)
    return bits, y0, y1, x0, x1


def extent_of(marks: np.ndarray) -> Extent:
    """Returns the extent y0, y1, x0, x1 of what is not zero in `marks`, uint8 (h, w)."""
    used = marks != 0
    return span(np.atleast_1d(used.any(axis=1)), np.atleast_1d(used.any(axis=0)))[1:]
