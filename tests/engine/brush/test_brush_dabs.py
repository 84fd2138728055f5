"""The walk along a stroke, and the curves of pressure."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.checks import BrushError
from engine.brush.dabs import SEGMENT_CAP, STROKE_CAP, Stroker
from engine.brush.dynamics import evaluate, knots_of, respond, response
from engine.brush.samples import cleaned
from engine.brush.settings import Brush, from_json

POINTS = st.lists(st.tuples(st.floats(-200, 200), st.floats(-200, 200), st.floats(0, 1)), min_size=1, max_size=25).map(
    np.array
)
BRUSHES = st.builds(
    lambda radius, spacing, curve: from_json({"radius": radius, "spacing": spacing, "dynamics": curve}),
    st.floats(0, 60),
    st.floats(0, 3),
    st.sampled_from([{}, {"radius": "pressure"}, {"radius": [[0.2, 0.1], [0.5, 1], [0.9, 3]], "spacing": "pressure"}]),
)


def plain_curve(curve, pressure):
    """The straight line between the knots to both sides of a pressure."""
    knots = knots_of(curve)
    if pressure <= knots[0][0] or pressure > knots[-1][0]:
        return knots[0 if pressure <= knots[0][0] else -1][1]
    (a, low), (b, high) = next(pair for pair in pairwise(knots) if pressure <= pair[1][0])
    return low + (high - low) * ((pressure - a) / (b - a))


def plain_walk(brush, points):
    """The walk as the module's documentation tells it, dab by dab.

    Its sums are in the kernel's order: where spacing grows with pressure, a dab's error is a larger one in the next.
    """
    dabs, left, before = [], 0.0, None

    def value(name, pressure):
        factor = plain_curve(brush.dynamics.get(name), pressure)
        hi = 4000.0 if name == "radius" else 16.0 if name == "spacing" else 1.0
        return min(getattr(brush, name) * factor, hi)

    for point in points:
        start = before if before is not None else point
        dx, dy = point[0] - start[0], point[1] - start[1]
        length = math.sqrt(dx * dx + dy * dy)
        at = left
        while at <= length:
            part = at / length if length else 0.0
            x, y, p = (a + (b - a) * part for a, b in zip(start, point, strict=True))
            dabs.append([x, y, *(value(n, p) for n in ("radius", "opacity", "flow", "hardness"))])
            at += max(0.25, max(value("spacing", p), 0.02) * dabs[-1][2])
        left, before = at - length, point
    return np.array(dabs)


@settings(deadline=None, max_examples=80)
@given(BRUSHES, POINTS)
def test_the_walk_is_the_plain_one(brush, points):
    dabs = Stroker(brush).add(points)
    expected = plain_walk(brush, points)
    assert dabs.shape == expected.shape
    np.testing.assert_array_equal(dabs, expected)


@settings(deadline=None, max_examples=80)
@given(BRUSHES, POINTS, st.lists(st.integers(0, 25), max_size=6))
def test_any_portions_give_the_same_dabs_bit_for_bit(brush, points, cuts):
    whole = Stroker(brush).add(points)
    stroker = Stroker(brush)
    parts = [stroker.add(part) for part in np.split(points, sorted(min(c, len(points)) for c in cuts))]
    assert np.concatenate(parts).tobytes() == whole.tobytes()


def test_spacing_is_in_radii_and_carries_over():
    brush = from_json({"radius": 10, "spacing": 0.5, "dynamics": {}})
    dabs = Stroker(brush).add(np.array([[0.0, 0], [7, 0], [7, 0], [20, 0]]))
    np.testing.assert_allclose(dabs[:, 0], [0, 5, 10, 15, 20])
    assert (dabs[:, 2] == 10).all()


def test_one_point_makes_one_dab():
    stroker = Stroker(Brush())
    assert len(stroker.add(np.array([(3.0, 4.0, 0.5, 0.0, 0.0, 0.0)]))) == 1
    assert len(stroker.add(np.array([(3.0, 4.0, 1.0, 0.0, 0.0, 0.0)]))) == 0
    assert len(stroker.add(np.empty((0, 6)))) == 0


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.tuples(st.integers(0, 50), st.floats(0, 16)), min_size=1, max_size=8, unique_by=lambda k: k[0]),
    st.lists(st.floats(0, 1), min_size=1, max_size=20),
)
def test_curves_are_piecewise_linear(knots, pressures):
    curve = tuple(sorted((x / 50, y) for x, y in knots))
    brush = from_json({"radius": 2, "dynamics": {"radius": [list(k) for k in curve], "opacity": "pressure"}})
    now = np.empty(5)
    for pressure in [*pressures, 0.0, 1.0, curve[0][0], curve[-1][0]]:
        respond(*response(brush), pressure, now)
        assert now[0] == pytest.approx(2 * evaluate(curve, np.array(pressure)), rel=1e-12)
        assert now[1] == pressure
        assert now[2] == 1.0


def test_named_and_absent_curves():
    p = np.linspace(0, 1, 7)
    assert (evaluate("pressure", p) == p).all()
    assert (evaluate(None, p) == 1).all()
    assert knots_of(((0.0, 2.0),)) == ((0.0, 2.0),)


def test_settings_driven_out_of_range_stay_in_range():
    brush = from_json({"radius": 4000, "dynamics": {"radius": [[0, 16]], "flow": [[0, 16]], "hardness": [[0, 2]]}})
    assert Stroker(brush).add(np.array([[0.0, 0]])).tolist() == [[0, 0, 4000, 1, 1, 1]]


HOSTILE = [
    ([[math.nan, 0, 1]], 0, 1),
    ([[0, math.inf, 1]], 0, 1),
    ([[0, 0, math.nan]], 0, 1),
    ([[0, 0, math.inf]], 1, 0),
    ([[0, 0, -5]], 1, 0),
    ([[-0.0, 5e-324, 2]], 1, 0),
    ([[0, 0, 1, math.nan, -1e9, math.inf]], 1, 0),
    ([[0, 0, 1], [math.nan, 1, 1], [1, 1, 1]], 2, 1),
]


@pytest.mark.parametrize(("points", "kept", "dropped"), HOSTILE)
def test_hostile_points(points, kept, dropped):
    table, gone = cleaned(np.array(points, float))
    assert (len(table), gone) == (kept, dropped)
    assert np.isfinite(table).all()
    assert ((table[:, 2] >= 0) & (table[:, 2] <= 1)).all()
    stroker = Stroker(Brush())
    stroker.add(np.array(points, float))
    assert stroker.dropped == dropped


@pytest.mark.parametrize("far", [2.0**31 + 1, -1e308, 1e10])
def test_points_too_far_away_are_refused(far):
    with pytest.raises(BrushError, match="from the origin"):
        Stroker(Brush()).add(np.array([[0.0, 0], [0.0, far]]))


def test_the_shape_of_points_is_checked():
    with pytest.raises(BrushError, match="shape"):
        Stroker(Brush()).add(np.zeros((3, 8)))


def test_the_number_of_dabs_is_bounded():
    tiny = from_json({"radius": 0, "spacing": 0, "dynamics": {}})
    stroker = Stroker(tiny)
    far = np.array([[-(2.0**31), 0], [2.0**31, 0]])
    assert len(stroker.add(far)) <= SEGMENT_CAP + 2
    for _ in range(STROKE_CAP // SEGMENT_CAP + 1):
        stroker.add(far)
    assert len(stroker.add(far)) <= 4
