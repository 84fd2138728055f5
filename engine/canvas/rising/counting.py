"""Compiled loops that make residuals, in steps of the grid on which the values lie, and measure them."""

from __future__ import annotations

import numpy as np

from engine.canvas.plain import Corner, Window
from engine.canvas.rising import plain_counting as plainly
from engine.canvas.rising.spans import Found, Marks, Span
from engine.numeric.ahead import ask
from engine.numeric.grid import snap_to
from engine.numeric.kernel import Array, inlined, inner_uncounted, kernel, uncounted
from engine.numeric.stand_in import or_plain
from engine.texture.planes import COLOURS

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)
_THREE, _NINE, _SIXTEENTH = np.float32(3.0), np.float32(9.0), np.float32(1.0 / 16.0)


@or_plain(plainly.residual)
@kernel
def residual(
    value: Array, start: Corner, predicted: Array, touched: Array, corner: Corner, out: Array, used: Array,
    step: np.float32,
) -> tuple[bool, int, int, int, int, int]:  # fmt: skip
    """out[:, top:, left:] (int32, in steps) = value - predicted where touched.

    `value` float32 (C, H, W) is read from `start` on; `predicted` float32 (C, h, w), `touched` uint8 (h, w).
    Returns whether that changed `out`, and what `extent` tells of it then; `used` (C,) is written as there.
    """
    (row, column), (top, left) = start, corner
    width = touched.shape[1]
    changed, count = np.int32(0), _ONE / step
    for c in range(out.shape[0]):
        for y in range(touched.shape[0]):
            v, p, t = value[c, row + y][column : column + width], predicted[c, y], touched[y]
            o = out[c, top + y][left : left + width]
            for i in range(width):
                new = np.int32((v[i] - p[i]) * count) if t[i] else o[i]
                changed |= new ^ o[i]
                o[i] = new
    if changed == 0:
        return False, 0, 0, 0, 0, 0
    bits, y0, y1, x0, x1 = _measured(out, used)
    return True, bits, y0, y1, x0, x1


@or_plain(plainly.first_residual)
@uncounted
def first_residual(
    value: Array, start: Corner, coarse: Array, corner: Corner, planes: Array, marks: Marks, out: Array, found: Found,
    step: np.float32,
) -> Span:  # fmt: skip
    """Returns the residual of a tile that had none, and what `extent` tells of it.

    `value` float32 (C, H, W) is read from `start` on; the prediction is expand of `coarse`, placed from `corner` and
    chosen as by `expand_into`; `marks`: `touched` uint8 (2h, 2w), and its `spans` (2h, 2) as `spread` tells them;
    `out` int32 (C, 2h, 2w), in steps, is written in these columns only.  `found`, int32: `used` (C,), which is
    written as by `extent`, rows (2h,) and columns (2w,), which are 0 before.
    """
    (line, column), (top, left) = start, corner
    touched, spans = marks
    used, rows, columns = found
    for c in range(out.shape[0]):
        source, whole = planes[c], np.int32(0)
        for y in range(touched.shape[0]):
            first, last = spans[y, 0], spans[y, 1]
            if first >= last:
                continue
            n = (last - first) // 2
            v, k, o = value[c, line + y][column + first : column + last], touched[y][first:last], out[c, y][first:last]
            _count_row(v, coarse, source, top + 1 + y // 2, 2 * (y & 1) - 1, left + first // 2, o, step)
            edge = columns[first:last]
            bits = np.int32(0)
            for i in range(2 * n):
                new = o[i] if k[i] else np.int32(0)
                o[i] = new
                size = abs(new)
                edge[i] |= size
                bits |= size
            rows[y] |= bits
            whole |= bits
        used[c] = whole
    return _span(rows, columns)


@inner_uncounted
def _count_row(
    v: Array, coarse: Array, source: int, row: int, other: int, left: int, out: Array, step: np.float32
) -> None:
    """out (2n,), int32, = v less expand of rows `row` and `row + other` of a plane of `coarse` from `left` on, none of
    it for -1."""
    n, count = out.size // 2, _ONE / step
    if source < 0:
        for i in range(2 * n):
            out[i] = np.int32(v[i] * count)
        return
    near, far = coarse[source, row][left : left + n + 2], coarse[source, row + other][left : left + n + 2]
    for i in range(n):
        here = _NINE * near[i + 1] + _THREE * far[i + 1]
        even = snap_to((here + (_THREE * near[i] + far[i])) * _SIXTEENTH, step)
        odd = snap_to((here + (_THREE * near[i + 2] + far[i + 2])) * _SIXTEENTH, step)
        out[2 * i] = np.int32((v[2 * i] - even) * count)
        out[2 * i + 1] = np.int32((v[2 * i + 1] - odd) * count)


@or_plain(plainly.crop)
@uncounted
def crop(data: Array, spans: Array, planes: Array, corner: Corner, out: Array) -> None:
    """out (D, h, w) = data from `corner` on, where it lies in the columns of each row that `spans` tells; 0 elsewhere.
    Plane c comes from `data[planes[c]]`."""
    top, left = corner
    width = out.shape[2]
    for c in range(out.shape[0]):
        for y in range(out.shape[1]):
            o = out[c, y]
            first, last = max(spans[top + y, 0] - left, 0), min(spans[top + y, 1] - left, width)
            o[:] = 0
            if first < last:
                d, o = data[planes[c], top + y][left + first : left + last], o[first:last]
                for i in range(o.size):
                    o[i] = d[i]


@or_plain(plainly.renew)
@uncounted
def renew(
    value: Array, start: Corner, coarse: Array, corner: Corner, planes: Array, marks: Marks, window: Window, row: Array,
    out: Array, told: Array, step: np.float32,
) -> tuple[bool, int, bool]:  # fmt: skip
    """As `first_residual` of a tile that has a residual: `out` int16 (C, h, w), which is it, is written where it is
    touched.  Returns whether that changed it; the bits of the absolute values that belong there, not below 2^15 where
    `out` cannot hold them; and whether something lies at each edge of `out`, and of each ink.

    `marks`: `touched` uint8 (H, W), and its spans (H, T, 2); `window`: the rows of these, an even one and how many, and
    which of the spans; where the first pixel of touched[0] lies in `out`, row and column, outside of it perhaps; and
    the column of `touched` from which on `told`, uint8 (h, 2), becomes the spans of these rows.
    The value of that pixel would lie at `start`, and what it is expanded from after `corner`.  `row`, int32 (2w,), is
    written over.
    """
    (line, column), (top, left) = start, corner
    touched, spans = marks
    begin, height, tile, down, right = window[:5]
    bits, changed = np.int32(0), np.int32(0)
    _ask_for(value, start, coarse, corner, spans, window, told)
    for c in range(out.shape[0]):
        for y in range(begin, begin + height):
            first, last = spans[y, tile, 0], spans[y, tile, 1]
            if first >= last:
                continue
            v, k = value[c, line + y][column + first : column + last], touched[y][first:last]
            o, r = out[c, down + y][right + first : right + last], row[: last - first]
            _count_row(v, coarse, planes[c], top + 1 + y // 2, 2 * (y & 1) - 1, left + first // 2, r, step)
            for i in range(r.size):
                old = np.int32(o[i])
                new = r[i] if k[i] else old
                changed |= new ^ old
                bits |= abs(new)
                o[i] = np.int16(new)
    return changed != 0, bits, _fills(out)  # type: ignore[return-value]


@inner_uncounted
def _ask_for(
    value: Array, start: Corner, coarse: Array, corner: Corner, spans: Array, window: Window, told: Array
) -> None:
    """Asks for all that `renew` reads at once, and tells the spans."""
    begin, height, tile, _, _, edge = window
    for y in range(begin, begin + height):
        first, last = spans[y, tile, 0], spans[y, tile, 1]
        told[y - begin, 0], told[y - begin, 1] = max(first - edge, 0), max(last - edge, 0)
        if first >= last:
            continue
        left = corner[1] + first // 2
        for c in range(value.shape[0]):
            ask(value, c, start[0] + y, start[1] + first, start[1] + last)
        if y & 1:
            for c in range(coarse.shape[0]):
                ask(coarse, c, corner[0] + 1 + y // 2, left, left + (last - first) // 2 + 2)


@inner_uncounted
def _fills(data: Array) -> bool:
    """Tells whether something lies in the first and in the last row, in the first and in the last column, and of each
    ink."""
    planes, height, width = data.shape
    for c in range(COLOURS, planes, 3):
        if not _any_in(data[c : c + 3], 0, height, 0, width):
            return False
    return (
        _any_in(data, 0, 1, 0, width)
        and _any_in(data, height - 1, height, 0, width)
        and _any_in(data, 0, height, 0, 1)
        and _any_in(data, 0, height, width - 1, width)
    )


@inner_uncounted
def _any_in(data: Array, y0: int, y1: int, x0: int, x1: int) -> bool:
    """Tells whether anything lies in a rectangle of any plane."""
    for c in range(data.shape[0]):
        for y in range(y0, y1):
            for x in range(x0, x1):
                if data[c, y, x]:
                    return True
    return False


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


@or_plain(plainly.edges)
@kernel
def edges(data: np.ndarray, used: np.ndarray) -> tuple[int, int, int, int, int]:
    """As `extent`, of int16 (C, h, w)."""
    columns, rows = np.zeros(data.shape[2], np.int16), np.zeros(data.shape[1], np.int32)
    for c in range(data.shape[0]):
        found = np.int32(0)
        for y in range(data.shape[1]):
            row = data[c, y]
            bits = np.int16(0)
            for i in range(row.size):
                columns[i] |= row[i]
                bits |= row[i]
            rows[y] |= np.int32(bits) & 0xFFFF
            found |= np.int32(bits) & 0xFFFF
        used[c] = found
    wide = np.empty(columns.size, np.int32)
    for x in range(wide.size):
        wide[x] = np.int32(columns[x]) & 0xFFFF
    return _span(rows, wide)
