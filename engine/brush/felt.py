"""What a brush makes of all that a stroke tells at a dab: pressure, tilt, direction, speed, distance, chance.

The value of each target (module `targets`) is the brush's own times a factor for every input (module `inputs`) that it
follows, by a curve of straight lines.  Random numbers hang on the stroke's seed and place and on the number of the dab,
and are others for every target.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from immutables import Map

from engine.brush import inputs
from engine.brush.dynamics import DYNAMIC, knots_of, most_of
from engine.brush.inputs import (
    DIRECTION,
    NUMBERS,
    PEN,
    RANDOM_DAB,
    RANDOM_STROKE,
    ROTATION,
    SPEED,
    TILT,
    TILT_DIRECTION,
)
from engine.brush.settings import FIXED_TO, Brush
from engine.brush.targets import ANGLE, COLOUR_TARGETS, FOLLOWERS
from engine.brush.tip_shape import FOLLOWS, ROUND
from engine.numeric.elementary import atan, atan2, cos, mapped, sin, tan
from engine.numeric.hashing import MASK64, fold_key, mix64, mixed, uniform
from engine.numeric.kernel import Array, inner

# What a walk knows of where it is; the last point's members stand as in a table of points.
AT_X, AT_Y, AT_PRESSURE, AT_TILT_X, AT_TILT_Y, AT_TIME, AT_TURN = range(7)
IS_BEGUN, IS_LEFT, IS_LAID, IS_WAY_X, IS_WAY_Y, IS_PACE, IS_TIMED, IS_GONE = range(7, 15)
STATE = 15
HAS_FOLLOW, HAS_WAY, HAS_TURNS, HAS_COUNT, HAS_TINTS, HAS_PLACE = range(6)  # of a plan
PLACE_COLUMNS = 6  # of a dab whose textures are fixed to it: a matrix row by row, and where its middle lies in them
_ALWAYS = 1 << 40  # in place of a dab's number, of what stays all through a stroke
_SLOTS = 64  # random numbers of a dab
_LAG = 0.04  # s by which the speed lags behind
_SOFT = 0.25, 1.0, 16.0  # of a radius, and px: how gradually the direction turns
_DEGREES = 57.29577951308232
_BRUSHES = 256
_HAIRS = 0x6861697273  # "hairs"
_GOLDEN, _TURN = 0.6180339887498949, 6.283185307179586  # parts of a turn from hair to hair
_LEAST, _LARGEST = 0.7, 1.3  # hairs to the middle one
_STOUT = 0.85  # how large hairs are: those of the whole tip together cover it about once


class Feeling(NamedTuple):
    """What the walk of a brush that feels more than pressure needs to know.

    `values`, `lo`, `hi`: float64, a target each; `turns`: bool, likewise; `curves`: int64 (k, 4), target, input, first
    knot and the one after the last of `knots`, float64 (m, 2); `used`: bool, of each input; `plan`: int64, what the
    tip follows, whether the direction is looked at, whether dabs are turned, how many lie at each place, how many
    tints they have, what their textures are fixed to; `soft`: px
    over which the direction turns; `hairs`: float64 (n, 4), of each its place in the tip, size and load; `fine`: how
    large they are to the tip.
    """

    values: np.ndarray
    lo: np.ndarray
    hi: np.ndarray
    turns: np.ndarray
    curves: np.ndarray
    knots: np.ndarray
    used: np.ndarray
    plan: np.ndarray
    soft: float
    hairs: np.ndarray
    fine: float


def feels(brush: Brush) -> bool:
    """Tells whether a brush's dabs hang on more than the pen's pressure, or are more than round."""
    return (
        brush.shape != ROUND
        or brush.wet is not None
        or brush.fixed != FIXED_TO[0]
        or any(
            isinstance(curve, Mapping) or (name in FOLLOWERS and name not in DYNAMIC)
            for name, curve in brush.dynamics.items()
        )
    )


def steadied(brush: Brush) -> Brush:
    """Returns a brush with a round tip, which follows nothing but the pressure."""
    if not feels(brush):
        return brush
    kept = {name: knots_of(brush.dynamics[name]) for name in DYNAMIC if name in brush.dynamics}
    return replace(brush, shape=ROUND, dynamics=Map(kept), wet=None, fixed=FIXED_TO[0])


def is_turned(brush: Brush) -> bool:
    """Tells whether each dab is turned and squeezed in its own way."""
    own, felt = brush.shape, brush.dynamics
    if own.bristles:
        return False
    aslant = own.angle != 0.0 or own.follow != ROUND.follow or "angle" in felt
    return own.ratio != 1.0 or "ratio" in felt or (brush.tip is not None and aslant)


def tints_of(brush: Brush) -> int:
    """Returns how many tints each dab has: three of its colour, and one of each component of the ink; 0 where none of
    these follow anything, and the brush is not wet."""
    names = {*COLOUR_TARGETS, *(f"ink_{n + 1}" for n in range(len(brush.ink)))}
    own = brush.row.lays_ink and (brush.wet is not None or bool(names & set(brush.dynamics)))
    return 3 + len(brush.ink) if own else 0


def is_dyed(brush: Brush) -> bool:
    """Tells whether the ink is laid under tints: those of the dabs, or the brush's own where its textures do not lie on
    the canvas."""
    return tints_of(brush) > 0 or (is_placed(brush) and brush.row.lays_ink and bool(brush.ink))


def is_placed(brush: Brush) -> bool:
    """Tells whether each dab says where its textures lie."""
    return brush.fixed != FIXED_TO[0] and (brush.density is not None or (brush.row.lays_ink and bool(brush.ink)))


def hair_size(brush: Brush) -> float:
    """Returns how large the largest hairs of a tip may be, in its radii."""
    return fine_of(brush) * _LARGEST


def fine_of(brush: Brush) -> float:
    """Returns how large the hairs of a tip are on the whole, in its radii; 1 of a tip without."""
    count = brush.shape.bristles
    return min(1.0, _STOUT * float(np.sqrt(brush.shape.ratio / count))) if count else 1.0


def radii_around(brush: Brush) -> float:
    """Returns how many of its radii a brush's dabs reach from their places at most."""
    scatter = brush.shape.scatter * most_of(brush.dynamics.get("scatter"))
    return 1.0 + min(scatter, FOLLOWERS["scatter"].hi) + (_STOUT * _LARGEST if brush.shape.bristles else 0.0)


@lru_cache(_BRUSHES)
def feeling(brush: Brush) -> Feeling:
    """Returns what the walk needs to know of a brush: not to be written to."""
    rows: list[tuple[int, int, int, int]] = []
    knots: list[tuple[float, float]] = []
    for number, name in enumerate(FOLLOWERS):
        curve = brush.dynamics.get(name)
        if curve is None:
            continue
        for felt, given in (curve if isinstance(curve, Mapping) else {"pressure": knots_of(curve)}).items():
            rows.append((number, NUMBERS[felt], len(knots), len(knots) + len(given)))
            knots += given
    curves = np.array(rows, np.int64).reshape(-1, 4)
    used = np.zeros(len(NUMBERS), np.bool_)
    used[curves[:, 1]] = True
    plan = _plan(brush, used)
    own = [
        getattr(brush if name in DYNAMIC else brush.shape, name) if row.own is None else row.own
        for name, row in FOLLOWERS.items()
    ]
    part, least, most = _SOFT
    return Feeling(
        np.array(own, np.float64),
        np.array([row.lo for row in FOLLOWERS.values()]),
        np.array([row.hi for row in FOLLOWERS.values()]),
        np.array([row.turns for row in FOLLOWERS.values()]),
        curves,
        np.array(knots, np.float64).reshape(-1, 2),
        used,
        plan,
        min(max(part * brush.radius, least), most),
        np.empty((0, 4)),
        1.0,
    )


def _plan(brush: Brush, used: np.ndarray) -> np.ndarray:
    """Returns the `plan` of a Feeling; marks the inputs that it uses."""
    follow, turned = FOLLOWS.index(brush.shape.follow), is_turned(brush)
    place = FIXED_TO.index(brush.fixed) if is_placed(brush) else 0
    used[DIRECTION] |= follow == 1 or place == 1
    used[ROTATION] |= follow == 2
    used[TILT_DIRECTION] |= follow == 2
    looks = follow if turned or brush.shape.bristles or place == 2 else 0
    told = looks, used[DIRECTION], turned, brush.shape.count, tints_of(brush), place
    return np.array(told, np.int64)


def with_hairs(felt: Feeling, brush: Brush, key: int) -> Feeling:
    """Returns what the walk needs to know of one stroke of a brush, whose hairs lie as its `key` says."""
    count = brush.shape.bristles
    if not count:
        return felt
    turn, far, size, load = uniform(fold_key(_HAIRS, key), 4 * count).reshape(4, count)
    number = np.arange(count)
    away = np.sqrt((number + 0.25 + 0.5 * far) / count)
    angle = (number * _GOLDEN + (turn - 0.5) * 0.5) * _TURN
    places = away * mapped(cos, angle), away * mapped(sin, angle)
    hairs = np.stack([*places, _LEAST + (_LARGEST - _LEAST) * size, load], axis=1)
    return felt._replace(hairs=hairs, fine=fine_of(brush))


def plain_chance(key: int, number: int, slot: int) -> float:
    """As `chance`, of Python's integers."""
    return (mixed((int(key) ^ mixed((int(number) * _SLOTS + int(slot)) & MASK64)) & MASK64) >> 11) * 2.0**-53


@inner
def chance(key: np.uint64, number: int, slot: int) -> float:
    """A number evenly in [0, 1), of a dab and for one use."""
    h = mix64(key ^ mix64(np.uint64(number * _SLOTS + slot)))
    return float(h >> np.uint64(11)) * 2.0**-53


@inner
def sense(point: Array, state: Array, part: float, length: float, felt: Feeling, into: Array) -> None:
    """Writes every input that is used, at a part of the way to a point, into `into`; but for what is random."""
    into[inputs.PRESSURE] = state[AT_PRESSURE] + (point[AT_PRESSURE] - state[AT_PRESSURE]) * part
    if felt.used[TILT] or felt.used[TILT_DIRECTION]:
        a = tan((state[AT_TILT_X] + (point[AT_TILT_X] - state[AT_TILT_X]) * part) / _DEGREES)
        b = tan((state[AT_TILT_Y] + (point[AT_TILT_Y] - state[AT_TILT_Y]) * part) / _DEGREES)
        into[TILT] = atan(math.sqrt(a * a + b * b)) * _DEGREES
        into[TILT_DIRECTION] = turn_of(a, b)
    into[ROTATION] = 0.0
    if felt.used[ROTATION] and point.shape[0] > AT_TURN:
        away = point[AT_TURN] - state[AT_TURN]
        turned = state[AT_TURN] + (away - 360.0 * math.floor(away / 360.0 + 0.5)) * part
        into[ROTATION] = turned - 360.0 * math.floor(turned / 360.0)
    into[PEN] = into[ROTATION] if point.shape[0] > AT_TURN else into[TILT_DIRECTION]
    if felt.used[DIRECTION]:
        x, y = way_at(point, state, part * length, length, felt.soft)
        into[DIRECTION] = turn_of(x, y)
    into[SPEED] = 1.0
    if felt.used[SPEED]:
        timed, pace = pace_at(point, state, length)
        into[SPEED] = state[IS_PACE] + (pace - state[IS_PACE]) * part if timed else 1.0
    into[inputs.DISTANCE] = state[IS_GONE] + part * length


@inner
def turn_of(x: float, y: float) -> float:
    """The angle of a direction, 0..360 degrees clockwise from the right."""
    if x == 0.0 and y == 0.0:
        return 0.0
    angle = atan2(y, x) * _DEGREES
    return angle + 360.0 if angle < 0.0 else angle


@inner
def way_at(point: Array, state: Array, gone: float, length: float, soft: float) -> tuple[float, float]:
    """Where the stroke goes after a part of the way to a point: the direction turns over `soft` px."""
    if length == 0.0:
        return state[IS_WAY_X], state[IS_WAY_Y]
    x, y = (point[AT_X] - state[AT_X]) / length, (point[AT_Y] - state[AT_Y]) / length
    if state[IS_WAY_X] == 0.0 and state[IS_WAY_Y] == 0.0:
        return x, y
    part = gone / (gone + soft)
    return state[IS_WAY_X] + (x - state[IS_WAY_X]) * part, state[IS_WAY_Y] + (y - state[IS_WAY_Y]) * part


@inner
def pace_at(point: Array, state: Array, length: float) -> tuple[bool, float]:
    """Whether any time has passed in the stroke, and px a second at a point."""
    passed = point[AT_TIME] - state[AT_TIME]
    if not passed > 0.0:
        return state[IS_TIMED] > 0.0, state[IS_PACE]
    return True, state[IS_PACE] + (length / passed - state[IS_PACE]) * (passed / (passed + _LAG))


@inner
def respond_felt(felt: Feeling, sensed: Array, key: np.uint64, number: int, into: Array) -> None:
    """Writes every target at the dab of a number into `into`, each within its range."""
    into[:] = 1.0
    for k in range(felt.curves.shape[0]):
        target, source, first, last = felt.curves[k, 0], felt.curves[k, 1], felt.curves[k, 2], felt.curves[k, 3]
        value = sensed[source]
        if source == RANDOM_DAB:
            value = chance(key, number, target)
        if source == RANDOM_STROKE:
            value = chance(key, _ALWAYS, target)
        into[target] *= factor(felt.knots[first:last], value)
    for target in range(into.shape[0]):
        own = felt.values[target]
        value = own + 360.0 * (into[target] - 1.0) if felt.turns[target] else own * into[target]
        into[target] = min(max(value, felt.lo[target]), felt.hi[target])
    if felt.plan[HAS_FOLLOW] == 1:
        into[ANGLE] += sensed[DIRECTION]
    if felt.plan[HAS_FOLLOW] == 2:
        into[ANGLE] += sensed[PEN]


@inner
def factor(knots: Array, value: float) -> float:
    """What a curve through knots, float64 (n, 2), has at a value: level before the first and after the last."""
    n, k = knots.shape[0], 0
    while k < n and knots[k, 0] < value:
        k += 1
    if k == 0:
        return knots[0, 1]  # type: ignore[no-any-return]
    if k == n:
        return knots[n - 1, 1]  # type: ignore[no-any-return]
    part = (value - knots[k - 1, 0]) / (knots[k, 0] - knots[k - 1, 0])
    return knots[k - 1, 1] + (knots[k, 1] - knots[k - 1, 1]) * part  # type: ignore[no-any-return]
