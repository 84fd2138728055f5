"""What came while the program stood still, as on a loaded machine, happens in the order in which it was done."""

import numpy as np
import pytest
from driven import Stalled

pytestmark = pytest.mark.window


def test_keys_and_presses_are_taken_in_their_order(program):
    app = program()
    app.settled()
    empty = app.canvas()
    with Stalled(app):  # the view moves, there and back, and nothing is painted
        app.do("keydown", "space")
        app.stroke((500, 300), (600, 300), (700, 400), (500, 300))
        app.do("keyup", "space")
    assert app.comes_to(empty)
    with Stalled(app):  # painted with one brush, and then picked another tool
        app.keys("b")
        app.stroke(*((500 + 20 * i, 400) for i in range(8)))
        app.keys("h")
    painted = app.canvas_unlike(empty)
    app.keys("ctrl+m")
    app.click("adjustment")
    app.click("Formula")
    field = app.at("formula", window="Adjust")
    app.box("Cancel", "Adjust")
    with Stalled(app):
        app.do("mousemove", *field, "mousedown", 1, "sleep", 0.05, "mouseup", 1, "sleep", 0.7)
        app.keys("ctrl+a")
        app.do("type", "--delay", 20, "1 - pic")
        app.do("sleep", 0.7)
    app.click(app.at("Cancel", 1.3, window="Adjust"))  # leaves the field
    app.until(lambda screen: bool(np.any(screen[300:740, 270:970].min(axis=-1) > 250)))
    app.keys("Escape")
    app.until_gone("formula")
    assert app.comes_to(painted)
