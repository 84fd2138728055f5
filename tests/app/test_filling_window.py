"""Regions filled by hand in the real window."""

import math

import numpy as np
import pytest

pytestmark = pytest.mark.window
MIDDLE = 560, 360


def ring(radius, gap=0.0):
    """Points of a circle around the middle, less a gap at its right."""
    x, y = MIDDLE
    angles = np.linspace(gap, 2 * math.pi - gap, 40)
    return [(round(x + radius * math.cos(a)), round(y + radius * math.sin(a))) for a in angles]


@pytest.fixture
def app(program):
    """The window with a ring, one pixel of level 0 on one of the screen."""
    app = program()
    app.settled()
    app.keys("1")
    empty = app.canvas()
    app.stroke(*ring(110))
    app.outlined = app.canvas_unlike(empty)
    return app


def test_a_click_fills_a_region_and_asks_before_it_runs_out_of_sight(app):
    outlined = app.outlined
    app.keys("g")
    app.click(MIDDLE)
    filled = app.canvas_unlike(outlined)
    changed = (np.abs(filled.astype(int) - outlined).max(axis=2) > 8).sum()
    assert 0.7 < changed / (math.pi * 105**2) < 1.1  # what lies within the ring
    app.keys("ctrl+z")
    assert app.comes_to(outlined)
    app.click((300, 200))  # what leaks is asked about
    app.box("Fill all the same")
    assert app.comes_to(outlined)
    app.click("Fill all the same")
    app.canvas_unlike(outlined)
    app.until_gone("Fill all the same")


@pytest.mark.nightly
def test_a_colour_that_is_dropped_into_a_region_fills_it(app):
    colour = app.screen()[app.at("now")[::-1]].astype(int)
    app.move_to(app.at("now"))
    app.do("mousedown", 1, "mousemove", 800, 300, "mousemove", *MIDDLE)
    app.until(lambda screen: (screen[MIDDLE[1], MIDDLE[0]] == colour).all(), MIDDLE)  # it goes along
    assert np.abs(app.screen()[MIDDLE[1] + 40, MIDDLE[0]].astype(int) - colour).max() > 8
    app.do("mouseup", 1)
    screen = app.until(lambda screen: (screen[MIDDLE[1] + 40, MIDDLE[0]] == colour).all())
    assert (screen[MIDDLE[1] - 40 : MIDDLE[1] + 40, MIDDLE[0] - 40 : MIDDLE[0] + 40] == colour).all()
    app.keys("ctrl+z")
    assert app.comes_to(app.outlined)
    app.drag(app.at("shade 6"), MIDDLE)
    app.do("mouseup", 1)
    app.canvas_unlike(app.outlined)
    app.keys("ctrl+z")
    assert app.comes_to(app.outlined)

    # A press on a patch of a panel that floats over the canvas takes the colour, and fills nothing below it.
    _, y = app.at("Colour")
    app.drag((1060, y), (760, 110))
    app.do("mouseup", 1)
    app.wait_until(lambda: app.box("Colour")[0] < 760, "it does not float")
    before = app.screen()[app.at("now")[::-1]].astype(int)
    app.click("shade 2")
    now = app.at("now")[::-1]
    app.until(lambda screen: np.abs(screen[now] - before).max() > 8, MIDDLE)
    assert not any(name == "Fill all the same" for _, name in app.boxes())
    app.keys("ctrl+z")  # what drew the ring is the last step
    app.until(lambda screen: (np.abs(screen[150:450, 440:680] - app.outlined[90:390, 170:410]).max(axis=2) > 8).any())


def test_what_is_gone_round_is_filled_and_a_texture_that_is_dropped_into_a_region(app):
    app.keys("alt+g")
    app.box("Within")
    app.stroke(*ring(170))
    inside = app.canvas_unlike(app.outlined)[150:450, 140:440]
    whole = (np.abs(inside - app.outlined[150:450, 140:440]).max(axis=2) > 8).sum()
    assert 0.7 < whole / (math.pi * 105**2) < 1.1  # what lies within the ring, though more was gone round
    app.keys("ctrl+z", "b")
    assert app.comes_to(app.outlined)
    app.click("Add texture")
    app.move_to(app.at("texture Squares"))
    app.do("mousedown", 1, "mousemove", 900, 400)
    app.do("mousemove", 700, 380, "mousemove", *MIDDLE)
    app.settled()
    app.do("mouseup", 1)
    app.until_gone("texture Squares")
    laid = app.canvas_unlike(app.outlined)[230:370, 220:360]
    assert np.ptp(laid.reshape(-1, 3), axis=0).max() > 60  # no plain colour
    app.keys("ctrl+z")
    assert app.comes_to(app.outlined)
