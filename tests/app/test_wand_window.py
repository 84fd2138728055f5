"""Regions of one colour selected by a click in the real window, and filled."""

import math
import time

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]
LEFT, TOP = 270, 60  # of what `canvas` shows
MIDDLE, RADIUS = (560, 360), 110


def until(app, good, seconds=60.0):
    """Waits until the canvas is good, whose rim of what is selected never comes to rest."""
    end = time.monotonic() + seconds
    while not good(app.screen()[TOP:740, LEFT:970].astype(int)):
        assert time.monotonic() < end, "it never comes"
        time.sleep(0.1)


def test_a_click_selects_a_region_which_is_filled_by_a_key(program):
    app = program()
    app.keys("1")
    empty = app.canvas()
    turns = np.linspace(0, 2 * math.pi, 40)
    app.stroke(*((round(MIDDLE[0] + RADIUS * math.cos(t)), round(MIDDLE[1] + RADIUS * math.sin(t))) for t in turns))
    outlined = app.canvas_unlike(empty)
    app.keys("shift+w")
    app.click(MIDDLE)
    app.park()

    def unlike(canvas):
        return (np.abs(canvas - outlined).max(axis=2) > 24).sum()

    until(app, lambda canvas: 200 < unlike(canvas) < 4000)  # a thin line
    app.keys("shift+F5")
    until(app, lambda canvas: 0.7 < unlike(canvas) / (math.pi * 105**2) < 1.1)  # what lies within the ring
    app.keys("ctrl+z")
    until(app, lambda canvas: 200 < unlike(canvas) < 4000)
