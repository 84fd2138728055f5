"""What the actions of the Select menu ask for, and when they may be done."""

import numpy as np
import pytest

from app.actions.actions import ACTIONS, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from engine.numeric.address import Rect
from engine.painting.commands import SetFrame
from engine.painting.select_commands import Box, Select, Whole
from engine.studio.selecting.ants_records import Ants

BOUNDS = Rect(5, 7, 205, 150)


def told(bounds):
    return Ants(True, (), 0, Rect(0, 0, 9, 9), np.empty((0, 4), np.float32), bounds is not None, bounds)


@pytest.fixture
def desk():
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    made.learn(ready=True)
    return made


@pytest.fixture
def posted(desk):
    requests = []
    desk.post = requests.append
    return requests


@pytest.mark.parametrize("bounds", [None, BOUNDS])
def test_the_frame_is_cropped_to_a_selection_that_has_bounds(desk, posted, bounds):
    assert not perform(desk, ACTIONS["crop"])
    desk.selecting.hear(told(bounds))
    assert perform(desk, ACTIONS["crop"]) == (bounds is not None)
    assert [request.command for request in posted] == ([SetFrame(BOUNDS)] if bounds else [])


def test_a_key_right_after_a_drag_counts_before_the_engine_tells_of_it(desk, posted):
    assert not perform(desk, ACTIONS["select_invert"])
    desk.selecting.choose(desk.post, Select(Box(0, BOUNDS)))
    assert perform(desk, ACTIONS["select_invert"])
    assert perform(desk, ACTIONS["select_none"])
    assert not perform(desk, ACTIONS["select_invert"])
    desk.selecting.hear(told(None))  # of what was asked for before
    assert not perform(desk, ACTIONS["select_invert"])
    assert [request.command.source for request in posted] == [Box(0, BOUNDS), Whole("invert"), Whole("none")]
