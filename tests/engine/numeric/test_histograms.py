"""Histogram matching: monotone, bounded, as near as its tables allow, safe on flat pictures."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from engine.numeric import histograms as h

FLOATS = st.floats(-1e6, 1e6, width=32)
SOME = arrays(np.float32, st.integers(1, 60), elements=FLOATS)
WAYS = {"tables": h.match, "ranks": h.match_by_rank}


def moved(way, values, ordered):
    out = values.copy()
    WAYS[way](out, ordered)
    return out


@settings(deadline=None, max_examples=150)
@given(SOME)
def test_sorting(values):
    assert np.array_equal(h.sorted_values(values), np.sort(values))


def test_sorting_any_shape_and_size():
    for shape in ((1,), (7, 5), (200, 333), (3, 4, 5)):
        values = np.random.default_rng(1).standard_normal(shape).astype(np.float32) ** 3
        assert np.array_equal(h.sorted_values(values), np.sort(values, axis=None))
    assert np.array_equal(h.sorted_values(np.zeros((4, 8), np.float32)[:, ::2]), np.zeros(16, np.float32))


@settings(deadline=None, max_examples=150)
@given(SOME, SOME, st.sampled_from(sorted(WAYS)))
@example(np.float32([0.0, 1.0]), np.float32([0.796875, 262145.66]), "ranks")  # rounding went beyond the range
def test_order_and_range_are_kept(values, example, way):
    ordered = np.sort(example)
    out = moved(way, values, ordered)
    assert np.isfinite(out).all()
    assert ordered[0] <= out.min()
    assert out.max() <= ordered[-1]
    order = np.argsort(values, kind="stable")
    assert (np.diff(out[order]) >= 0).all()
    same = np.diff(values[order]) == 0
    assert (np.diff(out[order])[same] == 0).all()


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("value", [0.0, -3.5, 1e30, 1e-40])
def test_flat_pictures_become_the_median(way, value):
    ordered = np.array([1.0, 2.0, 5.0], np.float32)
    assert (moved(way, np.full((4, 6), value, np.float32), ordered) == 2.0).all()
    flat = np.full(9, 0.25, np.float32)
    assert (moved(way, np.random.default_rng(1).random((5, 5), np.float32), flat) == 0.25).all()


def test_ranks_are_exact():
    rng = np.random.default_rng(2)
    values = rng.permutation(40000).astype(np.float32).reshape(200, 200)
    ordered = np.sort(rng.standard_normal(40000).astype(np.float32))
    out = moved("ranks", values, ordered)
    assert np.abs(out - ordered[values.astype(int)]).max() < 1e-6
    assert np.array_equal(moved("ranks", np.sort(values, axis=None), ordered[::-1][::-1]).shape, (40000,))


@pytest.mark.parametrize("make", ["laplace", "exponential", "standard_normal", "random"])
def test_tables_come_near_the_exact_form(make):
    rng = np.random.default_rng(3)
    values = rng.standard_normal((256, 256)).astype(np.float32)
    ordered = h.sorted_values(getattr(rng, make)(size=50000))
    by_tables, exact = moved("tables", values, ordered), moved("ranks", values, ordered)
    spread = ordered.std()
    assert h.distance(h.sorted_values(exact), ordered) < 1e-4 * spread
    assert h.distance(h.sorted_values(by_tables), ordered) < 4e-3 * spread
    assert np.abs(by_tables - exact).mean() < 4e-3 * spread


def test_as_plain_tables():
    """Both cumulative tables in NumPy."""
    rng = np.random.default_rng(4)
    values, ordered = rng.standard_normal(5000).astype(np.float32), np.sort(rng.random(3000, np.float32))
    edges = np.linspace(values.min(), values.max(), 257)
    counts, _ = np.histogram(values, edges)
    parts = np.concatenate([[0.0], np.cumsum(counts)]) / values.size
    places = (np.arange(3000) + 0.5) / 3000
    wanted = np.interp(parts, places, ordered)
    assert np.abs(moved("tables", values, ordered) - np.interp(values, edges, wanted)).max() < 2e-3


def test_rows_are_matched_each_by_itself():
    rng = np.random.default_rng(5)
    rows, ordered = (
        rng.random((4, 30, 20), np.float32) * np.arange(4, dtype=np.float32)[:, None, None],
        h.sorted_values(rng.random(99)),
    )
    out = rows.copy()
    h.match_rows(out, ordered)
    for row, found in zip(rows, out, strict=True):
        assert np.array_equal(moved("tables", row, ordered), found)


def test_what_cannot_be_written_into_is_refused():
    for values in (np.zeros((4, 4), np.float32).T[::2], np.zeros(4)):
        with pytest.raises(ValueError, match="expected C-contiguous float32"):
            h.match(values, np.zeros(3, np.float32))


@settings(deadline=None, max_examples=60)
@given(SOME, SOME)
def test_distance_is_a_distance(a, b):
    a, b = np.sort(a), np.sort(b)
    assert h.distance(a, a) == 0.0
    assert h.distance(a, b) == h.distance(b, a)
    shifted = h.distance(a.astype(np.float64), a.astype(np.float64) + 3.0)
    assert shifted == pytest.approx(3.0, rel=1e-6)


@settings(deadline=None, max_examples=60)
@given(SOME, SOME)
def test_blends_go_straight_from_one_to_the_other(a, b):
    a, b = np.sort(a), np.sort(b)
    count = max(a.size, b.size)
    first, last = h.quantiles(a, count), h.quantiles(b, count)
    whole = np.abs(first.astype(np.float64) - last).mean()
    for weight in (0.0, 0.25, 0.5, 1.0):
        between = h.quantiles(h.blended(a, b, weight), count)
        assert (np.diff(between) >= 0).all()
        scale = max(abs(float(a[0])), abs(float(b[0])), float(a[-1]), float(b[-1]), 1e-9)
        assert np.abs(between.astype(np.float64) - first).mean() == pytest.approx(weight * whole, abs=1e-5 * scale)
