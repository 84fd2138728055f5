"""What the actions of the Select menu ask for, and when they may be done."""

import numpy as np
import pytest

from app.actions.actions import ACTIONS, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.moving.floating import want_rim
from app.desk.moving.move_state import Floating
from engine.canvas.placing.pose import Pose
from engine.numeric.address import Rect
from engine.painting.commands import SetFrame
from engine.painting.select_commands import Box, Select, Whole
from engine.studio.selecting.ants_records import Ants, AskAnts

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


@pytest.mark.parametrize("pose", [None, Pose((900, -700)), Pose(turned=(0.8, 0.6)), Pose((9, 4), levels=2, turn=1)])
def test_the_rim_of_what_floats_is_asked_for_wherever_it_comes_into_sight(desk, posted, pose):
    desk.moving.floating = None if pose is None else Floating("Paint", pose, "cut", 1)
    want_rim(desk)
    want_rim(desk)
    (asked,) = posted
    assert isinstance(asked, AskAnts)
    assert asked.area.area < 4 * 1792 * 1280
    shown = asked.area if pose is None else pose.similarity.shown(asked.area, asked.level, 0)
    visible = desk.view.visible(0)
    assert shown.union(visible) == shown
    if pose is not None:
        desk.moving.floating = None
        want_rim(desk)
        assert posted[-1].level == 0
        assert posted[-1].area.union(visible) == posted[-1].area
