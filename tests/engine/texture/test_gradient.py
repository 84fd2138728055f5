"""Gradients: the ramp at every level, whatever rectangle is asked for; painted, saved, refused."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.numeric.pyramid import expand
from engine.painting import commands as c
from engine.session.session import Session
from engine.texture.gradient import GRADIENTS, gradient
from engine.texture.table import from_key

RAMP = [[0, "#ff0000"], [0.25, "#00ff0080"], [1, "#0000ff"]]
TOLD = {"from": [10, 20], "to": [74, 20], "ramp": [[0, "#000000"], [1, "#ffffff"]]}


@given(
    st.sampled_from(GRADIENTS),
    st.integers(-2, 5),
    st.integers(0, 12),
    st.sampled_from([0, 5, 1 << 40, -(1 << 300)]),
    st.tuples(st.integers(0, 40), st.integers(0, 40), st.integers(1, 20), st.integers(1, 20)),
)
@settings(deadline=None, max_examples=40)
def test_any_part_of_a_rectangle_is_what_the_whole_has_there(shape, level, finer, far, part):
    made = gradient({**TOLD, "kind": shape, "level": level, "ramp": RAMP}, level)
    x, y, width, height = part
    whole, cut = Rect.at(far, -7, 64, 64), Rect.at(far + x, y - 7, width, height)
    seen, inside = made.appearance(level + finer, whole), made.appearance(level + finer, cut)
    np.testing.assert_array_equal(seen[:, *cut.slices(whole)], inside)
    adds, within = made.bandpass(level + finer, whole), made.bandpass(level + finer, cut)
    zeros = np.zeros((3, 64, 64), np.float32)
    adds, within = zeros if adds is None else adds, zeros[:, :height, :width] if within is None else within
    np.testing.assert_array_equal(adds[:, *cut.slices(whole)], within)
    assert (seen[:3] <= seen[3] + 1e-6).all()
    assert from_key(made.key, {}) == made


@pytest.mark.parametrize("shape", GRADIENTS)
def test_a_pixel_shows_the_ramp_where_it_is_smooth(shape):
    made = gradient({**TOLD, "kind": shape}, 0)
    seen = made.appearance(3, Rect.at(0, 0, 800, 400))[0]
    y, x = (np.mgrid[:400, :800] + 0.5) / 8 - np.array([20, 10])[:, None, None]
    turn = np.arctan2(y, x) / (2 * math.pi) % 1
    told = {"linear": x / 64, "radial": np.hypot(x, y) / 64, "angular": turn}[shape]
    calm = (told > 0.02) & (told < 0.98) & (np.hypot(x, y) > 2)
    assert np.abs(seen - told)[calm].max() < (2e-3 if shape == "angular" else 1e-6)


@pytest.mark.parametrize("shape", GRADIENTS)
def test_a_level_is_the_coarser_one_expanded_and_what_it_adds(shape):
    made = gradient({**TOLD, "kind": shape, "ramp": RAMP}, 0)
    for level in (1, 4):
        rect = Rect.at(70 << level, 14 << level, 64, 64)
        coarse = made.appearance(level - 1, rect.parents())
        adds = made.bandpass(level, rect)
        found = expand(coarse[:3]) + (0 if adds is None else adds)
        assert np.abs(found - made.appearance(level, rect)[:3]).max() < 2**-15


def test_a_steep_ramp_has_an_edge_one_pixel_wide_at_every_level():
    made = gradient({**TOLD, "ramp": [[0, "#000000"], [0.5, "#000000"], [0.5000000001, "#ffffff"]]}, 0)
    for level in (0, 3, 20):
        middle = 42 << level
        line = made.appearance(level, Rect.at(middle - 4, 0, 8, 1))[0, 0]
        assert line[0] == 0
        assert line[-1] == pytest.approx(1)
        assert ((line > 0) & (line < 1)).sum() <= 2


def painted(*commands):
    session = Session()
    for command in commands:
        session.do(c.parse(command))
    return session


def test_it_is_painted_without_bands_refined_and_opened(tmp_path):
    define = {"do": "texture", "name": "sky", "maker": "gradient", "kind": "linear", **TOLD}
    fill = {"do": "fill", "like": {"at": [5, 5], "rect": [0, 0, 96, 64]}, "open": True}
    session = painted(define, {**fill, "brush": {"ink": [{"texture": "sky", "amount": 1, "colour": "#ffffff"}]}})
    (layer,) = layers(session.painting.root)
    made = gradient(TOLD, 0)
    for level, rect in ((0, Rect.at(4, 4, 88, 56)), (6, Rect.at(40 << 6, 30 << 6, 128, 64))):
        seen = evaluate(layer.pyramid, level, rect).rgba
        assert np.abs(seen[0] - made.appearance(level, rect)[0]).max() < 2**-13
        assert (np.diff(seen[0], axis=1) >= -(2**-14)).all()
    save(tmp_path / "sky.ora", Snapshot(session.painting, session.recording()))
    (again,) = layers(open_painting(tmp_path / "sky.ora").painting.root)
    np.testing.assert_array_equal(evaluate(again.pyramid, 6, rect).data, evaluate(layer.pyramid, 6, rect).data)


def test_what_is_transparent_in_it_shows_the_brushes_colour():
    ramp = [[0, "#ffffff00"], [1, "#ffffff"]]
    define = {"do": "texture", "name": "veil", "maker": "gradient", **TOLD, "ramp": ramp}
    fill = {"do": "fill", "like": {"at": [5, 5], "rect": [0, 0, 96, 64]}, "open": True}
    brush = {"colour": "#ff0000", "ink": [{"texture": "veil", "amount": 1, "colour": "#ffffff"}]}
    session = painted(define, {**fill, "brush": brush})
    (layer,) = layers(session.painting.root)
    seen = evaluate(layer.pyramid, 0, Rect.at(0, 20, 96, 1)).rgba[:, 0]
    np.testing.assert_allclose(seen[:3, 2], [1, 0, 0], atol=1e-3)
    np.testing.assert_allclose(seen[:3, 90], [1, 1, 1], atol=1e-3)
    np.testing.assert_allclose(seen[1, 42], 0.5, atol=0.02)


@pytest.mark.parametrize(
    ("wrong", "place"),
    [
        ({"kind": "square"}, "kind"),
        ({"from": [0]}, "from"),
        ({"to": [10, 20]}, "to"),
        ({"from": [0, 0], "to": [1e-300, 0]}, "to"),
        ({"to": [math.inf, 0]}, "to"),
        ({"level": 0.5}, "level"),
        ({"ramp": [[0, "#000000"]]}, "ramp"),
        ({"ramp": [[0, "#000000"], [0, "#ffffff"]]}, "ramp"),
        ({"ramp": [[0, "#000000"], [1, "white"]]}, "ramp"),
        ({"ramp": None}, "ramp"),
    ],
)
def test_what_makes_no_sense_is_told_by_its_place(wrong, place):
    with pytest.raises(FieldError) as told:
        gradient({**TOLD, **wrong}, 0)
    assert told.value.place == place
