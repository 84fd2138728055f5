"""The steerable pyramid: the way back, the published filters, orientation, any size."""

import hashlib
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric import steerable
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.steerable import Place


def grain(size, seed=0):
    return np.random.default_rng(seed).standard_normal(size).astype(np.float32)


def ran(steps):
    """What a generator returns, and what it told on the way."""
    told = []
    while True:
        try:
            told.append(next(steps))
        except StopIteration as stop:
            return stop.value, told


@settings(deadline=None, max_examples=60)
@given(st.integers(1, 70), st.integers(1, 70), st.integers(0, 4), st.integers(1, 6), st.sampled_from([1, 2]))
def test_the_way_back(height, width, levels, orientations, arithmetic):
    x = grain((height, width))
    levels = min(levels, steerable.most_levels(height, width))
    made = steerable.filters(height, width, levels, orientations, arithmetic)
    back = steerable.collapse(steerable.build(x, made), made)
    assert np.abs(back - x).max() < 1e-5 * np.abs(x).max()
    same, told = ran(steerable.changed(x[None], made, lambda place, values: None))
    assert np.abs(same[0] - x).max() < 1e-5 * np.abs(x).max()
    assert told == sorted(told)
    assert told[-1] == 1.0


@pytest.mark.parametrize(("levels", "orientations"), [(4, 4), (3, 1), (2, 2), (3, 3), (2, 6)])
def test_responses_are_those_of_pyrtools(levels, orientations):
    """Its bands grow by 4 from level to level, ours keep the values of the filtered picture."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from pyrtools.pyramids import SteerablePyramidFreq
    x = grain((96, 128))
    theirs = SteerablePyramidFreq(x.astype(np.float64), levels, orientations - 1, is_complex=False).pyr_coeffs
    made = steerable.filters(96, 128, levels, orientations)
    for place, values in steerable.build(x, made).items():
        known = {-1: "residual_highpass", levels: "residual_lowpass"}.get(place.level, (place.level, place.orientation))
        wanted = theirs[known] / 4.0 ** max(place.level, 0)
        assert values.shape == wanted.shape
        assert np.abs(values - wanted).max() < 1e-4 * np.abs(wanted).max(), place


@pytest.mark.parametrize("orientations", [1, 2, 4, 5])
def test_squares_of_all_masks_add_up_to_one(orientations):
    """Energy is kept: the filters are a tight frame."""
    made = steerable.filters(64, 48, 0, orientations)
    assert np.allclose(made.high**2 + made.low**2, 1.0, atol=1e-6)
    x = grain((64, 48))
    pyramid = steerable.build(x, steerable.filters(64, 48, 3, orientations))
    energy = sum(np.square(v, dtype=np.float64).sum() * (x.size / v.size) for v in pyramid.values())
    assert energy == pytest.approx(np.square(x, dtype=np.float64).sum(), rel=1e-4)


def test_a_wave_is_answered_by_its_level_and_orientation():
    y, x = np.mgrid[:128, :128]
    for level in range(3):
        for k in range(4):
            u, v = np.cos(np.pi * k / 4), np.sin(np.pi * k / 4)
            n = 128 * 0.25 * 2.0**-level
            wave = np.cos(2 * np.pi * (round(n * u) * x + round(n * v) * y) / 128).astype(np.float32)
            pyramid = steerable.build(wave, steerable.filters(128, 128, 3, 4))
            strongest = max(pyramid, key=lambda place: pyramid[place].std())
            assert strongest == Place(level, k)


def test_what_is_added_where_is_the_adjoint():
    """<band(x), y> = <x, back(y)>, the sizes of the levels allowed for: so matching moves towards the example."""
    made = steerable.filters(45, 62, 2, 4)
    x, pyramid = grain((45, 62)), steerable.build(grain((45, 62), 1), made)
    empty = {place: np.zeros_like(values) for place, values in pyramid.items()}
    own = steerable.build(x, made)
    for place, values in pyramid.items():
        back = steerable.collapse({**empty, place: values}, made)
        one = (own[place].astype(np.float64) * values).sum() * (x.size / values.size)
        assert one == pytest.approx((x.astype(np.float64) * back).sum(), rel=1e-3, abs=0.5)


def test_leading_axes_are_a_batch():
    x = grain((2, 3, 32, 31))
    made = steerable.filters(32, 31, 2, 4)
    alone = steerable.build(x[1, 2], made)
    for place, values in steerable.build(x, made).items():
        assert np.array_equal(values[1, 2], alone[place])
    assert np.abs(steerable.collapse(steerable.build(x, made), made) - x).max() < 1e-5


def test_threads_change_nothing():
    from concurrent.futures import ThreadPoolExecutor

    def change(place, values):
        np.tanh(values, out=values)

    x, made = grain((3, 64, 80)), steerable.filters(64, 80, 3, 4)
    with ThreadPoolExecutor(3) as threads:
        many, _ = ran(steerable.changed(x, made, change, threads))
    one, _ = ran(steerable.changed(x, made, change))
    assert np.array_equal(many, one)
    assert np.abs(one - x).max() > 0.1


@pytest.mark.parametrize("found", [(0, 5, 0, 4), (16, 16, 3, 4), (16, 16, -1, 4), (16, 16, 1, 0)])
def test_what_has_no_room_is_refused(found):
    with pytest.raises(ValueError, match="steerable pyramid: found"):
        steerable.filters(*found)


@pytest.mark.parametrize("orientations", [1, 2, 4, 5])
def test_subbands_are_nearly_the_same_in_both_arithmetics(orientations):
    x = grain((3, 45, 66))
    one, other = (
        steerable.build(x, steerable.filters(45, 66, 3, orientations, kind)) for kind in (LIBRARY, EVERYWHERE)
    )
    for place, values in one.items():
        assert np.abs(other[place] - values).max() < 2e-6 * np.abs(values).max(), place


def test_subbands_are_the_same_bits_as_ever():
    """Found with AVX-512 and FMA, and without AVX and FMA."""
    whole = (np.arange(2 * 40 * 37) * 7919 % 1009 / 512).reshape(2, 40, 37).astype(np.float32)
    made = steerable.filters(40, 37, 3, 4, EVERYWHERE)
    bands = steerable.build(whole, made)
    digest = hashlib.sha256(b"".join(bands[place].tobytes() for place in steerable.places(3, 4)))
    digest.update(steerable.collapse(bands, made).tobytes())
    assert digest.hexdigest()[:24] == "cb2033ed092fbcaf860694ca"
