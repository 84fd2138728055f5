"""Views that a recording asks for: exact at any depth, and reached by flying."""

import math

import pytest

from app.canvas.glide import Glide
from app.canvas.view import SUBPIXEL, Place, View
from app.desk.flight import middle
from engine.numeric.address import Rect


def arrive(view, there, seconds, frames=40):
    glide = Glide()
    view = glide.fly(view, there, seconds)
    steps = 0
    while glide.moving:
        view = glide.step(view, seconds / frames)
        steps += 1
    return view, steps


@pytest.mark.parametrize("levels", [1, 4, 20, 60, -7])
def test_a_flight_ends_at_the_view_it_was_to_go_to(levels):
    start = View(Place(100 << 16, 50 << 16, 16), 0, 0.0, 1280, 800)
    there = View(Place((123 << 80) + 5, 60 << 80, 80), levels, 0.25, 1280, 800)
    end, steps = arrive(start, there, 1.0)
    assert steps > 10
    assert (end.level, end.fraction) == (there.level, there.fraction)
    x, y = end.to_screen(there.centre)
    assert (x, y) == pytest.approx((640, 400), abs=0.01)


def test_a_flight_without_zoom_is_a_jump():
    start = View(Place(0, 0, 0), 0, 0.0, 1280, 800)
    there = View(Place(5000, 0, 0), 0, 0.0, 1280, 800)
    assert arrive(start, there, 1.0) == (there, 0)


def test_the_middle_of_a_recorded_view_is_exact_at_depth():
    origin = (1 << 90) + 7
    assert middle(origin, 100, 0.0) == (origin << SUBPIXEL) + (50 << SUBPIXEL)
    assert middle(10.5, 4, 0.0) == round(12.5 * (1 << SUBPIXEL))
    assert abs(middle(origin, 0, 0.5) - math.isqrt(((origin << SUBPIXEL) ** 2) >> 1)) <= 1
    assert middle(1024, 0, 0.5) == pytest.approx(1024 / 2**0.5 * (1 << SUBPIXEL), abs=2)


def test_the_screen_shows_the_rectangle_that_was_looked_at():
    view = View(Place(middle(300, 200, 0.0), middle(100, 100, 0.0), SUBPIXEL), 2, 0.0, 1280, 800)
    seen = view.visible(0)
    assert Rect(360, 110, 440, 190).intersect(seen) == Rect(360, 110, 440, 190)
