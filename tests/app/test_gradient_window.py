"""Gradients dragged by hand in the real window."""

import numpy as np
import pytest

pytestmark = pytest.mark.window
ROW, FROM, TO = 400, 330, 900  # a row of the screen, and columns


def row_of(screen):
    """The row, between the panels."""
    return screen[ROW, 290:960].astype(int)


def drag(app):
    """Draws the line, and holds its end."""
    app.do("mousemove", FROM, ROW, "mousedown", 1, "mousemove", 500, ROW, "mousemove", TO, ROW)


def test_a_drag_fills_the_frame_from_one_colour_to_the_other_in_one_step(program):
    app = program()
    app.keys("1", "d", "shift+g")
    app.box("Radial")
    paper = app.canvas()[ROW - 60, 20:690]
    drag(app)
    app.until(lambda screen: np.abs(row_of(screen)[60:600] - paper[60:600]).max() > 8, (TO, ROW))  # it shows a line
    app.do("mouseup", 1)
    row = row_of(app.until(lambda screen: (row_of(screen)[:35] == 0).all()))
    assert (row[615:] == 255).all()
    assert (np.diff(row, axis=0) >= 0).all()
    assert np.diff(row, axis=0).max() <= 1  # no bands: every tone of the screen is there
    assert (row == row[:, :1]).all()
    app.keys("ctrl+z")
    app.until(lambda screen: (row_of(screen) == paper).all())
    app.click("Transparent")
    drag(app)
    app.do("mouseup", 1)
    row = row_of(app.until(lambda screen: (row_of(screen)[:35] == 0).all()))
    assert (row[615:] == paper[615:]).all()
    shown = np.clip((np.arange(290, 960) - FROM) / (TO - FROM), 0, 1)[:, None]
    assert np.abs(row - paper * shown).max() <= 2
