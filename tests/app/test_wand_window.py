"""Regions of one colour selected by a click in the real window, and filled."""

import math

import numpy as np
import pytest

pytestmark = pytest.mark.window
LEFT, TOP = 270, 60  # of what `canvas` shows
MIDDLE, RADIUS = (560, 360), 110


def test_a_click_selects_a_region_which_is_filled_by_a_key(program):
    app = program()
    app.keys("1")
    empty = app.canvas()
    turns = np.linspace(0, 2 * math.pi, 40)
    app.stroke(*((round(MIDDLE[0] + RADIUS * math.cos(t)), round(MIDDLE[1] + RADIUS * math.sin(t))) for t in turns))
    outlined = app.canvas_unlike(empty)
    app.keys("shift+w")
    app.click(MIDDLE)

    def unlike(screen):
        return (np.abs(screen[TOP:740, LEFT:970] - outlined).max(axis=2) > 24).sum()

    app.until(lambda screen: 200 < unlike(screen) < 4000)  # a thin line
    app.keys("shift+F5")
    app.until(lambda screen: 0.7 < unlike(screen) / (math.pi * 105**2) < 1.1)  # what lies within the ring
    app.keys("ctrl+z")
    app.until(lambda screen: 200 < unlike(screen) < 4000)
