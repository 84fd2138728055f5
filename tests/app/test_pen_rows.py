"""What a pen tells as a row of a stroke: over a picture that is turned and mirrored, its tilt and barrel go along."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.canvas.view import Place, View
from app.input.events import PenEvent
from app.tools.painting_gestures import _point


@given(st.floats(-3, 3), st.booleans(), st.floats(0, 360))
def test_tilt_and_barrel_point_where_the_pen_goes(angle, mirrored, degrees):
    view = View(Place(0, 0, 0), 0, 0.25, 800, 600, angle, mirrored)
    way = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    start = PenEvent("down", 300.0, 200.0, 0.5, pen=True)
    first = _point(view, 0, (0, 0), start, 0.0)
    told = {"tilt_x": 40 * way[0], "tilt_y": 40 * way[1], "rotation": degrees}
    there = _point(view, 0, (0, 0), PenEvent("move", 300 + 50 * way[0], 200 + 50 * way[1], 0.5, pen=True, **told), 0.0)
    gone = math.atan2(there[1] - first[1], there[0] - first[0])
    assert len(first) == 6
    np.testing.assert_allclose(there[3:5], [40 * math.cos(gone), 40 * math.sin(gone)], atol=1e-3)
    assert math.cos(math.radians(there[6]) - gone) == pytest.approx(1.0, abs=1e-6)
