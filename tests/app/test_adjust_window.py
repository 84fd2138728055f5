"""Colours of a layer adjusted in the real window: seen while they are set, done as one step."""

import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]


def test_an_adjustment_is_seen_before_it_is_done_and_taken_back_at_once(program):
    app = program()
    app.settled(60.0)
    empty = app.canvas()
    app.stroke(*((500 + 8 * i, 500) for i in range(50)))
    painted = app.canvas_unlike(empty)
    app.keys("ctrl+m")
    app.box("Adjust", "Adjust")
    app.keys("Return")  # nothing is set yet
    app.click("adjustment")
    app.box("Invert")
    app.keys("Return")  # it is for the list
    app.until_gone("Invert")
    app.click("adjustment")
    app.click("Invert")
    app.box("Adjust", "Adjust")
    app.canvas_unlike(painted)
    app.keys("Escape")
    assert app.comes_to(painted)
    app.keys("ctrl+m")
    app.click("adjustment")
    app.click("Invert")
    app.canvas_unlike(painted)
    app.click("Adjust", "Adjust")
    app.until_gone("adjustment")
    app.canvas_unlike(painted)
    app.keys("ctrl+z")
    assert app.comes_to(painted)
