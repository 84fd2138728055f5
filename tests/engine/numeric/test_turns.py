"""Parts of a full turn: the doubles that are nearest, with the symmetry of the circle."""

import math
from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from engine.numeric.turns import turned

WHOLES = st.integers(1, 512)


@given(st.integers(-1000, 1000), WHOLES)
def test_it_is_the_cosine_and_the_sine(part, whole):
    x, y = turned(part, whole)
    angle = 2 * math.pi * (part % whole) / whole
    assert math.isclose(x, math.cos(angle), abs_tol=2e-15)
    assert math.isclose(y, math.sin(angle), abs_tol=2e-15)
    assert abs(Fraction(x) ** 2 + Fraction(y) ** 2 - 1) < Fraction(1, 1 << 51)


@given(st.integers(-1000, 1000), WHOLES)
def test_quarters_and_opposites_are_exact(part, whole):
    x, y = turned(part, whole)
    assert turned(part + whole, whole) == (x, y)
    assert turned(4 * part + whole, 4 * whole) == (-y + 0.0, x)
    assert turned(-part, whole) == (x, -y + 0.0)
    assert turned(3 * part, 3 * whole) == (x, y)
    assert [turned(k, 4) for k in range(4)] == [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
