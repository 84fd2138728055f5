"""What the dabs of a wet brush see of the painting: squares of 32 x 32 pixels, found by the place of a dab."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from engine.numeric.kernel import Array, Int, inner_uncounted, uncounted
from engine.numeric.pigment import to_paint

SIDE = 32
HALF = 1 << 30  # added to the coordinates of squares, so that codes are positive
THINNEST = 0.75  # px: half the breadth of what is looked at, at least
FRONT, NARROW = 1.0, 0.6  # of a radius: how far ahead paint is taken up; how far around
_RIM = 0.5  # px


class Manner(NamedTuple):
    """What stays the same all through a stroke.

    `size`: of a vector (`numeric.pigment`).  `numbers`: float64, log2 of the length, the amount, the water in the load,
    pixels to one of the level, where the stroke's origin lies, how large hairs are for their tip.  `plan`: int64, dabs
    that follow one another as copies of one, hairs, whether dabs are turned, the column of their first tint, whether
    alpha is locked.  `period`: int64,
    the corner and the size of the cell of a layer that is repeated, of no width on others.  `ways`: as of a `Pattern`.
    """

    size: int
    numbers: Array
    plan: Array
    period: Array
    ways: Array
    told: Array


class Water(NamedTuple):
    """What lies in the squares `codes`, sorted, at the places `slots` of `slab`, float32 (k, 32, 32, 2 n + 2), n being
    a vector with its alpha: what lay there, the mean of what dabs laid, how much they cover, and how far the place is
    selected."""

    codes: Array
    slots: Array
    slab: Array


@inner_uncounted
def _around(at: Int, first: Int, period: Int) -> Int:
    return first + (at - first) % period if period else at


@inner_uncounted
def way_to(to: Array, x: float, y: float, manner: Manner) -> tuple[float, float]:
    """How far it is to a dab, in pixels of the level: on a layer that is repeated, the shortest way."""
    dx, dy = to[0] - x, to[1] - y
    if manner.period[2]:
        across, down = manner.period[2] / manner.numbers[3], manner.period[3] / manner.numbers[3]
        dx -= across * math.floor(dx / across + 0.5)
        dy -= down * math.floor(dy / down + 0.5)
    return dx, dy


@inner_uncounted
def _code(x: Int, y: Int) -> Int:
    return ((y // SIDE + HALF) << 32) + (x // SIDE + HALF)


@inner_uncounted
def _find(codes: Array, code: Int) -> Int:
    low, high = 0, codes.shape[0]
    while low < high:
        middle = (low + high) // 2
        if codes[middle] < code:
            low = middle + 1
        else:
            high = middle
    return low


@inner_uncounted
def square_of(x: Int, y: Int, manner: Manner, water: Water, known: tuple[Int, Int]) -> tuple[Int, Int, Int, Int]:
    """The square in which a pixel lies, its slot, and the row and column there; `known`: of the pixel before."""
    left, top, width, height = manner.period
    px, py = _around(x, left, width), _around(y, top, height)
    code, slot = _code(px, py), known[1]
    if code != known[0]:
        slot = water.slots[_find(water.codes, code)]
    return code, slot, py % SIDE, px % SIDE


@inner_uncounted
def reached(dab: Array, manner: Manner) -> tuple[float, float, float]:
    """Where a dab lies, and how far from there it is looked at, px."""
    scale = manner.numbers[3]
    reach = max(dab[2] * scale, THINNEST) + _RIM
    return dab[0] * scale + manner.numbers[4], dab[1] * scale + manner.numbers[5], reach


@inner_uncounted
def is_idle(dab: Array) -> bool:
    """Whether a dab lays nothing."""
    return not (dab[3] > 0.0 and dab[4] > 0.0)


@inner_uncounted
def _mark(box: tuple[float, float, float, float], period: Array, codes: Array, made: Int) -> Int:
    """Writes the codes of the squares that a box meets, as far as there is room; returns how many there are now."""
    left, top, width, height = period
    x0, y0, x1, y1 = math.floor(box[0]), math.floor(box[1]), math.ceil(box[2]), math.ceil(box[3])
    y = y0
    while y < y1:
        down = _around(y, top, height)
        x = x0
        while x < x1:
            across = _around(x, left, width)
            if made < codes.shape[0]:
                codes[made] = _code(across, down)
            made += 1
            x += min(SIDE - across % SIDE, left + width - across) if width else SIDE - across % SIDE
        y += min(SIDE - down % SIDE, top + height - down) if height else SIDE - down % SIDE
    return made


@uncounted
def squares_met(dabs: Array, manner: Manner, codes: Array) -> Int:
    """Writes the codes of the squares in which dabs lie or take up paint, some of them more than once, as far as there
    is room; returns how many there are."""
    made: Int = np.int64(0)
    each, hairs = manner.plan[0], manner.plan[1]
    for i in range(dabs.shape[0]):
        if hairs > 1:
            if i // each % hairs == 0:
                x0, y0, x1, y1, wide = _box(dabs, i, manner)
                if wide > 0.0:
                    wide += math.sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0))
                    made = _mark((x0 - wide, y0 - wide, x1 + wide, y1 + wide), manner.period, codes, made)
        elif not is_idle(dabs[i]):
            cx, cy, reach = reached(dabs[i], manner)
            reach *= FRONT + NARROW
            made = _mark((cx - reach, cy - reach, cx + reach, cy + reach), manner.period, codes, made)
    return made


@inner_uncounted
def _box(dabs: Array, first: Int, manner: Manner) -> tuple[float, float, float, float, float]:
    """Where the hairs of a tip lie, the first of them given, px, and how far beyond they reach; 0 if all are dry."""
    each, hairs = manner.plan[0], manner.plan[1]
    x, y, wide = reached(dabs[first], manner)
    x0, y0, x1, y1, wide = x, y, x, y, 0.0
    for k in range(hairs):
        dab = dabs[first + k * each]
        dx, dy = way_to(dab, dabs[first, 0], dabs[first, 1], manner)
        cx, cy, reach = x + dx * manner.numbers[3], y + dy * manner.numbers[3], reached(dab, manner)[2]
        x0, y0, x1, y1 = min(x0, cx), min(y0, cy), max(x1, cx), max(y1, cy)
        if not is_idle(dab):
            wide = max(wide, reach * (FRONT + NARROW))
    return x0, y0, x1, y1, wide


@uncounted
def fill(slab: Array, slot: Int, seen: Array, selected: Array, told: Array, vector: Array) -> None:
    """Writes what lies in a square, premultiplied float32 (4, 32, 32), and how far it is selected, (32, 32).
    `vector`, float64 (n - 1,), is written over."""
    n = slab.shape[3] // 2 - 1
    plane = slab[slot]
    for y in range(SIDE):
        for x in range(SIDE):
            alpha = min(max(float(seen[3, y, x]), 0.0), 1.0)
            pixel = plane[y, x]
            pixel[:] = np.float32(0.0)
            pixel[2 * n + 1] = selected[y, x]
            if alpha > 0.0:
                red, green, blue = seen[0, y, x] / alpha, seen[1, y, x] / alpha, seen[2, y, x] / alpha
                to_paint(red, green, blue, told, vector)
                for c in range(n - 1):
                    pixel[c] = np.float32(vector[c] * alpha)
                pixel[n - 1] = np.float32(alpha)
