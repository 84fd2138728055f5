"""The brush record: strict reading, unchanged writing, one clear line for what is wrong."""

import math
import pickle
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine.brush.checks import BrushError
from engine.brush.edits import check
from engine.brush.parts import Edge, Surface
from engine.brush.settings import SETTINGS, Brush, from_json, to_json

EVERYTHING = {
    "radius": 12.5,
    "hardness": 0.25,
    "opacity": 0.5,
    "flow": 0.125,
    "spacing": 0.5,
    "mode": "example",
    "colour": "#a0b1c2",
    "ink": [
        {
            "texture": "rock",
            "amount": 0.5,
            "colour": "#102030",
            "period": 64,
            "seed": 3,
            "shaping": "power",
            "new": [1, {"a": None}],
        }
    ],
    "op": {"formula": "1 - pic"},
    "density": "paper",
    "grain": {"texture": "canvas", "amount": 0.3, "level": 2, "shaping": "negate", "period": 40},
    "shaping": [[0, 1], [0.5, 0.25], [1, 0]],
    "edge": {"curve": "worn", "width": 0.25, "amount": 0.5, "colour": "#102030"},
    "tip": {"texture": "leaf", "from": "window", "shaping": [[0, 0], [1, 1]], "period": 12},
    "extent": True,
    "example": "leaves",
    "depth": 2,
    "example_level": -3,
    "example_detail": 2,
    "dynamics": {"radius": "pressure", "opacity": [[0, 0.1], [1, 1]], "sparkle": {"of": "later"}},
    "of a later version": {"x": [1, 2.5, "three", None, True]},
}

CURVES = st.one_of(
    st.just("pressure"),
    st.lists(st.integers(0, 1000), min_size=1, max_size=6, unique=True).flatmap(
        lambda xs: st.lists(st.floats(0, 16), min_size=len(xs), max_size=len(xs)).map(
            lambda ys: [[x / 1000, y] for x, y in zip(sorted(xs), ys, strict=True)]
        )
    ),
)


def test_defaults_are_those_of_the_recording_format():
    brush = from_json({})
    assert brush == Brush()
    assert (brush.radius, brush.hardness, brush.opacity, brush.flow, brush.spacing) == (16, 0.8, 1, 1, 0.25)
    assert (brush.mode, brush.colour, brush.op, brush.dynamics) == (
        "paint",
        "#000000",
        "toward",
        Map({"opacity": "pressure"}),
    )
    assert {name: row.default for name, row in SETTINGS.items()} == {n: getattr(brush, n) for n in SETTINGS}


def test_every_field_survives_the_round_trip():
    brush = from_json(EVERYTHING)
    assert to_json(brush) == EVERYTHING
    assert from_json(to_json(brush)) == brush
    assert hash(from_json(EVERYTHING)) == hash(brush)


@settings(deadline=None, max_examples=60)
@given(
    st.fixed_dictionaries(
        {},
        optional={name: st.floats(row.lo, row.hi) for name, row in SETTINGS.items()}
        | {
            "colour": st.from_regex("#[0-9a-f]{6}", fullmatch=True),
            "mode": st.sampled_from(["paint", "erase", "smooth", "raster", "example"]),
            "dynamics": st.dictionaries(st.sampled_from([*SETTINGS, "unheard of"]), CURVES, max_size=4),
            "else": st.recursive(st.none() | st.integers() | st.text(max_size=4), lambda s: st.lists(s, max_size=3)),
        },
    )
)
def test_any_valid_brush_round_trips(data):
    brush = from_json(data)
    assert from_json(to_json(brush)) == brush
    written = to_json(brush)
    assert all(written[name] == value for name, value in data.items())


HOSTILE = [
    ({"radius": -1}, "brush.radius"),
    ({"radius": 4000.5}, "brush.radius"),
    ({"radius": math.nan}, "brush.radius"),
    ({"radius": True}, "brush.radius"),
    ({"radius": "16"}, "brush.radius"),
    ({"radius": None}, "brush.radius"),
    ({"radius": 10**400}, "brush.radius"),
    ({"opacity": 1.01}, "brush.opacity"),
    ({"opacity": math.inf}, "brush.opacity"),
    ({"flow": -0.1}, "brush.flow"),
    ({"hardness": [1]}, "brush.hardness"),
    ({"spacing": -1}, "brush.spacing"),
    ({"mode": "bash"}, "brush.mode"),
    ({"mode": ["paint"]}, "brush.mode"),
    ({"colour": "#12345"}, "brush.colour"),
    ({"colour": "#12345g"}, "brush.colour"),
    ({"colour": "red"}, "brush.colour"),
    ({"colour": "#١٢٣٤٥٦"}, "brush.colour"),
    ({"ink": {"texture": "rock"}}, "brush.ink"),
    ({"ink": [{}]}, "brush.ink[0].texture"),
    ({"ink": [{"texture": "rock"}, "rock"]}, "brush.ink[1]"),
    ({"ink": [{"texture": "rock", "amount": 1.5}]}, "brush.ink[0].amount"),
    ({"ink": [{"texture": "a\nb"}]}, "brush.ink[0].texture"),
    ({"ink": [{"texture": "rock"}] * 9}, "brush.ink"),
    ({"op": 3}, "brush.op"),
    ({"op": "moss"}, "brush.op"),
    ({"op": "clone"}, "brush.op.layer"),
    ({"op": {"name": "moss"}}, "brush.op.name"),
    ({"op": {"name": "lighten", "formula": "1"}}, "brush.op"),
    ({"op": {"name": "lighten", "amount": 2}}, "brush.op.amount"),
    ({"op": {"name": "gradient", "by": "hue"}}, "brush.op.by"),
    ({"op": {"name": "gradient", "ramp": [[0, "#000000"]]}}, "brush.op.ramp"),
    ({"op": {"name": "gradient", "ramp": [[0, "#000000"], [0, "#ffffff"]]}}, "brush.op.ramp[1][0]"),
    ({"op": {"name": "gradient", "ramp": [[0, "#000000"], [1, "white"]]}}, "brush.op.ramp[1][1]"),
    ({"op": {"name": "gradient", "ramp": [[0, "#000000"], 1]}}, "brush.op.ramp[1]"),
    ({"op": {"name": "clone", "layer": ""}}, "brush.op.layer"),
    ({"op": {"name": "clone", "layer": "a", "offset": [1]}}, "brush.op.offset"),
    ({"op": {"name": "clone", "layer": "a", "offset": [1, 0.5]}}, "brush.op.offset[1]"),
    ({"op": {"formula": "1 - pic.__class__"}}, "brush.op.formula, column 8"),
    ({"op": {"formula": 3}}, "brush.op.formula"),
    ({"op": {}}, "brush.op"),
    ({"density": 0.5}, "brush.density"),
    ({"grain": {"amount": 1}}, "brush.grain.texture"),
    ({"grain": {"texture": "canvas", "amount": "much"}}, "brush.grain.amount"),
    ({"shaping": []}, "brush.shaping"),
    ({"shaping": [[0, 0], [0, 1]]}, "brush.shaping[1]"),
    ({"shaping": [[0, 0], [1, 1.5]]}, "brush.shaping[1]"),
    ({"shaping": [[i / 64, 0.5] for i in range(65)]}, "brush.shaping"),
    ({"shaping": "bend"}, "brush.shaping"),
    ({"shaping": 2}, "brush.shaping"),
    ({"ink": [{"texture": "rock", "shaping": [[0.5, -1]]}]}, "brush.ink[0].shaping[0]"),
    ({"density": {"texture": "rock", "shaping": "wet"}}, "brush.density.shaping"),
    ({"grain": {"texture": "rock", "level": 0.5}}, "brush.grain.level"),
    ({"grain": {"texture": "rock", "level": 10**9}}, "brush.grain.level"),
    ({"grain": []}, "brush.grain"),
    ({"edge": "negate"}, "brush.edge"),
    ({"edge": {"curve": "negate"}}, "brush.edge.curve"),
    ({"edge": {"width": 5}}, "brush.edge.width"),
    ({"edge": {"amount": True}}, "brush.edge.amount"),
    ({"edge": {"colour": "blue"}}, "brush.edge.colour"),
    ({"edge": 0.5}, "brush.edge"),
    ({"tip": 3}, "brush.tip"),
    ({"tip": {"from": "sample"}}, "brush.tip.texture"),
    ({"tip": {"texture": "a", "from": "field"}}, "brush.tip.from"),
    ({"extent": 1}, "brush.extent"),
    ({"extent": None}, "brush.extent"),
    ({"example": 3}, "brush.example"),
    ({"depth": "deep"}, "brush.depth"),
    ({"depth": True}, "brush.depth"),
    ({"depth": 1e30}, "brush.depth"),
    ({"example_level": 0.5}, "brush.example_level"),
    ({"example_level": 1 << 20}, "brush.example_level"),
    ({"example_detail": 5}, "brush.example_detail"),
    ({"example_detail": None}, "brush.example_detail"),
    ({"dynamics": []}, "brush.dynamics"),
    ({"dynamics": {"radius": "speed"}}, "brush.dynamics.radius"),
    ({"dynamics": {"radius": []}}, "brush.dynamics.radius"),
    ({"dynamics": {"radius": [[0, 0, 0]]}}, "brush.dynamics.radius[0]"),
    ({"dynamics": {"radius": [[0.5, 1], [0.25, 1]]}}, "brush.dynamics.radius[1]"),
    ({"dynamics": {"radius": [[0, 1], [2, 1]]}}, "brush.dynamics.radius[1]"),
    ({"dynamics": {"radius": [[0, math.nan]]}}, "brush.dynamics.radius[0]"),
    ({"dynamics": {"radius": [[i / 100, 1] for i in range(65)]}}, "brush.dynamics.radius"),
    ([], "brush"),
    (None, "brush"),
]


@pytest.mark.parametrize(("data", "place"), HOSTILE)
def test_what_is_wrong_is_named_on_one_line(data, place):
    with pytest.raises(BrushError) as caught:
        from_json(data)
    assert caught.value.place == place
    line = str(caught.value)
    assert line.startswith(f"{place}: found ")
    assert "expected" in line
    assert "\n" not in line
    assert line.isascii()
    assert len(line) < 300
    assert str(pickle.loads(pickle.dumps(caught.value))) == line


def test_a_brush_made_in_the_program_is_checked_too():
    with pytest.raises(BrushError, match="radius"):
        replace(Brush(), radius=math.nan)
    with pytest.raises(BrushError, match="depth"):
        replace(Brush(), depth=math.inf)
    assert Brush(colour="#ABCDEF").colour == "#abcdef"
    assert SETTINGS["radius"].clamped(1e9) == 4000
    assert SETTINGS["radius"].clamped(math.nan) == 16


@pytest.mark.parametrize(
    ("data", "place"),
    [
        ({"mode": "example"}, "brush.example"),
        ({"mode": "example", "depth": 2}, "brush.example"),
    ],
)
def test_a_brush_that_lacks_what_its_mode_needs_is_kept_but_refused_at_use(data, place):
    brush = from_json(data)
    assert to_json(brush)["mode"] == "example"
    with pytest.raises(BrushError) as caught:
        check(brush)
    assert caught.value.place == place
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "data",
    [
        {},
        {"shaping": [[0, 0], [1, 1]]},
        {"shaping": "negate", "op": "toward"},
        {"grain": "p", "density": "p"},
        {"mode": "erase"},
        {"mode": "erase", "depth": -1.5},
        {"mode": "example", "example": "leaves"},
        {"example": "leaves", "depth": 3},
    ],
)
def test_ordinary_brushes_are_usable(data):
    check(from_json(data))


def test_the_short_forms_and_the_defaults_left_out():
    brush = from_json(
        {
            "density": {"texture": "rock", "amount": 1.0, "level": 0},
            "grain": "paper",
            "edge": {"curve": "dark"},
            "tip": {"texture": "leaf", "from": "sample"},
            "extent": False,
            "shaping": None,
        }
    )
    assert brush.density == Surface("rock")
    assert brush.edge == Edge("dark", 0.5, 1.0, None)
    written = {name: v for name, v in to_json(brush).items() if name not in to_json(Brush())}
    assert written == {"density": "rock", "grain": "paper", "edge": "dark", "tip": "leaf"}


def test_dynamics_given_replace_the_default_ones():
    assert from_json({"dynamics": {}}).dynamics == Map()
    assert from_json({"dynamics": {"opacity": None}}).dynamics == Map()


@pytest.mark.parametrize(
    "member",
    [
        {"edge": {"curve": "dark", "of a later version": [1, {"a": 2}]}},
        {"op": {"name": "contrast", "gain": 2.0, "of a later version": [1]}},
        {"op": {"formula": "1 - 2*pic", "of a later version": {}}},
        {"grain": {"texture": "rock", "of a later version": 1}},
    ],
    ids=["edge", "op", "formula", "grain"],
)
def test_members_of_a_later_version_are_kept(member):
    brush = from_json(member)
    assert to_json(brush) | member == to_json(brush)
    assert from_json(to_json(brush)) == brush
    hash(brush)
