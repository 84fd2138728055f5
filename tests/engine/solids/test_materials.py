"""Procedural solids: seamless, by seed and place alone, of bounded colours, and still detailed in close-up."""

import hashlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.solids.material_sliders import MATERIALS
from engine.solids.materials import COLOURS, Seen
from engine.solids.solid_lookup import Cubed, Procedural
from engine.solids.solid_noise import Octaves, noise_at

PLACES = np.random.default_rng(5).random((400, 3))


@pytest.mark.parametrize("name", MATERIALS)
def test_a_material_repeats_after_a_unit_without_a_seam(name):
    row = MATERIALS[name]
    given = row.values({})
    for axis in range(3):
        edge = PLACES.copy()
        edge[:, axis] = 0.0
        near, far = edge.copy(), edge.copy()
        near[:, axis] += 1e-9
        far[:, axis] += 1.0 - 1e-9
        finest = 1e-2
        here = COLOURS[name](Seen(near, 3, finest), given)
        assert np.abs(COLOURS[name](Seen(far, 3, finest), given) - here).max() < 1e-3
        # A step in the middle of the solid is as small: what is tested above is no accident.
        assert np.abs(COLOURS[name](Seen(edge + 0.5, 3, finest), given) - here).max() > 0.05


@pytest.mark.parametrize("name", MATERIALS)
def test_every_slider_changes_the_solid_and_keeps_colours(name):
    row = MATERIALS[name]
    usual = COLOURS[name](Seen(PLACES, 1, 1e-3), row.values({}))
    assert usual.std(axis=0).max() > 0.03
    for slider, bounds in row.sliders.items():
        for value in (bounds.low, bounds.high):
            colours = COLOURS[name](Seen(PLACES, 1, 1e-3), row.values({slider: value}))
            assert colours.min() >= -1e-9
            assert colours.max() <= 1.0 + 1e-9
            assert value == bounds.usual or np.abs(colours - usual).max() > 0.02


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 399), st.integers(1, 200), st.integers(-(2**60), 2**60))
def test_a_place_has_one_colour_whatever_is_asked_with_it(first, count, seed):
    solid = Procedural("granite", seed)
    whole = solid.colours(PLACES, 1e-2)
    assert np.array_equal(solid.colours(PLACES[first : first + count], 1e-2), whole[first : first + count])


def test_the_bits_are_those_that_they_were():
    """What is cut from a solid becomes paint: every machine has the same."""
    digest = hashlib.sha256(noise_at(PLACES, Octaves((3, 5, 2)), 7, 1e-3).tobytes())
    for name, row in MATERIALS.items():
        digest.update(name.encode() + COLOURS[name](Seen(PLACES, 2, 1e-3), row.values({})).tobytes())
    assert digest.hexdigest() == "c6b3dcc4e92995a3991c977296b96d7b2b47fe5307c58d4711400dc86ee0756a"


def test_finer_octaves_go_on_in_close_up():
    """Beyond a voxel's size, too, where a cube is but smooth; and no more than its own finest detail is strong."""
    line = np.linspace(0.4, 0.4 + 1.0 / 32.0, 256)
    close = np.stack([line, line, line], axis=-1)
    rough = np.random.default_rng(1).random((32, 32, 32, 3)).astype(np.float32)
    flat = np.full((8, 8, 8, 3), 0.5, np.float32)
    smooth = Cubed(rough).colours(close, 1.0)
    fine = Cubed(rough).colours(close, 1e-5)
    assert np.abs(np.diff(fine, 2, axis=0)).mean() > 5.0 * np.abs(np.diff(smooth, 2, axis=0)).mean()
    assert 0.02 < np.abs(fine - smooth).mean() < 0.3
    assert np.abs(Cubed(flat).colours(close, 1e-5) - 0.5).max() < 1e-6


def test_a_cube_is_looked_up_at_its_voxels_and_repeats():
    ramp = np.zeros((4, 6, 8, 3), np.float32)
    ramp[..., 0] = np.arange(8) / 8.0
    ramp[..., 1] = (np.arange(6) / 6.0)[:, None]
    ramp[..., 2] = (np.arange(4) / 4.0)[:, None, None]
    found = Cubed(ramp).colours(np.array([[3.5 / 8, 2.5 / 6, 1.5 / 4], [1 + 3.5 / 8, 2.5 / 6 - 1, 2 + 1.5 / 4]]), 1.0)
    assert found == pytest.approx(np.array([[3 / 8, 2 / 6, 1 / 4]] * 2), abs=1e-6)
