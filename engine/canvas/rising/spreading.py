"""Where residuals change: at what changed of a level, and at the children of what moved above; tile by tile."""

from __future__ import annotations

import numpy as np

from engine.canvas.plain import Corner
from engine.canvas.rising.spans import Marks, ends, spans_of
from engine.numeric.address import TILE
from engine.numeric.kernel import Array, inner_uncounted, uncounted
from engine.numeric.stand_in import or_plain

_MOVED = np.uint8(2)
_ANY = np.uint8(1)


def _spread_plainly(parents: Marks, corner: Corner, out: Marks, phase: int) -> None:
    """As `spread`, plainly."""
    (top, left), (marks, spans) = corner, out
    y = np.arange(marks.shape[0])
    row, columns = top + 1 + y // 2, slice(left, left + marks.shape[1] // 2 + 2)
    both = (parents[0][row, columns] | parents[0][row + 2 * (y & 1) - 1, columns]) & _MOVED
    marks[:, ::2] |= both[:, 1:-1] | both[:, :-2]
    marks[:, 1::2] |= both[:, 1:-1] | both[:, 2:]
    for t in range(spans.shape[1]):
        first, last = max(TILE * t - phase, 0), min(TILE * (t + 1) - phase, marks.shape[1])
        found = marks[:, first:last]
        some = np.asarray(found.any(axis=1))
        spans[:, t] = np.where(some[:, None], spans_of(found) + first, 0)
        spans[:, t, 0] &= ~1
        spans[:, t, 1] += spans[:, t, 1] & 1


@or_plain(_spread_plainly)
@uncounted
def spread(parents: Marks, corner: Corner, out: Marks, phase: int) -> None:
    """The marks of `out`, uint8 (2h, 2w), |= 2 where any of the four parents that expand reads has bit 2; the first one
    is a child of parents[0][top + 1, left + 1].

    The spans of `parents` (H, S, 2) hold all its marks; those of `out` (2h, T, 2), one for each tile, hold all that is
    marked before, and then tell the columns of each row with marks, from an even one to an even one; 0, 0 for none.
    `phase`: the column of a tile in which the first pixel lies.
    """
    (top, left), (marks, spans), (moved, where) = corner, out, parents
    n = marks.shape[1] // 2
    for y in range(marks.shape[0]):
        row = top + 1 + y // 2
        other = row + 2 * (y & 1) - 1
        for s in range(where.shape[1]):
            first = max(min(where[row, s, 0], where[other, s, 0]) - 1, left + 1)
            last = min(max(where[row, s, 1], where[other, s, 1]) + 1, left + 1 + n)
            if first < last:
                x = 2 * (first - left - 1)
                _spread_row(moved[row][first - 1 : last + 1], moved[other][first - 1 : last + 1], marks[y][x:])
                _widen(spans[y], x, x + 2 * (last - first), phase)
        for t in range(spans.shape[1]):
            _tighten(marks[y], spans[y, t])


@inner_uncounted
def _spread_row(near: Array, far: Array, out: Array) -> None:
    """A row of `spread`: the children of all parents but the first and the last."""
    for i in range(near.size - 2):
        here = near[i + 1] | far[i + 1]
        out[2 * i] |= (here | near[i] | far[i]) & _MOVED
        out[2 * i + 1] |= (here | near[i + 2] | far[i + 2]) & _MOVED


@inner_uncounted
def _widen(spans: Array, first: int, last: int, phase: int) -> None:
    """Has the spans of the tiles of a row hold some columns."""
    for t in range((first + phase) // TILE, (last - 1 + phase) // TILE + 1):
        edge, span = TILE * t - phase, spans[t]
        begin = edge if edge > first else first
        end = edge + TILE if edge + TILE < last else last
        empty = span[0] >= span[1]
        span[0] = begin if empty or begin < span[0] else span[0]
        span[1] = end if empty or end > span[1] else span[1]


@inner_uncounted
def _tighten(marks: Array, span: Array) -> None:
    """Has a span hold no more than what is marked, from an even column to an even one."""
    begin, found = span[0], np.uint8(0)
    if begin < span[1]:
        row = marks[begin : span[1]]
        for i in range(row.size):
            found |= row[i]
    if not found:
        span[0] = span[1] = 0
        return
    first, last = ends(marks[begin : span[1]], _ANY)
    span[0], span[1] = (begin + first) & ~1, (begin + last + 1) & ~1


def _boxes_plainly(spans: np.ndarray, phase: int, out: np.ndarray) -> None:
    """As `boxes`, plainly."""
    out[...] = 0
    for r, t in np.ndindex(*out.shape[:2]):
        first = max(TILE * r - phase, 0)
        of_tile = spans[first : TILE * (r + 1) - phase, t]
        rows = np.flatnonzero(of_tile[:, 0] < of_tile[:, 1])
        if len(rows):
            filled = of_tile[rows]
            out[r, t] = first + rows[0], first + rows[-1] + 1, filled[:, 0].min(), filled[:, 1].max()


@or_plain(_boxes_plainly)
@uncounted
def boxes(spans: Array, phase: int, out: Array) -> None:
    """out, int32 (R, T, 4) = the extents y0, y1, x0, x1 of spans (h, T, 2) in each tile, 0 where there are none.
    `phase`: the row of a tile in which the first row lies."""
    for r in range(out.shape[0]):
        for t in range(out.shape[1]):
            out[r, t, 0] = out[r, t, 1] = out[r, t, 2] = out[r, t, 3] = 0
    for y in range(spans.shape[0]):
        for t in range(spans.shape[1]):
            first, last = spans[y, t, 0], spans[y, t, 1]
            if first < last:
                box = out[(y + phase) // TILE, t]
                if box[1] == 0:
                    box[0], box[2], box[3] = y, first, last
                box[1], box[2], box[3] = y + 1, min(box[2], first), max(box[3], last)
