"""What the tool Move tells of itself: what it would drag now, or that there is nothing."""

from dataclasses import replace

import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.moving import held_box
from app.desk.moving.move_hints import move_hint
from app.desk.moving.move_state import Label, Trial
from app.input.events import PenEvent
from app.tools.moving_gestures import move
from engine.canvas.placing.pose import UNMOVED, Pose, SourcePart
from engine.numeric.address import Rect
from engine.painting.select_commands import Select, Whole
from engine.studio.layer_rows import LayerRow
from engine.studio.moving.move_requests import Extent, Try
from engine.studio.results import Scene

ROW = LayerRow("Sky", False, 0, None, 0, 1.0, True, "src-over", False, False)
PAINT = SourcePart(0, Rect(0, 0, 9, 9))


def desk_with(row, part=PAINT, selected=False):
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), (posted := []).append)
    scene = Scene(Rect(0, 0, 9, 9), (row,), row.name, True, False, True, None)
    desk.known = replace(desk.known, ready=True, scene=scene)
    if selected:
        desk.selecting.choose(posted.append, Select(Whole("all")))
    desk.moving.wants(posted.append, desk.known, 0, selected)
    desk.moving.told(Extent(row.name, part, selected, 0 if selected else None))
    posted.clear()
    return desk, posted


@pytest.mark.parametrize(
    ("row", "part", "selected", "words"),
    [
        (ROW, PAINT, False, "Drag the layer;"),
        (replace(ROW, group=True), PAINT, False, "Drag the group;"),
        (replace(ROW, locked=True), PAINT, True, "“Sky” is locked"),
        (ROW, PAINT, True, "Drag what is selected of “Sky”;"),
        (ROW, None, False, "Nothing is painted on “Sky”"),
        (ROW, None, True, "Nothing is painted on “Sky” where it is selected"),
    ],
)
def test_it_tells_what_it_would_drag(row, part, selected, words):
    desk, _ = desk_with(row, part, selected)
    assert move_hint(desk).startswith(words)


@pytest.mark.parametrize("selected", [False, True])
def test_where_nothing_is_painted_nothing_is_asked_for_and_that_is_told(selected):
    desk, posted = desk_with(ROW, None, selected)
    assert list(move(desk, PenEvent("down", 5.0, 5.0))) == []
    assert desk.message.text == move_hint(desk)
    assert posted == []


def test_what_was_known_of_another_scene_does_not_count():
    desk, _ = desk_with(ROW, None)
    desk.known = replace(desk.known, scene=replace(desk.known.scene))
    assert move_hint(desk).startswith("Drag the layer;")


def test_what_was_refused_is_seen_where_it_is():
    desk, posted = desk_with(ROW)
    turned = Pose(turn=1)
    desk.moving.trial = Trial(desk.known.scene, ROW.name, turned)
    desk.behind = lambda: True  # it is not answered yet
    held_box.wants(desk)
    assert desk.moving.pose(desk.known, ROW) == turned
    desk.behind = lambda: False
    desk.moving.label = Label("turn 90°", True)  # another drag has begun
    held_box.wants(desk)
    assert desk.moving.pose(desk.known, ROW) == turned
    desk.moving.label = None
    held_box.wants(desk)
    assert desk.moving.pose(desk.known, ROW) == UNMOVED
    assert [request for request in posted if isinstance(request, Try)] == [Try(ROW.name, None)]
