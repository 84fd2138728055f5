"""Placements in a painting's life: commands, undo, what is seen anew, files, pictures of one node."""

import json
import zipfile
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from engine.archive.export import Picture, export
from engine.archive.manifest import FINE_FORMAT, PLACED_FORMAT, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.placing import baking
from engine.canvas.placing.baking import bake_levels
from engine.canvas.placing.placement import Placement
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.files.images import read_image
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.recording import version_of
from engine.painting.value import Refusal
from engine.session.session import Session

WINDOW = Rect(-60, -50, 140, 120)


def stroke(n, layer="Tree", level=0, **brush):
    x, y = (17 * n % 60) * 2.0**level, (29 * n % 50) * 2.0**level
    told = {"radius": 6, "colour": f"#{40 + 37 * n % 200:02x}6080", **brush}
    return {"do": "stroke", "level": level, "layer": layer, "points": [[x, y], [x + 25, y + 9]], "brush": told}


def done(*commands):
    session = Session()
    for command in ({"do": "layer", "add": "Tree"}, *commands):
        session.do(c.parse(command))
    return session


def placement(name="Copy", of="Tree", **members):
    return {"do": "layer", "add": name, "kind": "placement", "of": of, **members}


def picture(painting, level=0, rect=WINDOW):
    return composite(painting.root, level, rect, layer_planes)


def test_what_is_painted_on_the_source_is_seen_in_the_placement_and_undone_there():
    session = done(stroke(1), placement(at=[50, -20], turn=1))
    before = picture(session.painting)
    session.do(c.parse(stroke(4)))
    after = picture(session.painting)
    assert (before != after).any()
    session.do(c.parse({"do": "undo"}))
    np.testing.assert_array_equal(picture(session.painting), before)
    session.do(c.parse({"do": "undo"}))
    assert not layers.has(session.painting.root, "Copy")


def test_a_member_that_is_set_leaves_the_others():
    session = done(stroke(1), placement(at=[5, 6], level=1, levels=-1, turn=3, mirror=True, rect=[0, 0, 0, 30, 40]))
    session.do(c.parse({"do": "layer", "set": "Copy", "c": [0.6, 0.7], "opacity": 0.5}))
    node = layers.find(session.painting.root, "Copy")
    assert (node.pose.at, node.pose.level, node.pose.levels, node.pose.mirror) == ((5, 6), 1, -1, True)
    assert (node.pose.turned, node.pose.turn, node.opacity) == ((0.6, 0.7), 0, 0.5)
    session.do(c.parse({"do": "layer", "set": "Copy", "turn": 2, "rect": None}))
    node = layers.find(session.painting.root, "Copy")
    assert (node.pose.turned, node.pose.turn, node.part) == (None, 2, None)


@pytest.mark.parametrize(
    "members",
    [
        {"at": [1.5, 0]}, {"at": [1]}, {"turn": 4}, {"levels": 9000}, {"c": [0.1, 0.1]}, {"c": [2, 0]}, {"c": "x"},
        {"c": [1, 0], "turn": 1}, {"rect": [0, 0, 0, 0, 5]}, {"rect": [0, 0, 0, 5]}, {"mirror": 1}, {"of": 7},
        {"level": 5000},
    ],
)  # fmt: skip
def test_members_that_cannot_be_are_told(members):
    with pytest.raises(FieldError):
        c.parse({"do": "layer", "add": "Copy", "kind": "placement", "of": "Tree", **members})


def test_what_cannot_be_done_is_refused_and_nothing_has_changed():
    session = done(stroke(1), placement())
    before = session.painting
    for command, words in (
        (placement("Other", of="nobody"), "nobody"),
        (placement("Other", of=None), "no rect"),
        (placement("Other", of=None, rect=[0, 0, 0, 9, 9]), "halve"),
        (placement("Other", repeat=True), "rect"),
        ({"do": "layer", "remove": "Tree"}, "'Copy' showing it"),
        ({"do": "layer", "set": "Tree", "repeat": True}, "no placement"),
        ({"do": "layer", "set": "Copy", "of": None}, "no rect"),
        (stroke(2, layer="Copy"), "placement"),
    ):
        with pytest.raises(Refusal, match=words):
            session.do(c.parse(command))
    assert session.painting is before


def test_a_layer_that_is_moved_into_what_it_shows_is_refused_and_nothing_has_changed():
    session = done(
        {"do": "layer", "add": "Wood", "kind": "group"},
        {"do": "layer", "move": "Tree", "to": 0, "group": "Wood"},
        stroke(1),
        {"do": "layer", "add": "Grove", "kind": "group", "group": None},
        placement("Again", of="Wood", group="Grove"),
    )
    before = session.painting
    for name in ("Again", "Grove"):
        with pytest.raises(Refusal, match="Again"):
            session.do(c.parse({"do": "layer", "move": name, "to": 0, "group": "Wood"}))
    assert session.painting is before


def test_a_group_with_its_placements_can_go_and_be_copied():
    session = done(
        {"do": "layer", "add": "Wood", "kind": "group"},
        {"do": "layer", "move": "Tree", "to": 0, "group": "Wood"},
        stroke(1),
        placement(group="Wood", at=[20, 0]),
        {"do": "layer", "duplicate": "Wood", "to": "Grove"},
    )
    root = session.painting.root
    copy = layers.find(root, "Copy copy")
    assert isinstance(copy, Placement)
    assert copy.of == layers.find(root, "Tree copy").id
    session.do(c.parse({"do": "layer", "remove": "Wood"}))
    assert layers.find(session.painting.root, "Copy copy") == copy


def test_a_recording_with_placements_is_of_version_2():
    assert version_of(c.parse(placement())) == 2
    assert version_of(c.parse({"do": "layer", "set": "a", "mirror": True})) == 2
    assert version_of(c.parse({"do": "layer", "set": "a", "opacity": 0.5})) == 1


POSES = st.fixed_dictionaries(
    {"at": st.tuples(st.integers(-40, 40), st.integers(-40, 40)).map(list)},
    optional={
        "levels": st.integers(-2, 1),
        "turn": st.integers(0, 3),
        "mirror": st.booleans(),
        "level": st.integers(0, 2),
        "rect": st.just([0, -10, -10, 70, 60]),
    },
)
ACTS = st.one_of(
    st.builds(stroke, st.integers(0, 30), st.sampled_from(["Tree", "Sky"]), st.sampled_from([-1, 0, 1])),
    POSES.map(lambda pose: {"do": "layer", "set": "Copy", **pose}),
    POSES.map(lambda pose: {"do": "layer", "set": "Of both", **{k: v for k, v in pose.items() if k != "levels"}}),
    st.just({"do": "undo"}),
    st.just({"do": "redo"}),
)


@settings(deadline=None, max_examples=25, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(ACTS, min_size=1, max_size=6), st.integers(-1, 1))
def test_only_what_is_told_to_differ_differs(acts, level):
    session = done(
        {"do": "layer", "add": "Sky"},
        placement(at=[30, 5]),
        {"do": "layer", "add": "Both", "kind": "group"},
        {"do": "layer", "move": "Copy", "to": 0, "group": "Both"},
        placement("Of both", of="Both", c=[0.8, 0.6], group=None),
        placement("Itself", of=None, levels=-1, at=[40, 30], rect=[0, -60, -50, 200, 170], group=None),
        stroke(3),
    )
    window = WINDOW.zoomed(level)
    before = session.painting
    for act in acts:
        with suppress(Refusal):  # of what was undone
            session.do(c.parse(act))
    told = areas(before, session.painting)(level)
    old, new = picture(before, level, window), picture(session.painting, level, window)
    if told is not None:
        outside = np.ones(old.shape[1:], bool)
        for rect in told:
            outside[rect.intersect(window).slices(window)] = False
        np.testing.assert_array_equal(old[:, outside], new[:, outside])


@pytest.fixture
def placed():
    session = done(
        stroke(1),
        stroke(2, ink=[{"texture": "rock", "colour": "#ffffff", "period": 12}]),
        placement(at=[40, 10], turn=1, levels=-1, rect=[0, -20, -20, 90, 90]),
        placement("Turned", at=[20, 60], c=[0.8, 0.6], opacity=0.6),
        placement("Itself", of=None, levels=-2, at=[90, 70], rect=[0, 0, 0, 160, 120]),
    )
    return replace(session.painting, frame=Rect(0, 0, 160, 120)), session


def test_a_painting_is_opened_as_it_was_saved(placed, tmp_path):
    painting, _ = placed
    save(tmp_path / "a.ora", Snapshot(painting))
    found = open_painting(tmp_path / "a.ora")
    assert found.native
    for name in ("Copy", "Turned", "Itself"):
        assert layers.find(found.painting.root, name) == layers.find(painting.root, name)
    for level in (-2, 0, 3):
        window = WINDOW.zoomed(level)
        np.testing.assert_array_equal(picture(found.painting, level, window), picture(painting, level, window))
    save(tmp_path / "b.ora", Snapshot(found.painting))
    assert (tmp_path / "a.ora").read_bytes() == (tmp_path / "b.ora").read_bytes()


def test_only_a_painting_with_placements_is_of_the_newest_format(placed):
    assert format_of(placed[0]) == PLACED_FORMAT
    assert format_of(done(stroke(1)).painting) == FINE_FORMAT


def test_other_programs_see_what_placements_show(placed, tmp_path):
    painting, _ = placed
    save(tmp_path / "a.ora", Snapshot(painting))
    with zipfile.ZipFile(tmp_path / "a.ora") as file:
        told = json.loads(file.read("inkfall/manifest.json"))
        number = next(node["id"] for node in told["layers"] if node["name"] == "Turned")
        stack = file.read("stack.xml").decode()
        assert f"data/L{number}.png" in stack
        file.extract(f"data/L{number}.png", tmp_path)
    shown, _ = read_image(tmp_path / f"data/L{number}.png", "L.png")
    export(tmp_path / "one.png", Picture(painting, layer="Turned"))
    alone, _ = read_image(tmp_path / "one.png", "one.png")
    assert shown.any()
    np.testing.assert_array_equal(shown, alone)


def test_one_layer_is_baked_as_it_was_shown(tmp_path):
    rock = [{"texture": "rock", "colour": "#ffffff", "period": 12}]
    session = done(stroke(1), stroke(2, ink=rock), placement(at=[40, 10], turn=1, levels=-1, mirror=True))
    shown = {level: picture(session.painting, level, WINDOW.zoomed(level)) for level in (0, 2, 4)}
    session.do(c.parse({"do": "layer", "set": "Tree", "visible": False}))
    copy = {level: picture(session.painting, level, WINDOW.zoomed(level)) for level in (0, 2, 4)}
    session.do(c.parse({"do": "layer", "bake": "Copy"}))
    node = layers.find(session.painting.root, "Copy")
    assert isinstance(node, layers.Layer)
    for level, pixels in copy.items():
        np.testing.assert_array_equal(picture(session.painting, level, WINDOW.zoomed(level)), pixels)
        assert pixels.any()
        assert (shown[level] != pixels).any()
    painting = replace(session.painting, frame=Rect(0, 0, 90, 80))
    save(tmp_path / "a.ora", Snapshot(painting))
    found = open_painting(tmp_path / "a.ora").painting
    np.testing.assert_array_equal(picture(found, 4, WINDOW.zoomed(4)), copy[4])
    assert format_of(found) == PLACED_FORMAT
    session.do(c.parse({"do": "undo"}))
    assert isinstance(layers.find(session.painting.root, "Copy"), Placement)


@pytest.mark.parametrize(
    "members",
    [
        {"of": "Both", "at": [31, -7], "c": [0.8, 0.6]},
        {"of": "Both", "at": [31, -7], "turn": 2},
        {"of": "Tree", "at": [31, 5], "rect": [0, 3, 4, 20, 15]},
        {"of": "Tree", "rect": [0, 0, 0, 24, 20], "repeat": True},
    ],
)
def test_anything_else_is_baked_at_one_level(members):
    session = done(
        {"do": "layer", "add": "Both", "kind": "group"},
        {"do": "layer", "add": "Sky", "group": "Both"},
        stroke(3, layer="Sky"),
        stroke(1),
        stroke(7),
        placement(**members, group=None),
        {"do": "layer", "set": "Tree", "visible": False},
    )
    session = replace_frame(session)
    window = Rect(0, 0, 70, 60)
    before = picture(session.painting, 0, window)
    session.do(c.parse({"do": "layer", "bake": "Copy"}))
    assert before.any()
    np.testing.assert_allclose(picture(session.painting, 0, window), before, atol=3e-5)


def test_ink_that_becomes_pixels_is_lost_below_them():
    rock = {"ink": [{"texture": "rock", "amount": 0.5, "colour": "#806040"}]}
    for more, lost in (({}, False), (rock, True)):
        line = stroke(1)
        session = done({**line, "brush": {**line["brush"], **more}}, placement(at=[10, 0], c=[0.9, 0.3]))
        found = bake_levels(session.painting.root, layers.find(session.painting.root, "Copy"), session.painting.frame)
        assert found.level == found.finest
        assert found.loses == lost


FINE = {**stroke(0, level=19), "origin": [30 << 19, 34 << 19]}
DEEP = stroke(1), FINE, placement(at=[10, 0], c=[0.9, 0.3])


def test_paint_that_is_far_finer_than_most_is_baked_at_a_level_that_one_can_wait_for(monkeypatch):
    monkeypatch.setattr(baking, "_MOST_CHOSEN", 16)
    session = done(*DEEP)
    node = layers.find(session.painting.root, "Copy")
    found = bake_levels(session.painting.root, node, session.painting.frame)
    assert found.finest == 19
    assert 0 < found.level < 19
    assert found.loses
    with pytest.raises(Refusal, match="expected a coarser level"):
        session.do(c.parse({"do": "layer", "bake": "Copy", "level": 19}))
    with pytest.raises(Refusal, match="expected a coarser level"):
        session.do(c.parse({"do": "layer", "bake": "Copy"}))
    session.do(c.parse({"do": "layer", "set": "Tree", "visible": False}))
    before = picture(session.painting, 1)
    session.do(c.parse({"do": "layer", "bake": "Copy", "level": 1}))
    assert layers.find(session.painting.root, "Copy").pyramid.finest == 1
    assert before.any()
    np.testing.assert_allclose(picture(session.painting, 1), before, atol=3e-5)


def test_a_level_finer_than_all_paint_bakes_no_finer():
    session = done(stroke(1), placement(at=[10, 0], c=[0.9, 0.3]))
    session.do(c.parse({"do": "layer", "bake": "Copy", "level": 7}))
    assert layers.find(session.painting.root, "Copy").pyramid.finest == 0


def replace_frame(session):
    """The same painting in a small frame, in a session of its own."""
    return Session(replace(session.painting, frame=Rect(0, 0, 70, 60)))


def test_what_is_no_placement_is_not_baked():
    session = done(stroke(1))
    with pytest.raises(Refusal, match="no placement"):
        session.do(c.parse({"do": "layer", "bake": "Tree"}))


def test_a_replay_gives_the_same(placed):
    painting, session = placed
    again = Session()
    for command in session.log:
        again.do(command)
    np.testing.assert_array_equal(picture(again.painting), picture(painting))
