"""What was painted in the real window is had back, whatever ended the program, or its engine."""

import signal

import numpy as np
import pytest
from driven import REST

FILE_MENU = (22, 12)  # on the screen
pytestmark = pytest.mark.window


def unsteadied(app):
    """Has strokes follow the pointer at once.  Steadied, a stroke in hand lags behind by what the clock says, and its
    end catches up when it is lifted: it is another picture then, as it is meant to be."""
    slider = app.part("Stabiliser")
    before = app.parked()[slider]
    app.click(app.at("Stabiliser", across=0.0))
    app.until(lambda screen: not np.array_equal(screen[slider][:, 20:60], before[:, 20:60]))


def held(app, *points):
    """The left button drawn through screen points, and held at the last, where it has gone to and fro a little: so all
    is laid but what is hidden by the pointer.  Returns the canvas away from there."""
    x, y = points[-1]
    app.do("mousemove", *points[0], "mousedown", 1)
    for point in (*points[1:], (x + 1, y), (x + 2, y), (x, y)):
        app.do("mousemove", *point)
    app.until_rest((x, y))
    app.until_kept()
    return away_from((x, y), app.settled()[60:740, 270:970].astype(int))


def away_from(at, canvas):
    """The canvas but for what lies near a point of the screen, where the pointer may hide it."""
    x, y = at[0] - 270, at[1] - 60
    canvas = canvas.copy()
    canvas[y - 60 : y + 60, x - 60 : x + 60] = 0
    return canvas


def test_what_was_painted_is_had_back_after_a_signal_and_after_a_kill(program):
    app = program()
    unsteadied(app)
    app.stroke((400, 300), (500, 420), (600, 300))
    app.park()
    app.until_rest(REST)
    before = app.canvas()
    painted = held(app, (700, 250), (760, 300), (800, 380))
    assert not np.array_equal(painted, away_from((800, 380), before))
    app.process.send_signal(signal.SIGHUP)
    assert app.process.wait(90) == 0, app.log.read_text()
    app.do("mouseup", 1)

    app = program(ready="cards: 1")
    assert app.box("picture of Untitled")
    app.click("Open")
    app.until_gone("Open")
    app.wait_for("painting 1 shown")
    app.until(lambda screen: np.array_equal(away_from((800, 380), screen[60:740, 270:970]), painted))
    before = app.canvas()
    painted = held(app, (350, 600), (500, 640), (650, 600))
    assert not np.array_equal(painted, away_from((650, 600), before))
    app.process.send_signal(signal.SIGKILL)
    app.process.wait(90)
    app.do("mouseup", 1)

    app = program(ready="cards: 1")
    app.click("Open")
    app.wait_for("painting 1 shown")
    app.until(lambda screen: np.array_equal(away_from((650, 600), screen[60:740, 270:970]), painted))
    app.keys("ctrl+z")
    app.canvas_unlike(painted)
    app.keys("ctrl+q")
    app.click("Don’t save")
    assert app.process.wait(90) == 0, app.log.read_text()

    app = program(ready="cards: 0")
    app.click(FILE_MENU)
    app.click("Bin…")
    app.click("Delete")
    app.click("Sure?")
    app.until_gone("Sure?")


def test_an_engine_that_dies_is_started_again_with_the_painting_as_it_was(program):
    app = program(module="dying")
    app.move_to((500, 400))
    app.wheel(1)
    empty = app.canvas()
    app.stroke((400, 300), (500, 420), (600, 300))
    painted = app.canvas_unlike(empty)
    app.keys("ctrl+shift+n")
    app.wait_for("a fault that ends the engine's thread")
    app.box("Copy details")
    app.box("Layer 2")  # what had killed it
    assert app.comes_to(painted), "another picture, or another view"
    app.stroke((420, 300), (640, 260))
    app.canvas_unlike(painted)
    app.keys("ctrl+z")
    assert app.comes_to(painted)
    words = app.log.read_text()
    assert words.count("Traceback (most recent call last)") == 1
    app.close_excused()
