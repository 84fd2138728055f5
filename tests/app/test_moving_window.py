"""A layer moved by hand in the real window."""

import numpy as np
import pytest

pytestmark = pytest.mark.window
FROM, TO = (500, 357), (580, 417)  # within the box, far from its handles
CHEQUER = 13  # of 255: the difference of the squares under the paint, which stay
INNER = slice(150, 560), slice(150, 560)  # of the canvas, far from its rims


@pytest.fixture
def app(with_stroke):
    return with_stroke


def test_a_layer_is_dragged_and_nudged_and_nothing_of_it_is_lost(app):
    painted = app.canvas()
    app.keys("v")
    app.at("turn handle")
    app.stroke(FROM, (530, 380), (560, 400), TO)
    app.keys("b")  # without the box
    dragged = app.canvas_unlike(painted)
    by = TO[1] - FROM[1], TO[0] - FROM[0]
    assert np.abs(dragged[INNER] - np.roll(painted, by, axis=(0, 1))[INNER]).max() <= CHEQUER
    app.keys("Right")
    app.canvas_unlike(dragged)
    app.keys("ctrl+z", "ctrl+z")
    assert app.comes_to(painted)
    assert not any(key[1] == "Layer 1 (source)" for key in app.boxes())


@pytest.mark.nightly
def test_what_is_shown_again_is_moved_by_itself_and_leads_to_its_source(app):
    once = app.canvas()
    app.click("show_again")
    app.box("Layer 1 again")
    twice = app.canvas_unlike(once)
    app.keys("v")  # it is chosen already
    app.at("turn handle")
    app.stroke(FROM, (540, 390), TO)
    app.keys("b")
    apart = app.canvas_unlike(twice)
    app.click("source")
    app.settled()  # it is chosen
    app.stroke((600, 520), (680, 560))
    both = app.canvas_unlike(apart)
    changed = (np.abs(both - apart).max(axis=2) > 8).any(axis=1)
    assert changed.sum() > 60  # the stroke, and beside it the one that the placement shows
