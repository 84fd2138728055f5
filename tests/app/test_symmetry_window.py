"""Painting with symmetry in the real window."""

import numpy as np
import pytest

pytestmark = pytest.mark.window
NEAR = 6  # of 255: where two strokes meet their dabs come in another order


@pytest.mark.nightly
def test_a_stroke_is_mirrored_while_the_view_is_turned_and_the_axis_with_it(program):
    app = program()
    app.settled()
    app.keys("1")
    empty = app.canvas()
    app.keys("y")
    lined = app.canvas_unlike(empty)
    assert (np.abs(lined - empty).max(axis=2) > 8).any(axis=0).sum() <= 4  # an upright line
    app.stroke(*((440 + 8 * i, 320 + 5 * i) for i in range(12)))
    painted = app.canvas_unlike(lined)
    changed = np.abs(painted - lined).max(axis=2) > 40
    columns = np.flatnonzero(changed.any(axis=0))
    line = np.flatnonzero((np.abs(lined - empty).max(axis=2) > 8).any(axis=0)).mean()
    assert abs((columns[0] + columns[-1]) / 2 - line) < 3
    left, right = changed[:, : int(line)].sum(), changed[:, int(line) + 1 :].sum()
    assert left > 500
    assert abs(left - right) < 0.05 * left
    app.keys("ctrl+z")
    assert app.comes_to(lined)
    app.keys("ctrl+z")  # of what only set the symmetry nothing is taken back
    app.stroke((440, 320), (520, 380))
    again = app.canvas_unlike(lined)
    columns = np.flatnonzero((np.abs(again - lined).max(axis=2) > 40).any(axis=0))
    assert columns[0] < line - 50 < line + 50 < columns[-1]
    app.keys("ctrl+z")
    assert app.comes_to(lined)
    app.keys("y")
    assert app.comes_to(empty)
