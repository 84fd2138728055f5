"""What steers raster-ops: textures, matrices of colours, and formulas of the artist's own."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from op_edits import KEY, LUMA, SOFT, TARGETS, P, after, around, edited, grey, old_of

from engine.brush.checks import rgb
from engine.brush.settings import from_json, to_json
from engine.brush.tints import saturating, turning
from engine.numeric.address import TILE
from engine.numeric.grid import snapped
from engine.texture.planes import Planes

# ---- textures --------------------------------------------------------------------------------------------------------

INKS = (
    [{"texture": "white", "amount": 0.5}],
    [{"texture": "rock"}],
    [{"texture": "rock", "amount": 0.7}, {"texture": "stripes"}],
)


@pytest.mark.parametrize("ink", INKS)
@pytest.mark.parametrize("name", ["invert", "toward"])
def test_the_weight_is_coverage_times_texture(name, ink):
    planes = around(opaque=True)
    old = old_of(planes)
    made, m = edited(name, planes, SOFT, ink=ink)
    t = np.clip(made.mixture.tile(KEY), 0, 1)
    if ink[0]["texture"] == "white":
        np.testing.assert_allclose(t, 0.5)
    c = old.data[:3]
    np.testing.assert_allclose(after(made, old)[:3], c + m * t * (TARGETS[name](c) - c), atol=8e-5)


def test_the_texture_goes_on_as_ink_of_the_amplitude_that_the_op_has():
    planes = around(opaque=True)
    old = old_of(planes)
    for name in ("invert", "toward"):
        made, _ = edited(name, planes, ink=[{"texture": "rock", "amount": 0.8}])
        stamp = made.stamp(KEY, old)
        assert [i.key[0] for i in stamp.inks] == ["rock"]
        t = made.mixture.tile(KEY)
        free = (t >= 0) & (t <= 1)
        want = np.where(free, 0.4 * (TARGETS[name](old.data[:3]) - old.data[:3]), 0)
        np.testing.assert_allclose(stamp.add[4:7], want, atol=4e-5)


def test_ink_that_lies_there_follows_and_stays_bounded():
    planes = around(opaque=True)
    made, _ = edited("toward", planes, ink=[{"texture": "rock"}])
    inks = made.stamp(KEY, old_of(planes)).inks
    data = np.concatenate([old_of(planes).data, np.full((3, TILE, TILE), 1.5, np.float32)])
    old = Planes(data, inks)
    stamp = edited({"name": "contrast", "gain": 4}, planes)[0].stamp(KEY, old)
    ink = snapped(stamp.keep * data[4:]) + stamp.add[4:]
    assert ink.max() == 2.0
    inverted = edited("invert", planes)[0].stamp(KEY, old)
    assert (snapped(inverted.keep * data[4:]) + inverted.add[4:] == -1.5).all()
    for name in ("hue", "toward"):
        made, _ = edited(name, planes, ink=[{"texture": "rock"}])
        now = old
        for _ in range(12):
            stamp = made.stamp(KEY, now)
            add = stamp.add
            new = snapped(stamp.keep * now.data) + add
            new[3] = 1
            now = Planes(new, inks)
            assert np.abs(new[4:]).max() <= 1.5


def test_a_wash_by_texture_runs_along_the_ramp():
    planes = around(opaque=True)
    old = old_of(planes)
    op = {"name": "gradient", "by": "texture", "ramp": [[0, "#000000"], [1, "#ff8000"]]}
    made, _ = edited(op, planes, ink=[{"texture": "stripes", "period": 40}])
    stamp = made.stamp(KEY, old)
    t = np.clip(made.mixture.tile(KEY), 0, 1)
    want = np.array(rgb("#ff8000"))[:, None, None] * t
    np.testing.assert_allclose(after(made, old)[:3], want, atol=5e-5)
    assert (stamp.keep == 0).all()
    np.testing.assert_allclose(stamp.add[4:7, 5, 5], np.array(rgb("#ff8000")) / 2, atol=2e-3)


# ---- colour matrices -------------------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=25)
@given(st.floats(-360, 360), st.floats(0, 4))
def test_matrices_keep_grey_and_brightness(turn, amount):
    for matrix in (turning(turn), saturating(amount)):
        np.testing.assert_allclose(matrix @ np.ones(3), np.ones(3), atol=1e-12)
        np.testing.assert_allclose(LUMA[:, 0, 0] @ matrix, LUMA[:, 0, 0], atol=1e-12)
    np.testing.assert_allclose(turning(turn) @ turning(-turn), np.eye(3), atol=1e-12)


# ---- formulas --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "f"),
    [
        ("colour - pic", lambda c: P - c),
        ("1 - 2*pic", lambda c: 1 - 2 * c),
        ("0.25*(luma - pic)", lambda c: 0.25 * (grey(c) - c)),
        ("pic*1e300*1e300", lambda c: 0 * c),
        ("5", lambda c: 5 + 0 * c),
    ],
)
def test_a_formula_is_f(text, f):
    planes = around()
    old = old_of(planes)
    made, m = edited({"formula": text}, planes, SOFT)
    alpha = old.data[3].astype(float)
    c = np.clip(old.data[:3] / np.maximum(alpha, 1e-9), 0, 1)
    got = after(made, old)
    np.testing.assert_allclose(got[:3], alpha * np.clip(c + m * f(c), 0, 1), atol=8e-5)
    assert got[3].tobytes() == old.data[3].tobytes()


def test_a_formula_knows_its_place_texture_level_and_coverage():
    planes = around(opaque=True)
    planes.data[:3] = 0
    old = old_of(planes)
    x = np.arange(TILE) + 0.5
    for text, want in {
        "x/200": np.tile(x / 200, (TILE, 1)),
        "y/200": np.tile(x / 200, (TILE, 1)).T,
        "(level + 1) * 0.5": np.full((TILE, TILE), 0.5),
        "d": np.ones((TILE, TILE)),
        "pressure*0.5": np.full((TILE, TILE), 0.5),
    }.items():
        got = after(edited({"formula": text}, planes)[0], old)
        np.testing.assert_allclose(got[0], want, atol=3e-5)
    made, _ = edited({"formula": "tex"}, planes, ink=[{"texture": "rock"}])
    np.testing.assert_allclose(after(made, old)[1], np.clip(made.mixture.tile(KEY), 0, 1) ** 2, atol=4e-5)


def test_a_formula_has_a_slope():
    planes = around(opaque=True)
    planes.data[:3] = snapped(np.array([0.4]))
    keep = edited({"formula": "1 - 2*pic"}, planes)[0].stamp(KEY, old_of(planes)).keep
    np.testing.assert_allclose(keep, -1, atol=1e-4)
    keep = edited({"formula": "0.5*(pic - 0.5)"}, planes)[0].stamp(KEY, old_of(planes)).keep
    np.testing.assert_allclose(keep, 1.5, atol=1e-4)
    keep = edited({"formula": "0.1"}, planes)[0].stamp(KEY, old_of(planes)).keep
    np.testing.assert_allclose(keep, 1.0, atol=1e-4)


@pytest.mark.parametrize(
    "op",
    [
        "multiply",
        {"name": "lighten", "amount": 0.25},
        {"formula": "1 - pic"},
        {"name": "clone", "layer": "a", "offset": [3, -4]},
        {"name": "gradient", "by": "texture", "ramp": [[0, "#000000"], [0.5, "#102030"], [1, "#ffffff"]]},
    ],
)
def test_ops_are_written_as_they_were_read(op):
    brush = from_json({"mode": "raster", "op": op})
    assert to_json(brush)["op"] == op
    assert from_json(to_json(brush)) == brush
    hash(brush)
