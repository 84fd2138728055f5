"""Kernels of wet brushes: each dab takes up what lies under it, mixes it with its load, and is laid.

They see the painting in pixels so coarse that a dab is a few of them wide (module `wet_squares`): of each pixel what
lay there before the stroke, and what its dabs have laid since, by the rules of `mask` and `tinting`.  So a dab costs as
much whatever its size.  One dab follows another in a fixed order: the bits do not hang on how many come at once.
"""

from __future__ import annotations

import math

import numpy as np

from engine.brush.prints import onto_round
from engine.brush.wet_squares import FRONT, NARROW, THINNEST, Manner, Water, is_idle, reached, square_of, way_to
from engine.numeric.elementary import exp2
from engine.numeric.kernel import Array, Int, inner_uncounted, uncounted
from engine.numeric.pigment import LIGHT, from_paint, to_paint

BEGUN, AT_X, AT_Y, CARRIED = range(4)  # of a state; from CARRIED on what is carried, and its alpha
WAY_X, WAY_Y, TIP_FRONT = range(3, 6)  # of a tip of hairs, after where it is
TIP = 6
_LEAST_REACH = 1.25  # px: how far around paint is taken up
_MIDDLE = 0.01  # what the pixel in the middle counts at least


@inner_uncounted
def _matrix(dab: Array, number: Int, manner: Manner, radius: float) -> tuple[float, float, float, float]:
    """What brings a place of the dab onto the round tip."""
    if not manner.plan[2]:
        return 1.0, 0.0, 0.0, 1.0
    each = manner.plan[0]
    way = manner.ways[number % each * manner.ways.shape[0] // each]
    return onto_round(dab[6:], way, max(dab[8], min(1.0, THINNEST / max(radius, THINNEST))))


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
            if abs(dx) <= 0.5 and abs(dy) <= 0.5:
                weight = max(weight, _MIDDLE)  # a slender tip may miss the middle of every pixel
            if weight <= 0.0:
                continue
            last, slot, row, column = square_of(x, y, manner, water, (last, slot))
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
            last, slot, row, column = square_of(x, y, manner, water, (last, slot))
            pixel = water.slab[slot, row, column]
            before = float(pixel[2 * n])
            covered = before + max(0.0, ceiling - before) * profile
            strength = ceiling * profile
            if strength <= 0.0:
                continue
            share = min(strength / max(covered, strength), 1.0)
            pixel[2 * n] = np.float32(covered)
            for c in range(n):
                pixel[n + c] += np.float32((vector[c] - pixel[n + c]) * share)


@inner_uncounted
def _ahead(
    dab: Array, state: Array, matrix: tuple[float, float, float, float], manner: Manner
) -> tuple[float, float, float]:
    """Where a dab takes up paint, and how far around, px: at its front, where it has not been yet."""
    cx, cy, reach = reached(dab, manner)
    if state[BEGUN] == 0.0:
        return cx, cy, reach
    dx, dy = way_to(dab, state[AT_X], state[AT_Y], manner)
    u, v = matrix[0] * dx + matrix[1] * dy, matrix[2] * dx + matrix[3] * dy
    far = math.sqrt(u * u + v * v)
    if far == 0.0:
        return cx, cy, reach
    part = FRONT * dab[2] * manner.numbers[3] / far
    return cx + dx * part, cy + dy * part, max(reach * NARROW, _LEAST_REACH)


@inner_uncounted
def _turn_tip(dabs: Array, first: Int, manner: Manner, tip: Array) -> None:
    """Finds which way a tip of hairs goes, and how far its front is from its middle that way, px."""
    each, hairs = manner.plan[0], manner.plan[1]
    x, y = dabs[first, 0], dabs[first, 1]
    across, down = 0.0, 0.0
    for k in range(hairs):
        dx, dy = way_to(dabs[first + k * each], x, y, manner)
        across, down = across + dx, down + dy
    dx, dy = way_to(dabs[first], tip[AT_X], tip[AT_Y], manner)
    dx, dy = dx + across / hairs, dy + down / hairs
    far = math.sqrt(dx * dx + dy * dy)
    if tip[BEGUN] > 0.0 and far > 0.0:
        tip[WAY_X], tip[WAY_Y] = dx / far, dy / far
    tip[BEGUN], tip[AT_X], tip[AT_Y], tip[TIP_FRONT] = 1.0, x + across / hairs, y + down / hairs, -math.inf
    for k in range(hairs):
        dx, dy = way_to(dabs[first + k * each], tip[AT_X], tip[AT_Y], manner)
        tip[TIP_FRONT] = max(tip[TIP_FRONT], dx * tip[WAY_X] + dy * tip[WAY_Y])


@inner_uncounted
def _before_tip(dab: Array, tip: Array, manner: Manner) -> tuple[float, float, float]:
    """Where a hair takes up paint, and how far around, px: on its way, towards the front of the whole
    tip; the nearer to itself the less paint of its own it has, so that what it smears stays where it was."""
    cx, cy, reach = reached(dab, manner)
    dx, dy = way_to(dab, tip[AT_X], tip[AT_Y], manner)
    ahead = (tip[TIP_FRONT] - (dx * tip[WAY_X] + dy * tip[WAY_Y])) * (1.0 - manner.numbers[1] * manner.numbers[1])
    if tip[WAY_X] != 0.0 or tip[WAY_Y] != 0.0:
        ahead += FRONT * dab[2]
    ahead *= manner.numbers[3]
    return cx + ahead * tip[WAY_X], cy + ahead * tip[WAY_Y], max(reach * NARROW, _LEAST_REACH)


@inner_uncounted
def _carry(state: Array, dab: Array, seen: Array, manner: Manner) -> None:
    """What is carried fades on the way, and what is seen takes its place."""
    kept = 0.0
    if state[BEGUN] > 0.0:
        dx, dy = way_to(dab, state[AT_X], state[AT_Y], manner)
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
    there, square = state[CARRIED + size], amount * amount
    own = (1.0 - amount) * there + (1.0 - square * square * square * square) * (1.0 - there)
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
        if is_idle(dab):
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
        _lay(dab, reached(dab, manner), matrix, manner, water, vector)
        row = out[i]
        _tell(vector, manner, row)
        for c in range(3, row.shape[0] - 1):
            row[c] = own * dab[first + c]
        for k in range(around):
            for c in range(row.shape[0]):
                out[i - around // 2 + k, c] = row[c]
