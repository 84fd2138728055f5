"""Painting on an object: rays of the pen, the voxels while it moves and afterwards, and the command that is posted."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from test_solid_state import _Desk

from app.desk.hand import Hand
from app.desk.solids.shown_solid import turned_by
from app.desk.solids.solid_state import SolidState
from app.desk.solids.solid_work import Carve
from app.desk.solids.touching_up import ObjectSeen, TouchUp, brush_on_solid
from app.input.events import PenEvent
from app.panels.solids.solid_panel import SolidPanel
from app.tools.solid_gestures import touch_up
from engine.brush.settings import Brush
from engine.painting.commands import Touch
from engine.painting.layering.touch_command import VOXELS


@pytest.fixture
def state():
    state = SolidState(material="granite", name="cube", room=(400, 300), turn=(20.0, 15.0), corner=(30.0, 40.0))
    state.carved = Carve(state.made, "cube", 24, None).carry_out()
    state.painting = True
    return state


def _on_picture(state, place):
    x, y, z = turned_by(*state.turn) @ np.array(place)
    lens = 150.0 / state.carved.nearness / (6.4 - z)
    return 200.0 + lens * x, 150.0 - lens * y


def test_a_ray_meets_the_object_where_the_picture_shows_it(state):
    sight = ObjectSeen(state.aspect)
    for place in ((0.3, -1.0, 0.2), (-0.6, -1.0, -0.5), (0.4, 0.1, 1.0)):
        met = sight.hit(*_on_picture(state, place))
        wanted = (np.array(place) * state.scale + 0.5) * VOXELS
        assert np.abs(np.array(met.place) - wanted).max() < 1e-3 * VOXELS
        beside = sight.hit(_on_picture(state, place)[0] + 1.0, _on_picture(state, place)[1])
        assert 0.5 < np.abs(np.array(beside.place) - met.place).max() / met.voxels < 3.0
    assert sight.hit(5.0, 5.0) is None


@pytest.mark.parametrize("turn", [(20.0, 15.0), (45.0, 35.3), (0.0, 90.0)])
def test_a_cube_is_seen_whole_however_it_is_turned(state, turn):
    state.turn = turn
    corners = ObjectSeen(state.aspect)._corners
    assert (corners > 2.0).all()
    assert (corners < np.array((398.0, 298.0))).all()


def test_what_is_seen_while_the_pen_moves_is_what_is_carved_afterwards(state):
    sight = ObjectSeen(state.aspect)
    for mode in ("paint", "erase"):
        brush = brush_on_solid(Brush(radius=30.0, colour="#20d0ff", opacity=0.8, mode=mode), 20.0)
        stroke = TouchUp("granite", brush, state.carved)
        seen = state.carved
        for x in np.linspace(120.0, 260.0, 12):
            seen = stroke.go(sight.hit(x, 160.0), x, 160.0, 0.9) or seen
        assert stroke.go(sight.hit(260.1, 160.0), 260.1, 160.0, 0.9) is None  # no way at all
        told = (*state.carved.touches, stroke.told())
        carved = Carve(state.made, "cube", 24, seen, told).carry_out()
        assert np.abs(carved.cube.astype(int) - seen.cube).max() <= 3
        assert (seen.cube != state.carved.cube).any()
        assert carved.plain is state.carved.plain
        anew = Carve(state.made, "cube", 24, None, told).carry_out()
        assert np.array_equal(anew.cube, carved.cube)
        state.carved, state.touches = carved, told
    undone = Carve(state.made, "cube", 24, state.carved, ()).carry_out()
    assert np.array_equal(undone.cube, undone.plain)


def test_a_stroke_that_leaves_the_object_is_broken(state):
    sight = ObjectSeen(state.aspect)
    stroke = TouchUp("granite", brush_on_solid(Brush(), 9.0), state.carved)
    for x, y in ((190.0, 150.0), (200.0, 150.0), (5.0, 5.0), (210.0, 160.0), (215.0, 160.0)):
        stroke.go(sight.hit(x, y), x, y, 1.0)
    told = stroke.told()
    assert (len(told.points), told.breaks) == (4, (2,))


def test_a_gesture_paints_and_one_that_is_given_up_leaves_nothing(state):
    posted = []
    hand = Hand()
    desk = SimpleNamespace(solid=state, hand=hand, post=posted.append, strip="solid", known=SimpleNamespace(scene=None))
    x, y = np.array(_on_picture(state, (0.3, -1.0, 0.2))) + state.corner
    panel, before = SolidPanel(), state.carved
    assert panel.stroke(desk, 35.0, 45.0) is None
    assert panel.stroke(desk, x, y) is touch_up
    for last, count in (("lost", 1), ("", 1), ("up", 2)):
        gesture = touch_up(desk, PenEvent("down", x, y, pressure=0.8))
        next(gesture)
        assert state.stroke is not None
        assert state.seen is None
        gesture.send(PenEvent("move", x + 9, y, pressure=0.7))
        assert state.carved is not before
        if last:
            with pytest.raises(StopIteration):
                gesture.send(PenEvent(last, x + 9, y))
        gesture.close()
        assert state.stroke is None
        assert len(posted) == count
        if not last:
            assert state.carved is before
        state.carved = before
    command = posted[0].command
    assert isinstance(command, Touch)
    assert command.solid == "granite"
    assert [point[3] for point in command.points] == [0.8, 0.7]
    assert command.brush.radius == pytest.approx(
        hand.brush.radius * ObjectSeen(state.aspect).hit(x - 30.0, y - 40.0).voxels, rel=0.01
    )


def test_paint_that_the_painting_has_is_shown(state):
    touch = Touch("granite", ((128.0, 20.0, 128.0, 1.0),), brush_on_solid(Brush(colour="#00ff00"), 60.0))
    desk = _Desk(state)
    desk.known = SimpleNamespace(scene=SimpleNamespace(touches={"granite": (touch,)}))
    state.cubes, state.carved = (), replace(state.carved, whole=True)
    SolidPanel().wants(desk, 0.0)
    assert state.carved.touches == (touch,)
    assert state.carved.cube[12, 1, 12].tolist() == [0, 255, 0]
