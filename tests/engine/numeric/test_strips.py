"""Sums of copies in strips are those of copies laid row by row, bit for bit."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.strips import in_strips, lay_strips

SIDES = st.integers(1, 40)


@settings(deadline=None, max_examples=60)
@given(st.integers(1, 3), SIDES, SIDES, st.integers(1, 300), st.integers(1, 300), st.integers(0, 2**32 - 1))
def test_against_rows(channels, high, wide, height, width, seed):
    random = np.random.default_rng(seed)
    copied = random.standard_normal((channels, high, wide)).astype(np.float32)
    copied[:, : high // 3] = 0.0
    count, tall, first = 30, 17, -2 * high
    bands = -(-(height + 4 * high) // tall)
    band = np.sort(random.integers(0, bands, count))
    rows = first + band * tall + random.integers(0, tall, count)
    places = np.stack([rows, random.integers(-2 * wide, width + wide, count)], 1)
    weights = random.standard_normal(count).astype(np.float32)
    plain = np.zeros((channels, height + 6 * high + 2 * tall, width + 4 * wide), np.float32)
    for (y, x), weight in zip(places, weights, strict=True):
        part = plain[:, y + 2 * high : y + 3 * high, x + 2 * wide : x + 3 * wide]
        part += weight * copied
    out = np.full((channels, height, width), np.nan, np.float32)
    strips, filled = in_strips(copied)
    starts = np.searchsorted(band, np.arange(bands + 1))
    lay_strips(out, strips, filled, places, weights, (starts, first, tall))
    assert (out == plain[:, 2 * high : 2 * high + height, 2 * wide : 2 * wide + width]).all()


def test_large_pictures_are_not_laid_in_strips():
    assert in_strips(np.ones((1, 64, 64), np.float32))[0].size
    assert not in_strips(np.ones((1, 256, 256), np.float32))[0].size
    assert not in_strips(np.ones((3, 96, 96), np.float32))[0].size
    _, rows = in_strips(np.zeros((1, 5, 5), np.float32))
    assert (rows[:, 0] == rows[:, 1]).all()
