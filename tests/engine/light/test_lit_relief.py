"""The law of light on relief: the kernel against the plain form, and what it promises."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.light.light import Light
from engine.light.lit_relief import lit, luminance

SUNS = st.builds(
    Light,
    azimuth=st.floats(-720, 720),
    altitude=st.floats(1, 90),
    depth=st.floats(-60, 60),
    gloss=st.floats(0, 1),
)


def picture(seed, height=9, width=12):
    rng = np.random.default_rng(seed)
    alpha = np.where(rng.random((height, width)) < 0.4, rng.random((height, width)), 1.0)
    return np.concatenate([rng.random((3, height, width)) * alpha, alpha[None]]).astype(np.float32)


def plain(planes, heights, light):
    """The law as the text has it: normal, sun, ambient and diffuse part relative to a flat place, gloss less its
    value there."""
    h = heights.astype(np.float64)
    right, down = 0.5 * (h[1:-1, 2:] - h[1:-1, :-2]), 0.5 * (h[2:, 1:-1] - h[:-2, 1:-1])
    normal = np.stack([-light.depth * right, -light.depth * down, np.ones_like(right)])
    normal /= np.sqrt((normal**2).sum(0))
    around, up = math.radians(light.azimuth), math.radians(light.altitude)
    sun = np.array([math.sin(around) * math.cos(up), -math.cos(around) * math.cos(up), math.sin(up)])
    lambert = np.maximum(np.tensordot(sun, normal, 1), 0)
    between = 0.5 * (sun + np.array([0.0, 0.0, 1.0]))
    shine = np.maximum(np.tensordot(between, normal, 1), 0) ** 24 - between[2] ** 24
    inner = planes[:, 1:-1, 1:-1].astype(np.float64)
    colour = inner[:3] * (0.35 + 0.65 * lambert / sun[2]) + light.gloss * shine * inner[3]
    return np.concatenate([np.clip(colour, 0, inner[3]), inner[3:]])


@given(st.integers(0, 1000), SUNS)
@settings(max_examples=60, deadline=None)
def test_the_kernel_is_the_law(seed, light):
    planes = picture(seed)
    heights = luminance(planes)
    assert np.allclose(lit(planes, heights, light), plain(planes, heights, light), atol=1e-5)


@given(st.integers(0, 1000), st.floats(-5, 5, width=32), SUNS)
@settings(max_examples=30, deadline=None)
def test_what_is_flat_stays_as_it_was_painted(seed, height, light):
    planes = picture(seed)
    flat = np.full(planes.shape[1:], height, np.float32)
    assert np.array_equal(lit(planes, flat, light), planes[:, 1:-1, 1:-1])
    same = np.empty_like(planes)
    same[:] = planes[:, :1, :1]
    assert np.array_equal(lit(same, luminance(same), light), same[:, 1:-1, 1:-1])


def test_slopes_towards_the_sun_are_brighter_than_slopes_away_from_it():
    grey = np.full((4, 3, 7), 0.4, np.float32)
    grey[3] = 1
    ridge = np.broadcast_to(np.array([0, 0, 0.2, 0.4, 0.2, 0, 0], np.float32), (3, 7))
    row = lit(grey, ridge, Light(270, 40))[0, 0]
    assert row[0] > 0.4 > row[-1]
    assert row[2] == np.float32(0.4)
    assert np.array_equal(lit(grey, -ridge, Light(270, 40, -12))[0, 0], row)
    column = lit(grey.transpose(0, 2, 1), ridge.T, Light(0, 40))[0, :, 0]
    assert np.allclose(column, row, atol=1e-6)


def test_colour_never_leaves_its_alpha():
    planes = picture(5)
    found = lit(planes, 3 * luminance(planes), Light(10, 20, 90, 1))
    assert (found[:3] >= 0).all()
    assert (found[:3] <= found[3]).all()
    assert np.array_equal(found[3], planes[3, 1:-1, 1:-1])


@pytest.mark.parametrize(
    ("told", "name"),
    [((math.nan,), "azimuth"), ((0, 0.5), "altitude"), ((0, 91), "altitude"), ((0, 45, 2000), "depth")],
)
def test_a_light_that_cannot_be_is_refused(told, name):
    with pytest.raises(ValueError, match=f"^{name}: found .*, expected"):
        Light(*told)
