"""Curves edited by hand: whatever is done to them, they stay curves that a brush accepts."""

from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from app.desk import knots
from engine.brush import checks

PART = st.floats(0.0, 1.0, width=32)
GESTURE = st.tuples(st.sampled_from(["add", "move", "remove", "draw", "thin"]), st.integers(0, 70), PART, PART, PART)


@given(st.lists(GESTURE, max_size=90))
@settings(deadline=None, max_examples=60)
def test_any_editing_leaves_knots_that_a_brush_accepts(gestures):
    curve, pen = knots.STRAIGHT, (0.5, 0.5)
    for what, i, x, y, z in gestures:
        if what == "add":
            curve, _ = knots.added(curve, x, y)
        elif what == "move":
            curve = knots.moved_knot(curve, i % len(curve), x, y)
        elif what == "remove":
            curve = knots.removed(curve, i % len(curve))
        elif what == "draw":
            curve, pen = knots.drawn_curve(curve, pen, (x, y)), (x, y)
        else:
            curve = knots.thinned(curve, z / 10)
        assert len(curve) >= 2
        assert checks.knots(curve, "curve") == curve
        assert all(0.0 <= out <= 1.0 for _, out in curve)


def test_the_curve_is_straight_between_its_knots():
    curve = ((0.2, 0.1), (0.6, 0.9), (0.7, 0.3))
    x = np.linspace(0, 1, 101)
    expected = np.interp(x, *np.array(curve).T)
    assert np.allclose([knots.at(curve, v) for v in x], expected)


def test_a_knot_added_on_the_curve_changes_nothing_and_can_be_found_and_taken_away():
    curve, i = knots.added(knots.STRAIGHT, 0.25, 0.25)
    assert i == 1
    assert abs(knots.at(curve, 0.6) - knots.at(knots.STRAIGHT, 0.6)) < 1e-12
    assert knots.nearest(curve, 0.26, 0.24, 0.05) == 1
    assert knots.nearest(curve, 0.5, 0.9, 0.05) is None
    assert knots.removed(curve, 1) == knots.STRAIGHT
    assert knots.removed(knots.STRAIGHT, 0) == knots.STRAIGHT


def test_a_knot_does_not_pass_its_neighbour():
    curve, _ = knots.added(knots.STRAIGHT, 0.5, 0.5)
    pushed = knots.moved_knot(curve, 1, 4.0, -3.0)
    assert 0.99 < pushed[1][0] < 1.0
    assert pushed[1][1] == 0.0


def test_a_curve_drawn_by_hand_follows_the_pen_whichever_way_it_goes():
    there = knots.drawn_curve(knots.STRAIGHT, (0.2, 0.8), (0.6, 0.4))
    back = knots.drawn_curve(knots.STRAIGHT, (0.6, 0.4), (0.2, 0.8))
    assert there == back
    assert len(there) == knots.CAP
    assert abs(knots.at(there, 0.4) - 0.6) < 0.01
    assert abs(knots.at(there, 0.9) - 0.9) < 0.001  # untouched


def test_a_curve_drawn_by_hand_begins_and_ends_at_the_edges_though_the_pen_does_nearly():
    drawn, points = knots.STRAIGHT, [(0.02, 0.9), (0.4, 0.2), (0.97, 0.3)]
    assert knots.at_edge(points[1], 0.05) == points[1]
    pairs = [
        (knots.at_edge(points[0], 0.05), points[0]),
        *pairwise(points),
        (points[2], knots.at_edge(points[2], 0.05)),
    ]
    for start, end in pairs:
        drawn = knots.drawn_curve(drawn, start, end)
    assert (drawn[0][1], drawn[-1][1]) == (0.9, 0.3)
    assert max(abs(a[1] - b[1]) for a, b in pairwise(drawn)) < 0.05


def test_thinning_keeps_the_shape():
    wave = tuple((i / 63, round(0.5 + 0.4 * np.sin(i / 8), 4)) for i in range(64))
    few = knots.thinned(wave, 0.02)
    assert len(few) < 30
    assert max(abs(knots.at(few, x) - y) for x, y in wave) <= 0.0201
    assert knots.thinned(knots.drawn_curve(knots.STRAIGHT, (0, 0), (1, 1)), 0.001) == knots.STRAIGHT
