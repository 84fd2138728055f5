"""The view: exact at any depth, and screen and canvas agree."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.canvas.glide import Glide
from app.canvas.view import Place, View, distance, place_of_pixel, view_of, zoom_text
from engine.numeric.address import Rect

LEVELS = st.integers(-40, 200)
FRACTIONS = st.sampled_from([0.0, 0.25, 0.5, 0.75])
POINTS = st.tuples(st.floats(0, 1280), st.floats(0, 800))


def exact(place: Place) -> tuple[Fraction, Fraction]:
    return Fraction(place.x) / Fraction(2) ** place.exponent, Fraction(place.y) / Fraction(2) ** place.exponent


@st.composite
def views(draw):
    level = draw(LEVELS)
    bits = max(0, level) + 16
    limit = 1 << (bits + 12)
    centre = Place(draw(st.integers(-limit, limit)), draw(st.integers(-limit, limit)), bits)
    angle = draw(st.sampled_from([0.0, 0.3, -2.0, math.pi / 2]))
    return View(centre, level, draw(FRACTIONS), 1280, 800, angle, draw(st.booleans()))


@given(views(), POINTS)
@settings(deadline=None, max_examples=200)
def test_a_screen_point_comes_back_from_the_canvas(view, point):
    assert view.to_screen(view.to_canvas(*point)) == pytest.approx(point, abs=1e-3)


@given(views(), POINTS, st.integers(1, 240))
@settings(deadline=None, max_examples=60)
def test_zooming_in_and_out_about_a_point_ends_exactly_where_it_began(view, point, notches):
    held = view.to_canvas(*point)
    start = view.held(held, *point)
    deep = start
    for _ in range(notches):
        deep = deep.zoomed(0.25).held(held, *point)
        assert deep.to_screen(held) == pytest.approx(point, abs=1e-3)
    back = deep
    for _ in range(notches):
        back = back.zoomed(-0.25).held(held, *point)
    assert (back.level, back.fraction) == (start.level, start.fraction)
    assert exact(back.centre) == exact(start.centre)


@given(views(), st.lists(st.tuples(st.floats(-300, 300), st.floats(-300, 300)), max_size=30))
@settings(deadline=None, max_examples=60)
def test_moving_there_and_back_is_exact(view, ways):
    there = view.centre
    for dx, dy in ways:
        there = there.moved(dx, dy, view.level)
    for dx, dy in reversed(ways):
        there = there.moved(-dx, -dy, view.level)
    assert exact(there) == exact(view.centre)


def test_four_hundred_quarter_pixels_at_level_60_are_a_hundred_pixels():
    start = View(place_of_pixel(60, 3 << 60, 5 << 59), 60, 0.0, 1280, 800)
    view = start
    for _ in range(400):
        view = view.held(view.centre, 640 - 0.25, 400 + 0.25)
    assert view.centre.pixel(60) == ((3 << 60) + 100, (5 << 59) - 100)
    x, y = view.pixel_to_screen(60, 3 << 60, 5 << 59)
    assert (x, y) == (640 - 100, 400 + 100)


@given(st.integers(0, 1000), st.integers(-(1 << 40), 1 << 40), st.integers(-(1 << 40), 1 << 40))
@settings(deadline=None, max_examples=60)
def test_pixels_lie_on_the_screen_where_they_should_at_any_depth(level, x, y):
    corner = ((1 << level) + x, y - (1 << level))
    view = View(place_of_pixel(level, *corner), level, 0.0, 1280, 800)
    assert view.pixel_to_screen(level, *corner) == (640.0, 400.0)
    assert view.pixel_to_screen(level, corner[0] + 256, corner[1] - 3) == (896.0, 397.0)
    assert view.pixel_to_screen(level - 1, corner[0] >> 1, corner[1] >> 1) == (640 - corner[0] % 2, 400 - corner[1] % 2)


@given(views())
@settings(deadline=None, max_examples=100)
def test_the_visible_rectangle_holds_the_corners_of_the_screen_and_little_more(view):
    level = view.shown_level
    seen = view.visible(level)
    for corner in ((0.01, 0.01), (1279.9, 0.01), (0.01, 799.9), (1279.9, 799.9)):
        x, y = view.to_canvas(*corner).pixel(level)
        assert seen.x0 <= x < seen.x1
        assert seen.y0 <= y < seen.y1
    assert seen.width <= 1.5 * math.hypot(1280, 800) / view.scale(level) + 4


@given(views())
@settings(deadline=None, max_examples=60)
def test_the_shown_level_has_pixels_as_large_as_those_of_the_screen(view):
    assert 0.7 < view.scale(view.shown_level) < 1.42


@given(views(), POINTS, st.floats(-3, 3))
@settings(deadline=None, max_examples=60)
def test_turning_leaves_the_place_under_the_pointer(view, point, angle):
    place = view.to_canvas(*point)
    assert view.turned(angle, *point).to_screen(place) == pytest.approx(point, abs=1e-2)


def test_mirroring_swaps_left_and_right():
    view = View(Place(0, 0, 0), 0, 0.0, 1280, 800)
    assert view.flipped().pixel_to_screen(0, 10, 20) == (630.0, 420.0)
    assert view.flipped().flipped() == replace(view, angle=-0.0)


def test_fitting_shows_the_whole_frame_in_the_free_area():
    frame = Rect(-100, 50, 4000, 2000)
    view = view_of(frame, (250, 24, 990, 770), 1280, 800)
    x0, y0 = view.pixel_to_screen(0, frame.x0, frame.y0)
    x1, y1 = view.pixel_to_screen(0, frame.x1, frame.y1)
    assert x0 > 250
    assert x1 < 990
    assert y0 > 24
    assert y1 < 770
    assert x1 - x0 > 0.85 * (990 - 250)


def test_a_glide_ends_exactly_at_its_target_whatever_the_frames():
    ends = []
    for step in (0.004, 0.016, 0.05):
        view, glide = View(Place(77 << 16, 5 << 16, 16), 3, 0.25, 1280, 800), Glide()
        for _ in range(8):
            glide.zoom(view, 0.25, 300.0, 200.0)
            view = glide.step(view, step)
        while glide.moving:
            view = glide.step(view, step)
        ends.append((view.level, view.fraction, exact(view.centre)))
    assert ends[0] == ends[1] == ends[2]
    assert ends[0][:2] == (5, 0.25)


def test_distance_counts_levels():
    view = View(Place(0, 0, 0), 2, 0.5, 100, 100)
    assert distance(view, 5, 0.25) == 2.75


@pytest.mark.parametrize(
    ("level", "fraction", "text"),
    [
        (0, 0.0, "1:1"),
        (20, 0.0, "x 1,048,576"),
        (-2, 0.0, "1:4"),
        (0, 0.5, "x 1.41"),
        (-1, 0.5, "1:1.41"),
        (60, 0.0, "x 1.15 quintillion"),
        (30, 0.0, "x 1.07 billion"),
        (-30, 0.0, "1:1.07 billion"),
        (300, 0.0, "x 10^90"),
    ],
)
def test_zoom_in_words(level, fraction, text):
    assert zoom_text(level, fraction) == text
