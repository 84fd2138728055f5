"""Whose a press is: a panel's as long as it lasts, or the canvas's."""

from types import SimpleNamespace

import pytest
from imgui_bundle import imgui  # before glfw, so that both use one libglfw

import glfw  # isort: skip

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.input.events import LEFT, MIDDLE, PenEvent
from app.router import Router

assert glfw
EDGE = 248  # what lies to the left is a panel


@pytest.fixture
def router():
    context = imgui.create_context()
    imgui.get_io().display_size = 1280, 800
    imgui.get_io().backend_flags |= imgui.BackendFlags_.renderer_has_textures
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    desk.hand.use("pan")
    layout = SimpleNamespace(covers=lambda x, y: x < EDGE, stroke=lambda *_: None)
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
