"""The frame fits what is painted: nothing that shows lies outside, and each of its sides meets paint."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.settings import Brush
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.moving.move_requests import AskPainted, FitFrame, PaintedTold
from engine.studio.studio import Studio

FIRST = Rect(0, 0, 300, 200)


@pytest.fixture
def told():
    return []


@pytest.fixture
def studio(told):
    made = Studio(told.append, lambda request: None)
    made.do(q.New(FIRST))
    return made


def dot(x, y, level=0, layer=None, radius=6.0):
    line = np.zeros((2, 6))
    line[:, 0], line[:, 1], line[:, 2] = (x, x + 3), y, 1
    return c.Stroke(level, (0, 0), line, Brush(radius=radius, colour="#205080"), layer)


def fit(studio):
    studio.do(FitFrame())
    while studio.step():
        pass
    return studio.easel.session.painting


def reached(studio, told):
    studio.do(AskPainted())
    while studio.step():
        pass
    return [one.rect for one in told if isinstance(one, PaintedTold)][-1]


def alpha(painting, rect):
    return composite(painting.root, 0, rect, layer_planes)[3] != 0


@settings(max_examples=10, deadline=None)
@given(spots=st.lists(st.tuples(st.integers(-200, 500), st.integers(-200, 400)), min_size=1, max_size=4))
def test_it_holds_all_paint_and_no_more(spots):
    studio = Studio(lambda result: None, lambda request: None)
    studio.do(q.New(FIRST))
    for x, y in spots:
        studio.do(q.Do(dot(x, y)))
    painting = fit(studio)
    frame = painting.frame
    wide = alpha(painting, frame.grown(30))
    assert wide[30:-30, 30:-30].sum() == wide.sum()
    for side in (wide[30], wide[-31], wide[:, 30], wide[:, -31]):
        assert side.any()
    studio.do(q.Do(c.Undo()))
    assert studio.easel.session.painting.frame == FIRST


def test_what_is_hidden_or_a_reference_does_not_count(studio):
    for name in ("Near", "Hidden", "Photo"):
        studio.do(q.Do(c.AddLayer(name)))
        studio.do(q.Do(dot(40 if name == "Near" else 900, 50, layer=name)))
    studio.do(q.Do(c.SetLayer("Hidden", visible=False)))
    studio.do(q.Do(c.SetLayer("Photo", role="reference")))
    assert fit(studio).frame.x1 < 100


def test_where_nothing_is_painted_the_frame_stays_and_that_is_told(studio, told):
    assert fit(studio).frame == FIRST
    notes = [one.text for one in told if isinstance(one, results.Note)]
    assert notes == ["There is no paint to fit the frame to"]
    assert reached(studio, told).empty
    studio.do(q.Do(dot(40, 50)))
    steps = len(fit(studio) and studio.easel.session.log)
    fit(studio)
    assert len(studio.easel.session.log) == steps
    assert [one.text for one in told if isinstance(one, results.Note)][1:] == ["The frame fits the paint already"]
