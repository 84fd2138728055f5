"""What was saved is opened again from the menu, and comes into another painting exactly, in its own place."""

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.nightly]


def test_a_painting_is_opened_again_from_the_menu_and_brought_into_another_one(with_stroke):
    app = with_stroke
    painted = app.canvas()
    app.save_as(app.folder / "lake.ora")
    app.keys("ctrl+n")
    app.click("Start", "New painting")
    app.until_gone("Start")
    app.keys("1")
    empty = app.canvas_unlike(painted)
    app.click("File menu")
    app.click("Bring in a picture…")
    app.click("lake.ora", "Bring in a picture")
    app.click("Open", "Bring in a picture")
    app.click("Group in its place")
    app.box("lake")
    app.keys("b")
    both = app.canvas_unlike(empty)
    dark = [np.argwhere(one.max(axis=-1) < 140) for one in (painted, both)]
    assert abs(len(dark[0]) - len(dark[1])) < len(dark[0]) / 10
    app.keys("ctrl+z")
    app.until_gone("lake")
    app.click("File menu")
    app.click("Open recent")
    app.click("lake.ora")
    app.click("Don’t save")
    app.wait_for("painting 2 shown")
    app.box("Layer 1")
