"""Mixtures of two textures: palette, bands, averages."""

import numpy as np
import pytest
import specimens
from quality import channels_of, unlikeness

from engine.numeric import histograms
from engine.numeric.colour_axes import axes_of
from engine.texture.matching import PYRAMIDS, Shape, analysed, matched, matched_colours, noise
from engine.texture.mixing import MIXES, Mix, average, bands, coarsened, palette

SIDE = 96
FIRST, SECOND = specimens.granite((SIDE, SIDE)), specimens.bark((SIDE, SIDE))


def made(pattern, seed=2):
    return matched_colours(pattern, matched(pattern, noise(pattern.colours.count, (SIDE, SIDE), seed)))


def shape(kind="steerable"):
    return Shape(kind).within((SIDE, SIDE))


def test_palette_of_one_with_the_pattern_of_the_other():
    found = made(palette(FIRST, SECOND, shape(), Mix()))
    assert np.abs(found.mean(axis=(1, 2)) - FIRST.mean(axis=(1, 2))).max() < 0.03
    assert np.abs(found.std(axis=(1, 2)) - FIRST.std(axis=(1, 2))).max() < 0.05
    # Its main axis has the subbands of the second's, whatever the colours.
    planes = axes_of(found).planes(found)[:1]
    own, other = (axes_of(given).planes(given)[:1] for given in (SECOND, FIRST))
    assert unlikeness(planes, own) < 0.15 < 2.0 * unlikeness(planes, other)


@pytest.mark.parametrize("kind", PYRAMIDS)
def test_the_slider_goes_straight_from_one_to_the_other(kind):
    weights = (0.0, 0.25, 0.5, 0.75, 1.0)
    found = [made(average(FIRST, SECOND, shape(kind), Mix(weight))) for weight in weights]
    from_first, from_second = ([unlikeness(f, given, shape(kind)) for f in found] for given in (FIRST, SECOND))
    assert from_first == sorted(from_first)
    assert from_second == sorted(from_second, reverse=True)
    assert from_first[0] < 0.15 < from_first[1]
    assert from_second[-1] < 0.15 < from_second[-2]
    steps = np.diff(from_first)
    assert steps.max() < 2.0 * steps.min()
    assert np.array_equal(found[0], made(analysed(FIRST, shape(kind))))


def test_the_pixels_of_averages_are_averaged():
    a, b = (analysed(given, shape()) for given in (FIRST, SECOND))
    half = average(FIRST, SECOND, shape(), Mix(0.5))
    for own, first, second in zip(half.pixels, a.pixels, b.pixels, strict=False):
        assert histograms.distance(own, first) == pytest.approx(histograms.distance(own, second), rel=1e-3)


@pytest.mark.parametrize("kind", PYRAMIDS)
@pytest.mark.parametrize("split", [1, 2, 3])
def test_low_bands_of_the_first_under_high_ones_of_the_second(kind, split):
    found = made(bands(FIRST, SECOND, shape(kind), Mix(split=split)))
    axes = channels_of(found)
    own, first, second = (analysed(given, shape(kind), axes).bands for given in (found, FIRST, SECOND))

    def distance(wanted, levels):
        return np.mean(
            [
                histograms.distance(own[c][place], wanted[c][place]) / wanted[c][place].std()
                for c in range(3)
                for place in wanted[c]
                if place.level in levels
            ]
        )

    # Subbands next to the split hold a little of both.
    fine, coarse = range(-1, split - 1) if split > 1 else [0], range(split + 1, 5)
    assert distance(second, fine) < 0.5 * distance(first, fine)
    assert distance(first, coarse) < 0.5 * distance(second, coarse)


@pytest.mark.parametrize("kind", PYRAMIDS)
def test_split_at_the_ends(kind):
    fine = made(bands(FIRST, SECOND, shape(kind), Mix(split=9)))
    coarse = made(bands(FIRST, SECOND, shape(kind), Mix(split=-1)))
    assert unlikeness(fine, SECOND, shape(kind)) < 0.15
    assert unlikeness(coarse, FIRST, shape(kind)) < 0.15
    planes = noise(2, (50, 41), 1)
    assert np.abs(coarsened(planes, Shape(kind, 3), -1) - planes).max() < 1e-5
    assert np.abs(coarsened(planes, Shape(kind, 3), 9)).max() < 1e-5


@pytest.mark.parametrize("how", MIXES)
def test_any_two_pictures(how):
    rng = np.random.default_rng(0)
    grey, tiny = rng.random((1, 30, 40), np.float32), rng.random((3, 8, 8), np.float32)
    flat, glass = np.full((3, 12, 12), 0.25, np.float32), rng.random((4, 21, 33), np.float32)
    glass[:3] *= glass[3:]
    for first in (grey, tiny, flat, glass):
        for second in (grey, tiny, flat, glass):
            pattern = MIXES[how](first, second, Shape().within((20, 24)), Mix())
            count = pattern.colours.count
            found = matched_colours(pattern, matched(pattern, noise(count, (20, 24), 1), 2))
            assert found.shape[0] in {len(first), len(second)}
            assert np.isfinite(found).all()
            assert found.min() >= 0.0
            assert found.max() <= 1.0
