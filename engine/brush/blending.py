"""Kernels that lay the tints of dabs: those of each into the mean of what was laid at a pixel (module `tinting`)."""

from __future__ import annotations

import math

import numpy as np

from engine.brush.discs import CEILING, CX, CY, RATE, RIN2, ROUT, SCALE
from engine.brush.print_form import TwoInts
from engine.numeric.address import TILE
from engine.numeric.kernel import Array, inlined, inner, inner_uncounted, kernel

_ZERO, _ONE, _TWO, _THREE = np.float32(0.0), np.float32(1.0), np.float32(2.0), np.float32(3.0)
_HALF = np.float32(0.5)
TwoReals = tuple[float, float]
_FAINT = np.float32(1e-36)  # below any strength of a dab
_LANES = 16  # pixels of a row that are worked on together


@inner_uncounted
def _locate_row(share: Array, first: int, middle: TwoReals, place: Array, across: Array, down: Array) -> None:
    """Writes where textures lie, across and down, where at least half of what is there is the dab's: in the pixels of
    a row from the `first` on; `middle`: the dab's own, across, and how far above the row."""
    cx, dy = middle
    xx, xy, x = place[0], place[1] * dy, place[4]
    yx, yy, y = place[2], place[3] * dy, place[5]
    for i in range(share.shape[0]):
        dx = (first + i) + 0.5 - cx
        most = share[i] >= _HALF
        across[i] = np.float32(xx * dx + xy + x) if most else across[i]
        down[i] = np.float32(yx * dx + yy + y) if most else down[i]


@inner
def blend(planes: tuple[Array, Array, Array, Array], disc: Array, left: int, top: int) -> None:
    """Mixes a disc's tints, its last columns, into those of a tile, by its strength, which is cleared; `planes` as of
    `Print.lay_tinted`."""
    coverage, strength, tints, places = planes
    cx, cy, reach = disc[CX] - left, disc[CY] - top, disc[ROUT] + 2.0
    own = disc.shape[0] - tints.shape[0]
    first, last = max(0, math.floor(cx - reach)), min(TILE, math.ceil(cx + reach))
    for y in range(max(0, math.floor(cy - reach)), min(TILE, math.ceil(cy + reach))):
        m, k = coverage[y], strength[y]
        for x in range(first, last):  # how much of the dab is in the mean
            k[x] = min(k[x] / max(m[x], k[x]), _ONE) if k[x] > _ZERO else _ZERO
        for c in range(tints.shape[0]):
            t, value = tints[c, y], np.float32(disc[own + c])
            for x in range(first, last):
                t[x] += (value - t[x]) * k[x]
        if places.shape[0]:
            at = cx, y + 0.5 - cy
            _locate_row(
                k[first:last], first, at, disc[own - 6 : own], places[0, y, first:last], places[1, y, first:last]
            )
        for x in range(first, last):
            k[x] = _ZERO


@kernel
def blend_one(planes: tuple[Array, Array, Array, Array], disc: Array, left: int, top: int) -> None:
    """As `blend`, for Python."""
    blend(planes, disc, left, top)


@inlined
def _lay_row(
    m: Array, across: Array, share: Array, inside: TwoInts, down: np.float32, most: np.float32, rate: np.float32
) -> None:
    """Lays a row of a disc into the coverage, as `discs.lay` does; writes how much of the dab is in the mean.  Nothing
    is laid but `inside`."""
    for i in range(m.shape[0]):
        v = _ONE - max(_ZERO, min(_ONE, across[i] + down))
        part = rate * (v * v * (_THREE - _TWO * v))
        part = part if (i >= inside[0]) & (i < inside[1]) else _ZERO
        m[i] += max(_ZERO, most - m[i]) * part
        share[i] = min(most * part / max(max(m[i], most * part), _FAINT), _ONE)


@inlined
def _blend_row(t: Array, share: Array, value: np.float32) -> None:
    for i in range(t.shape[0]):
        t[i] += (value - t[i]) * share[i]


@inner_uncounted
def _lay_one(
    planes: tuple[Array, Array, Array, Array], disc: Array, left: int, top: int, scratch: tuple[Array, Array]
) -> None:
    coverage, _, tints, places = planes
    across, share = scratch
    cx, cy, outer, scale = disc[CX] - left, disc[CY] - top, disc[ROUT], disc[SCALE]
    ceiling, rate, own = np.float32(disc[CEILING]), np.float32(disc[RATE]), disc.shape[0] - tints.shape[0]
    for x in range(max(0, math.floor(cx - outer)) // _LANES * _LANES, min(TILE, math.ceil(cx + outer) + _LANES)):
        across[x] = np.float32((x + 0.5 - cx) * (x + 0.5 - cx) * scale)
    for y in range(max(0, math.ceil(cy - outer - 0.5)), min(TILE, math.floor(cy + outer - 0.5) + 1)):
        square = (y + 0.5 - cy) * (y + 0.5 - cy)
        half = math.sqrt(max(0.0, outer * outer - square))
        first, last = max(0, math.ceil(cx - half - 0.5)), min(TILE, math.floor(cx + half - 0.5) + 1)
        if first >= last:
            continue
        a, b = first // _LANES * _LANES, (last + _LANES - 1) // _LANES * _LANES
        down = np.float32((square - disc[RIN2]) * scale)
        _lay_row(coverage[y, a:b], across[a:b], share[a:b], (first - a, last - a), down, ceiling, rate)
        for c in range(tints.shape[0]):
            _blend_row(tints[c, y, a:b], share[a:b], np.float32(disc[own + c]))
        if places.shape[0]:
            mean, place, middle = share[first:last], disc[own - 6 : own], (cx, y + 0.5 - cy)
            _locate_row(mean, first, middle, place, places[0, y, first:last], places[1, y, first:last])


@kernel
def lay_round(planes: tuple[Array, Array, Array, Array], discs: Array, which: Array, corner: tuple[int, int]) -> None:
    """Lays round discs, as `discs.lay` does, and their tints, one after the other."""
    scratch = np.zeros(TILE, np.float32), np.zeros(TILE, np.float32)
    for index in which:
        _lay_one(planes, discs[index], corner[0], corner[1], scratch)
