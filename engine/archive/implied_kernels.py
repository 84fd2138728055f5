"""Compiled loops of what ink implies of colour (engine/archive/implied.py).

A tile, w x h, is its residuals `data`, int16 or int32 (4 + 3m, h, w) in units of `step`, the grid's, on the expanded
`parents`, float32 (C, H, W).  `place`, int64 (4,): the row and the column of `parents` above and left of the first
pixel's parent, and 1 where the tile begins on an odd row, on an odd column.  `sources` and `own`, int64 (n,): where the
amplitudes of each ink begin in `parents` and in `data`, -1 for nowhere.  `seen` is float32 (n, 1 or 3, H', W'), the
tile's first pixel at `start`, int64 (2,); `factors`, float32 (3, 1 + 2n), are p, then q and s of each ink; `detail`,
float32 (n or 0, 1 or 3, h, w), is what texture adds at this level of itself, all zero for inks of this level and
coarser ones.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.grid import snap_to
from engine.numeric.kernel import Array, Int, Real, inner, kernel
from engine.numeric.pyramid import blend_rows, expand_row

_ONE = np.float32(1.0)
_THREE = np.float32(3.0)
_ALPHA = np.int64(3)  # no plain 3: numba would compile what it is given to once more, for that number alone
_SIXTEENTH = np.float32(1.0 / 16.0)
_FAR = 21  # bits of what is implied, in steps: snap_to holds below 22
_RIDGE = 1e-10  # of the normal equations' trace: of terms that do the same, both get a part


@kernel
def lies(values: np.ndarray, plane: Int, top: Int, left: Int, height: Int, width: Int) -> bool:
    """Tells whether any of three planes from `plane` on is not zero on a rectangle."""
    for c in range(3):
        for y in range(height):
            row = values[plane + c, top + y][left : left + width]
            found = np.int32(0)
            for i in range(width):
                found |= np.int32(row[i] != np.float32(0.0))
            if found:
                return True
    return False


@inner
def _expanded(
    flat: Array, height: Int, width: Int, plane: Int, place: Array, y: Int, t: Array, line: Array, step: np.float32
) -> None:
    """Writes row `y` of a plane of the expanded parents, from the even column on; `flat`, all parents of height x
    width.

    (Views of one-dimensional arrays cost least: a row is no more work than it takes to cut it out.)
    """
    if plane < 0:
        line[:] = np.float32(0.0)
        return
    even = y + place[2]
    near = (plane * height + place[0] + 1 + even // 2) * width + place[1]
    far = near + (2 * (even & 1) - 1) * width
    blend_rows(flat[near : near + t.size], flat[far : far + t.size], t)
    expand_row(t, line, step)


@inner
def _refined(line: np.ndarray, flat: np.ndarray, height: Int, plane: Int, y: Int, step: np.float32) -> None:
    """line += row `y` of a plane of residuals, if there is one; `flat`, all planes of `height` rows."""
    if plane >= 0:
        start = (plane * height + y) * line.size
        d = flat[start : start + line.size]
        for i in range(line.size):
            line[i] += np.float32(d[i]) * step


@inner
def _clamped(line: np.ndarray) -> None:
    for i in range(line.size):
        line[i] = min(max(line[i], np.float32(0.0)), np.float32(1.0))


@kernel
def _textured(line: np.ndarray, amplitude: np.ndarray, detail: np.ndarray, step: np.float32) -> None:
    """line += what an ink adds, as the canvas does."""
    for i in range(detail.size):
        line[i] += snap_to(amplitude[i] * detail[i], step)


@inner
def _solve(a: np.ndarray, b: np.ndarray) -> None:
    """Writes the solution of the positive definite a x = b, in place, by elimination."""
    n = b.size
    for i in range(n):
        for j in range(i + 1, n):
            f = a[j, i] / a[i, i]
            for k in range(i, n):
                a[j, k] -= f * a[i, k]
            b[j] -= f * b[i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            b[i] -= a[i, k] * b[k]
        b[i] /= a[i, i]


@inner
def _sampled(
    parents: Array, plane: Int, data: Array, own: Int, place: Array, y: Int, stride: Int, line: Array, step: np.float32
) -> None:
    """Writes every `stride`-th pixel of a row, the parents expanded and the residual added, into `line` float32."""
    if plane < 0:
        line[:] = np.float32(0.0)
    else:
        even = y + place[2]
        row, left = place[0] + 1 + even // 2, place[1]
        near, far = parents[plane, row][left:], parents[plane, row + 2 * (even & 1) - 1][left:]
        for i in range(line.size):
            x = place[3] + stride * i
            j = 1 + x // 2
            k = j + 2 * (x & 1) - 1
            t = _THREE * (_THREE * near[j] + far[j]) + (_THREE * near[k] + far[k])
            line[i] = snap_to(t * _SIXTEENTH, step)
    if own >= 0:
        d = data[own, y]
        for i in range(line.size):
            line[i] += np.float32(d[stride * i]) * step


@inner
def _gather(sums: np.ndarray, x: np.ndarray) -> None:
    """Adds to `sums` (m (m + 3) / 2, w) the products of the rows of `x` (m + 1, w), column by column."""
    m, r = x.shape[0] - 1, 0
    for j in range(m):
        a = x[j]
        for k in range(j, m + 1):
            b, s = x[k], sums[r]
            for i in range(s.size):
                s[i] += a[i] * b[i]
            r += 1


@inner
def _solution(sums: np.ndarray, m: Int) -> np.ndarray:
    """Returns what has the smallest squares: float64 (m,), from the sums of products."""
    a, b, r, trace = np.zeros((m, m), np.float64), np.zeros(m, np.float64), 0, 0.0
    for j in range(m):
        for k in range(j, m + 1):
            total = 0.0
            for i in range(sums.shape[1]):
                total += sums[r, i]
            r += 1
            if k == m:
                b[j] = total
            else:
                a[j, k] = a[k, j] = total
        trace += a[j, j]
    for j in range(m):
        a[j, j] += _RIDGE * trace + 1e-30
    _solve(a, b)
    return b


@kernel
def fit(
    data: Array,
    parents: Array,
    place: Array,
    sources: Array,
    own: Array,
    seen: Array,
    start: Array,
    detail: Array,
    step: np.float32,
    stride: Int,
) -> Array:
    """Returns the factors, float64, that leave the smallest squares on every `stride`-th pixel of every such row."""
    n, width = sources.size, (data.shape[2] + stride - 1) // stride
    m = 1 + 2 * n
    sums, x = np.zeros((3, m * (m + 3) // 2, width), np.float64), np.empty((m + 1, width), np.float64)
    alpha, line, target = np.empty((3, width), np.float32)
    for y in range(0, data.shape[1], stride):
        _sampled(parents, _ALPHA, data, _ALPHA, place, y, stride, alpha, step)
        for i in range(width):
            x[0, i] = min(max(alpha[i], np.float32(0.0)), np.float32(1.0))
        for c in range(3):
            _sampled(parents, c, data, c, place, y, stride, target, step)
            rest = x[m]
            for i in range(width):
                rest[i] = target[i]
            for k in range(n):
                plane = sources[k] + c if sources[k] >= 0 else -1
                _sampled(parents, plane, data, own[k] + c if own[k] >= 0 else -1, place, y, stride, line, step)
                s = seen[k, c % seen.shape[1], start[0] + y][start[1] :]
                for i in range(width):
                    value = np.float64(s[stride * i])
                    rest[i] -= line[i] * value
                    x[1 + 2 * k, i] = line[i]
                    x[2 + 2 * k, i] = x[0, i] * value
                if detail.shape[0]:
                    d = detail[k, c % detail.shape[1], y]
                    for i in range(width):
                        rest[i] += snap_to(line[i] * d[stride * i], step)
            _gather(sums[c], x)
    b = np.empty((3, m), np.float64)
    for c in range(3):
        solution = _solution(sums[c], m)
        for i in range(m):  # b[c] = solution compiles the text of a mismatch of shapes, too: 4 s
            b[c, i] = solution[i]
    return b


@inner
def _add(line: Array, alpha: Array, amplitude: Array, s: Array, p: Real, q: Real, r: Real, first: bool) -> None:
    """line += p alpha + q amplitude + (amplitude + r alpha) s, or that alone if `first`."""
    if first:
        for i in range(line.size):
            line[i] = (p * alpha[i] + q * amplitude[i]) + (amplitude[i] + r * alpha[i]) * s[i]
    else:
        for i in range(line.size):
            line[i] += (p * alpha[i] + q * amplitude[i]) + (amplitude[i] + r * alpha[i]) * s[i]


@inner
def _exchanged(
    row: np.ndarray, implied: np.ndarray, below: np.ndarray, sign: Int, whole: np.ndarray, step: np.float32
) -> tuple[Int, Int, Int]:
    """Returns a row of `exchange`, into `whole` int32: all bits of what is implied, of the row before and after.

    Every sum is cast: int32 added to int32 is int64 otherwise, and half as many fit into a register.
    """
    shift, count = np.int32(31), _ONE / step
    far, old, new = np.int32(0), np.int32(0), np.int32(0)
    for i in range(row.size):
        here = np.int32(row[i])
        given = np.int32(snap_to(implied[i], step) * count)
        there = np.int32(here + np.int32(sign * np.int32(given - np.int32(below[i] * count))))
        far = np.int32(far | np.int32(given ^ np.int32(given >> shift)))
        old = np.int32(old | np.int32(here ^ np.int32(here >> shift)))
        new = np.int32(new | np.int32(there ^ np.int32(there >> shift)))
        whole[i] = there
    return far, old, new


@kernel
def exchange(
    data: Array,
    parents: Array,
    place: Array,
    sources: Array,
    own: Array,
    seen: Array,
    start: Array,
    detail: Array,
    step: np.float32,
    factors: Array,
    sign: Int,
    out: Array,
) -> int:
    """`out`, whose colour planes may be those of `data`, = `data`, to the colour of which implied - (expanded + detail)
    is added (`sign` 1: it is put back) or from which it is taken (-1).

    Gives the bits that it saves in the widths of rows, -1 also where values do not fit into `out`.
    """
    height, width = data.shape[1:]
    high, wide = parents.shape[1:]
    old, above, kept = data.ravel(), parents.ravel(), out.ravel()
    n, at = (place[3] + width + 1) // 2, place[3]
    t, lines = np.empty(n + 2, np.float32), np.empty((3, 2 * n), np.float32)
    over, under, first = lines[0], lines[1], lines[2]
    alpha, amplitude, below = over[at : at + width], under[at : at + width], first[at : at + width]
    implied, whole = np.empty(width, np.float32), np.empty(width, np.int32)
    saved, widest, far = np.int64(0), np.int32(0), np.int32(0)
    for y in range(height):
        _expanded(above, high, wide, _ALPHA, place, y, t, over, step)
        _refined(alpha, old, height, _ALPHA, y, step)
        _clamped(alpha)
        for c in range(3):
            _expanded(above, high, wide, c, place, y, t, first, step)
            for k in range(sources.size):
                _expanded(above, high, wide, sources[k] + c if sources[k] >= 0 else -1, place, y, t, under, step)
                _refined(amplitude, old, height, own[k] + c if own[k] >= 0 else -1, y, step)
                p = factors[c, 0] if k == 0 else np.float32(0.0)
                s = seen[k, c % seen.shape[1], start[0] + y][start[1] : start[1] + width]
                _add(implied, alpha, amplitude, s, p, factors[c, 1 + 2 * k], factors[c, 2 + 2 * k], k == 0)
                if detail.shape[0]:
                    _textured(below, amplitude, detail[k, c % detail.shape[1], y], step)
            place_of = (c * height + y) * width
            most, before, after = _exchanged(old[place_of : place_of + width], implied, below, sign, whole, step)
            row = kept[place_of : place_of + width]
            for i in range(width):
                row[i] = whole[i]
            far, widest = far | most, widest | after
            saved += _bits(before) - _bits(after)
    if _bits(far) > _FAR or _bits(widest) >= 8 * data.itemsize:
        return np.int64(-1)  # type: ignore[return-value]
    return saved  # type: ignore[return-value]


@inner
def _bits(value: Int) -> Int:
    count = 0
    while value:
        count += 1
        value >>= 1
    return count
