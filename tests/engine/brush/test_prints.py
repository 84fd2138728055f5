"""Elliptic dabs: the compiled form is the plain one, whatever tiles they meet, round ones are round."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush import prints
from engine.brush.copies import Copy, copied
from engine.brush.discs import as_discs, no_bounds
from engine.brush.mask import StrokeMask
from engine.brush.settings import from_json
from engine.numeric.address import TILE, Rect

NIB = from_json({"shape": {"ratio": 0.3}})
OVAL = prints.plain(NIB)
WHOLE = Rect(-64, -64, 192, 192)


def dab(x, y, radius, degrees, ratio, hardness=1.0, opacity=1.0, flow=1.0):
    angle = math.radians(degrees)
    return np.array([[x, y, radius, opacity, flow, hardness, math.cos(angle), math.sin(angle), ratio]])


def covered(dabs, rect=WHOLE, copies=(), oval=OVAL):
    mask = StrokeMask(0, (0, 0), tip=prints.for_copies(oval, copies), each=1 + len(copies))
    for part in copied(dabs, copies):
        mask.paint(part)
    out, coverage = np.zeros((rect.height, rect.width), np.float32), mask.coverage()
    for key in coverage.tiles:
        inner = key.rect.intersect(rect)
        if not inner.empty:
            out[inner.slices(rect)] = coverage.on_grid(key)[inner.slices(key.rect)]
    return out


def plain_dab(row, size=TILE):
    """The profile of one dab on the pixels of a tile, as the module's documentation tells it."""
    x, y, radius, opacity, flow, hardness, cos, sin, ratio = row
    radius = max(radius, 0.5)
    thin = max(ratio, min(1.0, 0.5 / radius))
    py, px = np.mgrid[:size, :size] + 0.5
    right, down = px - x, py - y
    u, v = cos * right + sin * down, (cos * down - sin * right) / thin
    square = u * u + v * v
    a, b = cos * u - sin * v / thin, sin * u + cos * v / thin
    half = 0.5 * np.sqrt((a * a + b * b) / np.maximum(square, 1e-30))
    outer, inside = (
        radius + half,
        np.maximum(0.0, np.minimum(max(0, min(hardness * radius, radius - 0.5)), radius - half)),
    )
    w = 1 - np.clip((square - inside**2) / (outer**2 - inside**2), 0, 1)
    profile = np.where(square == 0, 1.0, w * w * (3 - 2 * w))
    around = (u / (radius + 1.5)) ** 2 + ((cos * down - sin * right) / (radius * thin + 1.5)) ** 2
    profile = np.where(around <= 1, profile, 0.0)  # what lies farther from an ellipse is not looked at
    return opacity * min(1.0, ratio * radius / 0.5) * flow * profile


@settings(deadline=None, max_examples=60)
@given(
    st.floats(20, 100), st.floats(20, 100), st.floats(0.6, 30), st.floats(0, 360), st.floats(0.02, 1), st.floats(0, 1)
)
def test_a_dab_is_the_plain_one(x, y, radius, degrees, ratio, hardness):
    dabs = dab(x, y, radius, degrees, ratio, hardness)
    found, wanted = covered(dabs, Rect(0, 0, TILE, TILE)), plain_dab(dabs[0])
    assert np.abs(found - wanted).max() < 1e-4


@settings(deadline=None, max_examples=30)
@given(st.floats(0.6, 30), st.floats(0, 1), st.floats(0, 360))
def test_one_as_broad_as_long_is_round(radius, hardness, degrees):
    dabs = dab(60.3, 61.8, radius, degrees, 1.0, hardness)
    assert np.abs(covered(dabs) - covered(dabs[:, :6], oval=None)).max() < 2.0**-15


@settings(deadline=None, max_examples=20)
@given(st.floats(0, 360), st.floats(0.05, 1), st.integers(1, 127))
def test_it_does_not_matter_which_tiles_it_meets(degrees, ratio, shift):
    dabs = dab(64, 64, 25, degrees, ratio, 0.6)
    moved = dabs + np.array([shift, shift, *[0.0] * 7])
    here = Rect(20, 20, 108, 108)
    there = Rect(here.x0 + shift, here.y0 + shift, here.x1 + shift, here.y1 + shift)
    assert np.abs(covered(dabs, here) - covered(moved, there)).max() <= 2.0**-16


def test_a_quarter_turn_turns_its_pixels():
    upright, lying = covered(dab(64, 64, 30, 90, 0.3)), covered(dab(64, 64, 30, 0, 0.3))
    np.testing.assert_allclose(upright, lying.T, atol=1e-5)
    assert lying[128].sum() > 2 * lying[:, 128].sum()


def test_copies_are_turned_and_mirrored_with_it():
    dabs = dab(40, 30, 20, 25, 0.25)
    mirrored = covered(dabs, copies=(Copy(1.0, 0.0, 128.0, 0.0, True),))
    both = np.maximum(covered(dabs), covered(dab(88, 30, 20, 155, 0.25)))
    np.testing.assert_allclose(mirrored, both, atol=1e-4)
    turned = covered(dabs, copies=(Copy(0.0, 0.5, 100.0, 20.0),))
    both = np.maximum(covered(dabs), covered(dab(100 - 15, 20 + 20, 10, 115, 0.25)))
    np.testing.assert_allclose(turned, both, atol=1e-4)


def test_a_texture_is_turned_with_each_dab():
    brush = from_json({"radius": 30, "tip": {"texture": "squares", "period": 32}, "shape": {"ratio": 0.999}})
    oval = prints.resolve(brush, {}, 0, 1)
    lying, upright = (covered(dab(64, 64, 30, degrees, 1.0), oval=oval) for degrees in (0, 90))
    assert lying.any()
    assert np.abs(lying - covered(dab(64, 64, 30, 0, 1.0))).max() > 0.5
    np.testing.assert_allclose(np.rot90(lying, -1), upright, atol=0.02)


@pytest.mark.parametrize(
    "told", [{"angle": 30}, {"follow": "direction"}, {"scatter": 2}, {"bristles": 9, "ratio": 0.5}]
)
def test_round_dabs_need_no_ellipse(told):
    assert prints.plain(from_json({"shape": told})) is None


def test_windows_of_a_field_stay_as_the_field_lies():
    brush = from_json({"radius": 20, "tip": {"texture": "rock", "from": "window"}, "shape": {"ratio": 0.5}})
    found = covered(dab(64, 64, 20, 0, 0.5), oval=prints.resolve(brush, {}, 0, 1))
    whole = covered(dab(64, 64, 20, 0, 0.5))
    assert (found <= whole + 1e-6).all()
    assert 0.2 < found.sum() / whole.sum() < 0.9
    assert no_bounds()[4] == 0.0
    assert as_discs(dab(1, 2, 3, 0, 0.5), 0.0, 0.0, no_bounds()).shape == (1, 10)
