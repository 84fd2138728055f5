"""The noises of written textures, along a row of samples: smooth `noise`, and `white`, one value a cell.

Both are *balanced*: the cells of each block of 2 x 2 have a mean of exactly nothing, so that noise too fine for a pixel
is gone from that pixel, but for what its rim cuts; the mean over a pixel costs what that rim holds.  Smooth noise is
cells half a unit wide under the quadratic B-spline; the mean over a box is in closed form for both.

Samples are float64 (n,): places u, v in units, widths wu, wv of the box over which the mean is taken.
"""

from __future__ import annotations

import math

import numpy as np

from engine.numeric.kernel import Int, forced, inner_uncounted

CELLS_SEEN = 24.0  # cells across a pixel, beyond which it sees none of them
_FADES = 2.0 / 3.0  # of the widest that is seen, from which on they fade
_THIN = 0.25  # cells: over so narrow a box the mean of a spline goes by its bend
_FAR = 2.0**30  # cells: farther out there is nothing to see
ROOM = 2 * 18 + 1  # blocks along a side of the widest pixel, two numbers each, and where they begin
_LOW, _MIDDLE = np.uint32(0x3FF), np.uint32(0x7FF)
_ROUNDS = (np.uint32(0x9E3779B1), np.uint32(0x85EBCA77), np.uint32(0xC2B2AE3D), np.uint32(0x27D4EB2F))


@forced
def hash32(key: np.uint32, x: Int, y: Int) -> np.uint32:
    """Returns the hash of a cell, by the low 32 bits of its place."""
    h = np.uint32(np.uint32(x) * _ROUNDS[0] ^ key)
    h = np.uint32((h ^ (h >> np.uint32(15))) * _ROUNDS[1])
    h = np.uint32((h ^ np.uint32(np.uint32(y) * _ROUNDS[2])) * _ROUNDS[3])
    h = np.uint32((h ^ (h >> np.uint32(13))) * _ROUNDS[1])
    return np.uint32(h ^ (h >> np.uint32(16)))


@forced
def _spread(h: np.uint32) -> tuple[float, float, float]:
    """Returns three numbers of -1..1."""
    a = np.float64(np.int32(h & _LOW)) * (2.0 / 1023.0) - 1.0
    b = np.float64(np.int32((h >> np.uint32(10)) & _MIDDLE)) * (2.0 / 2047.0) - 1.0
    c = np.float64(np.int32(h >> np.uint32(21))) * (2.0 / 2047.0) - 1.0
    return a, b, c


@forced
def _block(key: np.uint32, x: Int, y: Int, sx: float, dx: float, sy: float, dy: float) -> float:
    """Returns what a block adds: `sx`, `dx` are the sum of the weights of its columns and their difference."""
    a, b, c = _spread(hash32(key, x, y))
    return (a * sx + c * dx) * dy + b * dx * sy


@forced
def _by_blocks(cell: float, w0: float, w1: float, w2: float) -> tuple[float, float, float, float, float]:
    """Returns the first of the two blocks that three cells lie in, and (sum, difference) of the weights of both."""
    first = math.floor((cell + 1.0) * 0.5) - 1.0
    even = cell - 2.0 * first - 1.0  # 0 or 1
    odd = 1.0 - even
    ae, ao = odd * w0, even * w0 + odd * w1
    be, bo = even * w1 + odd * w2, even * w2
    return first, ae + ao, ae - ao, be + bo, be - bo


@forced
def _weights(q: float, width: float) -> tuple[float, float, float, float, float]:
    """Returns, as `_by_blocks`, what the cells about a place weigh in the mean over a narrow box."""
    cell = math.floor(q)
    t = q - cell - 0.5
    bend = width * width * (1.0 / 24.0)
    w0, w2 = 0.5 * (0.5 - t) * (0.5 - t) + bend, 0.5 * (0.5 + t) * (0.5 + t) + bend
    return _by_blocks(cell, w0, 0.75 - t * t - 2.0 * bend, w2)


@forced
def _slope_weights(q: float) -> tuple[float, float, float, float, float]:
    """Returns, as `_by_blocks`, what they weigh in the slope there."""
    cell = math.floor(q)
    t = q - cell - 0.5
    return _by_blocks(cell, t - 0.5, -2.0 * t, t + 0.5)


@forced
def _seen(q: float) -> float:
    return q if abs(q) < _FAR else 0.0


@forced
def _at(x: float, y: float, width: float, height: float, key: np.uint32) -> float:
    """Returns the mean of smooth noise over a narrow box."""
    first, sx, dx, tx, ex = _weights(x, width)
    top, sy, dy, ty, ey = _weights(y, height)
    i, j = np.int32(first), np.int32(top)
    upper = _block(key, i, j, sx, dx, sy, dy) + _block(key, i + 1, j, tx, ex, sy, dy)
    return upper + (_block(key, i, j + 1, sx, dx, ty, ey) + _block(key, i + 1, j + 1, tx, ex, ty, ey))


@forced
def _slopes_at(x: float, y: float, width: float, height: float, key: np.uint32) -> tuple[float, float, float]:
    """Returns the mean of smooth noise over a narrow box, and its slopes across and down."""
    first, sx, dx, tx, ex = _weights(x, width)
    top, sy, dy, ty, ey = _weights(y, height)
    _, su, du, tu, eu = _slope_weights(x)
    _, sv, dv, tv, ev = _slope_weights(y)
    i, j = np.int32(first), np.int32(top)
    a, b, c = _spread(hash32(key, i, j))
    value, right, below = (a * sx + c * dx) * dy + b * dx * sy, (a * su + c * du) * dy + b * du * sy, 0.0
    below = (a * sx + c * dx) * dv + b * dx * sv
    a, b, c = _spread(hash32(key, i + 1, j))
    value += (a * tx + c * ex) * dy + b * ex * sy
    right += (a * tu + c * eu) * dy + b * eu * sy
    below += (a * tx + c * ex) * dv + b * ex * sv
    a, b, c = _spread(hash32(key, i, j + 1))
    value_low, right_low = (a * sx + c * dx) * ey + b * dx * ty, (a * su + c * du) * ey + b * du * ty
    below += (a * sx + c * dx) * ev + b * dx * tv
    a, b, c = _spread(hash32(key, i + 1, j + 1))
    value_low += (a * tx + c * ex) * ey + b * ex * ty
    right_low += (a * tu + c * eu) * ey + b * eu * ty
    return value + value_low, right + right_low, below + ((a * tx + c * ex) * ev + b * ex * tv)


@inner_uncounted
def _thin(
    u: np.ndarray, v: np.ndarray, widths: tuple[np.ndarray, np.ndarray], lattice: np.ndarray, key: np.uint32,
    out: np.ndarray,
) -> None:  # fmt: skip
    scale, across, down, gain = lattice[0], lattice[1], lattice[2], lattice[3]
    wu, wv = widths
    for i in range(out.size):
        x, y = _seen(u[i] * scale + across), _seen(v[i] * scale + down)
        out[i] += gain * _at(x, y, wu[i] * scale, wv[i] * scale, key)


@inner_uncounted
def _thin_slopes(
    u: np.ndarray, v: np.ndarray, widths: tuple[np.ndarray, np.ndarray], lattice: np.ndarray, key: np.uint32,
    outs: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> None:  # fmt: skip
    scale, across, down, gain = lattice[0], lattice[1], lattice[2], lattice[3]
    wu, wv = widths
    out, right, below = outs
    for i in range(out.size):
        x, y = _seen(u[i] * scale + across), _seen(v[i] * scale + down)
        value, one, other = _slopes_at(x, y, wu[i] * scale, wv[i] * scale, key)
        out[i] += gain * value
        right[i] += gain * scale * one
        below[i] += gain * scale * other


@forced
def _spline_sum(s: float) -> float:
    """Returns the integral of the quadratic B-spline from 0 to s."""
    t = min(abs(s), 1.5)
    rest = 1.5 - t
    half = t * (0.75 - t * t / 3.0) if t < 0.5 else 0.5 - rest * rest * rest / 6.0
    return half if s > 0.0 else -half


@forced
def _spline(s: float) -> float:
    t = min(abs(s), 1.5)
    return 0.75 - t * t if t < 0.5 else 0.5 * (1.5 - t) * (1.5 - t)


@forced
def _weight(low: float, high: float, middle: float, kind: int) -> float:
    """Returns what a cell adds to a box from low to high, times its width; `kind`: 0 for smooth noise, 1 for its slope,
    2 for cells of their own, 3 for their upper halves."""
    if kind == 0:
        return _spline_sum(high - middle) - _spline_sum(low - middle)
    if kind == 1:
        return _spline(high - middle) - _spline(low - middle)
    last = 0.5 if kind == 2 else 0.0
    return min(max(high - middle, -0.5), last) - min(max(low - middle, -0.5), last)


@inner_uncounted
def _weigh(
    u: np.ndarray, width: np.ndarray, lattice: tuple[float, float], kind: int, room: np.ndarray, ends: np.ndarray
) -> int:
    """Writes the weights of the cells that each box meets, by blocks: the first block to row 0 of `room`, then in turn
    the sum and the difference of each block's two; returns how many blocks there are at most.

    `lattice`: cells a unit, and their shift.  Rows that are the same all along, as of lines of pixels, are worked out
    once.
    """
    count, same = 1, True
    reach = 0.0 if kind >= 2 else 1.0
    scale, shift = lattice
    low, high, inverse = ends[0], ends[1], ends[2]
    for i in range(u.size):
        same = same and u[i] == u[0] and width[i] == width[0]
    last = 1 if same else u.size
    for i in range(last):
        q, wide = _seen(u[i] * scale + shift), min(max(width[i] * scale, 1e-6), CELLS_SEEN)
        low[i], high[i], inverse[i] = q - 0.5 * wide, q + 0.5 * wide, 1.0 / wide
        room[0, i] = math.floor((low[i] - reach) * 0.5)
        count = max(count, int(math.floor((high[i] + reach) * 0.5) - room[0, i]) + 1)
    for n in range(count):
        sums, differences = room[2 * n + 1], room[2 * n + 2]
        for i in range(last):
            middle = 2.0 * (room[0, i] + n) + 0.5
            even = _weight(low[i], high[i], middle, kind) * inverse[i]
            odd = _weight(low[i], high[i], middle + 1.0, kind) * inverse[i]
            sums[i], differences[i] = even + odd, even - odd
    if same:
        for n in range(2 * count + 1):
            row, value = room[n], room[n, 0]
            for i in range(u.size):
                row[i] = value
    return count


@forced
def _faded(width: float, widest: float) -> float:
    return min(max((widest - width) / (widest * (1.0 - _FADES)), 0.0), 1.0)


@inner_uncounted
def _broad(
    u: np.ndarray, v: np.ndarray, widths: tuple[np.ndarray, np.ndarray], lattice: np.ndarray, key: np.uint32,
    room: np.ndarray, out: np.ndarray,
) -> None:  # fmt: skip
    scale, across, down, gain, widest = lattice[0], lattice[1], lattice[2], lattice[3], lattice[4]
    columns = _weigh(u, widths[0], (scale, across), 0, room[0], room[2])
    rows = _weigh(v, widths[1], (scale, down), 0, room[1], room[2])
    total, left, top = room[2, 0], room[0, 0], room[1, 0]
    for i in range(out.size):
        total[i] = 0.0
    for j in range(rows):
        sy, dy = room[1, 2 * j + 1], room[1, 2 * j + 2]
        for k in range(columns):
            sx, dx = room[0, 2 * k + 1], room[0, 2 * k + 2]
            for i in range(out.size):
                total[i] += _block(key, np.int32(left[i]) + k, np.int32(top[i]) + j, sx[i], dx[i], sy[i], dy[i])
    for i in range(out.size):
        width, height = widths[0][i] * scale, widths[1][i] * scale
        if max(width, height) > _THIN:
            out[i] += gain * _faded(max(width, height), widest) * total[i]
        else:
            out[i] += gain * _at(_seen(u[i] * scale + across), _seen(v[i] * scale + down), width, height, key)


@inner_uncounted
def _broad_slopes(
    u: np.ndarray, v: np.ndarray, widths: tuple[np.ndarray, np.ndarray], lattice: np.ndarray, key: np.uint32,
    room: np.ndarray, outs: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> None:  # fmt: skip
    scale, across, down, gain, widest = lattice[0], lattice[1], lattice[2], lattice[3], lattice[4]
    columns = _weigh(u, widths[0], (scale, across), 0, room[0], room[2])
    rows = _weigh(v, widths[1], (scale, down), 0, room[1], room[2])
    _weigh(u, widths[0], (scale, across), 1, room[3], room[2])
    _weigh(v, widths[1], (scale, down), 1, room[4], room[2])
    value, right, below, left, top = room[2, 0], room[2, 1], room[2, 2], room[0, 0], room[1, 0]
    for i in range(value.size):
        value[i], right[i], below[i] = 0.0, 0.0, 0.0
    for j in range(rows):
        sy, dy, sv, dv = room[1, 2 * j + 1], room[1, 2 * j + 2], room[4, 2 * j + 1], room[4, 2 * j + 2]
        for k in range(columns):
            sx, dx, su, du = room[0, 2 * k + 1], room[0, 2 * k + 2], room[3, 2 * k + 1], room[3, 2 * k + 2]
            for i in range(outs[0].size):
                a, b, c = _spread(hash32(key, np.int32(left[i]) + k, np.int32(top[i]) + j))
                value[i] += (a * sx[i] + c * dx[i]) * dy[i] + b * dx[i] * sy[i]
                right[i] += (a * su[i] + c * du[i]) * dy[i] + b * du[i] * sy[i]
                below[i] += (a * sx[i] + c * dx[i]) * dv[i] + b * dx[i] * sv[i]
    for i in range(outs[0].size):
        width, height = widths[0][i] * scale, widths[1][i] * scale
        part, found = gain * _faded(max(width, height), widest), (value[i], right[i], below[i])
        if max(width, height) <= _THIN:
            x, y = _seen(u[i] * scale + across), _seen(v[i] * scale + down)
            part, found = gain, _slopes_at(x, y, width, height, key)
        outs[0][i] += part * found[0]
        outs[1][i] += part * scale * found[1]
        outs[2][i] += part * scale * found[2]


@forced
def _extent(widths: tuple[np.ndarray, np.ndarray], scale: float) -> tuple[float, float]:
    """Returns the narrowest and the widest sample of a row, in cells."""
    widest, narrowest = 0.0, 1e30
    for i in range(widths[0].size):
        wide = max(widths[0][i], widths[1][i]) * scale
        widest, narrowest = max(widest, wide), min(narrowest, wide)
    return narrowest, widest


@inner_uncounted
def noise_row(
    u: np.ndarray, v: np.ndarray, widths: tuple[np.ndarray, np.ndarray], lattice: np.ndarray, key: np.uint32,
    room: np.ndarray, out: np.ndarray,
) -> None:  # fmt: skip
    """Adds one octave of smooth noise.

    `lattice`: cells a unit, how far they are shifted across and down, the gain, and how many cells a pixel may span and
    still see them; `room`: float64 (5, ROOM, n).
    """
    narrowest, widest = _extent(widths, lattice[0])
    if widest <= _THIN:
        _thin(u, v, widths, lattice, key, out)
    elif narrowest < lattice[4]:
        _broad(u, v, widths, lattice, key, room, out)


@inner_uncounted
def noise_rows(
    u: np.ndarray, v: np.ndarray, widths: tuple[np.ndarray, np.ndarray], lattice: np.ndarray, key: np.uint32,
    room: np.ndarray, outs: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> None:  # fmt: skip
    """As `noise_row`, and its slopes along u and v, a unit."""
    narrowest, widest = _extent(widths, lattice[0])
    if widest <= _THIN:
        _thin_slopes(u, v, widths, lattice, key, outs)
    elif narrowest < lattice[4]:
        _broad_slopes(u, v, widths, lattice, key, room, outs)


@forced
def _four(key: np.uint32, x: Int, y: Int) -> tuple[float, float, float, float]:
    """Returns the cells of a block of white noise, -1..1: two, and what balances them."""
    h = hash32(key, x, y)
    s = np.float64(np.int32(h & np.uint32(0x7FFF))) * (2.0 / 32767.0) - 1.0
    t = np.float64(np.int32((h >> np.uint32(15)) & np.uint32(0x7FFF))) * (2.0 / 32767.0) - 1.0
    how = h >> np.uint32(30)
    if how == np.uint32(0):
        return s, -s, t, -t
    return (s, t, -s, -t) if how == np.uint32(1) else (s, t, -t, -s)


@inner_uncounted
def white_row(
    u: np.ndarray, v: np.ndarray, widths: tuple[np.ndarray, np.ndarray], key: np.uint32, half: int,
    room: np.ndarray, out: np.ndarray,
) -> None:  # fmt: skip
    """Writes a random number of -1/2..1/2 for each cell, one unit wide; `half` 1: only in the upper half of each, and 0
    elsewhere; `room`: float64 (5, ROOM, n)."""
    columns = _weigh(u, widths[0], (1.0, 0.0), 2, room[0], room[2])
    rows = _weigh(v, widths[1], (1.0, 0.0), 2 + half, room[1], room[2])
    for i in range(out.size):
        out[i] = 0.0
    for j in range(rows):
        sy, dy = room[1, 2 * j + 1], room[1, 2 * j + 2]
        for k in range(columns):
            sx, dx = room[0, 2 * k + 1], room[0, 2 * k + 2]
            for i in range(out.size):
                x, y = np.int32(room[0, 0, i]) + k, np.int32(room[1, 0, i]) + j
                a, b, c, d = _four(key, x, y)
                even, odd = 0.5 * (sx[i] + dx[i]), 0.5 * (sx[i] - dx[i])
                upper, lower = 0.5 * (sy[i] + dy[i]), 0.5 * (sy[i] - dy[i])
                out[i] += (a * even + b * odd) * upper + (c * even + d * odd) * lower
    for i in range(out.size):
        out[i] *= 0.5 * _faded(max(widths[0][i], widths[1][i]), CELLS_SEEN)
