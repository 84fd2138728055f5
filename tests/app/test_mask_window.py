"""Masks in the real window: painted on by the brush, seen alone, put aside, inverted."""

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]


def test_a_mask_is_painted_by_the_brush_and_seen_alone(program):
    app = program()
    app.settled(60.0)
    empty = app.canvas()
    app.stroke(*((380 + 12 * i, 400) for i in range(24)))
    painted = app.canvas_unlike(empty)
    app.click("mask_full")  # it is painted on from then on
    app.box("mask bar")
    app.stroke(*((500, 340 + 6 * i) for i in range(20)))
    hidden = app.canvas_unlike(painted)
    app.click("Alone")
    app.box("Painting")
    alone = app.canvas_unlike(hidden)
    middle = alone[alone.shape[0] // 2]
    assert (middle == 255).all(axis=-1).any()
    assert (np.ptp(middle.astype(int), axis=-1) == 0).mean() > 0.9
    app.click("Painting")
    assert app.comes_to(hidden)
    app.do("mousemove", *app.at("mask of Layer 1"), "click", 3)
    app.click("From the mask")
    app.box("deselect")
    app.keys("ctrl+z")
    app.until_gone("deselect")
    app.click("Done")
    app.until_gone("mask bar")
    app.keys("ctrl+z")
    assert app.comes_to(painted)
