"""The Laplacian pyramid: the plain form, the way back, edges and odd sizes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric import laplacian

EDGES = ("circular", "reflected")
PAD = {"circular": "wrap", "reflected": "reflect"}


def on_grid(size, seed=0):
    return (np.random.default_rng(seed).integers(-(1 << 16), 1 << 16, size) / 65536).astype(np.float32)


def plain_reduce(x, edges):
    for axis in range(x.ndim):
        n = x.shape[axis]
        padded = np.pad(x, [(2, 2) if a == axis else (0, 0) for a in range(x.ndim)], mode=PAD[edges])
        taps = [w * np.take(padded, range(k, k + n), axis) for k, w in enumerate((1, 4, 6, 4, 1))]
        x = np.take(sum(taps) / 16.0, range(0, n, 2), axis)
    return x


def plain_expand(x, size, edges):
    """Zeros between samples, smoothed; even sizes where circular."""
    for axis, n in enumerate(size):
        spread = np.zeros([*x.shape[:axis], n, *x.shape[axis + 1 :]])
        spread[(slice(None),) * axis + (slice(0, n, 2),)] = x
        padded = np.pad(spread, [(2, 2) if a == axis else (0, 0) for a in range(x.ndim)], mode=PAD[edges])
        x = sum(w * np.take(padded, range(k, k + n), axis) for k, w in enumerate((1, 4, 6, 4, 1))) / 8.0
    return x


@pytest.mark.parametrize("edges", EDGES)
@pytest.mark.parametrize("size", [(16,), (6, 10), (8, 4, 6), (31,), (7, 12), (9, 5, 6)])
def test_as_the_plain_form(size, edges):
    x = on_grid(size)
    small = plain_reduce(x.astype(np.float64), edges)
    assert np.abs(laplacian.reduce(x, x.ndim, edges) - small).max() < 1e-5
    if edges == "reflected" or all(n % 2 == 0 for n in size):
        grown = laplacian.expand(small.astype(np.float32), size, edges)
        assert np.abs(grown - plain_expand(small, size, edges)).max() < 1e-5


@settings(deadline=None, max_examples=100)
@given(st.lists(st.integers(1, 40), min_size=1, max_size=3), st.sampled_from(EDGES), st.integers(0, 6))
def test_the_way_back_is_exact(size, edges, levels):
    x = on_grid(size)
    pyramid = laplacian.build(x, min(levels, laplacian.most_levels(size)), x.ndim, edges)
    assert np.array_equal(laplacian.collapse(pyramid, x.ndim, edges), x)


@pytest.mark.parametrize("edges", EDGES)
def test_any_values_come_back_but_for_rounding(edges):
    x = (1000.0 * np.random.default_rng(1).standard_normal((45, 70))).astype(np.float32)
    assert np.abs(laplacian.collapse(laplacian.build(x, 3, 2, edges), 2, edges) - x).max() < 1e-3


@pytest.mark.parametrize("edges", EDGES)
@pytest.mark.parametrize("size", [(1,), (2, 3), (33, 20), (1, 50), (5, 6, 7)])
def test_flat_pictures_have_no_bands(size, edges):
    x = np.full(size, 0.375, np.float32)
    assert (laplacian.expand(laplacian.reduce(x, x.ndim, edges), size, edges) == x).all()


def test_leading_axes_are_a_batch():
    x = on_grid((2, 3, 20, 17))
    whole = laplacian.build(x, 2)
    for k in range(2):
        for i, band in enumerate(laplacian.build(x[k, 1], 2)):
            assert np.array_equal(whole[i][k, 1], band)


def test_circular_pyramids_move_with_the_picture():
    x = on_grid((32, 48))
    moved = laplacian.build(np.roll(x, (4, -8), (0, 1)), 2)
    for level, band in enumerate(laplacian.build(x, 2)):
        assert np.array_equal(np.roll(band, (4 >> level, -8 >> level), (0, 1)), moved[level])


def test_reflected_pyramids_keep_their_distance_from_the_other_end():
    x = np.zeros((64, 64), np.float32)
    x[:, 60:] = 1.0
    for name, limit in (("reflected", 1e-6), ("circular", 1e9)):
        bands = laplacian.build(x, 2, 2, name)
        assert np.abs(bands[0][:, :8]).max() < limit
        assert (np.abs(bands[0][:, :8]).max() > 0.1) == (name == "circular")


def test_too_many_levels_are_refused():
    with pytest.raises(ValueError, match="found 3 levels for 16 x 20"):
        laplacian.build(on_grid((16, 20)), 3)
