"""Layers, groups and placements moved: exactly where that can be, and nothing is lost where it cannot."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic, Similarity
from engine.painting import commands as c
from engine.painting.value import Refusal
from engine.session.moving import tried
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio.moving.move_requests import Try
from engine.studio.sight import tile_rect
from engine.studio.studio import Studio

WINDOW = Rect(-60, -50, 140, 120)
TURNED = {"c": [0.8, 0.6], "at": [12, -5]}


def painted(*commands):
    session = Session()
    brush = {"radius": 9, "colour": "#306080"}
    strokes = [{"do": "stroke", "points": [[x, 10], [x + 30, 40]], "brush": brush} for x in (0, 25)]
    for command in (*strokes, *commands):
        session.do(c.parse(command))
    return session


def picture(painting, level=0, rect=WINDOW):
    return composite(painting.root, level, rect, layer_planes)


def test_a_layer_is_moved_by_whole_pixels_and_can_be_painted_on():
    session = painted()
    before = picture(session.painting)
    session.do(c.parse({"do": "layer", "set": "Layer 1", "at": [17, -6]}))
    moved = picture(session.painting, 0, Rect(-43, -56, 157, 114))
    np.testing.assert_array_equal(moved, before)
    assert len(list(layers.layers(session.painting.root))) == 1
    session.do(c.parse({"do": "stroke", "points": [[50, 0]], "brush": {"radius": 20}}))
    assert (picture(session.painting) != moved).any()
    session.do(c.parse({"do": "undo", "count": 2}))
    np.testing.assert_array_equal(picture(session.painting), before)


@pytest.mark.parametrize("name", ["Layer 1", "Group"])
def test_what_cannot_be_exact_stays_as_a_source(name):
    session = painted(
        {"do": "layer", "add": "Group", "kind": "group"},
        {"do": "layer", "move": "Layer 1", "to": 0, "group": "Group"},
        {"do": "layer", "set": name, "opacity": 0.5},
    )
    before = session.painting
    session.do(c.parse({"do": "layer", "set": name, **TURNED}))
    shown = layers.find(session.painting.root, name)
    source = layers.find(session.painting.root, f"{name} (source)")
    assert isinstance(shown, Placement)
    assert (shown.of, shown.opacity, source.visible) == (source.id, 0.5, False)
    assert picture(session.painting).any()
    session.do(c.parse({"do": "layer", "set": name, "c": [1.0, 0.0], "at": [0, 0]}))
    np.testing.assert_allclose(picture(session.painting), picture(before), atol=1e-6)


@pytest.mark.parametrize("name", ["Layer 1", "Group"])
def test_what_is_moved_by_tiny_parts_of_its_pixels_stays_as_a_source(name):
    """As paint of its own it had so many tiles that nobody could wait for them."""
    session = painted(
        {"do": "layer", "add": "Group", "kind": "group"},
        {"do": "layer", "move": "Layer 1", "to": 0, "group": "Group"},
    )
    before = picture(session.painting, 1, WINDOW)
    session.do(c.parse({"do": "layer", "set": name, "at": [1 << 30, 3], "level": 29}))
    shown = layers.find(session.painting.root, name)
    assert isinstance(shown, Placement)
    assert picture(session.painting, 1, WINDOW).any()
    session.do(c.parse({"do": "layer", "set": name, "at": [0, 0], "level": 29}))
    np.testing.assert_array_equal(picture(session.painting, 1, WINDOW), before)


@pytest.mark.parametrize("number", [10**400, -(10**400)], ids=["more", "less"])
def test_a_scale_beyond_all_numbers_is_refused_in_a_line(number):
    with pytest.raises(FieldError, match="c: found"):
        c.parse({"do": "layer", "set": "Layer 1", "c": [number, 0.5]})


def test_a_group_keeps_all_that_it_shows():
    session = painted(
        {"do": "layer", "add": "Group", "kind": "group"}, {"do": "layer", "move": "Layer 1", "to": 0, "group": "Group"}
    )
    before = picture(session.painting)
    session.do(c.parse({"do": "layer", "set": "Group", "at": [5, 3]}))
    np.testing.assert_array_equal(picture(session.painting, 0, Rect(-55, -47, 145, 123)), before)


INNER = {"do": "layer", "add": "Again", "kind": "placement", "of": "Layer 1", "group": "Group"}
GROUPED = (
    {"do": "layer", "add": "Group", "kind": "group"},
    {"do": "layer", "move": "Layer 1", "to": 0, "group": "Group"},
    {**INNER, "c": [0.8, 0.6], "at": [9, 40], "rect": [0, 0, 0, 50, 40]},
    {"do": "select", "ellipse": [0, -10, -10, 90, 70]},
    {"do": "layer", "set": "Group", "opacity": 0.7, "mask": True},
)


@settings(deadline=None, max_examples=5)
@given(st.integers(-40, 40), st.integers(-40, 40), st.integers(0, 3), st.booleans(), st.integers(-1, 1))
def test_a_group_that_is_moved_exactly_stays_one(x, y, turn, mirror, levels):
    session = painted(*GROUPED)
    before = session.painting
    where = {"do": "layer", "set": "Group", "at": [x, y], "turn": turn, "mirror": mirror, "levels": levels}
    seen = picture(tried(before, "Group", c.parse(where).placing))
    session.do(c.parse(where))
    assert [n.name for n in layers.walk(session.painting.root)] == [n.name for n in layers.walk(before.root)]
    np.testing.assert_allclose(picture(session.painting), seen, atol=0.02)  # the mask was sampled in another place
    assert np.abs(picture(session.painting) - seen).mean() < 2e-4
    session.do(c.parse({"do": "undo"}))
    np.testing.assert_array_equal(picture(session.painting), picture(before))


def test_a_group_that_shows_the_whole_painting_is_not_moved():
    inside = {"of": None, "group": "Group", "levels": -1, "rect": [0, 0, 0, 64, 64]}
    session = painted(*GROUPED[:2], {**INNER, **inside})
    command = c.parse({"do": "layer", "set": "Group", "at": [5, 3]})
    with pytest.raises(LayerError, match="shows itself"):
        tried(session.painting, "Group", command.placing)
    with pytest.raises(Refusal, match="shows itself"):
        session.do(command)


@pytest.mark.parametrize("shown", ["Group", "Layer 1"])
def test_a_group_that_is_shown_elsewhere_stays_as_a_source(shown):
    more = {"do": "layer", "add": "More", "kind": "placement", "of": shown, "at": [200, 0], "group": None}
    session = painted(*GROUPED[:2], more)
    seen = picture(tried(session.painting, "Group", c.parse({"do": "layer", "set": "Group", "at": [5, 3]}).placing))
    session.do(c.parse({"do": "layer", "set": "Group", "at": [5, 3]}))
    assert layers.has(session.painting.root, "Group (source)")
    np.testing.assert_array_equal(picture(session.painting), seen)


def test_what_cannot_be_is_refused():
    session = painted({"do": "layer", "set": "Layer 1", "locked": True})
    with pytest.raises(Refusal, match="locked"):
        session.do(c.parse({"do": "layer", "set": "Layer 1", "at": [1, 1]}))
    session = painted()
    with pytest.raises(Refusal, match="no placement"):
        session.do(c.parse({"do": "layer", "set": "Layer 1", "repeat": True}))


QUARTERS = (1, 0), (0, 1), (-1, 0), (0, -1)
moves = st.builds(
    lambda q, k, x, y, e, mirror: Similarity(Dyadic.of(*QUARTERS[q], -k), Dyadic.of(x, y, e), mirror),
    st.integers(0, 3), st.integers(-40, 40), st.integers(-(1 << 70), 1 << 70), st.integers(-99, 99),
    st.integers(-30, 30), st.booleans(),
)  # fmt: skip
poses = st.one_of(
    moves.map(Pose.of),
    st.builds(
        lambda re, im, at, mirror: Pose(at=at, turned=(re, im), mirror=mirror),
        st.floats(0.6, 1.3), st.floats(-1.3, 1.3, allow_subnormal=False),
        st.tuples(st.integers(-99, 99), st.integers(-99, 99)), st.booleans(),
    ),
)  # fmt: skip


@given(poses, moves)
def test_a_pose_follows_exactly(pose, by):
    followed = pose.followed(by)
    assert followed.similarity == pose.similarity.then(by)
    assert followed.wrong() is None


@settings(deadline=None, max_examples=15)
@given(st.integers(-30, 30), st.integers(-30, 30), st.integers(0, 3))
def test_what_is_tried_looks_as_what_is_done(x, y, turn):
    session = painted()
    command = c.parse({"do": "layer", "set": "Layer 1", "at": [x, y], "turn": turn})
    seen = picture(tried(session.painting, "Layer 1", command.placing))
    session.do(command)
    np.testing.assert_array_equal(picture(session.painting), seen)


def test_what_is_dragged_is_seen_and_nothing_has_changed():
    sent = []
    studio = Studio(sent.append, lambda request: None)
    studio.do(q.Begin(0, (0, 0), painted().log[0].brush))
    studio.do(q.Points(np.array([[10.0, 10, 1, 0, 0, 0], [60, 50, 1, 0, 0, 0]])))
    studio.do(q.Finish())
    before = studio.easel.session.painting
    tile = tile_rect((0, 0, 0))
    still = studio.easel.viewer.picture(0, tile)
    command = c.parse({"do": "layer", "set": "Layer 1", "at": [30, 20]})
    studio.do(Try("Layer 1", command.placing))
    seen = studio.easel.viewer.picture(0, tile)
    assert (seen != still).any()
    assert studio.easel.session.painting is before
    studio.do(Try("nobody", command.placing))
    np.testing.assert_array_equal(studio.easel.viewer.picture(0, tile), still)
    studio.do(Try("Layer 1", command.placing))
    studio.do(q.Do(command))
    np.testing.assert_array_equal(studio.easel.viewer.picture(0, tile), seen)
    assert studio.easel.session.painting is not before
    assert replace(before, root=before.root).root is before.root


@pytest.mark.parametrize("where", [{"at": [30, -7]}, {"turn": 1, "levels": -1}, TURNED])
def test_a_copy_is_laid_elsewhere_in_one_step(where):
    session = painted({"do": "layer", "set": "Layer 1", "opacity": 0.5})
    before = session.painting
    copy = c.parse({"do": "layer", "duplicate": "Layer 1", "to": "Copy", **where})
    seen = picture(tried(before, "Layer 1", copy.placing, copy=True))
    session.do(copy)
    np.testing.assert_array_equal(picture(session.painting), seen)
    assert session.painting.active == "Copy"
    assert layers.find(session.painting.root, "Layer 1") is layers.find(before.root, "Layer 1")
    again = Session()
    for command in session.log:
        again.do(c.parse(c.to_json(command)))
    np.testing.assert_array_equal(picture(again.painting), seen)
    session.do(c.Undo())
    np.testing.assert_array_equal(picture(session.painting), picture(before))
    assert session.steps.count == 3


def test_a_copy_of_a_placement_shows_the_same_source():
    session = painted({"do": "layer", "add": "Again", "kind": "placement", "of": "Layer 1", **TURNED})
    session.do(c.parse({"do": "layer", "duplicate": "Again", "to": "Copy", "at": [50, 0]}))
    copy, one = (layers.find(session.painting.root, name) for name in ("Copy", "Again"))
    assert copy.of == one.of
    assert copy.pose == replace(one.pose, at=(50, 0))
