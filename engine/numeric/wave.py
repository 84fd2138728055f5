"""Exact pixel averages of square and sawtooth waves in any direction, at any unbounded integer origin.

Positions along the wave are integers in units of 2^-24 pixel: t(x, y) = ux x + uy y + phase.  A rectangle's origin is
reduced modulo the period with Python integers; inside a rectangle everything stays in integers until the distance to
the nearest edge is known.  A pixel's value is therefore a function of the pixel alone.

The average over a pixel of a step across a straight edge depends only on the distance from the pixel's centre to the
edge: the footprint of a unit square seen along the edge is a trapezoid, its integral is piecewise quadratic.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.functions import functions
from engine.numeric.kernel import Array, Int, Real, inlined, inner, kernel

UNIT = 1 << 24  # units in a pixel
# A cell longer than this cannot show two of its ends in one rectangle (fewer than 2^20 pixels across); the far end is
# moved to this distance, so that kernels never see larger numbers.
FAR = 1 << 46
LONGEST = 1 << 62  # the longest period whose ts fit into 64 bits
# Up to this a block of pixels may hold several edges.
_SHORT = 1 << 29
_BLOCK = 32

Footprint = tuple[np.float32, np.float32, np.float32, np.float32]

_UNIT = np.int64(UNIT)
_PER_UNIT = np.float32(1.0 / UNIT)
_ZERO = np.float32(0.0)
_HALF = np.float32(0.5)
_ONE = np.float32(1.0)
_TWO = np.float32(2.0)


@dataclass(frozen=True, slots=True)
class Wave:
    """A periodic function of t = ux x + uy y + phase, all in units of 2^-24 pixel of the level it was made for.

    `ux`, `uy` are even, so that t is an integer at pixel centres as well; `period` is a multiple of 4, so that half
    a period is even too.
    """

    ux: int
    uy: int
    period: int
    phase: int

    @classmethod
    def of(cls, period: float, angle: float, phase: float, arithmetic: int = LIBRARY) -> Wave:
        """`period` in pixels, `angle` in degrees from +x towards +y (clockwise as seen), `phase` in periods."""
        turns, rest = divmod(angle, 90.0)
        along = functions(arithmetic)
        ux, uy = along.cos(math.radians(rest)), along.sin(math.radians(rest))
        for _ in range(int(turns) % 4):
            ux, uy = -uy, ux
        units = 4 * round(period * UNIT / 4)
        return cls(2 * round(ux * UNIT / 2), 2 * round(uy * UNIT / 2), units, round(phase * units))

    def across(self) -> Wave:
        """Returns the same wave a quarter turn on."""
        return Wave(-self.uy, self.ux, self.period, self.phase)

    def finer(self, levels: int) -> Wave:
        """Returns the same wave seen `levels` (>= 0) finer."""
        return Wave(self.ux, self.uy, self.period << levels, self.phase << levels)

    def at(self, x: int, y: int) -> int:
        """t at the centre of pixel (x, y)."""
        return self.ux * x + self.uy * y + (self.ux + self.uy) // 2 + self.phase

    def edge_near(self, rect: Rect, cell: int, reach: int) -> bool:
        """Tells whether a multiple of `cell` lies within the ts of the rectangle grown by `reach` pixels."""
        r = rect.grown(reach)
        ends = [self.at(x, y) for x in (r.x0, r.x1 - 1) for y in (r.y0, r.y1 - 1)]
        return min(ends) // cell != max(ends) // cell

    def footprint(self) -> Footprint:
        """Returns what `_tail` needs of the pixel's shadow along the wave: 1/a, (a - b)/2, (a + b)/2, 1/(2ab) with a
        >= b."""
        a, b = sorted((abs(self.ux) / UNIT, abs(self.uy) / UNIT), reverse=True)
        return (
            np.float32(1 / a),
            np.float32((a - b) / 2),
            np.float32((a + b) / 2),
            np.float32(0.5 / (a * b) if b else 0.0),
        )


def folded(t: int, cell: int) -> tuple[int, int, int]:
    """(r, parity, cell'): t = r modulo the cell, whether the cell's number is odd, and the cell the kernel is told.

    Cells beyond FAR come back as FAR, r measured from the end nearest to t (and kept away from the other).
    """
    index, r = divmod(t, cell)
    if cell <= FAR:
        return r, index & 1, cell
    if r <= cell - r:
        return min(r, FAR // 2 - 1), index & 1, FAR
    return FAR - min(cell - r, FAR // 2), index & 1, FAR


def square_wave(wave: Wave, rect: Rect) -> np.ndarray:
    """Returns pixel averages of the wave that is +1 on the first half of each period, -1 on the second: float32 (h,
    w)."""
    out = np.empty((rect.height, rect.width), np.float32)
    r, odd, cell = folded(wave.at(rect.x0, rect.y0), wave.period // 2)
    _square_rows(out, r, odd, cell, wave.ux, wave.uy, wave.footprint())
    return out


def step_wave(wave: Wave, rect: Rect) -> np.ndarray:
    """Returns pixel averages of the step from -1 to +1 across that multiple of the period which is nearest: float32
    (h, w).

    For periods of FAR / 2 and more: there, no rectangle holds two edges.
    """
    out = np.empty((rect.height, rect.width), np.float32)
    r, _, cell = folded(wave.at(rect.x0, rect.y0), wave.period)
    _square_rows(out, r, 0 if 2 * r < cell else 1, cell, wave.ux, wave.uy, wave.footprint())
    return out


def saw_wave(wave: Wave, rect: Rect) -> np.ndarray:
    """Returns pixel averages of the wave that falls from +1 to -1 over each period, then jumps: float32 (h, w).

    For periods up to LONGEST.
    """
    out = np.empty((rect.height, rect.width), np.float32)
    _saw_rows(out, wave.at(rect.x0, rect.y0) % wave.period, wave.period, wave.ux, wave.uy, wave.footprint())
    return out


@inlined
def _tail(z: Real, shadow: tuple[Real, Real, Real, Real]) -> Real:
    """Returns the part of a pixel that lies beyond an edge at distance z >= 0 (pixels) from its centre."""
    rest = max(shadow[2] - z, _ZERO)
    return _HALF - z * shadow[0] if z < shadow[1] else rest * rest * shadow[3]


@inlined
def _stepped(r: Int, odd: Int, step: Int, wraps: Int, cell: Int) -> tuple[Int, Int]:
    """r + step modulo the cell; `step` is reduced already, `wraps` says whether that dropped an odd number of cells."""
    r += step
    odd ^= wraps
    if r >= cell:
        r -= cell
        odd ^= 1
    return r, odd


@inlined
def _lift(ux: Int, cell: Int) -> Int:
    """Returns an even number of cells that keeps every t of a block positive; with r, it stays below 2^31."""
    return 0 if ux >= 0 else ((_BLOCK * -ux) // (2 * cell) + 1) * 2 * cell


@inlined
def _within(t: Int, cell: Int, per_cell: Real) -> tuple[Int, Real]:
    """(m, d): t = m cell + d, 0 <= d < cell; all int32, t >= 0.  The quotient by float32, put right where it is off."""
    m = np.int32(np.float32(t) * per_cell)
    d = np.int32(t - np.int32(m * cell))
    m = np.int32(m - 1) if d < 0 else m
    d = np.int32(d + cell) if d < 0 else d
    m = np.int32(m + 1) if d >= cell else m
    d = np.int32(d - cell) if d >= cell else d
    return m, d  # type: ignore[return-value]


@inner
def _square_short(row: np.ndarray, r: Int, odd: Int, cell: Int, ux: Int, shadow: tuple[Real, Real, Real, Real]) -> None:
    """Writes a block of the square wave whose cells are at most _SHORT: any number of edges."""
    start, step, size = np.int32(r + _lift(ux, cell)), np.int32(ux), np.int32(cell)
    per_cell = _ONE / np.float32(size)
    flip = np.int32(odd)
    for i in range(row.size):
        m, d = _within(np.int32(start + np.int32(i) * step), size, per_cell)
        near = _tail(np.float32(d) * _PER_UNIT, shadow)
        far = _tail(np.float32(np.int32(size - d)) * _PER_UNIT, shadow)
        value = _ONE - _TWO * (near + far)
        row[i] = value if np.int32(m ^ flip) & 1 == 0 else -value


@inner
def _square_edge(row: Array, distance: Int, sign: Real, ux: Int, shadow: tuple[Real, Real, Real, Real]) -> None:
    """Writes a block with one edge, `distance` units before its first pixel's centre; `sign` holds after the edge."""
    start, step = np.int32(distance), np.int32(ux)
    for i in range(row.size):
        d = np.int32(start + np.int32(i) * step)
        z = np.float32(d) * _PER_UNIT
        value = sign * (_ONE - _TWO * _tail(abs(z), shadow))
        row[i] = value if d >= 0 else -value


@inner
def _square_long(row: np.ndarray, r: Int, odd: Int, cell: Int, ux: Int, shadow: tuple[Real, Real, Real, Real]) -> None:
    """Writes a block of the square wave whose cells are longer than _SHORT: at most one edge."""
    span = ux * (row.size - 1)
    past = 2 * r + span >= cell
    distance = r - cell if past else r
    sign = _ONE if odd == np.int64(past) else -_ONE
    if min(distance, distance + span) >= _UNIT:
        row[:] = sign
    elif max(distance, distance + span) <= -_UNIT:
        row[:] = -sign
    else:
        _square_edge(row, distance, sign, ux, shadow)


@kernel
def _square_rows(
    out: Array, r: Int, odd: Int, cell: Int, ux: Int, uy: Int, shadow: tuple[Real, Real, Real, Real]
) -> None:
    """Writes the square wave over `out` (h, w), whose first pixel's centre is at r (0 <= r < cell) in an even or odd
    cell."""
    jump, jumps = (_BLOCK * ux) % cell, ((_BLOCK * ux) // cell) & 1
    down, downs = uy % cell, (uy // cell) & 1
    for y in range(out.shape[0]):
        q, p = r, odd
        for x in range(0, out.shape[1], _BLOCK):
            block = out[y, x : min(x + _BLOCK, out.shape[1])]
            if cell <= _SHORT:
                _square_short(block, q, p, cell, ux, shadow)
            else:
                _square_long(block, q, p, cell, ux, shadow)
            q, p = _stepped(q, p, jump, jumps, cell)
        r, odd = _stepped(r, odd, down, downs, cell)


@inner
def _saw_short(row: np.ndarray, r: Int, cell: Int, ux: Int, shadow: tuple[Real, Real, Real, Real]) -> None:
    """Writes a block of the sawtooth whose period is at most _SHORT: any number of jumps."""
    start, step, size = np.int32(r + _lift(ux, cell)), np.int32(ux), np.int32(cell)
    per_cell = _ONE / np.float32(size)
    for i in range(row.size):
        _, d = _within(np.int32(start + np.int32(i) * step), size, per_cell)
        near = _tail(np.float32(d) * _PER_UNIT, shadow)
        far = _tail(np.float32(np.int32(size - d)) * _PER_UNIT, shadow)
        row[i] = _ONE - _TWO * (np.float32(d) * per_cell + near - far)


@inner
def _saw_long(row: np.ndarray, r: Int, cell: Int, ux: Int, shadow: tuple[Real, Real, Real, Real]) -> None:
    """Writes a block of the sawtooth with one jump at most; the ramp in float64."""
    slope = 2.0 / cell
    span = ux * (row.size - 1)
    if min(r, r + span) >= _UNIT and max(r, r + span) <= cell - _UNIT:
        for i in range(row.size):
            row[i] = np.float32(1.0 - slope * np.float64(r + np.int64(i) * ux))
        return
    for i in range(row.size):
        t = r + i * ux
        t += (cell if t < 0 else 0) - (cell if t >= cell else 0)
        near = _tail(np.float32(min(t, _UNIT)) * _PER_UNIT, shadow)
        far = _tail(np.float32(min(cell - t, _UNIT)) * _PER_UNIT, shadow)
        row[i] = np.float32((1.0 - slope * np.float64(t)) - np.float64(_TWO * (near - far)))


@kernel
def _saw_rows(out: np.ndarray, r: Int, cell: Int, ux: Int, uy: Int, shadow: tuple[Real, Real, Real, Real]) -> None:
    """Writes the sawtooth over `out` (h, w), whose first pixel's centre is at r, 0 <= r < cell = the period."""
    jump, down = (_BLOCK * ux) % cell, uy % cell
    for y in range(out.shape[0]):
        q = r
        for x in range(0, out.shape[1], _BLOCK):
            block = out[y, x : min(x + _BLOCK, out.shape[1])]
            if cell <= _SHORT:
                _saw_short(block, q, cell, ux, shadow)
            else:
                _saw_long(block, q, cell, ux, shadow)
            q, _ = _stepped(q, 0, jump, 0, cell)
        r, _ = _stepped(r, 0, down, 0, cell)
