"""Smooth curves through knots: they go through them, rise where these rise, and pass no knot by."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from engine.brush.tints import tone_table
from engine.numeric.curves import smooth_curve

knots = st.lists(
    st.tuples(st.integers(0, 64), st.integers(0, 32)), min_size=1, max_size=9, unique_by=lambda knot: knot[0]
).map(lambda found: tuple(sorted((x / 64, y / 32) for x, y in found)))


@given(knots)
def test_it_goes_through_its_knots_and_between_two_never_beyond_them(held):
    x, y = np.array(held).T
    np.testing.assert_allclose(smooth_curve(held, x), y, atol=1e-12)
    for a, b, low, high in zip(x, x[1:], y, y[1:], strict=False):
        found = smooth_curve(held, np.linspace(a, b, 40))
        assert found.min() >= min(low, high) - 1e-12
        assert found.max() <= max(low, high) + 1e-12
        assert (np.diff(found) * np.sign(high - low) >= -1e-12).all()
    assert (smooth_curve(held, np.array([-1.0, 2.0])) == (y[0], y[-1])).all()


@given(knots)
def test_it_is_smooth_but_at_its_ends(held):
    x = np.array(held)[1:-1, 0]
    near = 1e-9
    left, right = (
        (smooth_curve(held, x) - smooth_curve(held, x - near)) / near,
        (smooth_curve(held, x + near) - smooth_curve(held, x)) / near,
    )
    np.testing.assert_allclose(left, right, rtol=1e-3, atol=1e-3)


def test_two_knots_are_a_straight_line_to_the_bit():
    assert (tone_table(((0.0, 0.0), (1.0, 1.0))) == np.arange(1025) / 1024).all()


def test_a_tones_table_is_not_to_be_written_to():
    with pytest.raises(ValueError, match="read-only"):
        tone_table(((0.0, 0.5),))[0] = 1
