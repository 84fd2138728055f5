"""The table of textures: its rows make instances, and instances come back from their keys."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.address import Rect
from engine.texture.image import ImageSource
from engine.texture.planes import merged
from engine.texture.table import KINDS, TextureError, from_key, instance

SOURCE = ImageSource.of("a picture", np.full((4, 6, 10), 0.25, np.float32))
NAMES = ", ".join(KINDS)
NUMBERS = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=3), st.lists(st.integers()))


def values(row):
    return st.fixed_dictionaries(
        {p.name: st.integers(int(p.lo), int(p.hi)) if p.whole else st.floats(p.lo, p.hi) for p in row.parameters}
    )


@settings(deadline=None, max_examples=60)
@given(st.sampled_from(sorted(KINDS)), st.integers(-300, 300), st.data())
def test_an_instance_comes_back_from_its_key(kind, level, data):
    made = instance(kind, data.draw(values(KINDS[kind])), level, 5, SOURCE)
    back = from_key(json.loads(json.dumps(made.key)), {SOURCE.sha: SOURCE})
    assert back == made
    assert back.key == made.key
    assert hash(back) == hash(made)
    assert back.base == level
    rect = Rect.at(3, 5, 8, 8)
    assert (back.appearance(level, rect) == made.appearance(level, rect)).all()


@pytest.mark.parametrize("kind", sorted(KINDS))
def test_defaults_are_in_range_and_stand_in_for_what_is_missing(kind):
    row = KINDS[kind]
    assert row.tooltip
    for p in row.parameters:
        assert p.checked(p.default) == p.default
        assert p.tooltip
    made = instance(kind, {"unknown": "kept"}, 3, 77, SOURCE)
    assert made == instance(kind, {p.name: None for p in row.parameters}, 3, 77, SOURCE)
    assert made.bandpass(3, Rect.at(0, 0, 8, 8)) is None


def test_seed_of_the_stroke_unless_the_texture_names_its_own():
    assert instance("rock", {}, 0, 9).key[-1] == 9
    assert instance("rock", {"seed": 4}, 0, 9).key[-1] == 4
    assert instance("stripes", {"seed": 4}, 0, 9) == instance("stripes", {}, 0, 1)


def test_a_picture_comes_in_its_own_width():
    assert instance("image", {}, 0, 0, SOURCE).key[2] == 10
    assert instance("image", {"period": 33}, 0, 0, SOURCE).key[2] == 33
    assert instance("canvas", {"period": 33.0}, 0, 0, SOURCE) == instance("image", {"period": 33}, 0, 0, SOURCE)


def test_the_cover_of_a_picture_comes_back_from_its_key_but_has_no_name():
    cover = instance("image", {}, 0, 0, SOURCE).cover
    assert from_key(list(cover.key), {SOURCE.sha: SOURCE}) == cover
    with pytest.raises(TextureError, match="texture"):
        instance("cover", {}, 0, 0, SOURCE)


def test_one_texture_has_one_key():
    a, b = (
        instance("stripes", {"angle": -0.0, "period": 8}, 0, 0),
        instance("stripes", {"angle": 0, "period": 8.0}, 0, 0),
    )
    assert json.dumps(a.key) == json.dumps(b.key)
    inks = merged(
        (a, instance("rock", {}, 0, 1)), (b, instance("image", {}, 0, 0, SOURCE), instance("white", {}, 0, 0))
    )
    assert [ink.key[0] for ink in inks] == ["image", "rock", "stripes", "white"]


@pytest.mark.parametrize(
    ("kind", "parameters", "message"),
    [
        (
            "marble",
            {},
            'texture: found "marble", expected one of ' + NAMES,
        ),
        ("stripes", {"period": 1.5}, "period: found 1.5, expected a number from 2 to 65536"),
        ("stripes", {"period": float("nan")}, "period: found NaN, expected a number from 2 to 65536"),
        ("rock", {"roughness": float("inf")}, "roughness: found Infinity, expected a number from 0 to 1"),
        ("rock", {"seed": 0.5}, "seed: found 0.5, expected an integer from -9.22337e+18 to 1.84467e+19"),
        ("squares", {"angle": "steep"}, 'angle: found "steep", expected a number from -360 to 360'),
        ("sawtooth", {"phase": True}, "phase: found true, expected a number from 0 to 1"),
        (
            "squares",
            {"period": 10**400},
            "period: found an integer of about 400 digits, expected a number from 2 to 65536",
        ),
        ("image", {}, "source: found none, expected a picture for the texture 'image'"),
        (
            ["rock"],
            {},
            'texture: found ["rock"], expected one of ' + NAMES,
        ),
    ],
)
def test_what_is_refused_and_how(kind, parameters, message):
    with pytest.raises(TextureError) as caught:
        instance(kind, parameters, 0, 0)
    assert str(caught.value) == message


@pytest.mark.parametrize("level", [1 << 17, -(1 << 17), 0.0, None, True])
def test_levels_out_of_reach_are_refused(level):
    with pytest.raises(TextureError, match=r"level: found .*, expected an integer from -65536 to 65536"):
        instance("rock", {}, level, 0)


@pytest.mark.parametrize(
    "key",
    [
        None,
        [],
        "rock",
        ["rock"],
        ["rock", 0],
        ["rock", 0, 8.0, 0.5, 1, 2],
        ["rock", 0, 8.0, float("nan"), 1],
        ["rock", 0.5, 8.0, 0.5, 1],
        ["image", 0, 8, "name"],
        ["image", 0, 8, "name", 7],
        ["image", 0, 8, None, "00"],
        [7, 0],
        {"rock": 0},
    ],
)
def test_keys_of_another_form_are_refused(key):
    with pytest.raises(TextureError):
        from_key(key, {})


@settings(deadline=None, max_examples=150)
@given(st.lists(st.one_of(st.sampled_from(sorted(KINDS)), NUMBERS), max_size=6))
def test_any_key_is_read_or_refused_in_one_line(key):
    try:
        made = from_key(key, {})
    except TextureError as error:
        line = str(error)
    else:
        line = "made"
        assert json.loads(json.dumps(made.key)) == list(made.key)
    assert line.isascii()
    assert "\n" not in line


def test_a_picture_that_is_gone_keeps_its_key():
    key = ("image", 0, 8, "gone", "00ff")
    assert from_key(key, {SOURCE.sha: SOURCE}).key == key
