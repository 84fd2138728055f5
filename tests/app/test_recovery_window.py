"""What was painted in the real window is had back, whatever ended the program, or its engine."""

import signal
import time

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(240)]


def held(app, *points):
    """The left button drawn through screen points, and held at the last."""
    app.do("mousemove", *points[0], "mousedown", 1)
    for point in points[1:]:
        app.do("mousemove", *point)
        time.sleep(0.03)
    time.sleep(0.3)


def away_from(at, canvas):
    """The canvas but for what lies near a point of the screen, where the pointer may hide it."""
    x, y = at[0] - 270, at[1] - 60
    canvas = canvas.copy()
    canvas[y - 60 : y + 60, x - 60 : x + 60] = 0
    return canvas


def seen(app):
    """The canvas as it is, wherever the pointer is."""
    return app.settled()[60:740, 270:970].astype(int)


def test_what_was_painted_is_had_back_after_a_signal_and_after_a_kill(program):
    app = program()
    app.stroke((400, 300), (500, 420), (600, 300))
    app.stroke((420, 500), (700, 520))
    app.canvas()
    held(app, (700, 250), (760, 300), (800, 380))
    painted = away_from((800, 380), seen(app))
    app.process.send_signal(signal.SIGHUP)
    assert app.process.wait(30) == 0, app.log.read_text()
    app.do("mouseup", 1)

    app = program(ready="cards: 1")
    assert app.box("picture of Untitled")
    app.click("Open")
    app.until_gone("Open")
    app.wait_for("engine ready")
    app.until(lambda screen: np.array_equal(away_from((800, 380), screen[60:740, 270:970]), painted))
    held(app, (350, 600), (500, 640), (650, 600))
    painted = away_from((650, 600), seen(app))
    app.process.send_signal(signal.SIGKILL)
    app.process.wait(30)
    app.do("mouseup", 1)

    app = program(ready="cards: 1")
    app.click("Open")
    app.until(lambda screen: np.array_equal(away_from((650, 600), screen[60:740, 270:970]), painted))
    app.keys("ctrl+z")
    app.canvas_unlike(painted)
    app.keys("ctrl+q")
    app.click("Don’t save")
    assert app.process.wait(30) == 0, app.log.read_text()

    app = program(ready="cards: 0")
    app.click("File")
    app.click("Bin…")
    app.click("Delete")
    app.click("Sure?")
    app.until_gone("Sure?")
