"""Erosion from the window: worked out piece by piece, told how far it is, given up, done in one step."""

import numpy as np
import pytest
from immutables import Map

from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.land.wear_records import StopWearing, WearDown, WornTold
from engine.studio.studio import Studio
from engine.terrain.plane import land

COMMAND = c.Erode(Rect.at(8, 8, 48, 48), 0, "Land", rain=4.0, talus=0.5)
FRAME = Rect.at(0, 0, 64, 64)
LINE = np.array([[32.0, 32, 1, 0, 0, 0]])
PAINTED = (
    c.AddLayer("Land"),
    c.SetLayer("Land", role="height", scale=60.0),
    c.Stroke(0, (0, 0), LINE, Brush(radius=40, hardness=0.0, colour="#ffffff", dynamics=Map()), "Land"),
)


@pytest.fixture
def told():
    return []


@pytest.fixture
def studio(told):
    made = Studio(told.append, lambda request: None)
    made.do(q.New(FRAME))
    for command in PAINTED:
        made.do(q.Do(command))
    while made.step():
        pass
    told.clear()
    return made


def heights(painting):
    return land(painting, "Land").height(0, FRAME)


def test_what_is_worked_out_ahead_is_what_the_command_makes(studio, told):
    before = heights(studio.easel.session.painting)
    studio.do(WearDown(COMMAND))
    while studio.step():
        pass
    parts = [one.part for one in told if isinstance(one, WornTold)]
    assert parts[-1] is None
    assert parts[:-1] == sorted(parts[:-1])
    assert len(parts) > 4
    after = heights(studio.easel.session.painting)
    assert np.abs(after - before).max() > 1
    alone = Studio(lambda result: None, lambda request: None)
    alone.do(q.New(FRAME))
    for command in (*PAINTED, COMMAND):
        alone.do(q.Do(command))
    assert np.array_equal(heights(alone.easel.session.painting), after)
    studio.do(q.Do(c.Undo()))
    assert np.array_equal(heights(studio.easel.session.painting), before)


def test_it_can_be_given_up(studio, told):
    before = studio.easel.session.painting
    studio.do(WearDown(COMMAND))
    studio.do(StopWearing())
    while studio.step():
        pass
    assert studio.easel.session.painting is before
    assert [one.part for one in told if isinstance(one, WornTold)] == [0.0, None]


def test_what_cannot_be_done_is_told(studio, told):
    studio.do(q.Do(c.SetLayer("Land", locked=True)))
    studio.do(WearDown(COMMAND))
    while studio.step():
        pass
    notes = [one for one in told if isinstance(one, results.Note)]
    assert "locked" in notes[-1].text
    assert [one.part for one in told if isinstance(one, WornTold)][-1] is None
