"""What is moved, scaled and turned by the handles of its box, in the real window."""

import math
import time

import numpy as np
import pytest

from engine.canvas import layers
from engine.canvas.placing.placement import Placement
from engine.studio.filing.documents import opened

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]
STROKE = tuple((440 + 8 * i, 320 + 5 * i) for i in range(16))
CORNERS = "top left", "top right", "bottom right", "bottom left"


@pytest.fixture
def app(program):
    """The window with a stroke, one pixel of level 0 on one of the screen."""
    app = program()
    app.settled(60.0)
    app.keys("1")
    empty = app.canvas()
    app.stroke(*STROKE)
    app.canvas_unlike(empty)
    return app


def handles(app):
    """Where the corners of the box are."""
    app.park()
    app.settled()
    return [app.at(f"{name} handle") for name in CORNERS]


def drag(app, start, end, steps=6):
    """The left button held from one point to another, as slowly as by hand."""
    app.do("mousemove", *start)
    time.sleep(0.1)
    app.do("mousedown", 1)
    for i in range(1, steps + 1):
        app.do("mousemove", *(round(a + (b - a) * i / steps) for a, b in zip(start, end, strict=True)))
        time.sleep(0.03)


def nodes(app, folder):
    app.save_as(folder / "moved.ora")
    return {node.name: node for node in layers.walk(opened(folder / "moved.ora").painting.root)}


def test_a_corner_scales_by_powers_of_two_exactly_and_escape_gives_it_up(app, tmp_path):
    painted = app.canvas()
    app.keys("v")
    (x0, y0), _, (x1, y1), _ = handles(app)
    drag(app, (x1, y1), ((x0 + x1) // 2, (y0 + y1) // 2))
    app.box("exactly 50 %")
    app.do("key", "Escape")
    app.do("mouseup", 1)
    app.keys("b")
    assert app.comes_to(painted)
    app.keys("v")
    handles(app)
    drag(app, (x1, y1), ((x0 + x1) // 2, (y0 + y1) // 2))
    app.do("mouseup", 1)
    app.keys("b")
    app.canvas_unlike(painted)
    found = nodes(app, tmp_path)
    assert list(found) == ["Layer 1"]  # it is paint still, half as large
    app.keys("ctrl+z")
    assert app.comes_to(painted)


def test_the_handle_above_turns_as_one_step_and_back_to_nothing_lost(app, tmp_path):
    painted = app.canvas()
    app.keys("v")
    a, b, c, d = handles(app)
    middle = (a[0] + c[0]) // 2, (a[1] + c[1]) // 2
    up = app.at("turn handle")
    drag(app, up, (middle[0] + 60, middle[1] - 50))
    app.do("mouseup", 1)
    turned = handles(app)
    assert math.dist(turned[1], b) > 20
    app.keys("b")
    once = app.canvas_unlike(painted)
    app.keys("v")
    handles(app)
    drag(app, app.at("turn handle"), (middle[0], middle[1] - 70))
    app.box("exactly 0°")
    app.do("mouseup", 1)
    np.testing.assert_allclose(handles(app), [a, b, c, d], atol=1)
    app.keys("b")
    assert app.comes_to(painted)
    placement = nodes(app, tmp_path)["Layer 1"]
    assert isinstance(placement, Placement)
    assert placement.pose.similarity.quarter == (0, 0)
    app.keys("ctrl+z")
    assert app.comes_to(once)
    app.keys("ctrl+z")
    assert app.comes_to(painted)
