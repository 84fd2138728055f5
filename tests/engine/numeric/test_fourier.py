"""Fourier transforms of our own: against NumPy's, for lengths of every kind, and the same bits as ever."""

import hashlib

import numpy as np
import pytest

from engine.numeric import fourier
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.array_functions import array_functions

LENGTHS = (1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 49, 61, 64, 67, 97, 122, 128, 134, 255, 509, 512, 1000)


def drawn(*shape):
    """Numbers made of whole ones, the same everywhere."""
    n = np.arange(np.prod(shape), dtype=np.float64).reshape(shape)
    return (n * 7919.0) % 1009.0 / 512.0 - 1.0


@pytest.mark.parametrize("n", LENGTHS)
def test_any_length_is_as_numpy_has_it(n):
    values = drawn(3, n) + 1j * drawn(3, n)[::-1]
    found, right = fourier._along(values, -1), np.fft.fft(values)
    assert np.abs(found - right).max() <= 4e-15 * np.abs(right).max()


def test_there_and_back_again():
    for shape in ((3, 48, 67), (1, 1, 5), (2, 30, 30)):
        values = drawn(*shape).astype(np.float32)
        assert np.allclose(fourier.fft2(values), np.fft.fft2(values.astype(np.float64)), rtol=0, atol=1e-11)
        assert np.allclose(fourier.ifft2(fourier.fft2(values)), values, rtol=0, atol=1e-14)


def test_functions_of_arrays_are_nearly_the_same_in_both_arithmetics():
    one, other = array_functions(LIBRARY), array_functions(EVERYWHERE)
    x, y = np.abs(drawn(9, 40)) + 0.1, drawn(9, 40)
    z, w = x + 1j * y, np.exp(1j * y)
    for name in ("exp", "expm1", "log", "log1p", "log2", "sin", "cos"):
        assert np.allclose(getattr(one, name)(x), getattr(other, name)(x), rtol=1e-14)
    for name in ("size", "angle", "fft2", "ifft2"):
        assert np.allclose(getattr(one, name)(z), getattr(other, name)(z), rtol=0, atol=1e-12)
    assert np.allclose(one.powers(x, 1.3), other.powers(x, 1.3), rtol=1e-14)
    assert np.allclose(one.arctan2(y, x), other.arctan2(y, x), rtol=1e-14)
    assert np.allclose(one.distance(y, x), other.distance(y, x), rtol=1e-14)
    for wide in (np.float32, np.float64):
        assert np.allclose(one.waves(y.astype(wide)), other.waves(y.astype(wide)), rtol=0, atol=1e-7)
        assert (
            one.distance(y.astype(wide), x.astype(wide)).dtype == other.distance(y.astype(wide), x.astype(wide)).dtype
        )
    assert np.allclose(one.turned(z, w), other.turned(z, w), rtol=0, atol=1e-14)
    assert np.allclose(one.turned(x, w), other.turned(x, w), rtol=0, atol=1e-14)


def test_they_give_the_same_bits_as_ever():
    """Found with AVX-512 and FMA, and without AVX and FMA."""
    digest, own = hashlib.sha256(), array_functions(EVERYWHERE)
    for n in LENGTHS:
        digest.update(fourier.fft2(drawn(2, n, 12)).tobytes())
    z = drawn(30, 40) + 1j * drawn(30, 40)[::-1]
    for found in (own.size(z), own.angle(z), own.waves(z.real), own.turned(z, own.waves(z.imag)), own.ifft2(z)):
        digest.update(found.tobytes())
    assert digest.hexdigest()[:24] == "2aa77b0a8e3cbd5e8eaecf45"
