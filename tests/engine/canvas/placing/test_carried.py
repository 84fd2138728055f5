"""Strokes limited by what is selected as a placement shows it: as if it had been selected where the source lies."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas.layers import layers
from engine.canvas.placing.pose import Pose
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting.commands import parse, to_json
from engine.painting.layering.seen_member import write_seen
from engine.session.session import Session

POINTS = [[0.5, 3.25, 0.9], [50, 44, 0.4], [14, 60, 1]]
BRUSHES = (
    {"radius": 11, "hardness": 0.3, "colour": "#b04020"},
    {"radius": 9, "mode": "erase", "opacity": 0.8},
    {"radius": 12, "wet": {"amount": 0.6}, "colour": "#2040b0"},
)
poses = st.builds(
    Pose,
    at=st.tuples(st.integers(-90, 90), st.integers(-90, 90)),
    level=st.sampled_from([0, 1, -1]),
    levels=st.integers(-2, 2),
    turn=st.integers(0, 3),
    mirror=st.booleans(),
)


def begun(*selected):
    session = Session()
    session.do(parse({"do": "layer", "add": "a"}))
    session.do(parse({"do": "stroke", "points": [[-40, 30], [90, 20]], "brush": {"radius": 40, "colour": "#607080"}}))
    for command in selected:
        session.do(parse({"do": "select", **command}))
    return session


def painted(session):
    (layer,) = layers(session.painting.root)
    return [layer_planes(layer, level, Rect(-128, -128, 256, 256)) for level in (0, 1, 2)]


@settings(max_examples=6, deadline=None)
@given(poses, st.sampled_from(BRUSHES), st.booleans())
def test_a_stroke_within_is_as_if_it_had_been_selected_where_the_source_lies(pose, brush, inverse):
    box = Rect(3, 5, 45, 40)  # of the source, at level 2: it has whole pixels wherever it is seen
    shown = pose.similarity.shown(box, 2, 4)
    turned = ({"invert": True},) if inverse else ()
    there = begun({"rect": [4, shown.x0, shown.y0, shown.width, shown.height]}, *turned)
    here = begun({"rect": [2, box.x0, box.y0, box.width, box.height]}, *turned)
    stroke = {"do": "stroke", "level": 2, "points": POINTS, "brush": brush}
    here.do(parse(stroke))
    there.do(parse({**stroke, "seen": write_seen(pose)}))
    for one, other in zip(painted(there), painted(here), strict=True):
        np.testing.assert_array_equal(one, other)
    again = begun()
    for command in list(there.log)[2:]:
        again.do(parse(json.loads(json.dumps(to_json(command)))))
    before = painted(again)
    again.do(parse({"do": "undo"}))
    again.do(parse({"do": "redo"}))
    for one, other, third in zip(painted(there), before, painted(again), strict=True):
        np.testing.assert_array_equal(one, other)
        np.testing.assert_array_equal(one, third)


def test_on_a_layer_that_is_repeated_it_holds_in_all_cells():
    for seen in (None, {"at": [64, 0], "levels": 0}):
        session = begun({"rect": [0, 64 if seen else 0, 0, 20, 60]})
        session.do(parse({"do": "layer", "set": "a", "wrap": [0, 0, 0, 64, 64]}))
        before = painted(session)
        stroke = {"do": "stroke", "points": [[0, 30], [128, 30]], "brush": {"radius": 9, "colour": "#ff0000"}}
        session.do(parse({**stroke, **({"seen": seen} if seen else {})}))
        changed = np.abs(painted(session)[0] - before[0]).any(axis=0)
        columns = changed.any(axis=0)[128:192]
        assert columns[:20].all()
        assert not columns[20:].any()


@pytest.mark.parametrize(
    ("seen", "found"),
    [({"c": [1.0, 0.2]}, "a member of no pose"), ({"turn": 4}, "expected an integer"), ([1], "expected an object")],
)
def test_what_is_no_pose_is_refused_in_a_line(seen, found):
    with pytest.raises(FieldError, match=found) as told:
        parse({"do": "stroke", "points": [[0, 0]], "seen": seen})
    assert "seen" in str(told.value)
