"""Kernels of wet brushes: each dab takes up what lies under it, mixes it with its load, and is laid.

They see the painting in pixels so coarse that a dab is a few of them wide, in squares of 32 x 32: of each pixel what
lay there before the stroke, and what its dabs have laid since, by the rules of `mask` and `tinting`.  So a dab costs as
much whatever its size.  One dab follows another in a fixed order: the bits do not hang on how many come at once.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from engine.brush.prints import onto_round
from engine.numeric.elementary import exp2
from engine.numeric.kernel import Array, Int, inner_uncounted, kernel, uncounted
from engine.numeric.pigment import LIGHT, from_paint, to_paint

SIDE = 32
HALF = 1 << 30  # added to the coordinates of squares, so that codes are positive
_LOW = (1 << 32) - 1
_THINNEST = 0.75  # px: half the breadth of what is looked at, at least
_RIM = 0.5  # px
_FRONT, _NARROW, _LEAST_REACH = 1.0, 0.6, 1.25  # of a radius: how far ahead paint is taken up; how far around; px
BEGUN, AT_X, AT_Y, CARRIED = range(4)  # of a state; from CARRIED on what is carried, and its alpha
WAY_X, WAY_Y, FRONT = range(3, 6)  # of a tip of hairs, after where it is
TIP = 6


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
def _way(to: Array, x: float, y: float, manner: Manner) -> tuple[float, float]:
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
def _place_of(x: Int, y: Int, manner: Manner, water: Water, known: tuple[Int, Int]) -> tuple[Int, Int, Int, Int]:
    """The square in which a pixel lies, its slot, and the row and column there; `known`: of the pixel before."""
    left, top, width, height = manner.period
    px, py = _around(x, left, width), _around(y, top, height)
    code, slot = _code(px, py), known[1]
    if code != known[0]:
        slot = water.slots[_find(water.codes, code)]
    return code, slot, py % SIDE, px % SIDE


@inner_uncounted
def _reached(dab: Array, manner: Manner) -> tuple[float, float, float]:
    """Where a dab lies, and how far from there it is looked at, px."""
    scale = manner.numbers[3]
    reach = max(dab[2] * scale, _THINNEST) + _RIM
    return dab[0] * scale + manner.numbers[4], dab[1] * scale + manner.numbers[5], reach


@inner_uncounted
def _idle(dab: Array) -> bool:
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
        elif not _idle(dabs[i]):
            cx, cy, reach = _reached(dabs[i], manner)
            reach *= _FRONT + _NARROW
            made = _mark((cx - reach, cy - reach, cx + reach, cy + reach), manner.period, codes, made)
    return made


@inner_uncounted
def _box(dabs: Array, first: Int, manner: Manner) -> tuple[float, float, float, float, float]:
    """Where the hairs of a tip lie, the first of them given, px, and how far beyond they reach; 0 if all are dry."""
    each, hairs = manner.plan[0], manner.plan[1]
    x, y, wide = _reached(dabs[first], manner)
    x0, y0, x1, y1, wide = x, y, x, y, 0.0
    for k in range(hairs):
        dab = dabs[first + k * each]
        dx, dy = _way(dab, dabs[first, 0], dabs[first, 1], manner)
        cx, cy, reach = x + dx * manner.numbers[3], y + dy * manner.numbers[3], _reached(dab, manner)[2]
        x0, y0, x1, y1 = min(x0, cx), min(y0, cy), max(x1, cx), max(y1, cy)
        if not _idle(dab):
            wide = max(wide, reach * (_FRONT + _NARROW))
    return x0, y0, x1, y1, wide


@kernel
def fill(slab: Array, slot: Int, seen: Array, selected: Array, told: Array) -> None:
    """Writes what lies in a square, premultiplied float32 (4, 32, 32), and how far it is selected, (32, 32)."""
    n = slab.shape[3] // 2 - 1
    vector = np.empty(n - 1)
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


@inner_uncounted
def _matrix(dab: Array, number: Int, manner: Manner, radius: float) -> tuple[float, float, float, float]:
    """What brings a place of the dab onto the round tip."""
    if not manner.plan[2]:
        return 1.0, 0.0, 0.0, 1.0
    each = manner.plan[0]
    way = manner.ways[number % each * manner.ways.shape[0] // each]
    return onto_round(dab[6:], way, max(dab[8], min(1.0, _THINNEST / max(radius, _THINNEST))))


@inner_uncounted
def _look(place: tuple[float, float, float], matrix: tuple[float, float, float, float], manner: Manner, water: Water,
          seen: Array) -> None:  # fmt: skip
    """Writes the mean of what a dab meets, a vector with its alpha, into `seen`: the middle counts most."""
    cx, cy, reach = place
    n = seen.shape[0]
    seen[:] = 0.0
    total = 0.0
    last: Int = np.int64(-1)
    slot: Int = np.int64(0)
    locked = manner.plan[4] != 0
    for y in range(math.floor(cy - reach), math.ceil(cy + reach)):
        for x in range(math.floor(cx - reach), math.ceil(cx + reach)):
            dx, dy = x + 0.5 - cx, y + 0.5 - cy
            u, v = matrix[0] * dx + matrix[1] * dy, matrix[2] * dx + matrix[3] * dy
            weight = 1.0 - (u * u + v * v) / (reach * reach)
            if weight <= 0.0:
                continue
            last, slot, row, column = _place_of(x, y, manner, water, (last, slot))
            pixel = water.slab[slot, row, column]
            laid, alpha = float(pixel[2 * n]) * pixel[2 * n + 1], float(pixel[n - 1])
            total += weight
            kept = 1.0 - laid * pixel[2 * n - 1]
            laid = laid * alpha if locked else laid
            for c in range(n - 1):
                seen[c] += weight * (kept * pixel[c] + laid * pixel[n + c])
            seen[n - 1] += weight * (alpha if locked else kept * alpha + laid * pixel[2 * n - 1])
    for c in range(n):
        seen[c] /= total


@inner_uncounted
def _lay(dab: Array, place: tuple[float, float, float], matrix: tuple[float, float, float, float], manner: Manner,
         water: Water, vector: Array) -> None:  # fmt: skip
    """Lays a dab of a vector with its alpha."""
    cx, cy, reach = place
    n = vector.shape[0]
    own = dab[2] * manner.numbers[3]
    radius = max(own, 0.5)
    inside = max(0.0, min(dab[5] * radius, radius - 0.5))
    outer = radius + 0.5
    spread = 1.0 / (outer * outer - inside * inside)
    ceiling, rate = dab[3] * min(1.0, 4.0 * own * own), dab[4]
    last: Int = np.int64(-1)
    slot: Int = np.int64(0)
    for y in range(math.floor(cy - reach), math.ceil(cy + reach)):
        for x in range(math.floor(cx - reach), math.ceil(cx + reach)):
            dx, dy = x + 0.5 - cx, y + 0.5 - cy
            u, v = matrix[0] * dx + matrix[1] * dy, matrix[2] * dx + matrix[3] * dy
            part = 1.0 - max(0.0, min(1.0, (u * u + v * v - inside * inside) * spread))
            profile = rate * (part * part * (3.0 - 2.0 * part))
            if profile <= 0.0:
                continue
            last, slot, row, column = _place_of(x, y, manner, water, (last, slot))
            pixel = water.slab[slot, row, column]
            before = float(pixel[2 * n])
            covered = before + max(0.0, ceiling - before) * profile
            strength = ceiling * profile
            share = min(strength / max(covered, strength), 1.0)
            pixel[2 * n] = np.float32(covered)
            for c in range(n):
                pixel[n + c] += np.float32((vector[c] - pixel[n + c]) * share)


@inner_uncounted
def _ahead(
    dab: Array, state: Array, matrix: tuple[float, float, float, float], manner: Manner
) -> tuple[float, float, float]:
    """Where a dab takes up paint, and how far around, px: at its front, where it has not been yet."""
    cx, cy, reach = _reached(dab, manner)
    if state[BEGUN] == 0.0:
        return cx, cy, reach
    dx, dy = _way(dab, state[AT_X], state[AT_Y], manner)
    u, v = matrix[0] * dx + matrix[1] * dy, matrix[2] * dx + matrix[3] * dy
    far = math.sqrt(u * u + v * v)
    if far == 0.0:
        return cx, cy, reach
    part = _FRONT * dab[2] * manner.numbers[3] / far
    return cx + dx * part, cy + dy * part, max(reach * _NARROW, _LEAST_REACH)


@inner_uncounted
def _turn_tip(dabs: Array, first: Int, manner: Manner, tip: Array) -> None:
    """Finds which way a tip of hairs goes, and how far its front is from its middle that way, px."""
    each, hairs = manner.plan[0], manner.plan[1]
    x, y = dabs[first, 0], dabs[first, 1]
    across, down = 0.0, 0.0
    for k in range(hairs):
        dx, dy = _way(dabs[first + k * each], x, y, manner)
        across, down = across + dx, down + dy
    dx, dy = _way(dabs[first], tip[AT_X], tip[AT_Y], manner)
    dx, dy = dx + across / hairs, dy + down / hairs
    far = math.sqrt(dx * dx + dy * dy)
    if tip[BEGUN] > 0.0 and far > 0.0:
        tip[WAY_X], tip[WAY_Y] = dx / far, dy / far
    tip[BEGUN], tip[AT_X], tip[AT_Y], tip[FRONT] = 1.0, x + across / hairs, y + down / hairs, -math.inf
    for k in range(hairs):
        dx, dy = _way(dabs[first + k * each], tip[AT_X], tip[AT_Y], manner)
        tip[FRONT] = max(tip[FRONT], dx * tip[WAY_X] + dy * tip[WAY_Y])


@inner_uncounted
def _before_tip(dab: Array, tip: Array, manner: Manner) -> tuple[float, float, float]:
    """Where a hair takes up paint, and how far around, px: on its way, towards the front of the whole
    tip; the nearer to itself the less paint of its own it has, so that what it smears stays where it was."""
    cx, cy, reach = _reached(dab, manner)
    dx, dy = _way(dab, tip[AT_X], tip[AT_Y], manner)
    ahead = (tip[FRONT] - (dx * tip[WAY_X] + dy * tip[WAY_Y])) * (1.0 - manner.numbers[1] * manner.numbers[1])
    if tip[WAY_X] != 0.0 or tip[WAY_Y] != 0.0:
        ahead += _FRONT * dab[2]
    ahead *= manner.numbers[3]
    return cx + ahead * tip[WAY_X], cy + ahead * tip[WAY_Y], max(reach * _NARROW, _LEAST_REACH)


@inner_uncounted
def _carry(state: Array, dab: Array, seen: Array, manner: Manner) -> None:
    """What is carried fades on the way, and what is seen takes its place."""
    kept = 0.0
    if state[BEGUN] > 0.0:
        dx, dy = _way(dab, state[AT_X], state[AT_Y], manner)
        way = math.sqrt(dx * dx + dy * dy) * manner.numbers[6] / max(dab[2], 0.25)
        kept = exp2(max(manner.numbers[0] * way, -64.0))
    state[BEGUN], state[AT_X], state[AT_Y] = 1.0, dab[0], dab[1]
    for c in range(seen.shape[0]):
        state[CARRIED + c] = seen[c] + (state[CARRIED + c] - seen[c]) * kept


@inner_uncounted
def _mix(state: Array, load: Array, manner: Manner, vector: Array) -> float:
    """Writes what a dab lays of what is carried and of its load; returns how much of that is load.  Where there is
    little to carry, the load stands in, the more it counts beside that."""
    size, amount = manner.size, manner.numbers[1]
    there = state[CARRIED + size]
    own = (1.0 - amount) * there + (1.0 - amount * amount * amount) * (1.0 - there)
    own *= 1.0 - manner.numbers[2]
    for c in range(size):
        vector[c] = amount * state[CARRIED + c] + own * load[c]
    vector[size] = amount * there + own
    return own  # type: ignore[no-any-return]


@inner_uncounted
def _tell(vector: Array, manner: Manner, row: Array) -> None:
    """Writes the colour of what is laid, premultiplied, and its alpha, into a row's first numbers and its last."""
    size = manner.size
    alpha = vector[size]
    row[0], row[1], row[2], row[row.shape[0] - 1] = 0.0, 0.0, 0.0, alpha
    if alpha > 0.0:
        red, green, blue = from_paint(vector[:size], manner.told)
        part = alpha if size != LIGHT else 1.0
        row[0], row[1], row[2] = red * part, green * part, blue * part


@uncounted
def soak(
    dabs: Array,
    laid: Int,
    manner: Manner,
    going: tuple[Array, Array],
    water: Water,
    scratch: tuple[Array, Array, Array],
    out: Array,
) -> None:
    """Lays dabs, float64 (m, k), after `laid` others, in order, all hairs of a tip at once.  States go along: of each
    hair, or of the tip, in each copy, float64 (hairs times copies, 3 + n), and of tips, float64 (copies, 6).

    Writes what becomes of their tints into `out`, float64 (m, tints + 1): the colour that each lays, premultiplied, its
    amounts of ink, and how much of what it covers is paint.  `scratch`: float64 (n,), (n,) and (n - 1,), written over.
    """
    each, hairs, first = manner.plan[0], manner.plan[1], manner.plan[3]
    copies = manner.ways.shape[0]
    around = each // copies
    seen, vector, load = scratch
    states, tips = going
    for i in range(dabs.shape[0]):
        number = laid + i
        dab = dabs[i]
        if number % around != around // 2:
            continue
        if hairs > 1 and number // each % hairs == 0:
            _turn_tip(dabs, i, manner, tips[number % each // around])
        if _idle(dab):
            continue
        state = states[number // each % hairs * copies + number % each // around]
        matrix = _matrix(dab, number, manner, dab[2] * manner.numbers[3])
        if hairs > 1:
            place = _before_tip(dab, tips[number % each // around], manner)
        else:
            place = _ahead(dab, state, matrix, manner)
        _look(place, matrix, manner, water, seen)
        _carry(state, dab, seen, manner)
        to_paint(dab[first], dab[first + 1], dab[first + 2], manner.told, load)
        own = _mix(state, load, manner, vector)
        _lay(dab, _reached(dab, manner), matrix, manner, water, vector)
        row = out[i]
        _tell(vector, manner, row)
        for c in range(3, row.shape[0] - 1):
            row[c] = own * dab[first + c]
        for k in range(around):
            for c in range(row.shape[0]):
                out[i - around // 2 + k, c] = row[c]
