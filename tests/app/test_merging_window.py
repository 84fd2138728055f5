"""Layers made one in the real window: at once where all of it stays, else told before."""

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.nightly]


def test_layers_are_merged_and_what_would_be_lost_is_told_before(program):
    app = program()
    app.settled()
    empty = app.canvas()
    app.stroke(*((380 + 12 * i, 400) for i in range(24)))
    one = app.canvas_unlike(empty)
    app.click("add_layer")
    app.box("Layer 2")
    app.stroke(*((500, 300 + 9 * i) for i in range(24)))
    two = app.canvas_unlike(one)
    app.keys("ctrl+alt+e")
    app.until_gone("Layer 2")
    assert np.abs(app.canvas() - two).max() <= 1
    app.keys("ctrl+z")
    app.box("Layer 2")
    app.click("Layer 2")
    app.click("blend")
    app.click("Multiply")
    app.settled()
    app.click("merge_down")
    app.box("Merge", "Merge")
    app.keys("Escape")
    app.box("Layer 2")
    app.click("merge_down")
    app.click("Merge", "Merge")
    app.until_gone("Layer 2")
