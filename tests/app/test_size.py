"""The size of the brush: dragged on the canvas, and by the screen or locked to the canvas."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.canvas.view import Place, View
from app.cursor import dab_rings
from app.desk.desk import Desk
from app.desk.hand import LARGEST, SMALLEST
from app.desk.holding.size_lock import follow_view, set_lock
from app.input.events import LEFT, PenEvent
from app.tools.painting_gestures import paint
from app.tools.size_gestures import drag_size
from engine.brush.settings import Brush
from engine.studio import requests as q


def desk_with(radius, level=0, fraction=0.0):
    desk = Desk(View(Place(0, 0, 0), level, fraction, 1280, 800), [].append)
    desk.hand.take(Brush(radius=radius, hardness=0.5), "Pen", ())
    return desk


def event(kind, x, y, **told):
    return PenEvent(kind, 500.0 + x, 400.0 + y, button=LEFT, **told)


def dragged(desk, *ways):
    gesture = drag_size(desk, event("down", 0, 0))
    next(gesture)
    for x, y in ways:
        gesture.send(event("move", x, y))
    return gesture


def test_sideways_is_the_radius_and_up_the_hardness_each_by_itself():
    desk = desk_with(20.0)
    gesture = dragged(desk, (38, 5))
    assert (desk.hand.brush.radius, desk.hand.brush.hardness) == (50.0, 0.5)
    assert desk.hand_sight.ghost == (500.0, 400.0)
    gesture.send(event("move", -4, -68))
    assert (desk.hand.brush.radius, desk.hand.brush.hardness) == (20.0, 0.8)
    for x, y, radius, hardness in ((5000, 900, LARGEST, 0.0), (-5000, -900, SMALLEST, 1.0)):
        gesture.send(event("move", x, y))
        assert (desk.hand.brush.radius, desk.hand.brush.hardness) == (radius, hardness)
    with pytest.raises(StopIteration):
        gesture.send(event("up", 28, 0))
    assert (desk.hand.brush.radius, desk.hand_sight.ghost) == (SMALLEST, None)  # as it was shown last


def test_escape_gives_the_size_back():
    desk = desk_with(20.0)
    dragged(desk, (90, 90)).close()
    assert (desk.hand.brush.radius, desk.hand.brush.hardness, desk.hand_sight.ghost) == (20.0, 0.5, None)


@settings(deadline=None)
@given(st.floats(0.5, 300.0), st.lists(st.floats(-9.0, 9.0), max_size=6))
def test_a_locked_brush_is_as_large_on_the_canvas_however_near_and_comes_back(radius, ways):
    desk = desk_with(radius)
    set_lock(desk, True)
    for way in [*ways, -sum(ways)]:
        desk.view = desk.view.zoomed(way)
        follow_view(desk)
        zoom = desk.view.level + desk.view.fraction
        wanted = max(SMALLEST, min(LARGEST, radius * 2.0**zoom))
        assert desk.hand.brush.radius == pytest.approx(wanted, abs=2e-3)
        follow_view(desk)
    assert desk.hand.brush.radius == pytest.approx(radius, abs=2e-3)


def test_a_size_that_is_set_while_it_is_locked_is_the_one_that_stays():
    desk = desk_with(10.0)
    desk.hand.erase()
    desk.hand.change(radius=40.0)
    set_lock(desk, True)
    desk.view = desk.view.zoomed(1)
    follow_view(desk)
    assert desk.hand.brush.radius == 80.0
    desk.hand.erase(False)
    assert desk.hand.brush.radius == 20.0  # what rests is locked, too
    desk.hand.change(radius=6.0)
    follow_view(desk)
    desk.view = desk.view.zoomed(-1)
    follow_view(desk)
    assert desk.hand.brush.radius == 3.0
    set_lock(desk, False)
    desk.view = desk.view.zoomed(5)
    follow_view(desk)
    assert desk.hand.brush.radius == 3.0


@pytest.mark.parametrize("levels", [5000, -5000])
def test_a_locked_brush_can_be_painted_with_at_the_ends_of_the_world(levels):
    desk = desk_with(10.0)
    set_lock(desk, True)
    desk.view = desk.view.zoomed(levels)
    follow_view(desk)
    assert desk.hand.brush.radius == (LARGEST if levels > 0 else SMALLEST)


@settings(deadline=None)
@given(st.floats(0.5, 500.0), st.floats(0.0, 1.0))
def test_the_ghost_falls_off_as_a_dab_does(radius, hardness):
    rings = dab_rings(radius, hardness)
    assert all(0.0 <= alpha <= 1.0 for _, alpha in rings)
    assert rings == sorted(rings, reverse=True)
    assert [alpha for _, alpha in rings] == sorted(alpha for _, alpha in rings)


def test_on_a_rope_the_window_shows_where_the_brush_is_and_the_stroke_ends_there():
    out = []
    desk = desk_with(4.0)
    desk.post = out.append
    desk.hand.stabiliser, desk.hand.steadying = 0.5, "rope"  # 60 px
    stroke = paint(desk, event("down", 0, 0, time=0.0))
    next(stroke)
    for i in range(1, 21):
        stroke.send(event("move", 10 * i, 0, time=0.01 * i))
    shown = desk.view.to_screen(desk.hand_sight.brush_at)
    assert shown == pytest.approx((640.0, 400.0), abs=1e-3)
    with pytest.raises(StopIteration):
        stroke.send(event("up", 200, 0, time=0.3))
    assert desk.hand_sight.brush_at is None
    last = [request for request in out if isinstance(request, q.Points)][-1].points[-1]
    assert last[0] == pytest.approx(140.0, abs=1e-6)
