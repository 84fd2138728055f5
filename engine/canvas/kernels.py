"""Compiled loops of the canvas: plain functions over planar float32 arrays on the grid."""

from __future__ import annotations

import numpy as np

from engine.canvas import plain as plainly
from engine.canvas.plain import QUARTER, Pair
from engine.canvas.rising.spans import Extent, Marks, ends, spanned
from engine.numeric.grid import snap, snap_to
from engine.numeric.kernel import Array, inner_uncounted, kernel, uncounted
from engine.numeric.stand_in import or_plain

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)
_STEEPEST = np.float32(8.0)  # the residual up to which strokes can amplify detail, again and again


@or_plain(plainly.extent_in_rows)
@kernel
def extent_in_rows(data: np.ndarray, first_plane: int, last_plane: int, first: int, last: int) -> Extent:
    """Returns where values of planes [first_plane, last_plane), rows [first, last) of `data` (C, h, w) are not zero:
    rows and columns from, to; (0, 0, 0, 0) where all are."""
    top, bottom, left, right = last, first, data.shape[2], 0
    for c in range(first_plane, last_plane):
        for y in range(first, last):
            row = data[c, y]
            found = np.int32(0)
            for i in range(row.size):
                found |= np.int32(row[i] != _ZERO)
            if found:
                top, bottom = min(top, y), max(bottom, y + 1)
                x = 0
                while x < left and row[x] == _ZERO:
                    x += 1
                left = min(left, x)
                x = row.size
                while x > right and row[x - 1] == _ZERO:
                    x -= 1
                right = max(right, x)
    return (top, bottom, left, right) if top < bottom else (0, 0, 0, 0)


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
    out: Array, top: int, left: int, data: Array, row: int, column: int, height: int, width: int, planes: Array,
    step: np.float32,
) -> None:  # fmt: skip
    """out[:, top:, left:] += data * step over height x width; plane c comes from `data[planes[c]]`, -1 for none."""
    for c in range(out.shape[0]):
        source = planes[c]
        if source < 0:
            continue
        for y in range(height):
            a = out[c, top + y][left : left + width]
            b = data[source, row + y][column : column + width]
            for i in range(width):
                a[i] += np.float32(b[i]) * step


@kernel
def add_texture(
    out: np.ndarray, amplitudes: np.ndarray, plane: int, detail: np.ndarray, top: int, left: int, step: np.float32
) -> None:
    """Colour of `out` (C, h, w) from row `top` and column `left` += ink * detail, rounded to the grid of `step`;
    `detail` float32 (1 or 3, rows, columns), the ink's planes are those of `amplitudes` from `plane` (it may be `out`
    itself)."""
    right = left + detail.shape[2]
    for c in range(3):
        source = c if detail.shape[0] == 3 else 0
        for y in range(detail.shape[1]):
            a = out[c, top + y, left:right]
            ink = amplitudes[plane + c, top + y, left:right]
            d = detail[source, y]
            for i in range(a.size):
                a[i] += snap_to(ink[i] * d[i], step)


@kernel
def attenuate(data: Array, keep: Array, spares_alpha: bool, out: Array, step: np.float32, noise: Array) -> None:
    """out = data * keep, rounded to whole steps, within +-8 of values; alpha as it is if `spares_alpha`.

    `data` int (C, h, w), `keep` float32 (h, w), `out` int32 (C, h, w); `noise`, float32 (h, w), is added before what
    `keep` weakens is rounded, none where it is empty.
    """
    count = _ONE / step
    for c in range(data.shape[0]):
        spared = spares_alpha and c == 3
        for y in range(data.shape[1]):
            for x in range(data.shape[2]):
                value = np.float32(data[c, y, x]) * step * (_ONE if spared else keep[y, x])
                if noise.size:
                    value += noise[y, x]
                out[c, y, x] = np.int32(min(max(snap_to(value, step), -_STEEPEST), _STEEPEST) * count)


@or_plain(plainly.apply_stamp)
@uncounted
def apply_stamp(
    old: Array, keep: Array, add: Array, colour: Array, planes: Array, plain: bool, spares_alpha: bool, new: Array,
    marks: Marks, step: np.float32, noise: Array,
) -> Extent:  # fmt: skip
    """v' = snap(A v) + B over one tile, alpha clamped to [0, 1], or as it is if `spares_alpha`; where there is `noise`,
    float32 (n, n), v' = A v + B + noise, rounded to the grid of `step`.

    Writes `new` (C, n, n) and `marks`: `changed` (n, n) uint8, 1 where A != 1 or v' != v, and `spans` (n, 2) int32,
    the columns of each row in which any is marked.  Returns the extent y0, y1, x0, x1 of what is marked, y1 = 0 where
    nothing is.

    `keep` is A (n, n), `add` is B (D, n, n); plane c takes `add[planes[c]]`, zero for -1; where there is a `colour`
    (3,), B is as `coat.lay` makes it of that and A.  `plain`: B is 0 wherever A is 1, so that v' is v there.
    """
    changed, spans = marks
    n = keep.shape[1]
    for y in range(keep.shape[0]):
        a, s = keep[y], changed[y]
        found = np.uint8(0)
        for i in range(n):
            s[i] = np.uint8(a[i] != _ONE)
            found |= s[i]
        first, last = ends(s, found) if plain else (0, n)
        for c in range(old.shape[0]):
            before, after = old[c, y], new[c, y]
            for i in range(n):
                after[i] = before[i]
            if first < last and not (c == 3 and spares_alpha):
                where = planes[c], y, first
                _stamp_row(a[first:last], before[first:last], (add, colour), where, noise, step, after[first:last])
            if c == 3 and not spares_alpha:
                for i in range(n):
                    after[i] = min(max(after[i], _ZERO), _ONE)
            if not plain:
                for i in range(n):
                    s[i] |= np.uint8(before[i] != after[i])
                    found |= s[i]
        if not plain:
            first, last = ends(s, found)
        spans[y, 0], spans[y, 1] = first, last
    return spanned(spans, n)


@inner_uncounted
def _wash_row(
    a: Array, before: Array, colour: Array, where: tuple[int, int, int], noise: Array, step: np.float32, after: Array
) -> None:
    """As `_stamp_row`, of one colour."""
    plane, y, first = where
    if noise.size:
        d = noise[y, first : first + a.size]
        for i in range(a.size):
            m = _ONE - a[i]
            b = m if plane == 3 else snap(m * colour[plane])
            after[i] = snap_to((a[i] * before[i] + b) + d[i], step)
    elif plane == 3:
        for i in range(a.size):
            after[i] = snap(a[i] * before[i]) + (_ONE - a[i])
    else:
        value = colour[plane]
        for i in range(a.size):
            after[i] = snap(a[i] * before[i]) + snap((_ONE - a[i]) * value)


@inner_uncounted
def _stamp_row(
    a: Array, before: Array, paint: Pair, where: tuple[int, int, int], noise: Array, step: np.float32, after: Array
) -> None:
    """A row of `apply_stamp` from a column on; `paint`: B, or a colour; `where`: the plane of B, -1 for none, the row
    and the column."""
    (source, y, first), (add, colour) = where, paint
    if colour.size and source >= 0:
        _wash_row(a, before, colour, where, noise, step, after)
    elif noise.size:
        _stamp_row_coarsely(a, before, add, where, noise[y, first : first + a.size], step, after)
    elif source < 0:
        for i in range(a.size):
            after[i] = snap(a[i] * before[i])
    else:
        b = add[source, y][first : first + a.size]
        for i in range(a.size):
            after[i] = snap(a[i] * before[i]) + b[i]


@inner_uncounted
def _stamp_row_coarsely(
    a: Array, before: Array, add: Array, where: tuple[int, int, int], noise: Array, step: np.float32, after: Array
) -> None:
    """As `_stamp_row`, rounded once, with a row of noise."""
    source, y, first = where
    if source < 0:
        for i in range(a.size):
            after[i] = snap_to(a[i] * before[i] + noise[i], step)
    else:
        b = add[source, y][first : first + a.size]
        for i in range(a.size):
            after[i] = snap_to((a[i] * before[i] + b[i]) + noise[i], step)


@or_plain(plainly.halve)
@kernel
def halve(fine: np.ndarray, planes: np.ndarray, out: np.ndarray, top: int, left: int, step: np.float32) -> None:
    """out[:, top:, left:] = means of 2 x 2 pixels of `fine` (D, 2h, 2w), rounded to the grid of `step`; plane c takes
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
                row[i] = snap_to(total * QUARTER, step)
