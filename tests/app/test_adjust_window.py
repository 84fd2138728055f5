"""Colours of a layer adjusted in the real window: seen while they are set, done as one step."""

import numpy as np
import pytest

pytestmark = pytest.mark.window


@pytest.mark.nightly
def test_an_adjustment_is_seen_before_it_is_done_and_taken_back_at_once(program):
    app = program()
    app.settled()
    empty = app.canvas()
    app.stroke(*((500 + 8 * i, 500) for i in range(50)))
    app.box("Layer 1")  # the stroke is done, and there is something to adjust
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


def middle(screen):
    """The middle of what is white below the dialog, row and column; None where nothing is."""
    found = np.argwhere(screen[300:740, 270:970].min(axis=-1) > 250)
    return found.mean(axis=0) if len(found) else None


@pytest.mark.nightly
def test_formulas_and_curves_are_seen_and_the_view_moves_below_the_dialog(with_stroke):
    app = with_stroke
    app.keys("ctrl+m")
    app.click("adjustment")
    app.click("Formula")
    app.click("formula", "Adjust")
    app.fill("1 - pic")
    app.click(app.at("Cancel", 1.3, window="Adjust"))  # leaves the field
    white = middle(app.until(lambda screen: middle(screen) is not None))
    app.drag((900, 600), (860, 620))
    app.do("mouseup", 1)
    moved = white + np.array((20, -40))
    app.until(lambda screen: middle(screen) is not None and np.abs(middle(screen) - moved).max() < 2)
    app.do("mousemove", 800, 500)
    app.wheel(1)
    app.until(lambda screen: middle(screen) is None or np.abs(middle(screen) - moved).max() > 5)
    app.click("adjustment")
    app.click("Curves")
    app.click("curve All")
    left, top, right, bottom = app.box("whole curve")
    app.click(((left + right) // 2, top + (bottom - top) // 5))
    app.keys("Escape")
    app.until_gone("whole curve")
    app.click("Adjust", "Adjust")
    app.until_gone("adjustment")
