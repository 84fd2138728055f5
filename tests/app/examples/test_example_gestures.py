"""Gestures, keys and the status line while one paints with examples."""

import pytest
from examples_at_hand import named
from imgui_bundle import imgui

from app import icons
from app.actions.actions import ACTIONS
from app.cursor import apart
from app.desk.examples import example_state, example_use, example_work
from app.desk.examples.region_state import INVERTED
from app.input.events import PenEvent
from app.panels import status
from app.panels.strip import StripPanel
from app.tools import asking_gestures, painting_gestures
from engine.studio.requests import GetReady
from engine.studio.results import Growing, Writing


def pen(kind, x, y, eraser=False):
    return PenEvent(kind, x, y, eraser=eraser)


@pytest.fixture
def region(desk):
    """A region on the screen, its corner at (100, 200), two pixels of the screen for each of its own."""
    example_use.choose(desk, named(desk, "felt"))
    example_work.edit(desk)
    desk.examples.spot = (100.0, 200.0, 2.0)
    return desk.examples.region


def test_a_stroke_in_the_region_paints_there_and_a_pens_eraser_paints_out(desk, region):
    before = region.scene.inside.copy()
    gesture = painting_gestures.paint_region(desk, pen("down", 110.0, 210.0))
    next(gesture)
    with pytest.raises(StopIteration):
        gesture.send(pen("up", 130.0, 210.0))
    assert region.scene.inside[5, 5:15].all()
    gesture = painting_gestures.paint_region(desk, pen("down", 110.0, 210.0, eraser=True))
    next(gesture)
    with pytest.raises(StopIteration):
        gesture.send(pen("up", 130.0, 210.0))
    assert not region.scene.inside[5, 5:15].any()
    assert region.way == "in"
    region.travel(desk.post, -2)
    assert (region.scene.inside == before).all()


def test_a_stroke_that_is_given_up_leaves_the_region_as_it_was(desk, region):
    before = region.scene.inside.copy()
    gesture = painting_gestures.paint_region(desk, pen("down", 110.0, 210.0))
    next(gesture)
    gesture.send(pen("move", 130.0, 210.0))
    gesture.close()
    assert (region.scene.inside == before).all()
    assert not region.scene.can_undo


def test_keys_over_the_region_are_the_regions(desk, region, posted):
    strip = StripPanel()
    desk.pointer.x, desk.pointer.y = 110.0, 210.0
    region.do(desk.post, INVERTED)
    assert strip.takes(desk, ACTIONS["undo"])
    assert not region.scene.can_undo
    radius = region.radius
    assert strip.takes(desk, ACTIONS["larger"])
    assert region.radius > radius
    assert not strip.takes(desk, ACTIONS["fit"])
    desk.pointer.x = 90.0  # beside it
    assert not strip.takes(desk, ACTIONS["redo"])
    assert not posted


def test_the_strip_is_as_tall_whatever_it_shows(desk):
    strip, context = StripPanel(), imgui.create_context()
    try:
        heights = {strip.height(desk)}
        for desk.examples.tab in example_state.TABS:
            heights.add(strip.height(desk))
        assert len(heights) == 1
        desk.strip = ""
        assert strip.height(desk) == 0
    finally:
        imgui.destroy_context(context)


def test_a_click_swaps_and_escape_does_not(desk, posted):
    example_use.choose(desk, named(desk, "felt"))
    desk.examples.swapping = True
    ACTIONS["escape"].do(desk)
    assert not desk.examples.swapping
    desk.examples.swapping = True
    gesture = asking_gestures.swap(desk, pen("down", 400.0, 300.0))
    next(gesture)
    gesture.close()
    assert desk.examples.swapping
    assert not posted
    gesture = asking_gestures.swap(desk, pen("down", 400.0, 300.0))
    next(gesture)
    with pytest.raises(StopIteration):
        gesture.send(pen("up", 402.0, 303.0))
    assert posted[-1].command.at == (2, 3)
    assert not desk.examples.swapping


def test_the_status_line_tells_how_far_it_is_grown_although_no_tiles_wait(desk):
    desk.learn(growing=Growing(0.42), pending=0)
    assert status._fields(desk, "")[0][0] == "growing 42 %"
    desk.learn(growing=None, pending=8)
    assert status._fields(desk, "")[0][0] == "refining"
    desk.learn(writing=Writing(1, True, 0.4))
    assert status._fields(desk, "")[0][0] == f"{icons.DISK} Saving, growing 40 %"
    desk.learn(writing=Writing(1))
    assert status._fields(desk, "")[0][0] == f"{icons.DISK} Writing"


def test_marks_of_what_grows_do_not_lie_on_one_another():
    places = [(0.0, 0.0), (5.0, 5.0), (20.0, 0.0), (20.0, 1.0), (0.0, 11.0)]
    assert apart(places, 10.0) == [(0.0, 0.0), (20.0, 0.0), (0.0, 11.0)]


def test_the_engine_gets_ready_when_examples_are_used_once(desk, posted):
    desk.strip = ""
    example_use.prepare(desk, 1.0)
    assert not posted
    desk.strip = "examples"
    for now in (2.0, 3.0):
        example_use.prepare(desk, now)
    assert posted == [GetReady()]
    assert desk.known.preparing == 2.0
    assert "getting ready" in status._fields(desk, "")[0][0]
