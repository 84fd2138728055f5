"""Area means against two independent ways to get them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from skimage.transform import resize_local_mean

from engine.numeric.shrink import box_reduce, fitted_size


@settings(deadline=None, max_examples=40)
@given(st.integers(1, 23), st.integers(1, 23), st.data())
def test_equals_the_mean_of_a_finely_repeated_picture(w, h, data):
    """Repeat each pixel `width` x `height` times: then every target rectangle holds whole pixels."""
    width, height = data.draw(st.integers(1, w)), data.draw(st.integers(1, h))
    planes = np.random.default_rng(w * 31 + h).random((4, h, w), dtype=np.float32)
    fine = planes.astype(np.float64).repeat(height, axis=1).repeat(width, axis=2)
    expected = fine.reshape(4, height, h, width, w).mean(axis=(2, 4))
    assert np.abs(box_reduce(planes, width, height) - expected).max() < 1e-6


def test_agrees_with_skimage():
    planes = np.random.default_rng(0).random((4, 217, 301), dtype=np.float32)
    expected = resize_local_mean(planes.astype(np.float64), (93, 128), channel_axis=0)
    assert np.abs(box_reduce(planes, 128, 93) - expected).max() < 1e-6


def test_keeps_mean_order_and_displayability():
    planes = np.random.default_rng(1).random((4, 100, 130), dtype=np.float32)
    planes[:3] *= planes[3]
    small = box_reduce(planes, 37, 41)
    assert small.dtype == np.float32
    assert small.mean(axis=(1, 2)) == pytest.approx(planes.mean(axis=(1, 2)), abs=1e-6)
    assert (small[:3] <= small[3]).all()
    assert np.array_equal(box_reduce(np.ones_like(planes), 37, 41), np.ones((4, 41, 37)))
    assert np.array_equal(box_reduce(planes, 130, 100), planes)


def test_fitted_sizes():
    assert fitted_size(1920, 1080, 256) == (256, 144)
    assert fitted_size(100, 50, 256) == (100, 50)
    assert fitted_size(10, 100000, 256) == (1, 256)
    assert fitted_size(300, 300, 256) == (256, 256)


@pytest.mark.parametrize(("width", "height"), [(0, 5), (5, 0), (11, 5), (5, 11)])
def test_enlarging_is_refused(width, height):
    with pytest.raises(ValueError, match="expected 1x1 to 10x10"):
        box_reduce(np.zeros((4, 10, 10), np.float32), width, height)
