"""Products of matrices with many columns, lags and small systems: against NumPy's, and the same bits as ever."""

import hashlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.lags import apply_filter, lags_of, shortened
from engine.numeric.matrices import combinations, products
from engine.numeric.real_fourier import irfft2, rfft2
from engine.numeric.solving import nearest_rotation, solved


def drawn(*shape):
    """Numbers made of whole ones, the same everywhere."""
    n = np.arange(np.prod(shape), dtype=np.int64).reshape(shape)
    return ((n * 7919) % 1009 / 512 - 1.0).astype(np.float32)


def near(found, right, by=1e-5):
    return np.abs(found - right).max(initial=0.0) <= by * max(np.abs(right).max(initial=0.0), 1e-6)


@settings(deadline=None, max_examples=60)
@given(st.integers(1, 9), st.integers(1, 9), st.integers(1, 2100))
def test_products_and_combinations_are_as_numpy_has_them(a, b, n):
    x, y, factors = drawn(a, n), drawn(b, n)[:, ::-1].copy(), drawn(a, b)
    assert near(products(x, y), x.astype(np.float64) @ y.T)
    assert near(products(x, x), x.astype(np.float64) @ x.T)
    right = factors.astype(np.float64) @ y
    assert near(combinations(factors, y), right)
    assert near(combinations(factors, y, x.copy()), right + x)


def test_products_have_the_same_bits_everywhere():
    told = products(drawn(5, 3001), drawn(6, 3001)).tobytes() + combinations(drawn(6, 5), drawn(5, 3001)).tobytes()
    assert hashlib.sha256(told).hexdigest()[:16] == "fafe0ae743e54b63"


@settings(deadline=None, max_examples=30)
@given(st.integers(1, 12), st.integers(0, 99))
def test_systems_and_rotations(n, seed):
    random = np.random.default_rng(seed)
    a, b = random.standard_normal((3, n, n)), random.standard_normal((3, n, 2))
    assert near(np.matmul(a, solved(a, b)), b, 1e-6)
    left, _, right = np.linalg.svd(a[0])
    assert near(nearest_rotation(a[0]), left @ right, 1e-6)


def test_what_has_no_rotation_has_none():
    assert not nearest_rotation(np.zeros((3, 3))).any()


@pytest.mark.parametrize("size", [(24, 32), (17, 23), (9, 40)])
def test_lags_are_the_means_of_products_with_moved_pictures(size):
    pictures = drawn(2, *size)
    found = lags_of(rfft2(pictures), size[1], 3)
    for dy, dx in ((0, 0), (1, -3), (-2, 1), (3, 3)):
        right = (pictures * np.roll(pictures, (-dy, -dx), (1, 2))).mean(axis=(1, 2))
        assert near(found[:, 3 + dy, 3 + dx], right)


def test_a_filter_gives_the_lags_wanted():
    rough = np.random.default_rng(1).standard_normal((2, 48, 64)).astype(np.float32)
    smooth = rough + 0.6 * np.roll(rough, 1, 2) + 0.3 * np.roll(rough, (1, 1), (1, 2))
    want, half = lags_of(rfft2(smooth), 64, 2), rfft2(rough)
    for _ in range(6):
        apply_filter(half, 64, lags_of(half, 64, 4), want)
    assert near(lags_of(half, 64, 2), want, 0.05)
    assert near(irfft2(half, (48, 64)).mean(), rough.mean(), 9.0)


def test_lags_are_shortened_around_their_middle():
    lags = drawn(1, 7, 7)
    assert (shortened(lags, 1) == lags[:, 2:5, 2:5]).all()
    assert (shortened(lags, 3) == lags).all()
