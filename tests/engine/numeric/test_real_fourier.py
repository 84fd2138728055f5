"""Fourier transforms of real pictures: against NumPy's, for lengths of every kind, and the same bits as ever."""

import hashlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.real_fourier import fast_length, irfft2, rfft2

SIZES = ((1, 1), (2, 3), (5, 4), (16, 31), (33, 32), (37, 1), (7, 61), (64, 67), (134, 12), (90, 98), (3, 509))


def drawn(*shape):
    """Numbers made of whole ones, the same everywhere."""
    n = np.arange(np.prod(shape), dtype=np.int64).reshape(shape)
    return ((n * 7919) % 1009 / 512 - 1.0).astype(np.float32)


def near(found, right):
    return np.abs(found - right).max() <= 1e-6 * max(np.abs(right).max(), 1e-6)


@pytest.mark.parametrize("size", SIZES)
def test_any_length_is_as_numpy_has_it(size):
    pictures, half = drawn(3, *size), drawn(3, size[0], size[1] // 2 + 1, 2).view(np.complex64)[..., 0]
    assert near(rfft2(pictures), np.fft.rfft2(pictures.astype(np.float64)))
    kept = half.copy()
    assert near(irfft2(half, size), np.fft.irfft2(half.astype(np.complex128), s=size))
    assert (half == kept).all()
    irfft2(half, size, True)


@settings(deadline=None, max_examples=60)
@given(st.integers(1, 5), st.integers(1, 70), st.integers(1, 70))
def test_there_and_back_again(count, height, width):
    pictures = drawn(count, height, width)
    assert np.abs(irfft2(rfft2(pictures), (height, width)) - pictures).max() < 2e-6


@settings(deadline=None, max_examples=30)
@given(st.integers(1, 40), st.integers(1, 40), st.integers(1, 40))
def test_a_picture_does_not_hang_on_those_beside_it(count, height, width):
    pictures = drawn(count, height, width)
    half = rfft2(pictures)
    assert all((rfft2(one) == other).all() for one, other in zip(pictures[:3], half[:3], strict=True))
    whole = irfft2(half, (height, width))
    assert all((irfft2(one, (height, width)) == other).all() for one, other in zip(half[:3], whole[:3], strict=True))


def test_fast_lengths_are_those_of_scipy():
    from scipy.fft import next_fast_len

    assert [fast_length(n) for n in range(1, 1100)] == [next_fast_len(n, real=True) for n in range(1, 1100)]


def test_they_give_the_same_bits_as_ever():
    """Found with AVX-512 and FMA, and without AVX and FMA."""
    digest = hashlib.sha256()
    for size in SIZES:
        half = rfft2(drawn(2, *size))
        digest.update(half.tobytes())
        digest.update(irfft2(half, size).tobytes())
    assert digest.hexdigest()[:24] == "a9e6df1f136b4892e58c5b71"
