"""The walk along a stroke: a polyline of pen points to spaced dabs."""

from __future__ import annotations

import math

import numpy as np

from engine.brush.dynamics import FLOW, HARDNESS, OPACITY, RADIUS, SPACING, respond, response
from engine.brush.samples import cleaned
from engine.brush.settings import Brush
from engine.numeric.kernel import Array, kernel
from engine.numeric.stand_in import or_interpreted

DAB = 6  # columns: x, y, radius, opacity, flow, hardness
STEP_FLOOR = 0.25  # px
SPACING_FLOOR = 0.02  # radii: a brush of 4000 px must not lay down 16,000 discs for every one of its radii
SEGMENT_CAP = 1 << 18  # dabs between two points: farther points get wider spacing
STROKE_CAP = 1 << 22  # dabs of a stroke: after that, at most one for each point

_STARTED, _X, _Y, _PRESSURE, _LEFT, _COUNT = range(6)  # the walk's state


class Stroker:
    """Turns the points of one stroke into dabs, piece by piece.

    The path is the polyline through the points, with pressure interpolated along it.  There is a dab at the first
    point and then one after every `spacing * radius` px, both as they are at the dab before.  Adding the points in
    any portions gives the same dabs, bit for bit, as adding them at once.
    """

    def __init__(self, brush: Brush) -> None:
        self._response = response(brush)
        self._state = np.zeros(6)
        self.dropped = 0  # points that were no places

    def add(self, points: np.ndarray) -> np.ndarray:
        """Returns the dabs that `points`, float64 (n, 2..6): x, y, pressure, tilt_x, tilt_y, t, add to the stroke.

        Returns float64 (m, 6): x, y, radius in px; opacity, flow, hardness in 0..1.  Points that are not finite are
        dropped and counted; BrushError beyond 2^31 px.
        """
        points, dropped = cleaned(points)
        self.dropped += dropped
        return self.walk(points)

    def walk(self, points: np.ndarray) -> np.ndarray:
        """As `add`, for points float64 (n, 6) that are known to be good (`cleaned` would leave them as they are)."""
        points = points.view()
        points.flags.writeable = False  # as those of a recording: so the kernel is compiled once
        dabs = np.empty((4 * len(points) + 64, DAB))
        before = self._state.copy()
        count = walk_points(points, self._state, *self._response, dabs)
        if count > len(dabs):
            dabs = np.empty((count, DAB))
            self._state = before
            walk_points(points, self._state, *self._response, dabs)
        return dabs[:count]


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
