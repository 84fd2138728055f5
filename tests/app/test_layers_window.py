"""The list of layers in the real window."""

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]


def test_the_tooltip_of_a_layer_covers_no_row(program):
    app = program()
    app.settled(60.0)
    for name in ("Layer 1", "Layer 2", "Layer 3"):
        app.click("add_layer")
        app.box(name)
    rows = [app.part(name) for name in ("Layer 2", "Layer 1")]  # below the one that is pointed at
    left = app.part("eye")[1].start
    column = slice(rows[0][0].start, 730), slice(left, 1280)
    still = app.parked()
    for over in ("Layer 3", "eye"):
        pointed = app.parked(app.at(over))
        app.box("tooltip")
        assert np.array_equal(pointed[column], still[column]), f"the tooltip of {over} covers what is below"
