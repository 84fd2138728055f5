"""The walk along a stroke: a polyline of pen points to spaced dabs."""

from __future__ import annotations

import math

import numpy as np

from engine.brush import felt
from engine.brush.dynamics import respond, response
from engine.brush.felt_dabs import (
    ROUND_COLUMNS,
    SEGMENT_CAP,
    SPACING_FLOOR,
    STEP_FLOOR,
    STROKE_CAP,
    TURNED_COLUMNS,
    walk_felt,
)
from engine.brush.samples import cleaned
from engine.brush.settings import Brush
from engine.brush.targets import COLOUR_TARGETS, FLOW, HARDNESS, OPACITY, RADIUS, SPACING
from engine.numeric.hashing import fold_key
from engine.numeric.kernel import Array, kernel
from engine.numeric.oklch import lab_of, shift_colours
from engine.numeric.stand_in import or_interpreted

DAB = ROUND_COLUMNS
_DOMAIN = 0x64616273  # "dabs"

_STARTED, _X, _Y, _PRESSURE, _LEFT, _COUNT = range(6)  # the walk's state


class Stroker:
    """Turns the points of one stroke into dabs, piece by piece.

    The path is the polyline through the points, with pressure interpolated along it.  There is a dab at the first
    point and then one after every `spacing * radius` px, both as they are at the dab before.  Adding the points in
    any portions gives the same dabs, bit for bit, as adding them at once.
    """

    def __init__(self, brush: Brush, key: int = 0) -> None:
        self._response = response(brush)
        self._felt = felt.with_hairs(felt.feeling(brush), brush, key) if felt.feels(brush) else None
        plan = np.zeros(felt.HAS_PLACE + 1, np.int64) if self._felt is None else self._felt.plan
        self._tints = int(plan[felt.HAS_TINTS])
        self._width = (TURNED_COLUMNS if plan[felt.HAS_TURNS] else DAB) + self._tints
        self._width += felt.PLACE_COLUMNS if plan[felt.HAS_PLACE] else 0
        self._plain = brush.rgb if brush.wet is not None and not set(COLOUR_TARGETS) & set(brush.dynamics) else None
        self._lab = lab_of(brush.rgb) if self._tints and self._plain is None else None
        self._key = np.uint64(key)
        self._state = np.zeros(6 if self._felt is None else felt.STATE)
        self._columns = 0  # of the points
        self.dropped = 0  # points that were no places

    def add(self, points: np.ndarray) -> np.ndarray:
        """Returns the dabs that `points`, float64 (n, 2..7): x, y, pressure, tilt_x, tilt_y, t, rotation, add.

        Returns float64 (m, 6): x, y, radius in px; opacity, flow, hardness in 0..1; (m, 9) where dabs are turned: also
        the cosine and sine of the angle, and the ratio; and then, where they have tints, red, green and blue, encoded,
        and a factor for each component of the ink.  Points that are not finite are dropped and counted; BrushError
        beyond 2^31 px.
        """
        points, dropped = cleaned(points)
        self.dropped += dropped
        return self.walk(points)

    def walk(self, points: np.ndarray) -> np.ndarray:
        """As `add`, for points float64 (n, 6..7) that are known to be good (`cleaned` would leave them as they are)."""
        points = points.view()
        points.flags.writeable = False  # as those of a recording: so the kernel is compiled once
        self._columns = max(self._columns, points.shape[1])
        return self._walked(points, False)

    @property
    def waits(self) -> bool:
        """Tells whether the first dab waits for the direction of the stroke, which has gone nowhere yet."""
        return self._felt is not None and self._state[felt.IS_BEGUN] > 0.0 and self._state[felt.IS_LAID] == 0.0

    def rest(self) -> np.ndarray:
        """Returns the dab that waits, if any, as that of a stroke that ends where it began; it goes on waiting."""
        if not self.waits:
            return np.empty((0, self._width))
        before, last = self._state, self._state[None, : self._columns].copy()
        last.flags.writeable, self._state = False, before.copy()
        dabs = self._walked(last, True)
        self._state = before
        return dabs

    def whole(self, points: np.ndarray) -> np.ndarray:
        """Returns all dabs of a stroke with these points, as `walk` wants them."""
        dabs = self.walk(points)
        return np.concatenate([dabs, self.rest()]) if self.waits else dabs

    def _walked(self, points: np.ndarray, rest: bool) -> np.ndarray:
        dabs = np.empty((4 * len(points) + 64, self._width))
        before = self._state.copy()
        count = self._count(points, dabs, rest)
        if count > len(dabs):
            dabs = np.empty((count, self._width))
            self._state = before
            self._count(points, dabs, rest)
        first = self._width - self._tints
        if self._tints and self._plain is not None:
            dabs[:count, first : first + 3] = self._plain
        if self._lab is not None:
            colours = dabs[:count, first : first + 3].copy()
            shift_colours(colours, self._lab)
            dabs[:count, first : first + 3] = colours
        return dabs[:count]

    def _count(self, points: np.ndarray, dabs: np.ndarray, rest: bool) -> int:
        if self._felt is None:
            return walk_points(points, self._state, *self._response, dabs)
        return int(walk_felt(points, self._state, self._felt, self._key, dabs, rest))


def stroke_key(seed: int, level: int, origin: tuple[int, int]) -> int:
    """Returns what the random numbers of a stroke hang on: its seed and its place."""
    return fold_key(_DOMAIN, seed, level, *origin)


@or_interpreted()
@kernel
def walk_points(
    points: Array,
    state: Array,
    values: Array,
    lo: Array,
    hi: Array,
    inputs: Array,
    outputs: Array,
    counts: Array,
    dabs: Array,
) -> int:
    """Advances `state` over the points; writes the dabs that fit into `dabs` and returns how many there are."""
    now = np.empty(values.shape[0])
    made = 0
    for i in range(points.shape[0]):
        x, y, pressure = points[i, 0], points[i, 1], points[i, 2]
        if state[_STARTED] == 0.0:
            state[_STARTED] = 1.0
            state[_X], state[_Y], state[_PRESSURE], state[_LEFT] = x, y, pressure, 0.0
            length = 0.0
        else:
            length = math.sqrt((x - state[_X]) * (x - state[_X]) + (y - state[_Y]) * (y - state[_Y]))
        floor = max(STEP_FLOOR, length / SEGMENT_CAP)
        at = state[_LEFT]
        while at <= length:  # what is left over is above 0, so a point on the spot of the last adds nothing
            part = at / length if length > 0.0 else 0.0
            force = state[_PRESSURE] + (pressure - state[_PRESSURE]) * part
            respond(values, lo, hi, inputs, outputs, counts, force, now)
            if made < dabs.shape[0]:
                dab = dabs[made]
                dab[0] = state[_X] + (x - state[_X]) * part
                dab[1] = state[_Y] + (y - state[_Y]) * part
                dab[2], dab[3], dab[4], dab[5] = now[RADIUS], now[OPACITY], now[FLOW], now[HARDNESS]
            made += 1
            state[_COUNT] += 1.0
            if state[_COUNT] > STROKE_CAP:
                floor = max(floor, length)
            at += max(floor, max(now[SPACING], SPACING_FLOOR) * now[RADIUS])
        state[_LEFT] = at - length
        state[_X], state[_Y], state[_PRESSURE] = x, y, pressure
    return made
