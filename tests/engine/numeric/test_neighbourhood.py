"""How far neighbourhoods are apart, beside the plain sum."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numba import njit

from engine.numeric.neighbourhood import (
    RADIUS,
    ROW,
    SIDE,
    middle_apart,
    middle_apart_within,
    others_apart,
    others_apart_within,
    weights,
)

WIDE, HIGH = 12, 9


@njit
def apart(a, i, b, j, weighed):
    row = 4 * WIDE
    return middle_apart(a, i, row, b, j, row, weighed, 0), others_apart(a, i, row, b, j, row, weighed, 0)


@njit
def apart_within(a, i, b, j, weighed, care):
    row = 4 * WIDE
    return (
        middle_apart_within(a, i, row, b, j, row, weighed, 0, care),
        others_apart_within(a, i, row, b, j, row, weighed, 0, care),
    )


def plain(one, other, weighed):
    """Of the rows in the middle, and of the others: arrays (SIDE, SIDE, 4)."""
    rows = (weighed.reshape(SIDE, ROW // 4, 4)[:, :SIDE] * (one - other) ** 2).sum((1, 2))
    near = abs(np.arange(SIDE) - RADIUS) <= 1
    return rows[near].sum(), rows[~near].sum()


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 99), side=st.sampled_from([3, 5, 7]), place=st.tuples(*[st.integers(0, 2)] * 4))
def test_rows_add_up_to_the_whole_neighbourhood(seed, side, place):
    random = np.random.default_rng(seed)
    a, b = random.integers(0, 256, (2, HIGH + 1, WIDE, 4)).astype(np.int16)
    inside = random.integers(0, 2, (HIGH + 1, WIDE, 1))
    care = np.repeat(-inside, 4, 2).astype(np.int16)
    y, x, row, column = place
    i, j = 4 * (y * WIDE + x), 4 * (row * WIDE + column)
    one = a[y : y + SIDE, x : x + SIDE].astype(int)
    other = b[row : row + SIDE, column : column + SIDE].astype(int)
    within = inside[y : y + SIDE, x : x + SIDE]
    assert apart(a.ravel(), i, b.ravel(), j, weights(side)) == plain(one, other, weights(side))
    masked = (a * inside).astype(np.int16)
    found = apart_within(masked.ravel(), i, b.ravel(), j, weights(side), care.ravel())
    assert found == plain(one * within, other * within, weights(side))
