"""Whose a press is: a panel's as long as it lasts, or the canvas's."""

from types import SimpleNamespace

import pytest
from imgui_bundle import imgui  # before glfw, so that both use one libglfw

import glfw  # isort: skip

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.input.events import LEFT, MIDDLE, PenEvent
from app.router import Router
from engine.studio import requests as q

assert glfw
EDGE = 248  # what lies to the left is a panel


@pytest.fixture
def router():
    context = imgui.create_context()
    imgui.get_io().display_size = 1280, 800
    imgui.get_io().backend_flags |= imgui.BackendFlags_.renderer_has_textures
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    desk.hand.use("pan")
    dialogs = SimpleNamespace(open=False)
    layout = SimpleNamespace(covers=lambda x, y: x < EDGE, stroke=lambda *_: None, popup=False, dialogs=dialogs)
    yield Router(desk, layout)
    imgui.destroy_context(context)


def shown():
    """Two frames: imgui takes in a button after the move to it."""
    for _ in range(4):
        imgui.new_frame()
        imgui.end_frame()
    return imgui.get_io()


def send(router, kind, x, button=0):
    router.pointer(PenEvent(kind, x, 400.0, button=button))


@pytest.mark.parametrize("start", [100.0, EDGE - 0.01])
def test_a_press_on_a_panel_that_goes_onto_the_canvas_stays_the_panels(router, start):
    send(router, "down", start, LEFT)
    assert shown().mouse_down[0]
    for x in (EDGE - 1.0, EDGE, 600.0):
        send(router, "move", x)
        assert router.gesture is None
        assert not router.desk.pointer.over_canvas
    assert shown().mouse_pos.x == 600
    send(router, "up", 600.0, LEFT)
    assert router.gesture is None
    assert not shown().mouse_down[0]
    send(router, "down", 600.0, LEFT)
    assert router.gesture is not None


def test_a_stroke_goes_on_over_a_panel(router):
    send(router, "down", EDGE, LEFT)
    assert router.gesture is not None
    send(router, "move", 100.0)
    assert router.gesture is not None
    send(router, "up", 100.0, LEFT)
    assert router.gesture is None
    assert not shown().mouse_down[0]


def test_a_release_that_was_never_told_does_not_keep_the_canvas_from_the_artist(router):
    send(router, "down", 100.0, LEFT)
    send(router, "down", 120.0, MIDDLE)
    assert shown().mouse_down[0]
    send(router, "up", 600.0, MIDDLE)
    send(router, "down", 600.0, LEFT)
    assert router.gesture is not None
    assert not shown().mouse_down[0]


@pytest.fixture
def posted(router):
    """What a brush posts through the router, stabilised: its paint lags behind the pen."""
    out = []
    router.desk.post = out.append
    router.desk.hand.use("brush")
    router.desk.hand.stabiliser = 0.7
    return out


def lost_focus(router):
    router.lost_focus()


def lost_pen(router):
    router.pointer(PenEvent("lost", 0.0, 0.0))


@pytest.mark.parametrize("lost", [lost_focus, lost_pen])
def test_a_stroke_whose_pen_or_window_is_lost_ends_at_its_last_point_and_stays(router, posted, lost):
    send(router, "down", 500.0, LEFT)
    for x in (520.0, 560.0, 640.0):
        send(router, "move", x)
    lost(router)
    assert [type(request) for request in posted if not isinstance(request, q.Points)] == [q.Begin, q.Finish]
    last = posted[-2].points[-1]
    assert (last[0], last[1]) == (140.0, 0.0), "not where the pen was last"
    assert router.gesture is None
    assert not router.desk.painting
    send(router, "move", 700.0)
    send(router, "up", 700.0, LEFT)
    assert isinstance(posted[-1], q.Finish), "the release belongs to no stroke any more"


def test_escape_drops_the_stroke(router, posted):
    send(router, "down", 500.0, LEFT)
    send(router, "move", 520.0)
    router.key(glfw.KEY_ESCAPE, 0, glfw.PRESS, 0)
    assert isinstance(posted[-1], q.Abandon)
    assert router.gesture is None


@pytest.mark.parametrize("tool", ["zoom", "pick", "pan", "turn"])
def test_other_gestures_are_dropped_where_the_window_is_lost(router, posted, tool):
    router.desk.hand.use(tool)
    send(router, "down", 500.0, LEFT)
    before, count = router.desk.view.to_canvas(500.0, 400.0).pixel(8), len(posted)
    router.lost_focus()
    after = router.desk.view.to_canvas(500.0, 400.0).pixel(8)
    assert (router.gesture, after, router.desk.glide.moving) == (None, before, False)
    assert len(posted) <= count + (tool == "pick")
