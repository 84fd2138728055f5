"""A texture that tiles, around an object: no seam, as many times around as it fits, and no turn by accident."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from engine.solids.object_map import ObjectMap
from engine.solids.objects import object_named

WAVES = np.stack(
    [0.5 + 0.4 * np.sin(2 * np.pi * (y / 32 + k * x / 64)) for k in range(3) for y, x in [np.mgrid[:32, :64]]]
).astype(np.float32)


def colours(name, places, scale=0.42, finest=1e-3):
    return ObjectMap.of(WAVES, name, scale).colours(np.asarray(places) * scale + 0.5, finest)


@pytest.mark.parametrize("name", ["sphere", "torus", "vase"])
def test_every_corner_has_a_colour_of_the_texture(name):
    found = colours(name, object_named(name).points)
    assert found.shape == (len(object_named(name).points), 3)
    assert found.min() >= 0.1 - 1e-6
    assert found.max() <= 0.9 + 1e-6


@given(st.floats(0.05, 3.0), st.floats(-0.9, 0.9))
def test_no_seam_where_it_closes(scale, z):
    out = np.sqrt(1.0 - z * z)
    beside = [[-out, 1e-7, z], [-out, -1e-7, z]]  # both sides of where the angle begins and ends
    assert np.allclose(*colours("sphere", beside, scale), atol=1e-3)
    around = np.pi * (1.0 - 1e-7)
    tube = [[0.66 + 0.34 * np.cos(t), 0.0, 0.34 * np.sin(t)] for t in (around, -around)]
    assert np.allclose(*colours("torus", tube, scale), atol=1e-3)


def test_it_goes_around_a_whole_number_of_times_and_its_top_is_up():
    t = np.linspace(-np.pi, np.pi, 721)[:-1]
    ring = np.stack([np.cos(t), np.sin(t), 0 * t], axis=1)
    red, green, _ = colours("sphere", ring).T
    assert np.ptp(red) < 1e-6  # its first channel does not change across
    assert np.abs(np.fft.rfft(green - green.mean()))[1:].argmax() + 1 == round(2 * np.pi * 0.42)
    ramp = np.broadcast_to(np.linspace(0, 1, 32, dtype=np.float32)[:, None], (3, 32, 64)).copy()
    high, low = ObjectMap.of(ramp, "sphere", 0.05).colours(
        np.array([[0.02, 0, 0.8], [0.02, 0, -0.8]]) * 0.05 + 0.5, 1e-3
    )
    assert high[0] < 0.3
    assert low[0] > 0.7


def test_from_afar_it_is_smooth():
    t = np.linspace(-3, 3, 300)
    ring = np.stack([np.cos(t), np.sin(t), 0 * t], axis=1)
    assert np.ptp(colours("sphere", ring, 3.0, 0.5)[:, 2]) < np.ptp(colours("sphere", ring, 3.0)[:, 2]) / 2
