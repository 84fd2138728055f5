"""What a click of the wand asks for, and what is asked of a selection that is filled."""

import numpy as np
import pytest

from app.actions.actions import ACTIONS, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.input.events import PenEvent
from app.tools.tools import TOOLS
from engine.numeric.address import Rect
from engine.painting.fill_command import Fill, Like
from engine.painting.select_commands import Select
from engine.studio.selecting.ants_records import Ants

AT = (641.0, 403.0)


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


def clicked(desk, posted, tool):
    gesture = TOOLS[tool].gesture(desk, PenEvent("down", *AT, button=1))
    next(gesture)
    with pytest.raises(StopIteration):
        gesture.send(PenEvent("up", *AT, button=1))
    return posted.pop().command


@pytest.mark.parametrize(
    ("shift", "alt", "op"),
    [(False, False, "replace"), (True, False, "add"), (False, True, "subtract"), (True, True, "intersect")],
)
def test_the_wand_selects_what_the_tool_fill_would_fill_and_joins_it_as_the_keys_say(desk, posted, shift, alt, op):
    desk.filling.tolerance, desk.filling.gap, desk.filling.seen, desk.filling.contiguous = 0.3, 5.0, False, False
    filled = clicked(desk, posted, "fill")
    desk.pointer.shift, desk.pointer.alt = shift, alt
    chosen = clicked(desk, posted, "wand")
    assert chosen == Select(filled.like, op, filled.like.level, grow=1.0)
    assert isinstance(chosen.source, Like)


def test_nothing_is_asked_for_before_the_engine_is_there(desk, posted):
    desk.learn(ready=False)
    with pytest.raises(StopIteration):
        next(TOOLS["wand"].gesture(desk, PenEvent("down", *AT, button=1)))
    assert not posted


@pytest.mark.parametrize("bounded", [True, False])
def test_the_selection_is_filled_as_a_whole_or_as_far_as_it_is_seen(desk, posted, bounded):
    action = ACTIONS["fill_selection"]
    assert not perform(desk, action)  # nothing is selected
    desk.selecting.ants = Ants(True, (), 0, Rect(0, 0, 9, 9), np.empty((0, 4), np.float32), bounded)
    assert perform(desk, action)
    (request,) = posted
    assert isinstance(request.command, Fill)
    like = request.command.like
    assert (like is None) == bounded
    if like is not None:
        assert (like.rect, like.tolerance, like.contiguous) == (desk.view.visible(0), 1.0, False)
        assert request.command.open
