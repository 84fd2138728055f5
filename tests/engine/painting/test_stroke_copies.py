"""Strokes that are drawn again in the same step: one coverage, one step, the same in whatever portions they come."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sown import DEFINED, folder  # noqa: F401

from engine.brush.copies import Copy, boxes, symmetric
from engine.brush.dabs import Stroker
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.numeric.address import TILE, Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.grown import settled
from engine.session.here.painted_here import CanvasPixel, PaintedHere
from engine.session.replay import replay
from engine.session.session import Session
from engine.strokes.coverage_at import stroke_bounds

FRAME = Rect.at(0, 0, 256, 256)
AREA = Rect.at(-128, -128, 512, 512)
LINE = [[20.5, 30.25, 0.3], [60.75, 41.5, 1], [44.25, 90.5, 0.7]]
EIGHT = {"centre": [128, 128], "count": 4, "mirror": True}
LOOKS = {
    "paint": {"colour": "#a03010", "opacity": 0.6, "flow": 0.5, "hardness": 0.3},
    "ink": {"ink": [{"texture": "rock", "amount": 0.9}], "edge": {"curve": "wet", "width": 0.6, "colour": "#101830"}},
    "window": {"tip": {"texture": "rock", "from": "window"}, "spacing": 0.6},
    "sample": {"tip": {"texture": "squares", "angle": 20}, "spacing": 0.8},
    "erase": {"mode": "erase", "opacity": 0.7},
    "smooth": {"mode": "smooth"},
    "multiply": {"mode": "raster", "op": "multiply", "colour": "#40a060"},
    "formula": {"mode": "raster", "op": {"formula": "pressure - pic"}, "opacity": 0.8},
    "clone": {"mode": "raster", "op": {"name": "clone", "layer": "Layer 1", "offset": [40, 12]}},
}
GROUND = {"do": "stroke", "points": [[60, 60], [200, 190]], "brush": {"radius": 80, "colour": "#3060c0"}}


def stroke(points=LINE, origin=(0, 0), level=0, copies=None, symmetry=None, **brush):
    told = {"do": "stroke", "level": level, "origin": list(origin), "points": points, "brush": {"radius": 9, **brush}}
    told |= {} if copies is None else {"copies": copies}
    return c.parse(told | ({} if symmetry is None else {"symmetry": symmetry}))


def painted(*commands):
    session = Session()
    for command in commands:
        session.do(c.parse(command) if isinstance(command, dict) else command)
    return session


def pixels(session, level=0, rect=AREA):
    (layer,) = layers.layers(session.painting.root)
    return evaluate(layer.pyramid, level, rect).rgba


def portions(session, command, cuts):
    live = session.begin(
        command.level, command.origin, command.brush, command.layer, command.seed, copies=command.copies
    )
    for part in np.split(command.points, sorted(cuts)):
        live.add(part)
    return live


@pytest.mark.parametrize("look", LOOKS)
@settings(deadline=None, max_examples=4)
@given(
    st.lists(st.lists(st.integers(80, 1000).map(lambda n: n / 4), min_size=2, max_size=2), min_size=1, max_size=6),
    st.integers(1, 6),
    st.sampled_from((False, True, [3, 5])),
    st.sets(st.integers(1, 5)),
)
def test_in_any_portions_previewed_replayed_and_undone_it_is_the_same(look, points, count, mirror, cuts):
    symmetry = {"centre": [100.5, 131], "count": count, "mirror": mirror}
    command = stroke(points, symmetry=symmetry, **LOOKS[look])
    session = painted(GROUND)
    before = session.painting
    live = portions(session, command, cuts)
    seen = live.preview(AREA).rgba
    session.finish(live)
    assert np.array_equal(seen, pixels(session))
    assert session.steps.count == 2
    told = [json.loads(line) for line in session.recording().lines()]
    assert told[0]["inkfall"] == (2 if command.copies else 1)
    again = replay(r.Recording(r.Header(), tuple(map(c.parse, told[1:]))))
    for level in (0, -2, 1):
        rect = AREA.zoomed(level)
        assert np.array_equal(pixels(again, level, rect), pixels(session, level, rect))
    session.do(c.Undo())
    assert session.painting.root is before.root


def test_without_copies_nothing_is_told_and_with_them_all_comes_back():
    plain = stroke()
    assert plain.copies == ()
    assert plain == stroke(copies=[]) == stroke(symmetry={"centre": [3, 4]})
    assert "copies" not in c.to_json(plain)
    assert r.version_of(plain) == 1
    for copied in (stroke(copies=[[0.6, -0.8, 5, 6.5, True], [2, 0, 1, 1]]), stroke(symmetry=EIGHT)):
        assert c.parse(json.loads(json.dumps(c.to_json(copied)))) == copied
        assert r.version_of(copied) == 2
    assert stroke(copies=[[2, 0, 1, 1]]).copies == (Copy(2.0, 0.0, 1.0, 1.0, False),)


def test_a_symmetry_maps_its_centre_to_itself_and_its_copies_onto_one_another():
    found = symmetric((30.0, -7.0), 6, (1.0, 2.0))
    assert len(found) == 11
    assert sum(copy.mirror for copy in found) == 6
    for copy in found:
        assert np.allclose(copy.moved(30.0, -7.0), (30.0, -7.0))
        assert np.isclose(copy.scale, 1.0)
    mirror = next(copy for copy in found if copy.mirror)
    assert np.allclose(mirror.moved(31.0, -5.0), (31.0, -5.0))  # on the axis
    orbit = {tuple(np.round(copy.moved(50.0, 3.0), 6)) for copy in found} | {(50.0, 3.0)}
    for copy in found:
        assert {tuple(np.round(copy.moved(*place), 6)) for place in orbit} == orbit


@pytest.mark.parametrize(
    ("members", "place"),
    [
        ({"copies": 3}, "copies"),
        ({"copies": [[1, 0, 0]]}, "copies[0]"),
        ({"copies": [[1, 0, 0, 0, 1]]}, "copies[0]"),
        ({"copies": [[1, 0, 0, 0], [0, 0, 5, 5]]}, "copies[1]"),
        ({"copies": [[1e4, 0, 0, 0]]}, "copies[0]"),
        ({"copies": [[1, 0, 1e12, 0]]}, "copies[0]"),
        ({"copies": [[10**400, 0, 0, 0]]}, "copies[0]"),
        ({"copies": [[1, 0, 0, 0]] * 256}, "copies"),
        ({"copies": [], "symmetry": {"centre": [0, 0]}}, "symmetry"),
        ({"symmetry": []}, "symmetry"),
        ({"symmetry": {}}, "symmetry.centre"),
        ({"symmetry": {"centre": [0, 10**400]}}, "symmetry.centre"),
        ({"symmetry": {"centre": [0, 0], "count": 65}}, "symmetry.count"),
        ({"symmetry": {"centre": [0, 0], "mirror": [0, 0]}}, "symmetry.mirror"),
        ({"symmetry": {"centre": [0, 0], "mirror": 1}}, "symmetry.mirror"),
    ],
)
def test_what_is_no_copy_is_refused_by_its_place(members, place):
    with pytest.raises(FieldError) as caught:
        c.parse({"do": "stroke", "points": [[0, 0]], **members})
    assert caught.value.place == place


@pytest.mark.parametrize("look", ["paint", "window", "sample", "ink"])
def test_where_no_copy_comes_it_is_the_plain_stroke(look):
    """The stroke itself as without copies, and a copy moved by whole tiles as a stroke drawn there."""
    more = {**LOOKS[look], "ink": []}
    away = 8 * TILE
    both = painted(stroke(copies=[[1, 0, away, -away]], **more))
    alone, there = painted(stroke(**more)), painted(stroke(origin=(away, -away), **more))
    assert pixels(alone).any()
    assert np.array_equal(pixels(both), pixels(alone))
    moved = Rect.at(AREA.x0 + away, AREA.y0 - away, AREA.width, AREA.height)
    assert np.array_equal(pixels(both, 0, moved), pixels(there, 0, moved))


@pytest.mark.parametrize("look", ["paint", "sample"])
def test_mirrored_and_turned_by_half_it_is_the_very_picture(look):
    """Also where its tip is a picture: that is mirrored and turned with the stroke."""
    line = [[x, y, pressure] for x, y, pressure in LINE]
    session = painted(stroke(line, symmetry={"centre": [128, 128], "count": 2, "mirror": True}, **LOOKS[look]))
    whole = pixels(session, 0, FRAME)
    assert whole[3, :128, :128].any()
    assert np.array_equal(whole, whole[:, :, ::-1])
    assert np.array_equal(whole, whole[:, ::-1])


def test_the_sample_of_a_tip_is_turned_with_its_copy_and_a_copy_that_is_only_moved_lies_as_it_does():
    look = {"radius": 20, "tip": {"texture": "stripes", "period": 64}, "dynamics": {}, "hardness": 1}
    at = [[64.5, 128.5]]
    quarter = pixels(painted(stroke(at, symmetry={"centre": [128.5, 128.5], "count": 4}, **look)), 0, FRAME)[3]
    plain = pixels(painted(stroke(at, **look)), 0, FRAME)[3]
    own = plain[108:149, 44:85]
    assert np.abs(own - own.T).max() > 0.2
    assert np.array_equal(quarter[108:149, 44:85], own)
    np.testing.assert_allclose(quarter[44:85, 108:149], np.rot90(own, -1), atol=2 / 65536)
    moved = pixels(painted(stroke(at, copies=[[1, 0, 100, 0]], **look)), 0, FRAME)[3]
    assert np.array_equal(moved[108:149, 144:185], own)


def test_where_copies_cross_the_opacity_stays_a_ceiling():
    cross = [[100, 100], [160, 156]]
    look = {"opacity": 0.6, "dynamics": {}}
    once = pixels(painted(stroke(cross, symmetry=EIGHT, **look)))[3].max()
    twice = painted(*[stroke(cross, copies=[], **look), stroke([[156, 100], [100, 160]], **look)])
    assert abs(once - 0.6) < 1e-3
    assert pixels(twice)[3].max() > 0.8


def test_copies_may_be_larger_and_far_away():
    far = float(1 << 29)
    session = painted(stroke([[0, 0]], copies=[[0, 3, far, -far]], radius=5, hardness=1, dynamics={}))
    near = pixels(session, 0, Rect.at(-40, -40, 80, 80))[3]
    there = pixels(session, 0, Rect.at((1 << 29) - 40, -(1 << 29) - 40, 80, 80))[3]
    assert abs(near.sum() / 25 - np.pi) < 0.2
    assert abs(there.sum() / 225 - np.pi) < 0.1


def test_boxes_hold_all_that_each_copy_lays():
    command = stroke(symmetry=EIGHT)
    dabs = Stroker(command.brush).walk(command.points)
    rects = boxes(dabs, command.copies, (1000, -500), 0)
    assert len(rects) == 8
    session = painted(stroke(origin=(1000, -500), symmetry=EIGHT))
    whole = Rect.at(872, -628, 512, 512)
    alpha = pixels(session, 0, whole)[3]
    for rect in rects:
        part = rect.intersect(whole)
        assert alpha[part.slices(whole)].any()
        alpha[part.slices(whole)] = 0
    assert not alpha.any()
    assert stroke_bounds(stroke(origin=(1000, -500), symmetry=EIGHT)).intersect(rects[3]) == rects[3]


def test_a_copy_tells_of_itself_at_its_pixels():
    session = replay(r.Recording(r.Header(FRAME, 5), (stroke(symmetry=EIGHT, radius=6, dynamics={}),)))
    for x, y in ((20, 30), (235, 30), (20, 225), (30, 20)):
        found = PaintedHere().at(CanvasPixel(0, x, y), session.painting, session.steps)
        assert [one.step.index for one in found] == [0], (x, y)
    assert not PaintedHere().at(CanvasPixel(0, 128, 128), session.painting, session.steps)


@pytest.mark.parametrize("cuts", [(), (1, 2)])
def test_an_example_grows_and_is_erased_in_every_copy(folder, cuts):  # noqa: F811
    def grown(command, cuts):
        session = Session(folder=folder)
        for told in DEFINED[:1]:
            session.do(c.parse(told))
        for one in (command, stroke([[60, 41], [44, 90]], mode="erase", radius=5, copies=[[0, 1, 250, 0]])):
            session.finish(portions(session, one, cuts))
        return settled(session.painting)

    look = {"mode": "example", "example": "stripes", "hardness": 1, "radius": 14}
    both = grown(stroke(LINE, copies=[[1, 0, 130, 20]], **look), cuts)
    (layer,) = layers.layers(both.root)
    seen = layer_planes(layer, 0, AREA, None)
    (plain,) = layers.layers(grown(stroke(LINE, copies=[[1, 0, 130, 20]], **look), ()).root)
    assert np.array_equal(seen, layer_planes(plain, 0, AREA, None))
    own, other = Rect.at(0, 0, 128, 128), Rect.at(130, 20, 128, 128)
    first, second = (seen[3][part.slices(AREA)] > 0 for part in (own, other))
    assert first.sum() > 1000
    assert second.sum() > first.sum()  # the erased part lies on the stroke itself
