"""Painting on what a placement shows: the stroke on its source is seen where the pen was."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.known import Known
from app.desk.moving.painted_through import Through, through
from app.desk.stack.chosen_layer import choose_layer
from app.input.events import PenEvent
from app.tools.painting_gestures import begin_stroke
from engine.brush.copies import Copy
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.placing.pose import Pose
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.layering.placing_members import Placing
from engine.session.session import Session
from engine.studio.outline import rows
from engine.studio.results import Scene

poses = st.builds(
    Pose, at=st.tuples(st.integers(-90, 90), st.integers(-90, 90)), levels=st.integers(-3, 3), turn=st.integers(0, 3),
    mirror=st.booleans(),
)  # fmt: skip
BRUSH = c.parse({"do": "stroke", "points": [[0, 0]], "brush": {"radius": 7, "colour": "#a04020"}}).brush
POINTS = np.array([[0.25, 0.5, 1.0, 10.0, -20.0, 0.0], [33.0, 12.0, 0.6, 0.0, 5.0, 0.1], [50.5, -8.0, 0.9, 0, 0, 0.2]])


def known(painting, active):
    scene = Scene(painting.frame, tuple(rows(painting.root)), active, False, False, False, None)
    return Known(scene=scene)


def shown(*placed):
    """A painting with an empty layer and placements of it, each of the one before."""
    session = Session()
    session.do(c.AddLayer("Source"))
    of = "Source"
    for number, pose in enumerate(placed):
        given = Placing.at_pose(pose)
        session.do(c.AddPlacement(f"P{number}", Placing(of, *(getattr(given, n) for n in Placing.__slots__[1:]))))
        of = f"P{number}"
    return session, known(session.painting, of)


@settings(deadline=None, max_examples=30)
@given(
    st.lists(poses, min_size=1, max_size=2), st.integers(0, 2), st.tuples(st.integers(-99, 99), st.integers(-99, 99))
)
def test_a_stroke_through_placements_is_seen_where_it_was_drawn(placed, level, origin):
    session, told = shown(*placed)
    aim = through(told, told.active, level)
    assert isinstance(aim, Through)
    aligned = aim.similarity.aligned_from
    assume(aligned is None or aligned <= level)
    aimed = aim.begun(level, origin)
    points = aimed.points(POINTS)
    session.do(c.Stroke(aimed.level, aimed.origin, points, BRUSH, aimed.layer))
    plain = Session()
    plain.do(c.Stroke(level, origin, POINTS, BRUSH))
    rect = Rect(origin[0] - 20, origin[1] - 30, origin[0] + 80, origin[1] + 50)
    alone = layers.alone(layers.find(session.painting.root, told.active.name), session.painting.root)
    seen = composite(alone, level, rect, layer_planes)
    there = composite(plain.painting.root, level, rect, layer_planes)
    assert there[3].max() > 0.9
    np.testing.assert_allclose(seen, there, atol=3 / 65536)  # turned by a quarter, a dab's sums are in another order


def test_tilt_is_turned_along():
    aimed = Through("S", Pose(turn=1).similarity).begun(0, (0, 0))
    np.testing.assert_array_equal(aimed.points(np.array([[3.0, 4, 1, 30, 10, 0]]))[0], [4, -3, 1, 10, -30, 0])
    aimed = Through("S", Pose(mirror=True).similarity).begun(0, (0, 0))
    np.testing.assert_array_equal(aimed.points(np.array([[3.0, 4, 1, 30, 10, 0]]))[0], [-3, 4, 1, -30, 10, 0])


@pytest.mark.parametrize("pose", [Pose(turn=1), Pose(turn=2), Pose(mirror=True), Pose(turn=3, mirror=True)])
def test_the_barrel_is_turned_as_the_pen_leans(pose):
    aimed = Through("S", pose.similarity).begun(0, (0, 0))
    angle = math.radians(25)
    row = aimed.points(np.array([[3.0, 4, 1, 40 * math.cos(angle), 40 * math.sin(angle), 0, 25]]))[0]
    turned = math.radians(row[6])
    np.testing.assert_allclose(row[3:5], [40 * math.cos(turned), 40 * math.sin(turned)], atol=1e-9)


@pytest.mark.parametrize(
    ("made", "why"),
    [
        ({"of": "Source", "c": [0.8, 0.6]}, "turned or scaled by parts: paint on “Source”"),
        ({"of": None, "rect": [0, 0, 0, 40, 40], "levels": -1}, "shows the whole painting"),
        ({"of": "G"}, "shows the group “G”"),
        ({"of": "Source", "levels": 4000}, "too far away"),
        ({"of": "Locked"}, "Layer “Locked”, which “P” shows, is locked"),
    ],
)
def test_what_cannot_be_painted_through_says_why(made, why):
    session = Session()
    session.do(c.AddLayer("Source"))
    session.do(c.AddLayer("G", kind="group"))
    session.do(c.AddLayer("Locked"))
    session.do(c.SetLayer("Locked", locked=True))
    session.do(c.parse({"do": "layer", "add": "P", "kind": "placement", **made}))
    told = known(session.painting, "P")
    assert why in through(told, told.active, 1000)


@given(poses, st.builds(Copy, *([st.floats(-3, 3)] * 4), st.booleans()), st.floats(-99, 99), st.floats(-99, 99))
def test_copies_are_seen_where_they_would_be_drawn(pose, copy, x, y):
    aimed = Through("S", pose.similarity).begun(2, (7, -3))

    def on_layer(x, y):
        return aimed.points(np.array([[x, y, 1, 0, 0, 0]]))[0, :2]

    there = on_layer(*copy.moved(x, y))
    np.testing.assert_allclose(aimed.copies((copy,))[0].moved(*on_layer(x, y)), there, atol=1e-9)


def test_who_chooses_another_layer_paints_there_before_the_engine_answers():
    _, told = shown(Pose(at=(40, 0), turn=1))
    posted = []
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), posted.append)
    desk.known = replace(told, ready=True)
    choose_layer(desk, "Source")
    begun = begin_stroke(desk, PenEvent("down", 5.0, 5.0))
    assert begun.aimed is None
    assert [type(one).__name__ for one in posted] == ["Do", "Begin"]
    choose_layer(desk, "of another painting")
    assert desk.known.active.name == "Source"
