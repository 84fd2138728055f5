"""Strokes that follow tilt, direction, speed and chance, with turned and scattered tips: previewed, kept, replayed."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_stroke_copies import AREA, GROUND, painted, pixels, portions, stroke

from engine.brush.copies import NO_COPIES
from engine.brush.footprint import Footprint
from engine.journal.records import read_command, read_points, told_command, told_points
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.session.here.painted_here import CanvasPixel, PaintedHere
from engine.session.replay import replay
from engine.strokes.coverage_at import Covering, Seeds, stroke_bounds

LOOKS = {
    "speed": {"dynamics": {"radius": {"speed": [[0, 1], [900, 0.2]], "pressure": [[0, 0.4], [1, 1]]}}},
    "tilt": {"dynamics": {"opacity": {"tilt": [[0, 1], [60, 0.2]]}, "radius": {"tilt": [[0, 0.4], [60, 1]]}}},
    "chance": {
        "dynamics": {"radius": {"random_dab": [[0, 0.3], [1, 1]]}, "flow": {"random_stroke": [[0, 0.4], [1, 1]]}}
    },
    "nib": {"shape": {"ratio": 0.2, "angle": 40}, "hardness": 1},
    "following": {"shape": {"ratio": 0.3, "follow": "direction", "angle": 90}, "mode": "erase"},
    "barrel": {"shape": {"ratio": 0.3, "follow": "pen"}},
    "leaves": {
        "tip": {"texture": "squares"},
        "shape": {"scatter": 1.5, "count": 2, "ratio": 0.6},
        "dynamics": {"angle": {"random_dab": [[0, 0], [1, 1]]}},
    },
    "sway": {"shape": {"ratio": 0.3, "follow": "direction"}, "ink": [{"texture": "rock", "amount": 0.9}]},
    "bristles": {"shape": {"bristles": 12, "ratio": 0.4, "follow": "direction", "scatter": 0.5}},
    "tints": {
        "dynamics": {"hue": {"random_dab": [[0, 0.9], [1, 1.1]]}, "lightness": {"pressure": [[0, 1.6], [1, 1]]}},
        "colour": "#a04030",
    },
    "inks": {
        "ink": [{"texture": "rock", "amount": 0.9, "colour": "#20c040"}, {"texture": "stripes", "amount": 0.5}],
        "dynamics": {"ink_1": {"distance": [[0, 0], [120, 1]]}, "chroma": {"random_stroke": [[0, 0.5], [1, 1]]}},
        "shape": {"ratio": 0.4, "follow": "direction"},
        "edge": {"curve": "wet", "width": 0.6, "colour": "#101830"},
    },
    "changed": {"mode": "raster", "op": {"formula": "pressure - pic"}, "shape": {"scatter": 1, "follow": "direction"}},
}
PENS = st.lists(
    st.tuples(
        st.integers(60, 800).map(lambda n: n / 4),
        st.integers(60, 800).map(lambda n: n / 4),
        st.sampled_from((0.3, 1.0)),
        st.sampled_from((0, 40)),
        st.sampled_from((0, -30)),
        st.floats(0, 0.2),
        st.sampled_from((0, 120.5)),
    ).map(list),
    min_size=1,
    max_size=4,
)


def timed(points):
    return [[*row[:5], round(0.2 * k + row[5], 4), *row[6:]] for k, row in enumerate(points)]


@pytest.mark.parametrize("look", LOOKS)
@settings(deadline=None, max_examples=4)
@given(PENS.map(timed), st.booleans(), st.sets(st.integers(1, 4)))
def test_in_any_portions_previewed_replayed_and_undone_it_is_the_same(look, points, mirror, cuts):
    symmetry = {"centre": [100.5, 131], "count": 2, "mirror": mirror}
    command = stroke(points, symmetry=symmetry, **LOOKS[look])
    session = painted(GROUND)
    before = session.painting
    live = portions(session, command, cuts)
    seen = live.preview(AREA).rgba
    session.finish(live)
    assert np.array_equal(seen, pixels(session))
    told = [json.loads(line) for line in session.recording().lines()]
    assert told[0]["inkfall"] == 2
    again = replay(r.Recording(r.Header(), tuple(map(c.parse, told[1:]))))
    assert np.array_equal(pixels(again), pixels(session))
    session.do(c.Undo())
    assert session.painting.root is before.root


@pytest.mark.parametrize("look", LOOKS)
def test_what_it_covers_is_found_again_within_its_bounds(look):
    points = timed([[40, 40, 0.6, 20, 5, 0], [90, 55, 1, 0, 40, 0.1], [70, 110, 0.8, 10, 10, 0.1]])
    command = stroke(points, origin=(5, -9), **LOOKS[look])
    session = painted(GROUND)
    live = portions(session, command, [1])
    coverage = live._relief.over(live._mask.coverage())
    rect = stroke_bounds(command)
    assert rect.union(coverage.rect) == rect
    if "op" in LOOKS[look]:
        return
    found = Covering().over(command, 0, rect, {}, Seeds(0, 0))
    for key in coverage.tiles:
        part = key.rect.intersect(rect)
        assert np.array_equal(found[part.slices(rect)], coverage.on_grid(key)[part.slices(key.rect)])


def test_a_tap_leaves_a_dab_and_a_stroke_turns_its_first_one():
    nib = {"shape": {"ratio": 0.2, "follow": "direction"}, "dynamics": {}, "radius": 30}
    session = painted(stroke([[100, 100]], **nib))
    alpha = pixels(session)[3]
    assert alpha[228, 250] > 0.9
    assert alpha[250, 228] == 0.0
    live = portions(session := painted(), stroke([[100, 100], [100, 100.5], [100, 140]], **nib), [1])
    session.finish(live)
    alpha = pixels(session)[3]
    assert alpha[250, 228] > 0.9
    assert alpha[228, 250] == 0.0  # nothing stays of how it looked before it went anywhere


def test_what_a_dab_grows_of_an_example_is_turned_too():
    command = stroke([[60, 60]], mode="erase", radius=20, shape={"ratio": 0.2, "follow": "direction"}, dynamics={})
    whole, parts = ([*Footprint(command.brush, (0, 0)).whole(command.points)], Footprint(command.brush, (0, 0)))
    assert not any(mask.any() for _, mask in parts.lay(command.points))
    (rest,) = parts.rest()
    assert np.array_equal(rest[1], whole[0][1])
    assert 180 < rest[1].sum() < 260


def test_strokes_of_old_stay_of_version_1_and_others_do_not():
    assert r.version_of(stroke()) == 1
    assert r.version_of(stroke(dynamics={"radius": {"pressure": [[0, 1]]}})) == 1
    assert r.version_of(stroke(dynamics={"radius": {"tilt": [[0, 1]]}})) == 2
    assert r.version_of(stroke(shape={"ratio": 0.5})) == 2
    assert r.version_of(stroke([[1, 2, 1, 0, 0, 0, 0]])) == 2


def test_the_turn_of_a_barrel_is_told_and_journalled():
    plain, turned = stroke([[1, 2], [3, 4, 0.5]]), stroke([[1, 2, 1, 0, 0, 0, 0], [3, 4, 1, 0, 0, 0, -725.25]])
    assert plain.points.shape[1] == 6
    assert turned.points[:, 6].tolist() == [0.0, -725.25]
    for command in (plain, turned):
        assert c.parse(json.loads(json.dumps(c.to_json(command)))) == command
        assert read_command(told_command(command)) == command
        columns = command.points.shape[1]
        assert np.array_equal(read_points(told_points(command.points), columns), command.points)
    still = stroke([[1, 2, 1, 0, 0, 0, 0], [3, 4, 1, 0, 0, 0, 0]])
    assert c.parse(c.to_json(still)).points.shape == (2, 7)


def test_points_of_a_pen_whose_barrel_is_told_late_go_on_as_they_began():
    session = painted()
    live = session.begin(0, (0, 0), stroke().brush, None, None, copies=NO_COPIES)
    live.add(np.array([[1.0, 2, 1, 0, 0, 0]]))
    live.add(np.array([[30.0, 2, 1, 0, 0, 0.1, 45]]))
    assert live.to_command().points.shape == (2, 6)


def test_who_painted_here_is_told_of_turned_strokes_too():
    session = painted(stroke([[60, 60], [120, 60]], shape={"ratio": 0.1, "angle": 90}, dynamics={}, radius=20))
    for (x, y), found in {(90, 60): 1, (90, 76): 1, (40, 60): 0, (90, 82): 0}.items():
        assert len(PaintedHere().at(CanvasPixel(0, x, y), session.painting, session.steps)) == found, (x, y)


def test_strokes_on_a_torus_come_in_turned_at_the_other_side():
    wrap = {"do": "layer", "set": "Layer 1", "wrap": [0, 0, 0, 128, 128]}
    nib = {
        "shape": {"ratio": 0.2, "angle": 30, "scatter": 0.5},
        "dynamics": {"radius": {"random_dab": [[0, 0.5], [1, 1]]}},
    }
    session = painted(GROUND, wrap, stroke([[120, 30], [140, 60]], **nib))
    again = replay(session.recording())
    assert np.array_equal(pixels(again), pixels(session))
    around = Rect(-128, 0, 0, 128)
    assert pixels(session, 0, around).any()
