"""Strokes drawn onto guides: which of several is chosen, how much it draws, and straight lines with Shift."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.guides.snapping import BEGINNING, RULER_REACH, Snapper
from app.input.events import PenEvent
from app.tools.painting_gestures import paint
from engine.numeric.address import Rect
from engine.painting.commands import Guide
from engine.studio.requests import Points
from engine.studio.results import Scene

LEVEL = Guide("level", "ruler", 0, (0, 0), ((0.0, 0.0), (400.0, 0.0)))
UPRIGHT = Guide("upright", "ruler", 0, (0, 0), ((200.0, -200.0), (200.0, 200.0)))
SLANTED = Guide("slanted", "parallel", 0, (0, 0), ((0.0, 0.0), (30.0, 12.0)))
DEPTH = Guide("depth", "perspective-1", 0, (0, 0), ((150.0, 90.0), (250.0, 90.0)))
OVAL = Guide("oval", "ellipse", 0, (0, 0), ((100.0, 0.0), (180.0, 0.0), (100.0, 50.0)))
GRID = Guide("grid", "grid", 0, (0, 0), ((0.0, 0.0), (40.0, 0.0), (0.0, 40.0)))
FEW = settings(max_examples=20)
ANGLE, FAR = st.floats(0, math.tau), RULER_REACH * 3


def desk_with(*guides):
    posted = []
    desk = Desk(View(Place(200, 100, 0), 0, 0.0, 800, 600), posted.append)
    desk.learn(ready=True, scene=Scene(Rect(0, 0, 64, 64), (), None, False, False, False, None, guides=guides))
    return desk, posted


def drawn(start, angle, *guides, length=60, bow=0.0, desk=None):
    """The points that are recorded of a stroke from a place in a direction, float64 (n, 2), and its snapper."""
    along = np.linspace(0, 1, 25)[:, None]
    aside = bow * np.sin(np.pi * along)
    way, off = np.array([math.cos(angle), math.sin(angle)]), np.array([-math.sin(angle), math.cos(angle)])
    table = np.zeros((25, 6))
    table[:, :2] = np.array(start) + length * along * way + aside * off
    snapper = Snapper(desk or desk_with(*guides)[0], 0, (0, 0))
    return np.concatenate([*(snapper.add(row[None]) for row in table), snapper.finish()])[:, :2], snapper


@FEW
@given(st.tuples(st.floats(210, 390), st.floats(-9, 9)), st.floats(-0.15, 0.15), st.booleans())
def test_beside_a_ruler_that_is_chosen_before_lines_that_are_everywhere(start, off, back):
    found, snapper = drawn(start, off + math.pi * back, SLANTED, LEVEL, DEPTH)
    assert snapper.way.edge
    np.testing.assert_allclose(found[:, 1], 0, atol=1e-9)


@FEW
@given(st.tuples(st.floats(-300, 300), st.floats(FAR, 400)), ANGLE)
def test_far_from_rulers_the_line_that_runs_as_the_stroke_does_is_chosen(start, angle):
    """Those of a parallel ruler, and of one-point perspective: into the depth, level and upright."""
    if math.dist(start, (150, 90)) < 20:
        return
    ways = [math.atan2(12, 30), math.atan2(90 - start[1], 150 - start[0]), 0.0, math.pi / 2]
    apart = sorted((abs(math.remainder(angle - way, math.pi)), n) for n, way in enumerate(ways))
    if apart[1][0] - apart[0][0] < 1e-3:
        return
    found, snapper = drawn(start, angle, LEVEL, SLANTED, DEPTH)
    best = ways[apart[0][1]]
    if apart[0][0] > math.radians(60):
        assert snapper.way is None
        return
    assert abs(math.remainder(math.atan2(snapper.way.curve.dy, snapper.way.curve.dx) - best, math.pi)) < 1e-9
    off = (found - np.array(start)) @ np.array([-math.sin(best), math.cos(best)])
    np.testing.assert_allclose(off, 0, atol=1e-6)


@FEW
@given(st.tuples(st.floats(0, 400), st.floats(-100, 100)), ANGLE)
def test_strokes_along_a_grid_lie_on_its_lines_and_oblique_ones_are_free(start, angle):
    found, snapper = drawn(start, angle, GRID)
    aside = abs(math.remainder(angle, math.pi / 2))
    if aside > math.radians(21):
        assert snapper.way is None
        np.testing.assert_allclose(
            found[-1] - np.array(start), 60 * np.array([math.cos(angle), math.sin(angle)]), atol=1e-6
        )
    elif aside < math.radians(19):
        fixed = found[:, int(abs(math.sin(angle)) < 0.5)]
        np.testing.assert_allclose(fixed, 40 * round(fixed[0].item() / 40), atol=1e-6)


@FEW
@given(ANGLE)
def test_where_two_rulers_cross_the_first_pixels_choose_and_the_stroke_stays_on_that_one(angle):
    found, snapper = drawn((203, 4), angle, LEVEL, UPRIGHT, bow=4)
    even = abs(math.cos(angle)) > abs(math.sin(angle))
    bent = abs(abs(math.cos(angle)) - abs(math.sin(angle))) < 0.4  # which of them: the bow has a say
    axis = 1 if snapper.way.curve.dy == 0 else 0
    assert bent or axis == int(even)
    np.testing.assert_allclose(found[:, axis], 0 if axis else 200, atol=1e-9)


@FEW
@given(st.floats(0, 1), st.tuples(st.floats(20, 380), st.floats(-20, 20)))
def test_a_weaker_guide_draws_strokes_onto_it_by_its_part(snap, start):
    """Halfway between the stroke by hand and the line at a half; not at all at nothing."""
    found, snapper = drawn(start, 0.1, replace(LEVEL, snap=snap))
    assert (snapper.way is not None) == (snap > 0)
    free, _ = drawn(start, 0.1)
    np.testing.assert_allclose(found[:, 1], free[:, 1] * (1 - snap), atol=1e-9)


@FEW
@given(ANGLE, st.integers(-3, 3))
def test_a_stroke_along_an_ellipse_lies_on_it(turn, off):
    start = 100 + (80 + off) * math.cos(turn), (50 + off) * math.sin(turn)
    along = math.atan2(50 * math.cos(turn), -80 * math.sin(turn))
    found, snapper = drawn(start, along, OVAL, DEPTH, length=40)
    assert snapper.way.edge
    x, y = found.T
    np.testing.assert_allclose(((x - 100) / 80) ** 2 + (y / 50) ** 2, 1, atol=1e-6)


@pytest.mark.parametrize("how", ["none", "off", "switched off", "beyond its end", "too far"])
def test_nothing_holds_a_stroke_back_where_no_guide_has_a_say(how):
    desk, _ = desk_with(*{"none": (), "off": (replace(LEVEL, off=True),)}.get(how, (LEVEL,)))
    desk.guides.snaps = how != "switched off"
    start = {"beyond its end": (450, 3), "too far": (200, FAR)}.get(how, (200, 3))
    found, snapper = drawn(start, 0.2, desk=desk)
    assert snapper.way is None
    assert not snapper.waits
    np.testing.assert_allclose(found[0], start)
    assert len(found) == 25


def test_a_tap_beside_a_ruler_stays_a_dot():
    table = np.array([[200.0, 3.0, 1, 0, 0, 0], [200.0, 3.0 + BEGINNING / 2, 1, 0, 0, 0]])
    snapper = Snapper(desk_with(LEVEL)[0], 0, (0, 0))
    assert not len(snapper.add(table))
    assert snapper.waits
    np.testing.assert_array_equal(snapper.finish(), table)


@FEW
@given(ANGLE, st.floats(20, 150))
def test_dragged_with_shift_a_stroke_is_straight_at_the_next_of_15_degrees_whatever_guides_there_are(angle, length):
    desk, posted = desk_with(LEVEL, SLANTED)
    desk.pointer.shift = True
    desk.hand.stabiliser = 0.0
    first = PenEvent("down", 400.0, 300.0, button=1)
    gesture = paint(desk, first)
    next(gesture)
    for k in range(1, 13):
        x, y = length * k / 12 * math.cos(angle), length * k / 12 * math.sin(angle)
        gesture.send(PenEvent("move", 400 + x, 300 + y, time=k / 100))
    with pytest.raises(StopIteration):
        gesture.send(PenEvent("up", 400 + x, 300 + y, time=0.13, button=1))
    found = np.concatenate([request.points for request in posted if isinstance(request, Points)])[:, :2]
    dx, dy = found[-1] - found[0]
    step = math.pi / 12
    turns = math.atan2(dy, dx) / step
    assert turns == pytest.approx(round(turns), abs=1e-2)  # points lie on a grid
    assert abs(math.remainder(math.atan2(dy, dx) - angle, math.tau)) <= step / 2 + 1e-2
    assert math.hypot(dx, dy) == pytest.approx(length, rel=0.02)
