"""Compiled loops of rule U: what a change of a level makes of the next coarser one, only where it does."""

from __future__ import annotations

import numpy as np

from engine.canvas.plain import LAG, QUARTER, Corner, Pair, Window
from engine.canvas.rising import plain_lifting as plainly
from engine.canvas.rising.spans import Extent, Lowered, Marks, ends, spanned
from engine.numeric.grid import snap, snap_to
from engine.numeric.kernel import Array, inner_uncounted, uncounted
from engine.numeric.stand_in import or_plain

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)
_MOVED = np.uint8(2)


@or_plain(plainly.lower)
@uncounted
def lower(
    sources: Pair, maps: Pair, keep: Array, below: Marks, window: Window, lowered: Lowered, step: np.float32
) -> None:
    """What rule U reads of a changed rectangle, at the resolution of the level above; `step`: of the values' grid.

    `lowered`: means[0] and means[1] (2, C, h, w) become R of the two `sources` (D, H, W), v before and after; `kept`
    becomes R of A, `parents` 1 where a child is marked in `below`, and `spans` the columns of each row where all these
    are written.  Plane c comes from `maps[0][c]` and `maps[1][c]`, zero for -1.  `window`: the row and column that are
    read from, the height and width above, and where it is written from.
    """
    row, column, height, _, top, left = window
    changed, marked = below
    means, kept, parents, spans = lowered
    old, new = sources
    shift = left - column // 2
    for y in range(height):
        v = row + 2 * y
        first, last = min(marked[v, 0], marked[v + 1, 0]), max(marked[v, 1], marked[v + 1, 1])
        if first >= last:
            continue
        first, last = first // 2, (last + 1) // 2
        n, x = last - first, first + shift
        span = spans[top + y]
        span[0], span[1] = (x, x + n) if span[0] >= span[1] else (min(span[0], x), max(span[1], x + n))
        for c in range(means.shape[1]):
            _halve_row(old, maps[0][c], v, first, means[0, c, top + y][x : x + n], step)
            _halve_row(new, maps[1][c], v, first, means[1, c, top + y][x : x + n], step)
        up, down = changed[v][2 * first : 2 * last], changed[v + 1][2 * first : 2 * last]
        a, b = keep[v][2 * first : 2 * last], keep[v + 1][2 * first : 2 * last]
        p, k = parents[top + y][x : x + n], kept[top + y][x : x + n]
        for i in range(n):
            p[i] = np.uint8((up[2 * i] | up[2 * i + 1] | down[2 * i] | down[2 * i + 1]) != 0)
            k[i] = snap(((a[2 * i] + a[2 * i + 1]) + (b[2 * i] + b[2 * i + 1])) * QUARTER)


@inner_uncounted
def _halve_row(fine: np.ndarray, source: int, row: int, first: int, out: np.ndarray, step: np.float32) -> None:
    n = out.size
    if source < 0:
        for i in range(n):
            out[i] = _ZERO
        return
    upper, lower = fine[source, row][2 * first : 2 * (first + n)], fine[source, row + 1][2 * first : 2 * (first + n)]
    for i in range(n):
        out[i] = snap_to(((upper[2 * i] + upper[2 * i + 1]) + (lower[2 * i] + lower[2 * i + 1])) * QUARTER, step)


@or_plain(plainly.climb)
@uncounted
def climb(
    lowered: Lowered, spares: bool, around: Array, corner: Corner, values: Array, marks: Marks, step: np.float32,
    noise: Array,
) -> Extent:  # fmt: skip
    """Rule U: what a change of the level below does to this one.

    r = v - R v_below (zero where it is only lag);  v' = R v'_below + A r on `parents` of changed pixels, v elsewhere,
    and everywhere for alpha if `spares`; A r is rounded to the grid of `step`, with `noise` where that is not empty,
    float32 (h, w).  `lowered`: what `lower` made of the level below; v is read of `around` (C, H, W) from `corner` on.
    Written are `values` (2, C, h, w), v and v', and A, 1 off `parents`: in each pair of rows only in the columns where
    any of both is lowered, from an even one to an even one.
    `marks`: `changed`, uint8 (h, w), becomes 1 where A != 1, 2 more where v' != v; it is 0 before; and `spans` (h, 2)
    the columns of each row in which any is marked.
    Returns the extent y0, y1, x0, x1 of what is marked, y1 = 0 where nothing is.
    """
    means, keep, parents, written = lowered
    changed, spans = marks
    for y in range(keep.shape[0]):
        pair = y & ~1
        first = min(written[pair, 0], written[pair + 1, 0]) & ~1
        last = (max(written[pair, 1], written[pair + 1, 1]) + 1) & ~1
        spans[y, 0], spans[y, 1] = keep.shape[1], 0
        if first >= last:
            continue
        n = last - first
        a, p, m = keep[y][first:last], parents[y][first:last], changed[y][first:last]
        for i in range(n):
            a[i] = a[i] if p[i] else _ONE
        for c in range(values.shape[1]):
            u = around[c, corner[0] + y][corner[1] + first : corner[1] + last]
            v, w = values[0, c, y][first:last], values[1, c, y][first:last]
            before, after = means[0, c, y][first:last], means[1, c, y][first:last]
            if c == 3 and spares:
                for i in range(n):
                    v[i] = w[i] = u[i]
                continue
            _lift_row(u, (before, after), (a, p), (v, w), step, noise, (y, first))
            if c == 3:
                for i in range(n):
                    w[i] = min(max(w[i], _ZERO), _ONE)
            for i in range(n):
                m[i] |= np.uint8(w[i] != v[i])
        _mark_row(m, a, first, spans[y])
    return spanned(spans, keep.shape[1])


@inner_uncounted
def _lift_row(u: Array, means: Pair, where: Pair, out: Pair, step: np.float32, noise: Array, at: Corner) -> None:
    """A row of `climb` from a place on: v and v' of u, the old values, where A and `parents` are those of `where`."""
    (before, after), (a, p), (v, w), lag = means, where, out, LAG * step
    if noise.size:
        d = noise[at[0], at[1] : at[1] + u.size]
        for i in range(u.size):
            r = u[i] - before[i]
            r = _ZERO if abs(r) <= lag else r
            value = after[i] + snap_to(a[i] * r + d[i], step)
            v[i] = u[i]
            w[i] = value if p[i] else u[i]
        return
    for i in range(u.size):
        r = u[i] - before[i]
        r = _ZERO if abs(r) <= lag else r
        value = after[i] + snap_to(a[i] * r, step)
        v[i] = u[i]
        w[i] = value if p[i] else u[i]


@inner_uncounted
def _mark_row(marks: Array, keep: Array, first: int, span: Array) -> None:
    """The marks of a row of `climb`, 1 where a value changed before, and the columns, which begin at `first`."""
    found = np.uint8(0)
    for i in range(marks.size):
        marks[i] = np.uint8(2) * marks[i] + np.uint8(keep[i] != _ONE)
        found |= marks[i]
    if found:
        start, end = ends(marks, found)
        span[0], span[1] = first + start, first + end


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


@or_plain(plainly.spread)
@uncounted
def spread(parents: np.ndarray, top: int, left: int, out: np.ndarray, spans: np.ndarray) -> bool:
    """out (2h, 2w) |= 2 where any of the four parents that expand reads has bit 2; out[0, 0] is the first child of
    parents[top + 1, left + 1].  `spans` (2h, 2) gets the columns of each row in which any is set, from an even one to
    an even one.  Returns whether any is."""
    n = out.shape[1] // 2
    any_found = np.uint8(0)
    for y in range(out.shape[0]):
        row = top + 1 + y // 2
        near, far = parents[row][left : left + n + 2], parents[row + 2 * (y & 1) - 1][left : left + n + 2]
        s = out[y]
        found = np.uint8(0)
        for i in range(n):
            here = near[i + 1] | far[i + 1]
            even, odd = s[2 * i], s[2 * i + 1]
            even |= (here | near[i] | far[i]) & _MOVED
            odd |= (here | near[i + 2] | far[i + 2]) & _MOVED
            s[2 * i], s[2 * i + 1] = even, odd
            found |= even | odd
        first, last = ends(s, found)
        spans[y, 0], spans[y, 1] = first & ~1, (last + 1) & ~1
        any_found |= found
    return any_found != 0  # type: ignore[no-any-return]
