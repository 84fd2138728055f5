"""Sums in an order of our own: right, and the same bits as ever."""

import hashlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric import sums
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.array_functions import array_functions

AXES = (None, 0, -1, (1, 2), (-2, -1), (0, 2), (0, 1, 2))


def drawn(*shape):
    """Numbers made of whole ones, the same everywhere."""
    n = np.arange(np.prod(shape), dtype=np.float64).reshape(shape)
    return (n * 7919.0) % 1009.0 / 509.0 - 1.0


@settings(max_examples=60, deadline=None)
@given(st.tuples(*[st.integers(1, 20)] * 3), st.sampled_from(AXES), st.booleans(), st.sampled_from("fd"))
def test_they_are_those_of_numpy(shape, axis, kept, wide):
    values = drawn(*shape).astype(wide)
    one, other = array_functions(LIBRARY), array_functions(EVERYWHERE)
    for name in ("total", "mean"):
        right, found = (getattr(own, name)(values, axis=axis, keepdims=kept) for own in (one, other))
        assert found.shape == right.shape
        assert found.dtype == right.dtype
        assert np.allclose(found, right, rtol=1e-5, atol=1e-4)
        assert getattr(other, name)(values, axis=axis, dtype=np.float64).dtype == np.float64


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9, 1000])
def test_a_row_is_summed_in_eight_parts(count):
    values = drawn(count)
    parts = [sum(values[k::8].tolist()) for k in range(8)]
    a, b, c, d, e, f, g, h = parts
    assert float(sums.total(values)) == ((a + e) + (c + g)) + ((b + f) + (d + h))


def test_they_do_not_hang_on_how_an_array_lies():
    values = drawn(5, 33, 47)
    assert sums.total(np.asfortranarray(values), (1, 2)).tobytes() == sums.total(values, (1, 2)).tobytes()
    assert sums.mean(values[:, ::-1][:, ::-1], 1).tobytes() == sums.mean(values, 1).tobytes()


def test_they_give_the_same_bits_as_ever():
    """Found with AVX-512 and FMA, and without AVX and FMA."""
    digest = hashlib.sha256()
    for axis in AXES:
        digest.update(sums.total(drawn(3, 31, 45).astype(np.float32), axis).tobytes())
        digest.update(sums.mean(drawn(3, 31, 45) / 3.0, axis).tobytes())
    assert digest.hexdigest()[:24] == "5d9ec9523b1925af49d653fe"
