"""Selecting in the real window: what is dragged is selected, strokes stay within, the rim shows."""

import numpy as np
import pytest

pytestmark = pytest.mark.window
LEFT, TOP = 270, 60  # of what `canvas` shows
FROM, TO = (330, 260), (560, 430)


@pytest.fixture
def app(program):
    """The window, one pixel of level 0 on one of the screen."""
    app = program()
    app.settled()
    app.keys("1")
    return app


def unlike(one, other):
    return np.abs(one.astype(int) - other.astype(int)).max(axis=2) > 24


def marching(app, before):
    """The canvas once the rim shows, which goes round without end."""
    return app.until(lambda screen: unlike(screen[TOP:740, LEFT:970], before).sum() > 200)[TOP:740, LEFT:970]


def test_what_is_dragged_is_selected_and_strokes_stay_within(app):
    empty = app.canvas()
    app.keys("s")
    app.stroke(FROM, (400, 300), (500, 400), TO)
    app.keys("b")
    assert 200 < unlike(marching(app, empty), empty).sum() < 4000  # a thin line
    app.stroke(*((300 + 10 * i, 340) for i in range(40)))
    app.keys("ctrl+shift+a")
    painted = unlike(app.canvas(), empty)
    columns, rows = np.flatnonzero(painted.any(axis=0)), np.flatnonzero(painted.any(axis=1))
    assert columns[-1] - columns[0] == pytest.approx(TO[0] - FROM[0], abs=3)
    assert rows[-1] - rows[0] < TO[1] - FROM[1]
    app.keys("ctrl+z", "ctrl+z", "ctrl+z")
    assert app.comes_to(empty)


def test_a_click_selects_nothing_and_invert_paints_around(app):
    empty = app.canvas()
    app.keys("shift+s")
    app.stroke(FROM, (450, 350), TO)
    marching(app, empty)
    app.keys("ctrl+i", "b")
    app.stroke(*((300 + 10 * i, 340) for i in range(30)))
    app.keys("s")
    app.stroke((320, 500), (320, 500))
    painted = unlike(app.canvas(), empty)
    assert painted.any()
    assert not painted[335 - TOP : 345 - TOP, 345 - LEFT : 540 - LEFT].any()
    assert painted[335 - TOP : 345 - TOP, 300 - LEFT : 325 - LEFT].any()
