"""Compiled loops of the canvas: plain functions over planar float32 arrays on the grid."""

from __future__ import annotations

import numpy as np

from engine.canvas import plain as plainly
from engine.canvas.plain import COUNT, LAG, QUARTER, UNIT, Corner, Pair, Window
from engine.numeric.grid import snap
from engine.numeric.kernel import Array, inlined, inner, kernel
from engine.numeric.pyramid import blend_rows, expand_row
from engine.numeric.stand_in import or_plain

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)
_MOVED = np.uint8(2)
_STEEPEST = np.float32(8.0)  # the residual up to which strokes can amplify detail, again and again


@or_plain(plainly.any_nonzero)
@kernel
def any_nonzero(data: np.ndarray, first_plane: int, last_plane: int, first: int, last: int) -> bool:
    """Tells whether any value of planes [first_plane, last_plane), rows [first, last) of `data` (C, h, w) is not
    zero."""
    for c in range(first_plane, last_plane):
        for y in range(first, last):
            row = data[c, y]
            found = np.int32(0)
            for i in range(row.size):
                found |= np.int32(row[i] != _ZERO)
            if found:
                return True
    return False


@or_plain(plainly.clamp_alpha)
@kernel
def clamp_alpha(out: np.ndarray, first: int, last: int) -> None:
    """Alpha of rows [first, last) of `out` (C, h, w) into [0, 1], in place."""
    for y in range(first, last):
        row = out[3, y]
        for i in range(row.size):
            row[i] = min(max(row[i], _ZERO), _ONE)


@or_plain(plainly.add_residual)
@kernel
def add_residual(
    out: Array, top: int, left: int, data: Array, row: int, column: int, height: int, width: int, planes: Array
) -> None:
    """out[:, top:, left:] += data * 2^-16 over height x width; plane c comes from `data[planes[c]]`, -1 for none."""
    for c in range(out.shape[0]):
        source = planes[c]
        if source < 0:
            continue
        for y in range(height):
            a = out[c, top + y][left : left + width]
            b = data[source, row + y][column : column + width]
            for i in range(width):
                a[i] += np.float32(b[i]) * UNIT


@kernel
def add_texture(out: np.ndarray, amplitudes: np.ndarray, plane: int, detail: np.ndarray, first: int) -> None:
    """Colour rows of `out` (C, h, w) from row `first` += snap(ink * detail); `detail` float32 (1 or 3, rows, w), the
    ink's planes are those of `amplitudes` from `plane` (it may be `out` itself)."""
    for c in range(3):
        source = c if detail.shape[0] == 3 else 0
        for y in range(detail.shape[1]):
            a = out[c, first + y]
            ink = amplitudes[plane + c, first + y]
            d = detail[source, y]
            for i in range(a.size):
                a[i] += snap(ink[i] * d[i])


@kernel
def attenuate(data: np.ndarray, keep: np.ndarray, spares_alpha: bool, out: np.ndarray) -> None:
    """out = snap(data * keep), within +-8, in units of 2^-16; alpha as it is if `spares_alpha`.

    `data` int (C, h, w), `keep` float32 (h, w), `out` int32 (C, h, w).
    """
    for c in range(data.shape[0]):
        spared = spares_alpha and c == 3
        for y in range(data.shape[1]):
            for x in range(data.shape[2]):
                value = snap(np.float32(data[c, y, x]) * UNIT * (_ONE if spared else keep[y, x]))
                out[c, y, x] = np.int32(min(max(value, -_STEEPEST), _STEEPEST) * COUNT)


@or_plain(plainly.apply_stamp)
@kernel
def apply_stamp(
    old: Array, keep: Array, add: Array, planes: Array, plain: bool, spares_alpha: bool, new: Array, changed: Array
) -> tuple[int, int, int, int]:
    """v' = snap(A v) + B over one tile, alpha clamped to [0, 1], or as it is if `spares_alpha`.

    Writes `new` (C, n, n) and `changed` (n, n) uint8, 1 where A != 1 or v' != v.  Returns the extent y0, y1, x0, x1
    of what is marked, y1 = 0 where nothing is.

    `keep` is A (n, n), `add` is B (D, n, n); plane c takes `add[planes[c]]`, zero for -1.  `plain`: B is 0 wherever A
    is 1, so that v' need not be compared with v.
    """
    for c in range(old.shape[0]):
        source = planes[c]
        for y in range(keep.shape[0]):
            a, before, after = keep[y], old[c, y], new[c, y]
            if c == 3 and spares_alpha:
                for i in range(a.size):
                    after[i] = before[i]
            elif source < 0:
                for i in range(a.size):
                    after[i] = snap(a[i] * before[i])
            else:
                b = add[source, y]
                for i in range(a.size):
                    after[i] = snap(a[i] * before[i]) + b[i]
            if c == 3:
                for i in range(a.size):
                    after[i] = min(max(after[i], _ZERO), _ONE)
    return _mark(old, keep, plain, new, changed)


@inner
def _mark(
    old: np.ndarray, keep: np.ndarray, plain: bool, new: np.ndarray, changed: np.ndarray
) -> tuple[int, int, int, int]:
    """`changed` of `apply_stamp`, and its extent."""
    marks, columns = np.empty(keep.shape[1], np.int32), np.zeros(keep.shape[1], np.int32)
    rows = np.zeros(keep.shape[0], np.int32)
    for y in range(keep.shape[0]):
        a, s = keep[y], changed[y]
        for i in range(a.size):
            marks[i] = np.int32(a[i] != _ONE)
        if not plain:
            for c in range(old.shape[0]):
                before, after = old[c, y], new[c, y]
                for i in range(a.size):
                    marks[i] |= np.int32(before[i] != after[i])
        rows[y] = _noted(marks, columns, s)
    _, y0, y1, x0, x1 = _span(rows, columns)
    return y0, y1, x0, x1


@inner
def _noted(marks: np.ndarray, columns: np.ndarray, out: np.ndarray) -> np.int32:
    """Writes a row of marks into `out`, and into `columns` what any row has; returns what any of its pixels has."""
    found = np.int32(0)
    for i in range(marks.size):
        found |= marks[i]
        columns[i] |= marks[i]
        out[i] = np.uint8(marks[i])
    return found


@or_plain(plainly.halve)
@kernel
def halve(fine: np.ndarray, planes: np.ndarray, out: np.ndarray, top: int, left: int) -> None:
    """out[:, top:, left:] = snapped means of 2 x 2 pixels of `fine` (D, 2h, 2w); plane c of `out` takes
    `fine[planes[c]]`, zero for -1."""
    height, width = fine.shape[1] // 2, fine.shape[2] // 2
    for c in range(out.shape[0]):
        source = planes[c]
        for y in range(height):
            row = out[c, top + y][left : left + width]
            if source < 0:
                row[:] = _ZERO
                continue
            upper, lower = fine[source, 2 * y], fine[source, 2 * y + 1]
            for i in range(width):
                total = (upper[2 * i] + upper[2 * i + 1]) + (lower[2 * i] + lower[2 * i + 1])
                row[i] = snap(total * QUARTER)


@or_plain(plainly.lower)
@kernel
def lower(
    sources: Pair, maps: Pair, keep: Array, changed: Array, window: Window, means: Array, kept: Array, parents: Array
) -> None:
    """What rule U reads of a changed rectangle, at the resolution of the level above.

    means[0] and means[1] (2, C, h, w) become R of the two `sources` (D, H, W), v before and after; `kept` becomes R of
    A, and `parents` 1 where a child is marked in `changed`.  Plane c comes from `maps[0][c]` and `maps[1][c]`, zero for
    -1.  `window`: the row and column that are read from, the height and width above, and where it is written from.
    """
    row, column, height, width, top, left = window
    old, new = sources
    for c in range(means.shape[1]):
        _halve_window(old, maps[0][c], window, means[0, c])
        _halve_window(new, maps[1][c], window, means[1, c])
    for y in range(height):
        upper, lower = changed[row + 2 * y][column:], changed[row + 2 * y + 1][column:]
        a, b = keep[row + 2 * y][column:], keep[row + 2 * y + 1][column:]
        p, k = parents[top + y][left : left + width], kept[top + y][left : left + width]
        for i in range(width):
            p[i] = np.uint8((upper[2 * i] | upper[2 * i + 1] | lower[2 * i] | lower[2 * i + 1]) != 0)
            k[i] = snap(((a[2 * i] + a[2 * i + 1]) + (b[2 * i] + b[2 * i + 1])) * QUARTER)


@inner
def _halve_window(fine: np.ndarray, source: int, window: Window, out: np.ndarray) -> None:
    row, column, height, width, top, left = window
    for y in range(height):
        o = out[top + y][left : left + width]
        if source < 0:
            o[:] = _ZERO
            continue
        upper, lower = fine[source, row + 2 * y][column:], fine[source, row + 2 * y + 1][column:]
        for i in range(width):
            o[i] = snap(((upper[2 * i] + upper[2 * i + 1]) + (lower[2 * i] + lower[2 * i + 1])) * QUARTER)


@or_plain(plainly.climb)
@kernel
def climb(
    means: Array,
    keep: Array,
    parents: Array,
    spares: bool,
    around: Array,
    corner: Corner,
    values: Array,
    changed: Array,
) -> tuple[int, int, int, int]:
    """Rule U: what a change of the level below does to this one.

    r = v - R v_below (zero where it is only lag);  v' = R v'_below + snap(A r) on `parents` of changed pixels, v
    elsewhere, and everywhere for alpha if `spares`.  `means` (2, C, h, w) is R of the level below before and
    after; v is read of `around` (C, H, W) from `corner` on.  Written are `values` (2, C, h, w), v and v'; `changed`,
    uint8 (h, w): 1 where A != 1, 2 more where v' != v; and `keep`, A (h, w), is set to 1 off `parents`.
    Returns the extent y0, y1, x0, x1 of what is marked, y1 = 0 where nothing is.
    """
    width = keep.shape[1]
    marks, columns = np.empty(width, np.int32), np.zeros(width, np.int32)
    rows = np.zeros(keep.shape[0], np.int32)
    for y in range(keep.shape[0]):
        a, p, s = keep[y], parents[y], changed[y]
        for i in range(width):
            a[i] = a[i] if p[i] else _ONE
            marks[i] = np.int32(0)
        for c in range(values.shape[1]):
            v, w, u = values[0, c, y], values[1, c, y], around[c, corner[0] + y][corner[1] : corner[1] + width]
            before, after = means[0, c, y], means[1, c, y]
            for i in range(width):
                v[i] = u[i]
            if c == 3 and spares:
                for i in range(width):
                    w[i] = v[i]
                continue
            for i in range(width):
                r = v[i] - before[i]
                r = _ZERO if abs(r) <= LAG else r
                value = after[i] + snap(a[i] * r)
                w[i] = value if p[i] else v[i]
            if c == 3:
                for i in range(width):
                    w[i] = min(max(w[i], _ZERO), _ONE)
            for i in range(width):
                marks[i] |= np.int32(w[i] != v[i])
        for i in range(width):
            marks[i] = 2 * marks[i] + np.int32(a[i] != _ONE)
        rows[y] = _noted(marks, columns, s)
    _, y0, y1, x0, x1 = _span(rows, columns)
    return y0, y1, x0, x1


@or_plain(plainly.spread)
@kernel
def spread(parents: np.ndarray, top: int, left: int, out: np.ndarray) -> bool:
    """out (2h, 2w) |= 2 where any of the four parents that expand reads has bit 2; out[0, 0] is the first child of
    parents[top + 1, left + 1].  Returns whether any entry of `out` is set."""
    n = out.shape[1] // 2
    both = np.empty(n + 2, np.uint8)
    found = np.uint8(0)
    for y in range(out.shape[0]):
        row = top + 1 + y // 2
        near, far = parents[row][left : left + n + 2], parents[row + 2 * (y & 1) - 1][left : left + n + 2]
        for i in range(n + 2):
            both[i] = (near[i] | far[i]) & _MOVED
        s = out[y]
        before, here, after = both[0:n], both[1 : n + 1], both[2 : n + 2]
        for i in range(n):
            s[2 * i] |= here[i] | before[i]
            s[2 * i + 1] |= here[i] | after[i]
        for i in range(s.size):
            found |= s[i]
    return found != 0  # type: ignore[no-any-return]


@or_plain(plainly.residual)
@kernel
def residual(
    value: Array, start: Corner, predicted: Array, touched: Array, corner: Corner, out: Array, used: Array
) -> tuple[bool, int, int, int, int, int]:
    """out[:, top:, left:] (int32, units of 2^-16) = value - predicted where touched.

    `value` float32 (C, H, W) is read from `start` on; `predicted` float32 (C, h, w), `touched` uint8 (h, w).
    Returns whether that changed `out`, and what `extent` tells of it then; `used` (C,) is written as there.
    """
    (row, column), (top, left) = start, corner
    width = touched.shape[1]
    changed = np.int32(0)
    for c in range(out.shape[0]):
        for y in range(touched.shape[0]):
            v, p, t = value[c, row + y][column : column + width], predicted[c, y], touched[y]
            o = out[c, top + y][left : left + width]
            for i in range(width):
                new = np.int32((v[i] - p[i]) * COUNT) if t[i] else o[i]
                changed |= new ^ o[i]
                o[i] = new
    if changed == 0:
        return False, 0, 0, 0, 0, 0
    bits, y0, y1, x0, x1 = _measured(out, used)
    return True, bits, y0, y1, x0, x1


@or_plain(plainly.first_residual)
@kernel
def first_residual(
    value: Array, start: Corner, coarse: Array, corner: Corner, planes: Array, touched: Array, out: Array, used: Array
) -> tuple[int, int, int, int, int]:
    """Returns the residual of a tile that had none, and what `extent` tells of it.

    `value` float32 (C, H, W) is read from `start` on; the prediction is expand of `coarse`, placed from `corner` and
    chosen as by `expand_into`; `touched` uint8 (2h, 2w); `out` int32 (C, 2h, 2w) in units of 2^-16 is written
    everywhere, `used` (C,) as by `extent`.
    """
    (line, column), (top, left) = start, corner
    n = touched.shape[1] // 2
    t, predicted = np.empty(n + 2, np.float32), np.zeros(2 * n, np.float32)
    columns, rows = np.zeros(2 * n, np.int32), np.zeros(touched.shape[0], np.int32)
    for c in range(out.shape[0]):
        source, found = planes[c], np.int32(0)
        if source < 0:
            predicted[:] = _ZERO
        for y in range(touched.shape[0]):
            if source >= 0:
                row = top + 1 + y // 2
                near = coarse[source, row][left : left + n + 2]
                far = coarse[source, row + 2 * (y & 1) - 1][left : left + n + 2]
                blend_rows(near, far, t)
                expand_row(t, predicted)
            v, k, o = value[c, line + y][column : column + 2 * n], touched[y], out[c, y]
            bits = np.int32(0)
            for i in range(2 * n):
                new = np.int32((v[i] - predicted[i]) * COUNT)
                new = new if k[i] else np.int32(0)
                o[i] = new
                size = abs(new)
                columns[i] |= size
                bits |= size
            rows[y] |= bits
            found |= bits
        used[c] = found
    return _span(rows, columns)


@or_plain(plainly.extent)
@kernel
def extent(data: np.ndarray, used: np.ndarray) -> tuple[int, int, int, int, int]:
    """Of int32 (C, h, w): the bits of all absolute values, and the extent y0, y1, x0, x1 of what is not zero.

    `used`, int32 (C,), gets the bits of each plane.
    """
    return _measured(data, used)


@inlined
def _measured(data: np.ndarray, used: np.ndarray) -> tuple[int, int, int, int, int]:
    columns, rows = np.zeros(data.shape[2], np.int32), np.zeros(data.shape[1], np.int32)
    for c in range(data.shape[0]):
        found = np.int32(0)
        for y in range(data.shape[1]):
            row = data[c, y]
            bits = np.int32(0)
            for i in range(row.size):
                size = abs(row[i])
                columns[i] |= size
                bits |= size
            rows[y] |= bits
            found |= bits
        used[c] = found
    return _span(rows, columns)


@inlined
def _span(rows: np.ndarray, columns: np.ndarray) -> tuple[int, int, int, int, int]:
    bits = np.int32(0)
    y0, y1, x0, x1 = rows.size, 0, columns.size, 0
    for y in range(rows.size):
        if rows[y]:
            y0, y1 = min(y0, y), y + 1
            bits |= rows[y]
    for x in range(columns.size):
        if columns[x]:
            x0, x1 = min(x0, x), x + 1
    return bits, y0, y1, x0, x1  # type: ignore[return-value]
