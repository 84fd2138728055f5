"""Shapes drawn by the brush in the real window."""

import numpy as np
import pytest

pytestmark = pytest.mark.window


def test_an_ellipse_is_chosen_from_the_list_and_drawn_and_taken_back(program):
    app = program()
    app.settled()
    app.keys("1")
    app.click("shapes")
    app.click("shape draw_ellipse")
    app.until_gone("shape draw_ellipse")
    empty = app.canvas()
    app.stroke((420, 330), (500, 390), (620, 490))
    drawn = app.canvas_unlike(empty)
    rows, columns = np.nonzero(np.abs(drawn - empty).max(axis=2) > 40)
    assert abs(columns.max() - columns.min() - 200) < 12
    assert abs(rows.max() - rows.min() - 160) < 12
    middle = slice((rows.min() + rows.max()) // 2 - 20, (rows.min() + rows.max()) // 2 + 20)
    assert np.array_equal(
        drawn[middle, columns.min() + 60 : columns.max() - 60], empty[middle, columns.min() + 60 : columns.max() - 60]
    )
    app.keys("ctrl+z")
    assert app.comes_to(empty)
