"""Smoothing of raw pen samples."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.smoothing import Smoother
from engine.brush.steadying import STEADIED

SAMPLES = st.lists(st.tuples(st.floats(-500, 500), st.floats(-500, 500), st.floats(0, 1)), min_size=1, max_size=20).map(
    lambda rows: np.column_stack([np.array(rows), np.zeros((len(rows), 2)), np.arange(len(rows)) * 0.008])
)

WAYS = st.sampled_from([*STEADIED])


def smooth(samples, **options):
    smoother = Smoother(**options)
    return np.concatenate([smoother.add(samples), smoother.finish()])


@settings(deadline=None, max_examples=60)
@given(
    SAMPLES, st.lists(st.integers(0, 20), max_size=5), st.sampled_from([0.0, 0.3, 1.0]), st.sampled_from([*STEADIED])
)
def test_any_portions_give_the_same_path_bit_for_bit(samples, cuts, stabiliser, way):
    smoother = Smoother(stabiliser, way=way)
    parts = [smoother.add(part) for part in np.split(samples, sorted(min(c, len(samples)) for c in cuts))]
    whole = smooth(samples, stabiliser=stabiliser, way=way)
    assert np.concatenate([*parts, smoother.finish()]).tobytes() == whole.tobytes()


@settings(deadline=None, max_examples=60)
@given(SAMPLES, st.sampled_from([0.0, 0.5, 1.0]), WAYS)
def test_the_ends_are_kept_and_the_path_stays_among_the_samples(samples, stabiliser, way):
    path = smooth(samples, stabiliser=stabiliser, way=way)
    assert (path[0] == samples[0]).all()
    if STEADIED[way].to_the_pen or not stabiliser:
        np.testing.assert_allclose(path[-1], samples[-1], atol=1e-9)
    assert (path.min(0) >= samples.min(0) - 1e-9).all()
    assert (path.max(0) <= samples.max(0) + 1e-9).all()


def test_the_path_is_the_quadratic_b_spline():
    corner = np.array([[0.0, 0], [100, 0], [100, 100], [0, 100]])
    path = smooth(corner, tolerance=0.01)[:, :2]
    t = np.linspace(0, 1, 2000)[:, None]
    start, middle, end = np.array([50, 0]), np.array([100, 0]), np.array([100, 50])
    curve = (1 - t) ** 2 * start + 2 * t * (1 - t) * middle + t**2 * end
    on_piece = path[(path[:, 0] >= 50) & (path[:, 1] <= 50)]
    assert len(on_piece) > 10
    distance = np.sqrt(((on_piece[:, None] - curve[None]) ** 2).sum(2)).min(1)
    assert distance.max() < 0.05


def test_the_polyline_is_within_the_tolerance():
    samples = np.array([[0.0, 0], [300, 0], [300, 300], [0, 300], [0, 0]])
    coarse, fine = smooth(samples, tolerance=0.1)[:, :2], smooth(samples, tolerance=0.0001)[:, :2]
    a, b = coarse[:-1], coarse[1:]
    ab = b - a
    along = np.clip(((fine[:, None] - a) * ab).sum(2) / np.maximum((ab**2).sum(1), 1e-30), 0, 1)
    distance = np.sqrt(((a + along[..., None] * ab - fine[:, None]) ** 2).sum(2)).min(1)
    assert distance.max() < 0.101
    assert len(coarse) < 200


def test_one_sample_is_one_point_and_nothing_is_nothing():
    assert smooth(np.array([[1.0, 2, 0.5]])).tolist() == [[1, 2, 0.5, 0, 0, 0]]
    assert len(Smoother().finish()) == 0


def test_hostile_samples_are_dropped_and_counted():
    smoother = Smoother(0.5)
    smoother.add(
        np.array([[0.0, 0, 1, 0, 0, 0], [np.nan, 1, 1, 0, 0, 1], [5, np.inf, 1, 0, 0, 2], [9, 9, 7, 0, 0, -1]])
    )
    path = smoother.finish()
    assert smoother.dropped == 2
    assert path[-1, :3].tolist() == [9, 9, 1]


def test_the_stabiliser_takes_out_a_tremor():
    x = np.arange(200.0)
    shaky = np.column_stack([x, 3 * np.sin(x * 1.9), np.ones(200), np.zeros((200, 2)), x * 0.008])
    spread = [np.abs(smooth(shaky, stabiliser=s)[100:-40, 1]).mean() for s in (0.0, 0.5, 1.0)]
    assert spread[0] > 2 * spread[1] > 3 * spread[2]


@settings(deadline=None, max_examples=60)
@given(SAMPLES, st.sampled_from([0.1, 0.5, 1.0]), st.sampled_from([0.5, 1.0, 8.0]))
def test_on_a_rope_the_brush_is_never_farther_than_that_and_rests_while_it_is_slack(samples, stabiliser, unit):
    smoother, before = Smoother(stabiliser, way="rope", unit=unit), samples[0, :2]
    for sample in samples:
        smoother.add(sample[None])
        far, length = np.hypot(*(sample[:2] - before)), 120 * stabiliser * unit
        if far <= length:
            assert (np.array(smoother.at) == before).all()
        else:
            np.testing.assert_allclose(np.hypot(*(sample[:2] - smoother.at)), length, rtol=1e-9)
        before = np.array(smoother.at)
    path = smoother.finish()
    assert not len(path) or np.allclose(path[-1, :2], smoother.at)


@pytest.mark.parametrize("speed", [200.0, 1000.0, 5000.0])
def test_a_quick_brush_trails_a_fast_pen_by_few_pixels_whatever_the_scale(speed):
    times = np.arange(200) * 0.005
    for unit in (1.0, 1.3):
        samples = np.zeros((200, 6))
        samples[:, 0], samples[:, 5] = times * speed * unit, times
        quick, weighted = (Smoother(1.0, way=way, unit=unit) for way in ("quick", "weighted"))
        quick.add(samples)
        weighted.add(samples)
        assert samples[-1, 0] - quick.at[0] < 4.0 * unit
        assert samples[-1, 0] - weighted.at[0] > 0.13 * speed


def test_a_quick_brush_takes_a_tremor_out_of_slow_lines():
    rng = np.random.default_rng(3)
    samples = np.zeros((400, 6))
    samples[:, 5] = np.arange(400) * 0.005
    samples[:, 0] = samples[:, 5] * 10.0
    samples[:, 1] = rng.normal(0, 0.4, 400)
    assert np.abs(np.diff(smooth(samples, stabiliser=1.0, way="quick")[100:-60, 1])).mean() < 0.05
    assert np.abs(np.diff(smooth(samples)[100:-60, 1])).mean() > 0.1


def test_a_barrel_turns_on_past_a_full_turn():
    samples = np.zeros((8, 7))
    samples[:, 0], samples[:, 6] = np.arange(8) * 5.0, (340.0 + 10.0 * np.arange(8)) % 360.0
    parts = Smoother()
    points = np.concatenate([*(parts.add(row[None]) for row in samples), parts.finish()])
    assert points.shape[1] == 7
    assert (np.diff(points[:, 6]) >= 0).all()
    assert points[[0, -1], 6].tolist() == [340.0, 410.0]
