"""The slope of the measure, against differences of the measure itself."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import specimens
from quality import channels_of

from engine.numeric import steerable
from engine.texture.matching import Shape, analysed
from engine.texture.slope import beyond, folded, mirrored, sloped, wanted_of

SIDE = 32


@pytest.fixture(scope="module")
def wanted():
    example = specimens.sand((64, 64))[:1]
    return wanted_of(analysed(example, Shape(levels=3), channels_of(example)).bands[0])


@pytest.fixture(scope="module")
def pictures():
    return np.random.default_rng(3).normal(0.5, 0.1, (3, SIDE, SIDE)).astype(np.float32)


@pytest.mark.parametrize("edge", [0, 5])
def test_pictures_go_down_the_slope(wanted, pictures, edge):
    """As steeply as it says, a little way."""
    filters = steerable.filters(SIDE, SIDE, 3, 4)

    def inside(place, count):
        away = edge >> max(place.level, 0)
        return slice(away, count - away)

    def distance(moved):
        return sloped(moved, filters, wanted, inside)[0].mean()

    _, slope = sloped(pictures, filters, wanted, inside)
    step = slope * np.float32(2e-4 / slope.std())
    found = (distance(pictures + step) - distance(pictures - step)) / 2.0
    assert found == pytest.approx(np.vdot(slope, step) / len(pictures), rel=0.2)


def test_what_is_not_wanted_has_no_slope(wanted, pictures):
    filters = steerable.filters(SIDE, SIDE, 3, 4)
    only = {place: band for place, band in wanted.items() if place.level == 3}
    _, slope = sloped(pictures, filters, only, lambda _, count: slice(count))
    waves = np.abs(np.fft.fft2(slope[0]))
    k = np.abs(np.fft.fftfreq(SIDE) * SIDE)
    assert waves[np.hypot(k[:, None], k) > 2.01].max() < 1e-5 * waves.max()
    assert not sloped(pictures, filters, {}, lambda _, count: slice(count))[0].any()


def test_each_picture_by_itself(wanted, pictures):
    """However many are worked on at once, and by whom."""
    filters = steerable.filters(SIDE, SIDE, 3, 4)
    many = np.tile(pictures, (120, 1, 1))
    distance, slope = sloped(many, filters, wanted, lambda _, count: slice(count))
    one = sloped(pictures, filters, wanted, lambda _, count: slice(count))
    assert np.allclose(distance, np.tile(one[0], 120), rtol=1e-5)
    assert np.abs(slope - np.tile(one[1], (120, 1, 1))).max() < 1e-5 * np.abs(slope).max()
    with ThreadPoolExecutor(2) as threads:
        again = sloped(many, filters, wanted, lambda _, count: slice(count), threads)
    assert np.array_equal(again[1], slope)
    assert np.array_equal(again[0], distance)


@pytest.mark.parametrize("count", [4, 7])
def test_folding_is_the_transpose_of_mirroring(count):
    rng = np.random.default_rng(count)
    own, values = rng.normal(size=(2, count, count)), rng.normal(size=(2, 2 * count, 2 * count))
    seen = mirrored(own)
    assert np.vdot(seen, values) == pytest.approx(np.vdot(own, folded(values)))
    before, _ = beyond(count)
    assert np.array_equal(seen[:, before : before + count, before : before + count], own)
