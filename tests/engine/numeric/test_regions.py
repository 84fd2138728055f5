"""Colours, their regions and false colours, against plain counting and a second opinion."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from skimage.measure import label

from engine.numeric.regions import colour_count, false_colours, packed, region_count


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(1, 40), st.integers(1, 6))
@settings(deadline=None, max_examples=60)
def test_regions_are_those_of_a_second_opinion(seed, height, width, colours):
    values = np.random.default_rng(seed).integers(0, colours, (height, width)).astype(np.uint32)
    assert region_count(values) == label(values, background=-1, connectivity=1).max()
    assert colour_count(values) == len(set(values.ravel().tolist()))


def test_a_spiral_is_one_region():
    values = np.zeros((9, 9), np.uint32)
    y = x = 0
    dy, dx = 0, 1
    for run in (9, 8, 8, 6, 6, 4, 4, 2, 2):
        for _ in range(run - (run == 9)):
            values[y, x] = 1
            y, x = y + dy, x + dx
        values[y, x] = 1
        dy, dx = dx, -dy
    assert region_count(values) == label(values, background=-1, connectivity=1).max()


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_transparent_pixels_are_one_colour(dtype):
    pixels = np.random.default_rng(0).integers(0, 200, (8, 8, 4)).astype(dtype)
    pixels[..., 3] = 0
    assert colour_count(packed(pixels)) == region_count(packed(pixels)) == 1
    assert not false_colours(packed(pixels)).any()


def test_opaque_colours_get_different_false_ones():
    colours = np.arange(1 << 24, dtype=np.uint32).reshape(4096, 4096) << np.uint32(8) | np.uint32(255)
    shown = packed(false_colours(colours))
    seen = np.zeros(1 << 24, bool)
    seen[shown >> np.uint32(8)] = True
    assert seen.all()


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_false_colours_are_incoherent(dtype):
    """A smooth ramp comes out as unlike neighbours, and equal colours equal."""
    ramp = np.arange(200, dtype=dtype)
    pixels = np.broadcast_to(ramp[None, :, None], (3, 200, 4)).copy()
    pixels[..., 3] = np.iinfo(dtype).max
    shown = false_colours(packed(pixels)).astype(int)
    assert (shown[0] == shown[1]).all()
    assert np.abs(np.diff(shown[0, :, :3], axis=0)).mean() > 50
    assert (shown[..., 3] == 255).all()
    assert len(np.unique(shown[0], axis=0)) == 200


def test_other_arrays_are_refused():
    with pytest.raises(ValueError, match="colours"):
        packed(np.zeros((4, 4, 3), np.uint8))
