"""Shaping tables: named curves and knots, and the kernel that sends values through them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.curves import CURVES, EDGES
from engine.numeric.shaping import is_identity, shape, shape_signed, table

T = np.linspace(0, 1, 1025)
KNOTS = st.lists(st.integers(0, 64), min_size=1, max_size=64, unique=True).flatmap(
    lambda xs: st.lists(st.floats(0, 1), min_size=len(xs), max_size=len(xs)).map(
        lambda ys: tuple((x / 64, y) for x, y in zip(sorted(xs), ys, strict=True))
    )
)


@pytest.mark.parametrize(("rows", "name"), [("shaping", n) for n in CURVES] + [("edge", n) for n in EDGES])
def test_every_row_is_a_table_of_0_to_1(rows, name):
    row = (CURVES if rows == "shaping" else EDGES)[name]
    assert row.name == name
    assert row.label
    assert row.tooltip
    values = table(name, rows)
    assert values.shape == (1025,)
    assert values.dtype == np.float32
    assert values.min() >= 0
    assert values.max() <= 1
    assert np.ptp(values) > 0.3


def test_the_curves_of_the_paper():
    np.testing.assert_array_equal(table("identity"), T.astype(np.float32))
    np.testing.assert_array_equal(table("negate"), (1 - T).astype(np.float32))
    assert np.ptp(table("compress")) == 0.5
    np.testing.assert_array_equal(table("rectify"), table("rectify")[::-1])
    assert not table("clip")[:513].any()
    np.testing.assert_allclose(table("power"), T * T, atol=1e-7)


@settings(deadline=None, max_examples=40)
@given(KNOTS, st.lists(st.floats(-2, 3, width=32), min_size=1, max_size=20))
def test_the_kernel_does_what_plain_interpolation_does(knots, values):
    curve = table(knots)
    t = np.array(values, np.float32)
    plain = np.interp(np.clip(t.astype(float), 0, 1), T, curve.astype(float))
    np.testing.assert_allclose(shape(t, curve), plain, atol=3e-4 * 1025)
    np.testing.assert_allclose(shape(t, curve), plain, atol=1e-4 + 2e-4 * np.abs(np.diff(curve)).max() * 1024)
    np.testing.assert_allclose(shape_signed(2 * t - 1, curve), 2 * shape(t, curve) - 1, atol=2e-3)


def test_knots_hold_beyond_their_ends_and_a_single_one_is_level():
    curve = table(((0.25, 0.5), (0.5, 1.0)))
    assert (curve[:257] == 0.5).all()
    assert (curve[512:] == 1).all()
    assert curve[384] == 0.75
    assert (table(((0.3, 0.2),)) == np.float32(0.2)).all()


def test_what_changes_nothing_is_known():
    assert is_identity(None)
    assert is_identity("identity")
    assert is_identity(((0.0, 0.0), (0.5, 0.5), (1.0, 1.0)))
    assert not is_identity("negate")
    assert not is_identity(((0.0, 0.0), (1.0, 0.99)))
