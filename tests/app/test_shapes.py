"""Shapes drawn by the brush: their paths, and the gestures that post them as one stroke each."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.guides import shape_paths, symmetry
from app.input.events import PenEvent
from app.tools.painting_gestures import paint
from app.tools.shape_gestures import DRAWN
from engine.numeric.address import Rect
from engine.studio.requests import Begin, Finish, Points
from engine.studio.results import Scene

PLACE = st.tuples(st.floats(-500, 500), st.floats(-500, 500))


@pytest.fixture
def desk():
    posted = []
    desk = Desk(View(Place(1 << 400, 7, 0), 3, 0.25, 800, 600, 0.4), posted.append)
    desk.learn(scene=Scene(Rect(0, 0, 64, 64), (), None, False, False, False, None), ready=True)
    return desk, posted


@given(PLACE, PLACE, st.booleans(), st.booleans())
def test_shapes_lie_in_their_boxes(start, end, even, central):
    for path in (shape_paths.rectangle, shape_paths.ellipse):
        found = np.array(path(start, end, even, central))
        assert np.allclose(found[0], found[-1])
        (x0, y0), (x1, y1) = found.min(axis=0), found.max(axis=0)
        if even:
            assert x1 - x0 == pytest.approx(y1 - y0, rel=0.01, abs=0.3)
        else:
            factor = 2 if central else 1
            assert x1 - x0 == pytest.approx(factor * abs(end[0] - start[0]), rel=0.02, abs=1e-6)
        middle = start if central else None
        if middle is not None:
            assert ((x0 + x1) / 2, (y0 + y1) / 2) == pytest.approx(middle, abs=1e-6)
    begin, finish = shape_paths.line(start, end, even, central)
    assert math.dist(begin, finish) == pytest.approx((2 if central else 1) * math.dist(start, end), abs=1e-6)
    if even and math.dist(start, end) > 1:
        steps = math.degrees(math.atan2(finish[1] - begin[1], finish[0] - begin[0])) / 15
        assert steps == pytest.approx(round(steps), abs=1e-6)


def test_an_ellipse_is_round_at_any_size():
    for radius in (0.5, 10, 4000):
        found = np.array(shape_paths.ellipse((0, 0), (radius, radius), True, True))
        middles = (found[1:] + found[:-1]) / 2
        assert radius - np.hypot(*middles.T).min() <= 0.11


def events(gesture, *told):
    next(gesture)
    for event in told:
        gesture.send(event)


@pytest.mark.parametrize("name", ["draw_line", "draw_rectangle", "draw_ellipse"])
def test_a_shape_is_one_stroke_and_escape_gives_it_up(desk, name):
    desk, posted = desk
    gesture = DRAWN[name](desk, PenEvent("down", 200, 200))
    events(gesture, PenEvent("move", 260, 250))
    assert len(desk.guides.path) >= 2
    gesture.close()
    assert desk.guides.path == ()
    assert posted == []
    with pytest.raises(StopIteration):
        events(DRAWN[name](desk, PenEvent("down", 200, 200)), PenEvent("move", 220, 250), PenEvent("up", 300, 260))
    begin, points, end = posted
    assert isinstance(begin, Begin)
    assert isinstance(points, Points)
    assert isinstance(end, Finish)
    assert points.points[:, 2].min() == 1.0
    x, y = desk.view.to_canvas(200, 200).offset(begin.level, *begin.origin)
    assert min(x, y) >= 0
    assert max(x, y) <= 1
    if name == "draw_line":
        assert points.points[0, :2] == pytest.approx((x, y))


def test_a_polyline_ends_by_a_double_click_or_on_its_first_corner(desk):
    desk, posted = desk
    corners = [(200, 200), (300, 210), (280, 330)]

    def clicks(places, start=0.0):
        for n, place in enumerate(places):
            yield PenEvent("down", *place, time=start + n)
            yield PenEvent("up", *place, time=start + n + 0.1)

    for last in (
        [PenEvent("down", 280, 330, time=2.3)],
        [PenEvent("down", 203, 199, time=4.0)],
        [PenEvent("done", 280, 330)],
    ):
        posted.clear()
        told = [*list(clicks(corners))[1:], PenEvent("move", 250, 260, time=2.2), *last]
        with pytest.raises(StopIteration):
            events(DRAWN["draw_polyline"](desk, PenEvent("down", *corners[0], time=0.0)), *told)
        assert [type(one) for one in posted] == [Begin, Points, Finish]
        count = 4 if last[0].x == 203 else 3
        assert len(posted[1].points) == count
    gesture = DRAWN["draw_polyline"](desk, PenEvent("down", 200, 200))
    events(gesture, PenEvent("up", 200, 200), PenEvent("move", 260, 250))
    gesture.close()
    assert len(posted) == 3


def test_with_shift_a_straight_line_leads_from_the_last_stroke_to_the_next(desk):
    desk, posted = desk
    desk.hand.stabiliser = 0.0
    with pytest.raises(StopIteration):
        events(paint(desk, PenEvent("down", 100, 120)), PenEvent("up", 110, 130))
    posted.clear()
    desk.pointer.shift = True
    with pytest.raises(StopIteration):
        events(paint(desk, PenEvent("down", 300, 200)), PenEvent("up", 300, 200))
    first = next(one for one in posted if isinstance(one, Points)).points[0]
    begin = posted[0]
    assert first[:2] == pytest.approx(desk.view.to_canvas(110, 130).offset(begin.level, *begin.origin))


def touch(x, y, pressure, kind="move"):
    return PenEvent(kind, x, y, pressure, pen=True)


def rows_of(posted):
    return np.concatenate([one.points for one in posted if isinstance(one, Points)])


def test_a_tap_of_the_pen_and_a_line_to_it_are_as_heavy_as_it_was_pressed(desk):
    desk, posted = desk
    desk.hand.stabiliser = 0.0
    told = [touch(300, 200, 0.4), touch(300.5, 200.2, 0.8), touch(300, 200, 0.1), touch(300, 200, 0.0, "up")]
    with pytest.raises(StopIteration):
        events(paint(desk, touch(300, 200, 0.0, "down")), *told)
    assert set(rows_of(posted)[:, 2]) == {0.8}
    posted.clear()
    desk.pointer.shift = True
    with pytest.raises(StopIteration):
        events(paint(desk, touch(400, 200, 0.0, "down")), touch(400, 200, 0.6), touch(400, 200, 0.0, "up"))
    assert set(rows_of(posted)[:, 2]) == {0.6}


def test_a_stroke_of_the_pen_begins_as_light_as_it_came_down(desk):
    desk, posted = desk
    desk.hand.stabiliser = 0.0
    gesture = paint(desk, touch(300, 200, 0.1, "down"))
    events(gesture, touch(300.4, 200, 0.3))
    assert not any(isinstance(one, Points) for one in posted)
    gesture.send(touch(304, 200, 0.5))
    gesture.send(touch(310, 200, 0.7))
    with pytest.raises(StopIteration):
        gesture.send(touch(310, 200, 0.0, "up"))
    pressures = rows_of(posted)[:, 2]
    assert (pressures[0], pressures[-1]) == pytest.approx((0.1, 0.7))
    assert (np.diff(pressures) > 0).all()


def test_a_shape_has_the_copies_of_the_symmetry(desk):
    desk, posted = desk
    symmetry.choose(desk, "both")
    guide = posted.pop().command
    desk.learn(scene=Scene(Rect(0, 0, 64, 64), (), None, False, False, False, None, guides=(guide,)))
    with pytest.raises(StopIteration):
        events(DRAWN["draw_line"](desk, PenEvent("down", 200, 200)), PenEvent("up", 300, 260))
    assert len(posted[0].copies) == 3


KNOT = st.builds(shape_paths.Knot, *[st.floats(-900, 900)] * 4, st.floats(0, 1))


@given(st.lists(KNOT, min_size=2, max_size=5))
def test_a_curve_goes_through_its_knots_along_their_handles_and_is_cut_finely(knots):
    rows = np.array(shape_paths.bezier(knots))
    at = [np.flatnonzero((rows[:, :2] == (knot.x, knot.y)).all(axis=1)) for knot in knots]
    assert all(len(found) for found in at)
    assert rows[:, 2].min() >= min(knot.pressure for knot in knots) - 1e-9
    one, other = knots[:2]
    rows = np.array(shape_paths.bezier(knots[:2]))
    for t in (0.3, 0.77):
        u = 1 - t
        ways = ((one.x, one.dx, other.dx, other.x), (one.y, one.dy, other.dy, other.y))
        place = [u**3 * a + 3 * u * u * t * (a + da) + 3 * u * t * t * (b - db) + t**3 * b for a, da, db, b in ways]
        start, finish = rows[:-1, :2], rows[1:, :2]
        along = finish - start
        part = ((place - start) * along).sum(axis=1) / np.maximum((along * along).sum(axis=1), 1e-12)
        gaps = np.hypot(*(place - start - np.clip(part, 0, 1)[:, None] * along).T)
        assert gaps.min() < 0.11


def test_a_curve_is_clicked_bent_taken_back_and_ended(desk):
    desk, posted = desk
    gesture = DRAWN["draw_curve"](desk, PenEvent("down", 200, 200, time=0.0))
    told = [
        PenEvent("move", 240, 160, time=0.1), PenEvent("up", 240, 160, time=0.2),
        PenEvent("down", 340, 220, time=1.0), PenEvent("up", 340, 220, time=1.1),
        PenEvent("down", 640, 520, time=2.0), PenEvent("up", 640, 520, time=2.1), PenEvent("back", 640, 520),
    ]  # fmt: skip
    events(gesture, *told)
    assert len(desk.guides.path) > 10
    with pytest.raises(StopIteration):
        gesture.send(PenEvent("done", 640, 520))
    begin, points, _ = posted
    assert [type(one) for one in posted] == [Begin, Points, Finish]
    assert desk.guides.path == desk.guides.bar == ()
    ends = [desk.view.to_canvas(*at).offset(begin.level, *begin.origin) for at in ((200, 200), (340, 220))]
    assert points.points[0, :2] == pytest.approx(ends[0])
    assert points.points[-1, :2] == pytest.approx(ends[1])
    assert len(points.points) > 5
    posted.clear()
    gesture = DRAWN["draw_curve"](desk, PenEvent("down", 200, 200, time=0.0))
    with pytest.raises(StopIteration):
        events(gesture, PenEvent("up", 200, 200), PenEvent("back", 200, 200))
    assert posted == []
