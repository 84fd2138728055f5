"""Guides in the real window: added, dragged, and strokes drawn onto them."""

import numpy as np
import pytest

pytestmark = pytest.mark.window


@pytest.mark.nightly
def test_a_grid_is_taken_back_and_a_stroke_along_a_ruler_is_straight(program):
    app = program()
    app.settled()
    app.keys("1")
    empty = app.canvas()
    app.click("Guides menu")
    app.click("Add: grid")
    app.box("Grid 1 point 1")
    app.canvas_unlike(empty)
    app.keys("ctrl+z")
    app.until_gone("Grid 1 point 1")
    app.click("Add a guide")
    app.click("Ruler")
    (x0, y0), (x1, y1) = app.at("Ruler 1 point 1"), app.at("Ruler 1 point 2")
    app.stroke((x1, y1), (x1 - 5, y1 + 40), (x1 - 10, y1 + 90))
    app.keys("b")
    app.until_gone("Ruler 1 point 2")
    app.keys("ctrl+semicolon")
    app.park()
    assert app.comes_to(empty)  # hidden, it works all the same
    app.stroke(*((x0 + 20 + 12 * i, y0 + 6 + 3 * i + 8 * (i % 3 - 1)) for i in range(24)))
    painted = app.canvas_unlike(empty)
    rows, columns = np.nonzero(np.abs(painted - empty).max(axis=2) > 60)
    slope = 90 / (x1 - 10 - x0)
    away = (rows + 60 - y0) - slope * (columns + 270 - x0)
    assert columns.max() - columns.min() > 200
    assert np.abs(away).max() < 5  # as wide as the pencil
