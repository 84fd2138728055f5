"""Gradients dragged by hand in the real window."""

import time

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]
ROW, FROM, TO = 400, 330, 900  # a row of the screen, and columns


def until(app, good, seconds=60.0):
    """Returns the row of the screen once that is good, with nothing over it: what is drawn comes tile by tile."""
    end = time.monotonic() + seconds
    while not good(row := app.screen()[ROW, 290:960].astype(int)):
        assert time.monotonic() < end, f"it never comes: {row[::20].tolist()}"
        time.sleep(0.1)
    return row


def test_a_drag_fills_the_frame_from_one_colour_to_the_other_in_one_step(program):
    app = program()
    app.keys("1", "d", "shift+g")
    app.box("Radial")
    app.park()
    paper = app.canvas()[ROW - 60, 20:690]
    app.do("mousemove", FROM, ROW, "mousedown", 1)
    app.do("mousemove", 500, ROW, "mousemove", TO, ROW)
    until(app, lambda row: np.abs(row[60:600] - paper[60:600]).max() > 8)  # a line shows what is meant
    app.do("mouseup", 1)
    app.park()

    def even(row: np.ndarray) -> bool:
        """Whether it rises from black to white without a band: each grey of the screen is there."""
        steps = np.diff(row, axis=0)
        ends = (row[:35] == 0).all() and (row[615:] == 255).all()
        return bool(ends and steps.min() >= 0 and steps.max() <= 1 and (row == row[:, :1]).all())

    until(app, even)
    app.keys("ctrl+z")
    until(app, lambda row: (row == paper).all())
    app.click("Transparent")
    app.canvas()  # a loaded machine sees the drag begin before the click
    app.do("mousemove", FROM, ROW, "mousedown", 1, "mousemove", 500, ROW, "mousemove", TO, ROW, "mouseup", 1)
    app.park()
    faded = paper * np.clip((np.arange(290, 960) - FROM) / (TO - FROM), 0, 1)[:, None]
    until(app, lambda row: np.abs(row - faded).max() <= 2 and (row[615:] == paper[615:]).all())
