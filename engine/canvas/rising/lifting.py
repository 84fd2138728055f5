"""Compiled loops of rule U: what a change of a level makes of the next coarser one, only where it does."""

from __future__ import annotations

import numpy as np

from engine.canvas.plain import LAG, QUARTER, Pair, Window
from engine.canvas.rising import plain_lifting as plainly
from engine.canvas.rising.spans import NO_COLUMNS, Lowered, Marks, Means, Spare, ends
from engine.numeric.ahead import ask
from engine.numeric.grid import snap, snap_to
from engine.numeric.kernel import Array, inner_uncounted, uncounted
from engine.numeric.stand_in import or_plain

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


@or_plain(plainly.lower)
@uncounted
def lower(
    sources: Pair, maps: Pair, keep: Array, below: Marks, window: Window, means: Means, out: Lowered, step: np.float32
) -> None:
    """What rule U reads of a changed rectangle, at the resolution of the level above; `step`: of the values' grid.

    `means`: an array (2, C, h, w), which becomes R of the two `sources` (D, H, W), v before and after, and where in the
    level its corner lies; `out`: `kept` becomes R of A, `marks` 1 where a child is marked in `below`, and `spans`
    (h, S, 2) the columns of each row where all these are written.  Plane c comes from `maps[0][c]` and `maps[1][c]`,
    zero for -1.  `window`: the row and column that are read from, the height above, where it is written from, and
    which of the strips that is.
    """
    row, column, height, top, left, place = window
    changed, marked = below
    values, corner = means
    kept, parents, spans = out
    old, new = sources
    shift = left - column // 2
    for y in range(height):
        v = row + 2 * y
        first, last = min(marked[v, 0], marked[v + 1, 0]), max(marked[v, 1], marked[v + 1, 1])
        if first >= last:
            continue
        first, last = first // 2, (last + 1) // 2
        n, x = last - first, first + shift
        spans[top + y, place, 0], spans[top + y, place, 1] = x, x + n
        for c in range(values.shape[1]):
            before, after = values[0, c, top + y - corner[0]], values[1, c, top + y - corner[0]]
            _halve_row(old, maps[0][c], v, first, before[x - corner[1] : x - corner[1] + n], step)
            _halve_row(new, maps[1][c], v, first, after[x - corner[1] : x - corner[1] + n], step)
        _halve_marks(
            (changed[v][2 * first : 2 * last], changed[v + 1][2 * first : 2 * last]),
            (keep[v][2 * first : 2 * last], keep[v + 1][2 * first : 2 * last]),
            parents[top + y][x : x + n],
            kept[top + y][x : x + n],
        )


@inner_uncounted
def _halve_row(fine: np.ndarray, source: int, row: int, first: int, out: np.ndarray, step: np.float32) -> None:
    n = out.size
    if source < 0:
        for i in range(n):
            out[i] = _ZERO
        return
    upper, lower = fine[source, row][2 * first : 2 * (first + n)], fine[source, row + 1][2 * first : 2 * (first + n)]
    _mean_row(upper, lower, out, step)


@inner_uncounted
def _mean_row(upper: Array, lower: Array, out: Array, step: np.float32) -> None:
    """Means of 2 x 2 pixels of two rows."""
    for i in range(out.size):
        out[i] = snap_to(((upper[2 * i] + upper[2 * i + 1]) + (lower[2 * i] + lower[2 * i + 1])) * QUARTER, step)


@inner_uncounted
def _halve_marks(marks: Pair, keep: Pair, parents: Array, kept: Array) -> None:
    """A row of marks, and of A, of two below it."""
    (up, down), (a, b) = marks, keep
    for i in range(parents.size):
        parents[i] = np.uint8((up[2 * i] | up[2 * i + 1] | down[2 * i] | down[2 * i + 1]) != 0)
        kept[i] = snap(((a[2 * i] + a[2 * i + 1]) + (b[2 * i] + b[2 * i + 1])) * QUARTER)


@or_plain(plainly.climb)
@uncounted
def climb(
    means: Means, here: Lowered, values: Array, window: Window, coarser: Means, above: Lowered, spare: Spare,
    spares: bool, step: np.float32, noise: Array,
) -> int:  # fmt: skip
    """Rule U: what a change of the level below does to a part of this one, and `lower` of what that does.

    r = v - R v_below (zero where it is only lag);  v' = R v'_below + A r on parents of changed pixels, v elsewhere, and
    everywhere for alpha if `spares`; A r is rounded to the grid of `step`, with `noise` where that is not empty,
    float32 (h, w).  `means` and `here`: what `lower` made of the level below; `values`: v (C, h, w), which becomes v'.
    `window`: the rows, even ones, and the strips that are worked on; then how far down and to the right what lies above
    a pixel is from half its place; and whether the first strip is the right one of two of the level above, and how far
    to the right that is from half its number.
    Of `here`, `kept` becomes 1 off the parents; `marks` 1 where A != 1, 2 more where v' != v; and `spans` the columns
    of each row in which any is marked.  `coarser` and `above` become what `lower` makes of that.  `spare`: rows that
    are written over, float32 (2, C, n) and uint8 (n,), n as wide as a strip.
    Returns how many pairs of rows are marked, counted in each strip.
    """
    spans = here[2]
    y0, y1, s0, s1 = window[:4]
    count = 0
    for y in range(y0, y1):
        for s in range(s0, s1):
            first, last = spans[y, s, 0], spans[y, s, 1]
            if first < last:
                ask(here[0], 0, y, first, last)
                ask(here[1], 0, y, first, last)
                for c in range(values.shape[0]):
                    ask(values, c, y, first, last)
    for y in range(y0, y1, 2):
        for s in range(s0, s1):
            first = min(spans[y, s, 0], spans[y + 1, s, 0]) & ~1
            last = (max(spans[y, s, 1], spans[y + 1, s, 1]) + 1) & ~1
            if first >= last:
                continue
            for r in range(2):
                _climb_row(means, here, values, (y + r, first, last, s), spare[0][r], spare[1], spares, step, noise)
            top, left = min(spans[y, s, 0], spans[y + 1, s, 0]), max(spans[y, s, 1], spans[y + 1, s, 1])
            if top < left:
                count += 1
                at = y, top // 2, (left + 1) // 2, first
                place = y // 2 + window[4], window[5], ((s + window[6]) >> 1) + window[7]
                _lower_pair(values, here, spare[0], at, place, coarser, above, step)
    return count


@inner_uncounted
def _climb_row(
    means: Means, here: Lowered, values: Array, where: tuple[int, int, int, int], was: Array, moved: Array,
    spares: bool, step: np.float32, noise: Array,
) -> None:  # fmt: skip
    """A row of `climb` in some columns of a strip; `was` (C, n) becomes v."""
    y, first, last, s = where
    (lowered, corner), (kept, marks, spans), n = means, here, last - first
    a, p, m = kept[y][first:last], marks[y][first:last], moved[:n]
    lag = LAG * step
    for i in range(n):
        a[i] = a[i] if p[i] else _ONE
        m[i] = 0
    for c in range(values.shape[0]):
        u, v = values[c, y][first:last], was[c][:n]
        for i in range(n):
            v[i] = u[i]
        if c == 3 and spares:
            continue
        before = lowered[0, c, y - corner[0]][first - corner[1] : last - corner[1]]
        after = lowered[1, c, y - corner[0]][first - corner[1] : last - corner[1]]
        if noise.size:
            d = noise[y][first:last]
            for i in range(n):
                r = v[i] - before[i]
                r = _ZERO if abs(r) <= lag else r
                value = after[i] + snap_to(a[i] * r + d[i], step)
                u[i] = value if p[i] else v[i]
        else:
            for i in range(n):
                r = v[i] - before[i]
                r = _ZERO if abs(r) <= lag else r
                value = after[i] + snap_to(a[i] * r, step)
                u[i] = value if p[i] else v[i]
        if c == 3:
            for i in range(n):
                u[i] = min(max(u[i], _ZERO), _ONE)
        for i in range(n):
            m[i] |= np.uint8(u[i] != v[i])
    _mark_row(p, m, a, first, spans[y, s])


@inner_uncounted
def _mark_row(marks: Array, moved: Array, keep: Array, first: int, span: Array) -> None:
    """The marks of a row of `climb`, where a value changed if `moved`, and the columns, which begin at `first`."""
    found = np.uint8(0)
    for i in range(marks.size):
        marks[i] = np.uint8(2) * moved[i] + np.uint8(keep[i] != _ONE)
        found |= marks[i]
    span[0], span[1] = NO_COLUMNS
    if found:
        start, end = ends(marks, found)
        span[0], span[1] = first + start, first + end


@inner_uncounted
def _lower_pair(
    values: Array, here: Lowered, was: Array, at: tuple[int, int, int, int], place: tuple[int, int, int],
    coarser: Means, above: Lowered, step: np.float32,
) -> None:  # fmt: skip
    """A row of `lower` of two rows that `climb` changed: `at`: the first of them, the columns above, and where `was`
    begins; `place`: the row above, how far to the right its columns lie, and the strip."""
    (y, first, last, start), (row, shift, s) = at, place
    (means, corner), (kept, marks, spans) = coarser, above
    n, x = last - first, first + shift
    span = spans[row, s]
    span[0] = x if x < span[0] else span[0]
    span[1] = x + n if x + n > span[1] else span[1]
    for c in range(values.shape[0]):
        before, after = means[0, c, row - corner[0]], means[1, c, row - corner[0]]
        old = was[0, c][2 * first - start :], was[1, c][2 * first - start :]
        _mean_row(old[0], old[1], before[x - corner[1] : x - corner[1] + n], step)
        new = values[c, y][2 * first : 2 * last], values[c, y + 1][2 * first : 2 * last]
        _mean_row(new[0], new[1], after[x - corner[1] : x - corner[1] + n], step)
    _halve_marks(
        (here[1][y][2 * first : 2 * last], here[1][y + 1][2 * first : 2 * last]),
        (here[0][y][2 * first : 2 * last], here[0][y + 1][2 * first : 2 * last]),
        marks[row][x : x + n],
        kept[row][x : x + n],
    )


@or_plain(plainly.place_changed)
@uncounted
def place_changed(values: Array, planes: Array, spans: Array, out: Array, top: int, left: int) -> None:
    """out[:, top:, left:] = values (D, h, w) in the columns of each row that `spans` (h, 2) tells; plane c takes
    `values[planes[c]]`, zero for -1."""
    for c in range(out.shape[0]):
        source = planes[c]
        for y in range(spans.shape[0]):
            first, last = spans[y, 0], spans[y, 1]
            if first >= last:
                continue
            o = out[c, top + y][left + first : left + last]
            if source < 0:
                for i in range(o.size):
                    o[i] = _ZERO
            else:
                v = values[source, y][first:last]
                for i in range(o.size):
                    o[i] = v[i]
