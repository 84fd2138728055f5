"""Commands: parse and to_json are inverse to one another; what is wrong is named in one line."""

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.checks import frozen
from engine.brush.settings import Brush, Component
from engine.canvas.placing.pose import FINEST, MOST_LEVELS, SourcePart
from engine.checks.field_error import FieldError
from engine.files.strict_json import dumps, loads
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.layer_commands import SELECTED
from engine.painting.points import POINT_COLUMNS, points_array

names = st.text(
    st.characters(exclude_categories=["Cs", "Cc"], exclude_characters="\ufffe\uffff"), min_size=1, max_size=20
)
finite = st.floats(allow_nan=False, allow_infinity=False)
whole = st.integers(-c.PLACE_LIMIT, c.PLACE_LIMIT)
later = st.dictionaries(st.sampled_from(["zz_later", "zz-other"]), st.integers() | names | st.lists(finite)).map(frozen)
groups = st.none() | names | st.just(c.Same.SAME)
positions = st.integers(0, c.COUNT_LIMIT)
unit = st.floats(0, 1)


@st.composite
def strokes(draw):
    rows = draw(st.lists(st.tuples(*(st.floats(lo, hi) for _, _, lo, hi in POINT_COLUMNS)), min_size=1, max_size=6))
    cut = draw(st.integers(2, 6))
    brush = Brush(
        radius=draw(st.floats(0.5, 4000)),
        mode=draw(st.sampled_from(["paint", "example"])),
        example=draw(st.none() | names),
        depth=draw(st.none() | st.floats(-9, 9)),
        example_level=draw(st.none() | st.integers(-9, 9)),
        example_detail=draw(st.integers(0, 4)),
        colour=draw(st.sampled_from(["#000000", "#a0b1c2"])),
        ink=tuple(draw(st.lists(st.builds(Component, names, unit, st.just("#00ff00")), max_size=2))),
        extra=draw(later),
    )
    return c.Stroke(
        draw(st.integers(-c.LEVEL_LIMIT, c.LEVEL_LIMIT)),
        (draw(whole), draw(whole)),
        points_array([list(row[:cut]) for row in rows], "points"),
        brush,
        draw(st.none() | names),
        draw(st.none() | st.integers(-c.SEED_LIMIT, c.SEED_LIMIT)),
        draw(later),
    )


optional_flags = st.none() | st.booleans()
same = st.just(c.Same.SAME)
far = st.integers(-FINEST, FINEST)
turns = st.one_of(
    st.fixed_dictionaries({}, optional={"turn": st.integers(0, 3)}),
    st.floats(0, 6).map(lambda angle: {"turned": (1.2 * math.cos(angle), 1.2 * math.sin(angle))}),
)
parts = st.builds(
    lambda level, x, y, width, height: SourcePart(level, Rect.at(x, y, width, height)),
    far, whole, whole, st.integers(1, 1 << 40), st.integers(1, 1 << 40),
)  # fmt: skip
placings = st.builds(
    lambda turn, **given: c.Placing(**turn, **given),
    turns,
    of=st.none() | names | same,
    at=st.tuples(whole, whole) | same,
    level=far | same,
    levels=st.integers(-MOST_LEVELS, MOST_LEVELS) | same,
    mirror=st.booleans() | same,
    part=st.none() | parts | same,
    repeat=st.booleans() | same,
)
COMMANDS = st.one_of(
    strokes(),
    st.builds(c.AddLayer, names, st.sampled_from(["layer", "group"]), groups, st.none() | positions, later),
    st.builds(c.AddPlacement, names, placings, groups, st.none() | positions, later),
    st.builds(c.BakePlacement, names, st.none() | far, later),
    st.builds(c.MergeLayer, names, later),
    st.builds(c.FlattenGroup, st.none() | names, later),
    st.builds(c.ClearLayer, st.none() | names, st.booleans(), later),
    st.builds(
        c.Erode,
        st.builds(Rect.at, whole, whole, st.integers(16, 900), st.integers(16, 900)),
        st.integers(-4096, 4096),
        st.none() | names,
        unit,
        unit,
        unit,
        st.integers(0, 9),
        later,
    ),
    st.builds(
        c.LayGround,
        names,
        st.builds(Rect.at, whole, whole, st.integers(2, 900), st.integers(2, 900)),
        st.integers(-4096, 4096),
        st.none() | names,
        st.none() | st.tuples(unit, unit),
        st.none() | st.tuples(unit, unit),
        unit,
        unit,
        unit,
        st.integers(0, 9),
        later,
    ),
    st.builds(c.SetPaper, st.sampled_from([None, "#102030"]), later),
    st.builds(c.SetFrame, st.builds(Rect.at, whole, whole, st.integers(1, 1 << 40), st.integers(1, 1 << 40)), later),
    *(st.builds(kind, names, later) for kind in (c.SelectLayer, c.CopyPaint, c.CutPaint, c.PastePaint)),
    st.builds(c.RemoveLayer, names, later),
    st.builds(c.RenameLayer, names, names, later),
    st.builds(
        c.DuplicateLayer, names, names, st.none() | placings.filter(lambda placing: placing != c.Placing()), later
    ),
    st.builds(c.DuplicateLayer, names, names, extra=later, selected=st.sampled_from(SELECTED), aside=st.booleans()),
    st.builds(
        c.SetLayer,
        names,
        placing=placings.filter(lambda placing: placing != c.Placing()),
        selected=st.sampled_from(SELECTED),
        extra=later,
    ),
    st.builds(c.MoveLayer, names, positions, groups, later),
    st.builds(
        c.SetLayer,
        names,
        unit,
        optional_flags,
        st.none() | names,
        optional_flags,
        optional_flags,
        optional_flags,
        placing=st.none() | placings.filter(lambda placing: placing != c.Placing()),
        extra=later,
    ),
    st.builds(c.Undo, st.integers(1, c.COUNT_LIMIT), later),
    st.builds(c.Redo, st.integers(1, c.COUNT_LIMIT), later),
    st.builds(c.View, st.floats(-4096, 4096), st.tuples(finite, whole), st.tuples(st.integers(0, 9), unit), later),
    st.builds(
        c.Bookmark,
        names,
        st.floats(-4096, 4096),
        st.tuples(finite, whole),
        st.tuples(st.floats(1e-9, 2.0**40), st.integers(1, 1 << 40)),
        st.floats(-360, 360),
        st.booleans(),
        later,
    ),
    st.builds(c.RemoveBookmark, names, later),
    st.builds(c.RenameBookmark, names, names, later),
    st.builds(c.DefineTexture, names, names, later),
    st.builds(
        c.Swap,
        st.integers(-c.LEVEL_LIMIT, c.LEVEL_LIMIT),
        st.tuples(whole, whole),
        names,
        st.none() | names,
        st.none() | st.floats(-(2.0**31), 2.0**31),
        st.integers(0, 4),
        later,
    ),
)


@settings(deadline=None, max_examples=150)
@given(COMMANDS)
def test_what_is_written_is_read_back(command):
    told = c.to_json(command)
    again = c.parse(loads(dumps(told)))
    assert again == command
    assert c.to_json(again) == told


def test_what_a_newer_version_wrote_survives():
    told = {
        "do": "stroke",
        "level": 2,
        "origin": [1, 2],
        "points": [[0, 0]],
        "brush": {"glitter": {"a": [1]}},
        "x": [{}],
    }
    again = c.to_json(c.parse(told))
    assert again["x"] == [{}]
    assert again["brush"]["glitter"] == {"a": [1]}


def test_points_have_their_defaults_and_are_read_only():
    stroke = c.parse({"do": "stroke", "points": [[1, 2], [3, 4.5, 0.5], [-0.0, 0, 1, 10, -10, 2]]})
    assert stroke.points.dtype == np.float64
    expected = [[1, 2, 1, 0, 0, 0], [3, 4.5, 0.5, 0, 0, 0], [0, 0, 1, 10, -10, 2]]
    assert stroke.points.tolist() == expected
    assert not np.signbit(stroke.points[2, 0])
    with pytest.raises(ValueError, match="read-only"):
        stroke.points[0, 0] = 1
    assert json.dumps(c.to_json(stroke)["points"]) == "[[1, 2], [3, 4.5, 0.5], [0, 0, 1, 10, -10, 2]]"


HOSTILE = {
    "no object": ([], "found []"),
    "swap at nothing": ({"do": "swap", "example": "a"}, "at: found nothing"),
    "swap at half a pixel": ({"do": "swap", "example": "a", "at": [0.5, 1]}, "at: found"),
    "swap for nothing": ({"do": "swap", "at": [1, 1]}, "example: found nothing"),
    "swap at no depth": ({"do": "swap", "at": [1, 1], "example": "a", "depth": "x"}, 'depth: found "x"'),
    "swap with too much detail": ({"do": "swap", "at": [1, 1], "example": "a", "example_detail": 5}, "example_detail"),
    "no do": ({}, "do: found nothing"),
    "unknown do": ({"do": "paint"}, 'do: found "paint", expected one of stroke, fill, layer'),
    "do a list": ({"do": ["stroke"]}, "do: found"),
    "no points": ({"do": "stroke"}, "points: found nothing"),
    "empty points": ({"do": "stroke", "points": []}, "points: found"),
    "one number": ({"do": "stroke", "points": [[1]]}, "points[0]: found"),
    "eight numbers": ({"do": "stroke", "points": [[1, 2, 0, 0, 0, 0, 0, 0]]}, "points[0]: found"),
    "a word in a point": ({"do": "stroke", "points": [[0, 0], [1, "2"]]}, "points[1]: found"),
    "a flag in a point": ({"do": "stroke", "points": [[0, True]]}, "points[0]: found"),
    "null in a point": ({"do": "stroke", "points": [[0, None]]}, "points[0]: found"),
    "huge integer": ({"do": "stroke", "points": [[0, 10**400]]}, "points[0]: found"),
    "far away": ({"do": "stroke", "points": [[0, 1e308]]}, "points[0][1]: found 1e+308, expected y from"),
    "pressure 2": ({"do": "stroke", "points": [[0, 0, 2]]}, "points[0][2]: found 2, expected pressure from 0 to 1"),
    "negative pressure": ({"do": "stroke", "points": [[0, 0, -0.1]]}, "points[0][2]: found -0.1"),
    "tilt": ({"do": "stroke", "points": [[0, 0, 1, 1e9]]}, "points[0][3]: found 1e+09"),
    "level a float": ({"do": "stroke", "level": 0.5, "points": [[0, 0]]}, "level: found 0.5, expected an integer"),
    "level too fine": ({"do": "stroke", "level": 5000, "points": [[0, 0]]}, "level: found 5000"),
    "origin a float": ({"do": "stroke", "origin": [0, 0.5], "points": [[0, 0]]}, "origin: found [0, 0.5]"),
    "origin too long": ({"do": "stroke", "origin": [0, 1 << 9000], "points": [[0, 0]]}, "origin: found"),
    "layer a number": ({"do": "stroke", "layer": 3, "points": [[0, 0]]}, "layer: found 3"),
    "seed a float": ({"do": "stroke", "seed": 1.0, "points": [[0, 0]]}, "seed: found 1.0"),
    "brush a list": ({"do": "stroke", "brush": [], "points": [[0, 0]]}, "brush: found []"),
    "radius": ({"do": "stroke", "brush": {"radius": -1}, "points": [[0, 0]]}, "brush.radius: found -1"),
    "spacing a word": ({"do": "stroke", "brush": {"spacing": "x"}, "points": [[0, 0]]}, 'brush.spacing: found "x"'),
    "mode": ({"do": "stroke", "brush": {"mode": "burn"}, "points": [[0, 0]]}, 'brush.mode: found "burn"'),
    "colour": ({"do": "stroke", "brush": {"colour": "red"}, "points": [[0, 0]]}, 'brush.colour: found "red"'),
    "no verb": ({"do": "layer"}, "found none, expected exactly one of add"),
    "two verbs": ({"do": "layer", "add": "a", "remove": "a"}, "found add and remove"),
    "empty name": ({"do": "layer", "add": ""}, 'add: found ""'),
    "control character": ({"do": "layer", "add": "a\nb"}, "add: found"),
    "rename to nothing": ({"do": "layer", "rename": "a"}, "to: found nothing"),
    "move nowhere": ({"do": "layer", "move": "a"}, "to: found nothing"),
    "move below": ({"do": "layer", "move": "a", "to": -1}, "to: found -1"),
    "group a number": ({"do": "layer", "move": "a", "to": 0, "group": 4}, "group: found 4"),
    "kind": ({"do": "layer", "add": "a", "kind": "mask"}, 'kind: found "mask"'),
    "nothing set": ({"do": "layer", "set": "a"}, "found nothing to set"),
    "opacity": ({"do": "layer", "set": "a", "opacity": 1.5}, "opacity: found 1.5"),
    "visible": ({"do": "layer", "set": "a", "visible": 1}, "visible: found 1"),
    "undo nothing": ({"do": "undo", "count": 0}, "count: found 0"),
    "undo half": ({"do": "undo", "count": 0.5}, "count: found 0.5"),
    "view": ({"do": "view", "level": 1e9}, "level: found 1000000000.0"),
    "view origin": ({"do": "view", "origin": [1]}, "origin: found [1]"),
    "view size": ({"do": "view", "size": [1, -1]}, "size: found"),
    "bookmark without name": ({"do": "bookmark", "level": 2}, "name: found nothing"),
    "bookmark of no size": (
        {"do": "bookmark", "name": "a", "size": [0, 4]},
        "size: found [0, 4], expected numbers above",
    ),
    "bookmark too large": ({"do": "bookmark", "name": "a", "size": [1 << 41, 4]}, "size: found"),
    "bookmark at a word": ({"do": "bookmark", "name": "a", "origin": ["x", 4]}, "origin: found"),
    "bookmark too far": ({"do": "bookmark", "name": "a", "origin": [1 << 9000, 4]}, "origin: found"),
    "bookmark at a flag": ({"do": "bookmark", "name": "a", "origin": [True, 4]}, "origin: found"),
    "bookmark too deep": ({"do": "bookmark", "name": "a", "level": 5000}, "level: found 5000"),
    "bookmark turned over": ({"do": "bookmark", "name": "a", "angle": 400}, "angle: found 400"),
    "bookmark away and renamed": ({"do": "bookmark", "name": "a", "remove": True, "to": "b"}, 'to: found "b"'),
    "texture without maker": ({"do": "texture", "name": "a"}, "maker: found nothing"),
}


@pytest.mark.parametrize(("value", "message"), HOSTILE.values(), ids=HOSTILE)
def test_what_is_wrong_is_named(value, message):
    with pytest.raises(FieldError) as caught:
        c.parse(value)
    assert message in str(caught.value)
    assert "expected" in str(caught.value)
    assert "\n" not in str(caught.value)


@settings(deadline=None, max_examples=100)
@given(
    st.dictionaries(
        st.sampled_from(
            ["do", "points", "level", "origin", "brush", "layer", "add", "move", "set", "to", "count", "size"]
        ),
        st.sampled_from([*c.COMMANDS, 0, -1, 1.5, None, True, [], [[]], [[0, 0]], {}, 10**30, "a", [1, 2]]),
        max_size=6,
    )
)
def test_nothing_else_is_raised(value):
    try:
        command = c.parse(value)
    except FieldError:
        return
    assert c.parse(c.to_json(command)) == command
