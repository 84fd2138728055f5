"""Copy is no step and leaves nothing in the file; cut and paste are one step each; no undo forgets what was copied."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_selecting import GROUND, seen, told

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.value import Refusal
from engine.session.replay import replay
from engine.session.session import Session

WINDOW = Rect(-40, -40, 200, 180)
OVAL = {"do": "select", "ellipse": [0, 20, 10, 90, 80]}
NONE = {"do": "select", "none": True}
STROKE = {"do": "stroke", "points": [[10, 10], [90, 70]], "brush": {"radius": 20, "colour": "#3060f0"}}
OTHER = {"do": "stroke", "points": [[80, 10], [10, 60]], "brush": {"radius": 15, "colour": "#f06030"}}
UNDO, REDO = {"do": "undo"}, {"do": "redo"}


def layer(verb, name, **more):
    return {"do": "layer", verb: name, **more}


COPY, CUT, PASTE = layer("copy", "Layer 1"), layer("cut", "Layer 1"), layer("paste", "New")


def planes(session, name):
    return layer_planes(layers.find(session.painting.root, name), 0, WINDOW)


def names(session):
    return [node.name for node in layers.walk(session.painting.root)]


def test_a_copy_is_no_step_and_undo_takes_back_the_stroke_before():
    session = told(Session(), STROKE, OTHER)
    painting = session.painting
    told(session, OVAL, COPY)
    assert session.painting.root is painting.root
    assert (session.steps.count, session.history.undo_count) == (3, 3)
    told(session, UNDO, UNDO)
    assert (seen(session.painting, 0) == seen(told(Session(), STROKE).painting, 0)).all()
    told(session, REDO)
    assert session.painting.root is painting.root


def test_a_copy_does_not_end_what_can_be_done_again():
    session = told(Session(), STROKE, OTHER, UNDO, COPY)
    assert session.can_redo
    told(session, REDO, PASTE)
    one = told(Session(), STROKE)
    assert (planes(session, "New") == planes(one, "Layer 1")).all()


@pytest.mark.parametrize("since", [[OTHER], [layer("clear", "Layer 1")], [layer("remove", "Layer 1")], [UNDO, UNDO]])
def test_what_was_copied_is_pasted_whatever_came_since(since):
    session = told(Session(), STROKE, OVAL, layer("duplicate", "Layer 1", to="Part", selected="copy"))
    part = planes(session, "Part")
    told(session, UNDO, COPY, *since, PASTE)
    assert session.painting.active == "New"
    assert (planes(session, "New") == part).all()
    count = session.steps.count
    told(session, UNDO)
    assert session.steps.count == count - 1
    assert "New" not in names(session)
    told(session, layer("paste", "Twice"), layer("paste", "Thrice"))
    assert (planes(session, "Twice") == part).all()
    assert (planes(session, "Thrice") == part).all()


def test_a_cut_is_one_step_and_stays_held_when_it_is_taken_back():
    session = told(Session(), STROKE, OVAL)
    before = planes(session, "Layer 1")
    told(session, CUT)
    assert session.steps.count == 3
    left = planes(session, "Layer 1")
    told(session, UNDO)
    assert (planes(session, "Layer 1") == before).all()
    told(session, PASTE)
    assert np.abs(planes(session, "New") + left - before).max() <= 1 / 255


def test_the_file_has_nothing_of_it_and_nothing_is_pasted_after_opening(tmp_path):
    session = told(Session(), STROKE, OVAL, COPY)
    place = tmp_path / "copied.ora"
    save(place, Snapshot(session.painting))
    opened = open_painting(place).painting
    assert [node.name for node in layers.walk(opened.root)] == ["Layer 1"]
    for empty in (Session(opened), Session(GROUND)):
        with pytest.raises(Refusal, match="nothing was copied or cut"):
            empty.do(c.parse(PASTE))
        assert empty.log == []


def test_what_cannot_be_copied_leaves_what_was():
    session = told(Session(), STROKE, COPY, {"do": "select", "rect": [0, 5000, 5000, 9, 9]})
    with pytest.raises(Refusal, match="found no paint where it is selected"):
        session.do(c.parse(CUT))
    told(session, NONE, layer("set", "Layer 1", locked=True))
    for command, why in ((CUT, "found it locked"), (layer("copy", "Nobody"), "Nobody")):
        with pytest.raises(Refusal, match=why):
            session.do(c.parse(command))
    told(session, PASTE)
    assert (planes(session, "New") == planes(session, "Layer 1")).all()
    assert not layers.is_locked(session.painting.root, "New")


@pytest.mark.parametrize("place", [{"turn": 1, "mirror": True, "at": [99, 99]}, {"c": [0.8, 0.6], "at": [30, -9]}])
def test_what_a_placement_shows_is_copied_and_cannot_be_cut(place):
    shown = layer("add", "P") | {"kind": "placement", "of": "Layer 1", **place}
    session, baked = (told(Session(), STROKE, OTHER, shown) for _ in range(2))
    told(session, OVAL, layer("copy", "P"), NONE, PASTE)
    told(baked, layer("bake", "P"), OVAL, layer("copy", "P"), NONE, PASTE)
    assert planes(session, "New").any()
    assert (planes(session, "New") == planes(baked, "New")).all()
    with pytest.raises(Refusal, match="expected one to copy from"):
        session.do(c.parse(layer("cut", "P")))


@given(st.lists(st.sampled_from([STROKE, OVAL, NONE, COPY, CUT, PASTE, UNDO, UNDO, REDO]), min_size=4, max_size=9))
@settings(max_examples=8, deadline=None)
def test_a_replay_is_equal_and_the_steps_are_those_of_the_history(commands):
    session = told(Session(), STROKE)
    for n, one in enumerate(commands):
        command = c.parse(layer("paste", f"New {n}") if one is PASTE else one)
        try:
            session.do(command)
        except Refusal:
            assert isinstance(command, c.CopyPaint | c.CutPaint | c.PastePaint | c.Stroke)
    again = replay(r.Recording(commands=tuple(c.parse(c.to_json(one)) for one in session.log)))
    assert (seen(again.painting, 0) == seen(session.painting, 0)).all()
    assert names(again) == names(session)
    assert session.steps.count == session.history.undo_count
    assert [one.name for one in layers.walk(session.steps.root)] == names(session)


def test_recordings_that_copy_are_of_version_2():
    for command in (COPY, CUT, PASTE):
        parsed = c.parse({**command, "newer": 1})
        assert r.version_of(parsed) == 2
        assert c.to_json(parsed) == {**command, "newer": 1}
