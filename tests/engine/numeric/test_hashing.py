"""Hashes by place: the compiled form against plain Python, and that they look random wherever one stands."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.hashing import MASK32, MASK64, fold_key, hash_plane, mixed

ORIGINS = [(0, 0), (-64, -64), (1 << 32, -(1 << 40)), (-(1 << 80) - 13, (1 << 80) + 5), (3**150, -(7**90))]


def plain(key: int, x: int, y: int) -> int:
    return mixed(((y & MASK32) << 32 | (x & MASK32)) ^ fold_key(key, x >> 32, y >> 32))


def unit(key: int, origin: tuple[int, int], size: int = 256) -> np.ndarray:
    """Zero mean, unit variance."""
    h = hash_plane(key, *origin, size, size)
    return ((h >> np.uint64(40)).astype(np.float64) / 2**24 - 0.5) * np.sqrt(12)


def test_the_finaliser_is_splitmix64():
    """The published generator from seed 1234567: the finaliser of multiples of the golden gamma."""
    expected = [6457827717110365317, 3203168211198807973, 9817491932198370423, 4593380528125082431]
    assert [mixed((1234567 + (i + 1) * 0x9E3779B97F4A7C15) & MASK64) for i in range(4)] == expected


@settings(deadline=None, max_examples=30)
@given(
    st.integers(0, MASK64),
    st.integers(-(2**90), 2**90),
    st.integers(-(2**90), 2**90),
    st.integers(1, 9),
    st.integers(1, 9),
)
def test_compiled_equals_plain(key, x, y, width, height):
    found = hash_plane(key, x, y, width, height)
    assert found.tolist() == [[plain(key, x + i, y + j) for i in range(width)] for j in range(height)]


@pytest.mark.parametrize("edge", [0, 1 << 32, -(1 << 32), 5 << 70])
def test_a_plane_that_straddles_a_key_boundary(edge):
    found = hash_plane(9, edge - 3, edge - 2, 6, 5)
    assert found.tolist() == [[plain(9, edge - 3 + i, edge - 2 + j) for i in range(6)] for j in range(5)]


@settings(deadline=None, max_examples=100)
@given(st.lists(st.integers(-(2**130), 2**130), max_size=4), st.lists(st.integers(-(2**130), 2**130), max_size=4))
def test_different_lists_have_different_keys(a, b):
    assert (fold_key(*a) == fold_key(*b)) == (a == b)
    assert 0 <= fold_key(*a) <= MASK64


def test_near_lists_have_different_keys():
    near = [(), (0,), (0, 0), (-1,), (1,), (1 << 64,), (0, 1), (1, 0), (MASK64,), (-(1 << 64),), (1 << 128,)]
    assert len({fold_key(*numbers) for numbers in near}) == len(near)


@pytest.mark.parametrize("origin", ORIGINS)
def test_white_at_any_origin(origin):
    """Bounds at about 5 standard deviations: rows, columns, neighbours, the strongest wave."""
    noise = unit(77, origin)
    n = noise.shape[0]
    assert abs(noise.mean()) * n < 5
    assert np.abs(noise.mean(0)).max() * np.sqrt(n) < 5
    assert np.abs(noise.mean(1)).max() * np.sqrt(n) < 5
    for dy in range(4):
        for dx in range(-3, 4):
            if (dx, dy) != (0, 0):
                assert abs((noise * np.roll(noise, (dy, dx), (0, 1))).mean()) * n < 5
    power = np.abs(np.fft.rfft2(noise)) ** 2 / n**2
    assert power[0:, 1:].max() < 20  # exponential tail: e^-20 * 32768 pixels


@pytest.mark.parametrize("bit", [0, 7, 31, 32, 63])
def test_every_bit_is_even_and_flips_with_each_coordinate_bit(bit):
    h = hash_plane(3, 1 << 20, -(1 << 20), 256, 256)
    ones = (h >> np.uint64(bit)) & np.uint64(1)
    assert abs(ones.mean() - 0.5) * 2 * 256 < 5
    for near in (np.roll(ones, 1, 0), np.roll(ones, 2, 1)):
        assert abs((ones ^ near).mean() - 0.5) * 2 * 256 < 5


def test_keys_give_unrelated_planes():
    planes = [unit(fold_key(seed, level), (5, 5)) for seed in (1, 2) for level in (0, 1, 60, 200)]
    for i, a in enumerate(planes):
        for b in planes[:i]:
            assert abs((a * b).mean()) * 256 < 5
