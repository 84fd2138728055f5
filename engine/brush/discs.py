"""Round dabs as the mask's kernels see them: discs, the tiles they meet, and their profile laid into a tile.

The profile of a dab of radius R (px) is d = (1-u)^2 (1+2u) with u = clip((r^2 - Rin^2)/(Rout^2 - Rin^2), 0, 1): 1 up
to Rin, a smooth fall in r^2, 0 from Rout on.  Rout = R + 1/2 and Rin = min(hardness R, R - 1/2) >= 0, so that the
hardest brush still has an edge of one pixel.  Below R = 1/2 the profile keeps its size and fades by area.
"""

from __future__ import annotations

import math

import numpy as np

from engine.numeric.address import TILE
from engine.numeric.kernel import Int, Real, inlined, inner_uncounted, kernel, uncounted
from engine.numeric.stand_in import or_interpreted

CX, CY, ROUT, RIN2, SCALE, CEILING, RATE = range(7)  # a disc's columns; SCALE = 1/(Rout^2 - Rin^2)
DISC = 7
_DAB = 6  # columns of a dab that its disc is made of

_LANES = 16  # rows are worked on in whole groups of as many pixels, so that no scalar remainder is left
_FEW = 64  # pairs that are sorted by insertion
_LOW = (1 << 32) - 1
HALF = 1 << 30  # added to tile coordinates, which stay below 2^25, so that codes are positive
_INSIDE = -0.01  # u below which the whole profile is 1 whatever the rounding

_ZERO = np.float32(0.0)
_ONE = np.float32(1.0)
_TWO = np.float32(2.0)
_THREE = np.float32(3.0)


def no_bounds() -> np.ndarray:
    """Returns what `as_discs` tells of none: no place, and no ceiling."""
    return np.array([np.inf, np.inf, -np.inf, -np.inf, 0.0])


@or_interpreted()
@kernel
def as_discs(dabs: np.ndarray, shift_x: Real, shift_y: Real, bounds: np.ndarray) -> np.ndarray:
    """Dabs (n, 6 + k) as discs (n, 7 + k), moved by a shift in px; those without effect get RATE 0.

    CEILING is the dab's opacity on the grid 2^-16.  `bounds`, float64 (x0, y0, x1, y1, highest CEILING), grows to hold
    the discs.
    """
    more = DISC - _DAB
    discs = np.empty((dabs.shape[0], dabs.shape[1] + more))
    for i in range(dabs.shape[0]):
        radius = dabs[i, 2]
        fade = min(1.0, 4.0 * radius * radius)
        radius = max(radius, 0.5)
        outer = radius + 0.5
        inner = max(0.0, min(dabs[i, 5] * radius, radius - 0.5))
        disc = discs[i]
        disc[CX] = dabs[i, 0] + shift_x
        disc[CY] = dabs[i, 1] + shift_y
        disc[ROUT] = outer
        disc[RIN2] = inner * inner
        disc[SCALE] = 1.0 / (outer * outer - inner * inner)
        disc[CEILING] = math.floor(dabs[i, 3] * fade * 65536.0 + 0.5) / 65536.0
        disc[RATE] = dabs[i, 4] if disc[CEILING] > 0.0 else 0.0
        bounds[4] = max(bounds[4], disc[CEILING])
        if disc[RATE] > 0.0:
            bounds[0] = min(bounds[0], disc[CX] - outer)
            bounds[1] = min(bounds[1], disc[CY] - outer)
            bounds[2] = max(bounds[2], disc[CX] + outer)
            bounds[3] = max(bounds[3], disc[CY] + outer)
        for k in range(_DAB, dabs.shape[1]):  # what else dabs have
            disc[k + more] = dabs[i, k]
    return discs


@inlined
def _span(centre: Real, tile: Int) -> tuple[Real, Real]:
    """Along one axis, how far from `centre` the nearest and the farthest pixel centres of a tile are."""
    low = tile * TILE + 0.5 - centre
    high = low + (TILE - 1)
    return max(0.0, max(low, -high)), max(high, -low)


@or_interpreted()
@kernel
def list_pairs(
    discs: np.ndarray, start: Int, codes: np.ndarray, which: np.ndarray, inside: np.ndarray
) -> tuple[int, int]:
    """Returns the pairs (tile, disc) of the discs from `start` on, disc by disc, until the next might not fit.

    Writes the tile as (y + HALF) 2^32 + (x + HALF) into `codes`, the disc's index into `which`, and into `inside`
    whether it covers every pixel of the tile in full.  Returns the number of pairs and the next disc.
    """
    count = 0
    i = start
    while i < discs.shape[0]:
        disc = discs[i]
        cx, cy, outer = disc[CX], disc[CY], disc[ROUT]
        x0, x1 = math.floor((cx - outer) / TILE), math.floor((cx + outer) / TILE)
        y0, y1 = math.floor((cy - outer) / TILE), math.floor((cy + outer) / TILE)
        if count + (x1 - x0 + 1) * (y1 - y0 + 1) > codes.shape[0]:
            break
        if disc[RATE] > 0.0:
            for ty in range(y0, y1 + 1):
                near_y, far_y = _span(cy, ty)
                for tx in range(x0, x1 + 1):
                    near_x, far_x = _span(cx, tx)
                    if near_x * near_x + near_y * near_y < outer * outer:
                        codes[count] = ((ty + HALF) << 32) + (tx + HALF)
                        which[count] = i
                        inside[count] = (far_x * far_x + far_y * far_y - disc[RIN2]) * disc[SCALE] < _INSIDE
                        count += 1
        i += 1
    return count, i  # type: ignore[return-value]


def list_runs(
    discs: np.ndarray, start: int, codes: np.ndarray, which: np.ndarray, inside: np.ndarray, runs: np.ndarray
) -> tuple[int, int]:
    """As `list_pairs`, with the pairs of a tile brought together, tiles in order of their codes, discs in their own.

    Writes a row of `runs`, int64 (n, 5), for each tile: its first pair and the one after its last, the tile's x and y,
    and how many of its discs cover it in full.  Returns the number of rows and the next disc.
    """
    count, following = list_pairs(discs, start, codes, which, inside)
    if count > _FEW:  # numpy's sort: one compiled here would cost a new program five seconds
        order = np.argsort(codes[:count], kind="stable")
        for column in (codes, which, inside):
            column[:count] = column[order]
    return _join(codes, which, inside, count, runs), following


@or_interpreted()
@kernel
def _join(codes: np.ndarray, which: np.ndarray, inside: np.ndarray, count: Int, runs: np.ndarray) -> int:
    """Returns the runs among `count` pairs, which are sorted on the way."""
    for i in range(1, count):  # insertion: stable, and nothing is faster for the few of a frame, or where all is sorted
        code, disc, full = codes[i], which[i], inside[i]
        k = i
        while k > 0 and codes[k - 1] > code:
            codes[k], which[k], inside[k] = codes[k - 1], which[k - 1], inside[k - 1]
            k -= 1
        codes[k], which[k], inside[k] = code, disc, full
    made = 0
    for i in range(count):
        if i == 0 or codes[i] != codes[i - 1]:
            run = runs[made]
            run[0], run[2], run[3], run[4] = i, (codes[i] & _LOW) - HALF, (codes[i] >> 32) - HALF, 0
            made += 1
        runs[made - 1, 1] = i + 1
        runs[made - 1, 4] += inside[i]
    return made


@or_interpreted()
@kernel
def lay_flat(
    discs: np.ndarray, which: np.ndarray, inside: np.ndarray, value: Real, ceiling: Real
) -> tuple[np.float32, int]:
    """Lays discs on a tile whose coverage is one `value`, float32, for as long as it stays one.

    `ceiling`: no disc of the stroke so far has a higher one.  Returns the value and how many discs were laid.
    """
    laid = 0
    for k in range(which.shape[0]):  # a disc that fills the tile to the ceiling wipes out what came before
        disc = discs[which[k]]
        if inside[k] and disc[RATE] == 1.0 and disc[CEILING] >= ceiling:
            value, laid = np.float32(disc[CEILING]), k + 1
    for k in range(laid, which.shape[0]):
        disc = discs[which[k]]
        room = max(_ZERO, np.float32(disc[CEILING]) - value)
        if room > _ZERO:
            if not inside[k]:
                return value, k  # type: ignore[return-value]
            value = value + room * np.float32(disc[RATE])
    return value, which.shape[0]  # type: ignore[return-value]


@or_interpreted()
@kernel
def wiped(discs: np.ndarray, which: np.ndarray, inside: np.ndarray, ceiling: Real) -> bool:
    """Tells whether a disc among these fills the whole tile up to the ceiling."""
    for k in range(which.shape[0]):
        if inside[k] and discs[which[k], RATE] == 1.0 and discs[which[k], CEILING] >= ceiling:
            return True
    return False


@inlined
def _lay_row(row: np.ndarray, across: np.ndarray, down: Real, ceiling: Real, rate: Real) -> None:
    for i in range(row.shape[0]):
        v = _ONE - max(_ZERO, min(_ONE, across[i] + down))  # 1 - u
        row[i] += max(_ZERO, ceiling - row[i]) * (rate * (v * v * (_THREE - _TWO * v)))


def _lay_whole_row(
    row: np.ndarray, across: np.ndarray, down: np.float32, ceiling: np.float32, rate: np.float32
) -> None:
    """As `_lay_row`, without a loop."""
    v = _ONE - np.maximum(_ZERO, np.minimum(_ONE, across + down))
    row += np.maximum(_ZERO, ceiling - row) * (rate * (v * v * (_THREE - _TWO * v)))


@inner_uncounted
def _lay_disc(coverage: np.ndarray, disc: np.ndarray, left: Int, top: Int, across: np.ndarray) -> None:
    """Lays one disc into a tile whose corner lies at `left`, `top`; `across`, float32 (128,), is written over."""
    cx, cy, outer, scale = disc[CX] - left, disc[CY] - top, disc[ROUT], disc[SCALE]
    ceiling, rate = np.float32(disc[CEILING]), np.float32(disc[RATE])
    left_most = max(0, math.floor(cx - outer - 1.0)) // _LANES * _LANES
    right_most = min(TILE, math.ceil(cx + outer + 1.0) + _LANES)
    for x in range(left_most, right_most):
        across[x] = np.float32((x + 0.5 - cx) * (x + 0.5 - cx) * scale)
    for y in range(max(0, math.ceil(cy - outer - 0.5)), min(TILE, math.floor(cy + outer - 0.5) + 1)):
        dy2 = (y + 0.5 - cy) * (y + 0.5 - cy)
        half = math.sqrt(max(0.0, outer * outer - dy2))
        a = max(0, math.ceil(cx - half - 0.5)) // _LANES * _LANES
        b = (min(TILE, math.floor(cx + half - 0.5) + 1) + _LANES - 1) // _LANES * _LANES
        if a < b:
            down = np.float32((dy2 - disc[RIN2]) * scale)
            _lay_row(coverage[y, a:b], across[a:b], down, ceiling, rate)


@or_interpreted(_lay_row=_lay_whole_row)
@kernel
def lay(coverage: np.ndarray, discs: np.ndarray, which: np.ndarray, first: Int, last: Int, left: Int, top: Int) -> None:
    """Lays the discs which[first:last] into one tile, in order: M' = M + max(0, ceiling - M) * rate * d(r).

    `coverage`: M, float32 (128, 128), written; `left`, `top`: the tile's corner in px.
    """
    across = np.empty(TILE, np.float32)
    for k in range(first, last):
        _lay_disc(coverage, discs[which[k]], left, top, across)


@or_interpreted(_lay_row=_lay_whole_row)
@uncounted
def lay_runs(
    slab: np.ndarray, slots: np.ndarray, runs: np.ndarray, discs: np.ndarray, which: np.ndarray, across: np.ndarray
) -> None:
    """As `lay`, of many tiles: those of `slab`, float32 (n, 128, 128), that `slots` names for each of the `runs` (see
    `list_runs`); nothing for -1.  `across`, float32 (128,), is written over."""
    for r in range(runs.shape[0]):
        if slots[r] >= 0:
            for k in range(runs[r, 0], runs[r, 1]):
                _lay_disc(slab[slots[r]], discs[which[k]], runs[r, 2] * TILE, runs[r, 3] * TILE, across)


@inlined
def lay_spot(out: np.ndarray, disc: np.ndarray, left: Int, top: Int) -> None:
    """Lays a disc on the pixels (h, w) from a corner on, as `lay` does in their tiles."""
    ceiling, rate, scale = np.float32(disc[CEILING]), np.float32(disc[RATE]), disc[SCALE]
    x, y, reach = disc[CX] - left, disc[CY] - top, disc[ROUT]
    first, last = max(0, math.floor(x - reach)), min(out.shape[1], math.floor(x + reach) + 1)
    for i in range(max(0, math.floor(y - reach)), min(out.shape[0], math.floor(y + reach) + 1)):
        ty = (top + i) // TILE
        dy = (top + i - ty * TILE) + 0.5 - (disc[CY] - ty * TILE)
        down = np.float32((dy * dy - disc[RIN2]) * scale)
        start = first
        while start < last:  # tile by tile
            tx = (left + start) // TILE
            end, cx = min(last, (tx + 1) * TILE - left), disc[CX] - tx * TILE
            row, place = out[i, start:end], left + start - tx * TILE
            for k in range(row.shape[0]):
                dx = (place + k) + 0.5 - cx
                v = _ONE - max(_ZERO, min(_ONE, np.float32(dx * dx * scale) + down))
                row[k] += max(_ZERO, ceiling - row[k]) * (rate * (v * v * (_THREE - _TWO * v)))
            start = end
