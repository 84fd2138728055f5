"""The walk of strokes whose dabs hang on more than the pen's pressure; see `dabs` for that of all others.

There is a first dab as soon as the stroke's direction is known, where that counts; what never goes anywhere has it by
`rest`, with the direction to the right.
"""

from __future__ import annotations

import math

import numpy as np

from engine.brush import felt as f
from engine.brush import inputs
from engine.brush.felt import Feeling, chance, pace_at, plain_chance, respond_felt, sense, way_at
from engine.brush.targets import ANGLE, FLOW, HARDNESS, HUE, OPACITY, RADIUS, RATIO, SCATTER, SPACING
from engine.numeric.elementary import cos, sin
from engine.numeric.kernel import Array, Int, inner, kernel
from engine.numeric.stand_in import or_interpreted

STEP_FLOOR = 0.25  # px
SPACING_FLOOR = 0.02  # radii: a brush of 4000 px must not lay down 16,000 discs for every one of its radii
SEGMENT_CAP = 1 << 18  # dabs between two points: farther points get wider spacing
STROKE_CAP = 1 << 22  # dabs of a stroke: after that, at most one place for each point
ROUND_COLUMNS, TURNED_COLUMNS = 6, 9  # columns: x, y, radius, opacity, flow, hardness; cosine, sine of its angle, ratio
_ASIDE, _AWAY = 32, 33  # slots of random numbers
_STREAKS, _MOST_HAIRS = 1 << 41, 256  # numbers of what streaks hang on
_STREAK = 5.0  # radii along a streak
_OWN, _WET, _SHARP = 0.6, 1.0, 2.5  # of a hair: how much its load counts beside streaks; when it is dry
_TURN = 6.283185307179586
_PATCH, _FAR = 1 << 42, 8192.0  # number of what the place of textures hangs on; px
_DEGREE = 0.017453292519943295


@inner
def _tint(felt: Feeling, now: Array, dab: Array) -> None:
    """Writes the tints of a dab, its last columns: turn of the hue in degrees, factors of lightness, chroma, inks."""
    first = dab.shape[0] - felt.plan[f.HAS_TINTS]
    for k in range(felt.plan[f.HAS_TINTS]):
        dab[first + k] = now[HUE + k]


@inner
def _locate(felt: Feeling, key: np.uint64, sensed: Array, now: Array, aside: tuple[float, float], dab: Array) -> None:
    """Writes where the textures of a dab lie that are fixed to the stroke, or to the dab: what brings a place of it,
    from its middle, into them.  `aside`: how far it lies from the place that is theirs."""
    if not felt.plan[f.HAS_PLACE]:
        return
    first = dab.shape[0] - felt.plan[f.HAS_TINTS] - f.PLACE_COLUMNS
    along, turn = 0.0, now[ANGLE]
    if felt.plan[f.HAS_PLACE] == 1:
        along, turn = sensed[inputs.DISTANCE], sensed[inputs.DIRECTION]
    angle = (turn - 360.0 * math.floor(turn / 360.0)) * _DEGREE
    c, s = cos(angle), sin(angle)
    dab[first], dab[first + 1], dab[first + 2], dab[first + 3] = c, s, -s, c
    u, v = c * aside[0] + s * aside[1], c * aside[1] - s * aside[0]
    dab[first + 4] = u + along + math.floor(chance(key, _PATCH, 0) * _FAR)
    dab[first + 5] = v + math.floor(chance(key, _PATCH, 1) * _FAR)


@inner
def _write(x: float, y: float, felt: Feeling, now: Array, dab: Array) -> None:
    dab[0], dab[1] = x, y
    dab[2], dab[3], dab[4], dab[5] = now[RADIUS], now[OPACITY], now[FLOW], now[HARDNESS]
    _tint(felt, now, dab)
    if felt.plan[f.HAS_TURNS]:
        angle = (now[ANGLE] - 360.0 * math.floor(now[ANGLE] / 360.0)) * _DEGREE
        dab[6], dab[7], dab[8] = cos(angle), sin(angle), now[RATIO]


@inner
def _write_hairs(
    x: float,
    y: float,
    felt: Feeling,
    key: np.uint64,
    sensed: Array,
    aside: tuple[float, float],
    now: Array,
    dabs: Array,
    made: Int,
) -> Int:
    """Writes a dab for each hair; returns how many there are now.

    The paint runs along the stroke: a hair lays as much as the brush can while it is wet, which it is the longer the
    more it was loaded with, and less and more by turns; as many are wet as the opacity is of the brush's own.
    """
    angle = (now[ANGLE] - 360.0 * math.floor(now[ANGLE] / 360.0)) * _DEGREE
    across, down, most = now[RADIUS] * cos(angle), now[RADIUS] * sin(angle), felt.values[OPACITY]
    wet = _WET * now[OPACITY] / most if most > 0.0 else 0.0
    along = sensed[inputs.DISTANCE] / (_STREAK * max(felt.values[RADIUS], 1.0))
    streak = math.floor(along)
    part = along - streak
    part = part * part * (3.0 - 2.0 * part)
    for k in range(felt.hairs.shape[0]):
        if made < dabs.shape[0]:
            dab, hair = dabs[made], felt.hairs[k]
            low = chance(key, _STREAKS + int(streak) * _MOST_HAIRS + k, 0)
            high = chance(key, _STREAKS + (int(streak) + 1) * _MOST_HAIRS + k, 0)
            dry = _OWN * (1.0 - hair[3]) + (1.0 - _OWN) * (low + (high - low) * part)
            dab[0] = x + across * hair[0] - down * hair[1] * now[RATIO]
            dab[1] = y + down * hair[0] + across * hair[1] * now[RATIO]
            dab[2], dab[3] = now[RADIUS] * felt.fine * hair[2], most * min(1.0, max(0.0, (wet - dry) * _SHARP))
            dab[4], dab[5] = now[FLOW], now[HARDNESS]
            _tint(felt, now, dab)
            _locate(felt, key, sensed, now, (aside[0] + dab[0] - x, aside[1] + dab[1] - y), dab)
        made += 1
    return made


@inner
def _place(
    point: Array,
    state: Array,
    part: float,
    felt: Feeling,
    key: np.uint64,
    sensed: Array,
    now: Array,
    dabs: Array,
    made: Int,
) -> tuple[Int, float]:
    """Writes the dabs of one place; returns how many there are now, and how far it is to the next place."""
    x, y = (
        state[f.AT_X] + (point[f.AT_X] - state[f.AT_X]) * part,
        state[f.AT_Y] + (point[f.AT_Y] - state[f.AT_Y]) * part,
    )
    first, step = int(state[f.IS_LAID]) * felt.plan[f.HAS_COUNT], 0.0
    for k in range(felt.plan[f.HAS_COUNT]):
        sensed[inputs.DAB_NUMBER] = float(first + k)
        respond_felt(felt, sensed, key, first + k, now)
        if k == 0:
            step = max(now[SPACING], SPACING_FLOOR) * now[RADIUS] * felt.fine
        dx, dy = 0.0, 0.0
        if now[SCATTER] > 0.0:
            aside = chance(key, first + k, _ASIDE) * _TURN
            away = math.sqrt(chance(key, first + k, _AWAY)) * now[SCATTER] * now[RADIUS]
            dx, dy = away * cos(aside), away * sin(aside)
        own = (dx, dy) if felt.plan[f.HAS_PLACE] == 1 else (0.0, 0.0)
        if felt.hairs.shape[0] > 0:
            made = _write_hairs(x + dx, y + dy, felt, key, sensed, own, now, dabs, made)
            continue
        if made < dabs.shape[0]:
            _write(x + dx, y + dy, felt, now, dabs[made])
            _locate(felt, key, sensed, now, own, dabs[made])
        made += 1
    return made, step


@inner
def _stand(point: Array, state: Array) -> None:
    """The point becomes the last one."""
    for column in range(min(point.shape[0], f.AT_TURN + 1)):
        state[column] = point[column]


@inner
def _go_on(point: Array, state: Array, length: float, felt: Feeling) -> None:
    """The walk has come to a point."""
    x, y = way_at(point, state, length, length, felt.soft)
    timed, pace = pace_at(point, state, length)
    state[f.IS_WAY_X], state[f.IS_WAY_Y], state[f.IS_PACE] = x, y, pace
    state[f.IS_TIMED] = 1.0 if timed else 0.0
    state[f.IS_GONE] += length
    _stand(point, state)


@or_interpreted(chance=plain_chance)
@kernel
def walk_felt(points: Array, state: Array, felt: Feeling, key: np.uint64, dabs: Array, rest: bool) -> Int:
    """Advances `state` over the points; writes the dabs that fit into `dabs` and returns how many there are.

    `rest`: no more comes, so that a dab that still waits for its direction is laid without.
    """
    now, sensed = np.empty(felt.values.shape[0]), np.zeros(felt.used.shape[0] + 1)
    made: Int = np.int64(0)  # a constant would have what takes it compiled for that, too
    each = felt.plan[f.HAS_COUNT] * max(1, felt.hairs.shape[0])
    for i in range(points.shape[0]):
        point = points[i]
        if state[f.IS_BEGUN] == 0.0:
            _stand(point, state)
            state[f.IS_BEGUN] = 1.0
        length = math.sqrt(
            (point[0] - state[0]) * (point[0] - state[0]) + (point[1] - state[1]) * (point[1] - state[1])
        )
        waits = state[f.IS_LAID] == 0.0 and felt.plan[f.HAS_WAY] and length == 0.0 and not rest
        floor = max(STEP_FLOOR, length * each / SEGMENT_CAP)
        at = state[f.IS_LEFT]
        while at <= length and not waits:
            part = at / length if length > 0.0 else 0.0
            sense(point, state, part, length, felt, sensed)
            made, step = _place(point, state, part, felt, key, sensed, now, dabs, made)
            state[f.IS_LAID] += 1.0
            if state[f.IS_LAID] * each > STROKE_CAP:
                floor = max(floor, length)
            at += max(floor, step)
        state[f.IS_LEFT] = at if waits else at - length
        _go_on(point, state, length, felt)
    return made
