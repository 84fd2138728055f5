"""What is selected of a layer, lifted, moved and set down by hand in the real window."""

import numpy as np
import pytest

from engine.canvas import layers
from engine.studio.filing.documents import opened

pytestmark = pytest.mark.window
CHEQUER = 13  # of 255: the difference of the squares under the paint, which stay
BOX = (470, 330), (560, 420)  # what is selected, on the screen
CANVAS = (270, 60)  # where the canvas that is looked at begins on the screen


@pytest.fixture
def app(with_stroke):
    return with_stroke


def select(app):
    app.keys("s")
    app.stroke(BOX[0], (500, 380), BOX[1])
    app.keys("v")
    app.park()
    app.box("turn handle")


def moved(painted, across, down):
    """A picture of the canvas after the pixels that are selected were moved."""
    (x0, y0), (x1, y1) = ((x - CANVAS[0], y - CANVAS[1]) for x, y in BOX)
    out, part = painted.copy(), painted[y0:y1, x0:x1]
    out[y0:y1, x0:x1] = painted[10, 300]  # the paper
    inked = np.abs(part - painted[10, 300]).max(axis=2) > 2 * CHEQUER
    out[y0 + down : y1 + down, x0 + across : x1 + across][inked] = part[inked]
    return out


def names(app, path):
    app.save_as(path)
    return [node.name for node in layers.walk(opened(path).painting.root)]


def test_what_is_selected_floats_until_it_is_set_down_as_one_step(app, tmp_path):
    painted = app.canvas()
    select(app)
    app.drag((515, 375), (555, 445))
    app.box("exactly +40, +70 px")
    app.do("mouseup", 1)
    app.drag((555, 445), (615, 415))
    app.do("mouseup", 1)
    app.keys("Left", "Up", "Return")
    app.keys("ctrl+shift+a", "b")
    done = app.canvas_unlike(painted)
    assert (np.abs(done - moved(painted, 99, 39)).max(axis=2) > 3 * CHEQUER).mean() < 2e-4
    assert names(app, tmp_path / "moved.ora") == ["Layer 1"]
    app.keys("ctrl+z", "ctrl+z")  # that nothing is selected, and the move
    app.click("deselect")
    assert app.comes_to(painted)


@pytest.mark.nightly
def test_escape_takes_it_back_and_another_tool_sets_it_down(app):
    painted = app.canvas()
    select(app)
    app.drag((515, 375), (575, 445))
    app.do("mouseup", 1)
    app.keys("Escape")
    app.keys("ctrl+shift+a", "b")
    assert app.comes_to(painted)
    select(app)
    app.do("keydown", "alt")
    app.drag((515, 375), (575, 475))
    app.do("mouseup", 1)
    app.do("keyup", "alt")
    app.keys("b", "ctrl+shift+a")
    both = app.canvas_unlike(painted)
    assert (np.abs(both - painted).max(axis=2) > 3 * CHEQUER).sum() > 500
    old = np.abs(painted - painted[10, 300]).max(axis=2) > 3 * CHEQUER
    assert (np.abs(both - painted).max(axis=2)[old] > 3 * CHEQUER).mean() < 0.5


def turn(app):
    """Turns what is selected by parts."""
    x, y = app.at("turn handle")
    app.drag((x, y), (x + 60, y + 20))
    app.do("mouseup", 1)
    app.box("Pixels of level 0")


@pytest.mark.nightly
def test_what_is_turned_by_parts_is_laid_into_its_layer_which_is_painted_on(app, tmp_path):
    painted = app.canvas()
    select(app)
    turn(app)
    app.keys("b")
    app.keys("ctrl+shift+a")
    app.park()
    laid = app.canvas_unlike(painted)
    app.stroke((600, 500), (700, 520))
    app.settled()
    assert not np.array_equal(app.canvas(), laid)
    assert names(app, tmp_path / "turned.ora") == ["Layer 1"]
    app.keys("ctrl+z", "ctrl+z", "ctrl+z")
    app.click("deselect")
    assert app.comes_to(painted)


@pytest.mark.nightly
def test_what_is_turned_by_parts_is_set_down_above_and_can_be_baked(app, tmp_path):
    painted = app.canvas()
    select(app)
    turn(app)
    app.click("set_above")
    app.box("Layer 1 part")
    app.click("Make independent", "status")
    app.click("Make independent", "Make independent")  # its rock goes no finer then
    app.until_gone("Make independent")  # which takes the keys
    app.keys("ctrl+shift+a")
    app.settled()
    assert names(app, tmp_path / "turned.ora") == ["Layer 1", "Layer 1 part (source)", "Layer 1 part"]
    app.keys("ctrl+z", "ctrl+z", "ctrl+z", "b")
    app.click("deselect")
    assert app.comes_to(painted)
