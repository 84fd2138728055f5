"""Fills in a painting's life: what any brush does to a region, refusals, undo, replay, files."""

import io
import json
import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.checks import BrushError
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.grown import settled
from engine.painting.recording import read_from, version_of
from engine.painting.value import Leak, Painting, Refusal
from engine.session.here.painted_here import CanvasPixel, PaintedHere
from engine.session.replay import replay
from engine.session.session import Session

FRAME = Rect.at(0, 0, 160, 120)
RING = [[80 + 40 * math.cos(t), 60 + 40 * math.sin(t)] for t in np.linspace(0, 2 * math.pi, 48)]
LINE = {"do": "stroke", "points": RING, "brush": {"radius": 3, "colour": "#101418"}}
# What a brush can do; each changes what lies within the ring.
BRUSHES = {
    "colour": {"colour": "#c06020"},
    "ink": {"colour": "#c06020", "ink": [{"texture": "rock", "amount": 0.8, "colour": "#f0e0a0"}]},
    "rim": {"colour": "#c06020", "edge": {"curve": "wet", "width": 1, "colour": "#102040"}, "radius": 8},
    "density": {"colour": "#c06020", "density": {"texture": "stripes", "amount": 1}},
    "grain": {"colour": "#c06020", "opacity": 0.6, "grain": {"texture": "white", "amount": 1}},
    "erase": {"mode": "erase"},
    "smooth": {"mode": "smooth"},
    "op": {"mode": "raster", "op": "invert"},
    "formula": {"mode": "raster", "op": {"formula": "0.2 + 0.3*pressure + 0.1*sin(x/9)*pic"}},
    "predict": {"mode": "raster", "op": {"name": "predict", "window": 32}},
}
WASH = {"do": "stroke", "points": [[30, 60], [130, 62]], "brush": {"radius": 60, "hardness": 1, "colour": "#7090b0"}}


def fill(at=(80, 60), brush=None, **members):
    like = {"at": list(at), **members.pop("like", {})}
    return {"do": "fill", "like": like, "brush": brush or {"colour": "#c06020"}, **members}


def done(*commands):
    session = Session(Painting(FRAME, 7), TileCache(32 << 20))
    for command in commands:
        session.do(c.parse(command))
    return session


def seen(painting, level=0, rect=FRAME):
    return composite(settled(painting, 1).root, level, rect, layer_planes)


@pytest.mark.parametrize("name", BRUSHES)
def test_a_fill_does_what_the_brush_does_within_the_region_alone(name):
    session = done(WASH, LINE)
    before = seen(session.painting)
    session.do(c.parse(fill(brush=BRUSHES[name])))
    after = seen(session.painting)
    y, x = np.mgrid[:120, :160] + 0.5
    far = np.hypot(x - 80, y - 60)
    changed = (before != after).any(axis=0)
    assert not changed[far > 45].any()
    least = 0.5 if name in ("density", "grain") else 0.0 if name == "smooth" else 0.9
    assert changed[far < 36].mean() >= least
    assert changed.any()
    session.do(c.parse({"do": "undo"}))
    np.testing.assert_array_equal(seen(session.painting), before)
    session.do(c.parse({"do": "redo"}))
    np.testing.assert_array_equal(seen(session.painting), after)


def replayed(session):
    lines = b"\n".join(line.encode() for line in session.recording().lines())
    return replay(read_from(io.BytesIO(lines), "recording")).painting


@given(
    st.sampled_from(sorted(BRUSHES)),
    st.integers(-1, 2),
    st.integers(0, 8),
    st.booleans(),
    st.sampled_from([None, "Layer 1"]),
    st.tuples(st.integers(10, 150), st.integers(10, 110)),
)
@settings(deadline=None, max_examples=3, suppress_health_check=list(HealthCheck))
def test_it_is_replayed_saved_and_opened_bit_for_bit(tmp_path, name, level, gap, contiguous, of, at):
    session = done(WASH, LINE)
    told = {"level": level, "gap": gap, "contiguous": contiguous, "of": of, "tolerance": 0.2}
    place = [int(value * 2.0**level) for value in at]
    session.do(c.parse(fill(place, BRUSHES[name], like=told, open=True)))
    session.do(c.parse(fill(at, like={"of": None}, open=True)))
    again = replayed(session)
    path = tmp_path / "filled.ora"
    save(path, Snapshot(session.painting, session.recording()))
    opened = open_painting(path).painting
    for where, rect in ((-2, Rect(-5, -5, 45, 35)), (0, FRAME), (2, Rect(200, 160, 420, 330))):
        there = seen(session.painting, where, rect)
        np.testing.assert_array_equal(seen(again, where, rect), there)
        np.testing.assert_array_equal(seen(opened, where, rect), there)


def test_a_region_that_leaks_is_refused_in_a_line_and_nothing_changes():
    session = done(LINE)
    before = session.painting
    with pytest.raises(Leak, match="reaches the border of 160 x 120") as told:
        session.do(c.parse(fill((5, 5))))
    assert "\n" not in str(told.value)
    assert session.painting is before
    assert len(session.log) == 1
    session.do(c.parse(fill((5, 5), open=True)))
    assert seen(session.painting)[3, 5, 5] == 1


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (fill((500, 5)), "fill.like.at: found 500, 5"),
        (fill((5, 5), like={"rect": [10, 10, 20, 20]}), "fill.like.at"),
        (fill((5, 5), like={"level": 9}), "fill.like.rect: found 81920 x 61440"),
        (fill(layer="none"), "none"),
        (fill(like={"of": "none"}), "none"),
        (fill(brush={"mode": "example", "example": "none"}), "none"),
    ],
)
def test_what_cannot_be_done_is_told(command, told):
    session = done(LINE)
    with pytest.raises((Refusal, BrushError), match=told):
        session.do(c.parse(command))
    assert len(session.log) == 1


@pytest.mark.parametrize(
    ("like", "place"),
    [
        ({}, "like.at"),
        ({"at": [1, 2], "rect": [0, 0, 0, 5]}, "like.rect"),
        ({"at": [1, 2], "rect": [0, 0, 1 << 13, 1 << 13]}, "like.rect"),
        ({"at": [1, 2], "tolerance": 1.5}, "like.tolerance"),
        ({"at": [1, 2], "gap": -1}, "like.gap"),
        ({"at": [1, 2], "of": 5}, "like.of"),
        (5, "like"),
    ],
)
def test_what_makes_no_sense_is_told_by_its_place(like, place):
    with pytest.raises(FieldError) as told:
        c.parse({"do": "fill", "like": like, "brush": {}})
    assert told.value.place == place


def test_a_locked_layer_is_not_filled_and_locked_alpha_stays():
    session = done(LINE, {"do": "layer", "set": "Layer 1", "locked": True})
    with pytest.raises(Refusal, match="locked"):
        session.do(c.parse(fill()))
    session = done(WASH, LINE, {"do": "layer", "set": "Layer 1", "alpha_locked": True})
    alpha = seen(session.painting)[3]
    session.do(c.parse(fill()))
    np.testing.assert_array_equal(seen(session.painting)[3], alpha)


def test_what_is_looked_at_may_be_another_layer_or_all_that_is_seen():
    other = {"do": "layer", "add": "colours"}
    for of, colour in ((None, 1), ("Layer 1", 1), ("colours", 0)):
        session = done(LINE, other)
        command = fill(like={"of": of})
        if colour:
            session.do(c.parse(command))
            painted = layer_planes(layers.find(session.painting.root, "colours"), 0, FRAME)
            assert painted[3, 60, 80] == 1
            assert painted[3, 5, 5] == 0
        else:
            with pytest.raises(Leak):
                session.do(c.parse(command))


def test_a_fill_finds_a_first_layer_as_a_stroke_does():
    session = done(fill(open=True))
    assert session.painting.active == "Layer 1"
    assert seen(session.painting)[3].min() == 1
    assert len(session.steps.done) == 1


BLOB = {"do": "texture", "name": "leaf", "maker": "example", "path": "blob.png"}


@pytest.fixture
def grown(tmp_path):
    """A painting with an example in it, and a ring."""
    from everything import pictures

    pictures(tmp_path)
    session = Session(Painting(FRAME, 7), TileCache(32 << 20), folder=tmp_path)
    for command in (BLOB, LINE):
        session.do(c.parse(command))
    return session


def test_an_example_grows_in_the_region_alone_and_leaves_it_again(grown):
    before = seen(grown.painting)
    grown.do(c.parse(fill(brush={"mode": "example", "example": "leaf"})))
    after = seen(grown.painting)
    inside = np.hypot(*(np.mgrid[:120, :160] - np.array([60, 80])[:, None, None])) < 35
    assert (before != after).any(axis=0)[inside].mean() > 0.9
    np.testing.assert_array_equal(seen(replayed_in(grown)), after)
    grown.do(c.parse(fill(brush={"mode": "erase"}, like={"of": None, "tolerance": 1.0}, open=True)))
    assert not layers.find(grown.painting.root, "Layer 1").growth


def replayed_in(session):
    lines = b"\n".join(line.encode() for line in session.recording().lines())
    return replay(read_from(io.BytesIO(lines), "recording", session.folder)).painting


def test_paint_that_meets_an_example_makes_paint_of_it_first(grown):
    grown.do(c.parse(fill(brush={"mode": "example", "example": "leaf"})))
    grown.do(c.parse(fill((5, 5), open=True)))
    layer = layers.find(grown.painting.root, "Layer 1")
    assert not layer.growth
    np.testing.assert_array_equal(seen(replayed_in(grown)), seen(grown.painting))


def test_only_a_recording_that_fills_says_version_2():
    assert version_of(c.parse(fill())) == 2
    told = json.loads(next(done(LINE, fill()).recording().lines()))
    assert told["inkfall"] == 2
    assert json.loads(next(done(LINE).recording().lines()))["inkfall"] == 1


def test_what_was_painted_here_knows_of_fills():
    session = done(WASH, LINE, fill())
    history, count = session.history, session.steps.count

    def held(number):
        return history.at(number - count)

    def found(x, y, level=0, finder=None):
        finder = finder or PaintedHere(session.cache, held)
        return finder.at(CanvasPixel(level, x, y), session.painting, session.steps)

    assert [shown.step.index for shown in found(80, 60)] == [2]
    assert [shown.step.index for shown in found(320, 240, 2)] == [2]
    assert found(80, 60)[0].stroke.brush.colour == "#c06020"
    assert found(80, 60)[0].share == 1
    assert [shown.step.index for shown in found(30, 60)] == [0]
    assert [shown.step.index for shown in found(20, 15, -2)] == [2]
    unknown = found(80, 60, finder=PaintedHere())
    assert [shown.step.index for shown in unknown] == [2, 0]
    assert unknown[0].share == 0.5


BOX = {"do": "select", "rect": [0, 60, 20, 60, 60]}


@pytest.mark.parametrize("name", [*BRUSHES, "example"])
def test_nothing_outside_the_selection_changes(grown, name):
    brush = BRUSHES.get(name, {"mode": "example", "example": "leaf"})
    grown.do(c.parse(WASH))
    grown.do(c.parse(LINE))
    before = seen(grown.painting)
    grown.do(c.parse(BOX))
    grown.do(c.parse(fill(brush=brush)))
    after = seen(grown.painting)
    changed = (before != after).any(axis=0)
    assert changed[20:80, 60:120].any()
    changed[20:80, 60:120] = False
    assert not changed.any()
    np.testing.assert_array_equal(seen(replayed_in(grown)), after)


@pytest.mark.parametrize("name", ["colour", "rim", "erase", "example"])
def test_without_a_place_what_is_selected_is_filled(grown, name):
    brush = BRUSHES.get(name, {"mode": "example", "example": "leaf"})
    grown.do(c.parse(WASH))
    before = seen(grown.painting)
    for command in (BOX, {"do": "fill", "brush": brush}):
        grown.do(c.parse(command))
    changed = (before != seen(grown.painting)).any(axis=0)
    assert changed[22:78, 62:118].mean() > 0.9
    changed[20:80, 60:120] = False
    assert not changed.any()
    np.testing.assert_array_equal(seen(replayed_in(grown)), seen(grown.painting))


def test_without_a_selection_or_one_with_bounds_nothing_can_be_filled():
    session = done(LINE)
    with pytest.raises(Refusal, match="nothing selected and no like"):
        session.do(c.parse({"do": "fill", "brush": {}}))
    for command in (BOX, {"do": "select", "invert": True}):
        session.do(c.parse(command))
    with pytest.raises(Refusal, match="without bounds"):
        session.do(c.parse({"do": "fill", "brush": {}}))


def test_what_is_like_a_pixel_is_selected_as_it_would_be_filled():
    session, other = done(LINE), done(LINE)
    session.do(c.parse({"do": "select", "like": {"at": [80, 60], "gap": 3}}))
    session.do(c.parse({"do": "fill", "brush": {"colour": "#c06020"}}))
    other.do(c.parse(fill(like={"gap": 3})))
    np.testing.assert_array_equal(seen(session.painting), seen(other.painting))
    np.testing.assert_array_equal(seen(replayed(session)), seen(session.painting))
    with pytest.raises(Refusal, match=r"select\.like\.at"):
        session.do(c.parse({"do": "select", "like": {"at": [800, 60]}}))


def test_a_fill_that_grows_goes_under_the_line_around_it_and_not_beyond_that():
    y, x = np.mgrid[:120, :160] + 0.5
    far = np.hypot(x - 80, y - 60)
    changed = {}
    for grow in (0, 2.5):
        session = done(LINE)
        before = seen(session.painting)
        command = fill(brush=BRUSHES["colour"], grow=grow)
        session.do(c.parse(command))
        assert c.parse(c.to_json(c.parse(command))) == c.parse(command)
        assert c.to_json(c.parse(command)).get("grow", 0) == grow
        changed[grow] = (before != seen(session.painting)).any(axis=0)
    assert far[changed[2.5]].max() > far[changed[0]].max() + 1
    assert far[changed[2.5]].max() < 43.5


LINE_ALONE = {"within": [[0, 0], [9, 0], [0, 9]], "regions": "line"}


@pytest.mark.parametrize("members", [{"grow": -1}, {"grow": 257}, {"grow": 2, "like": {"at": [3, 4], **LINE_ALONE}}])
def test_a_fill_cannot_grow_by_less_or_more_or_beyond_a_line_that_is_all_of_it(members):
    with pytest.raises(FieldError, match="grow"):
        c.parse(fill(**members))
