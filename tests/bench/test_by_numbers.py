"""Painting with examples against texture-by-numbers (Ritter et al. 2006, section 8): only the former has rims where two
textures touch that do not touch in the example."""

import numpy as np
import pytest

from bench import by_numbers
from bench import five_textures as five

pytestmark = [pytest.mark.nightly, pytest.mark.timeout(300)]


@pytest.fixture(scope="module")
def place():
    return five.scene(240, 150)


@pytest.fixture(scope="module")
def theirs(place):
    return five.theirs(place)


@pytest.fixture(scope="module")
def ours(place):
    return five.ours(place)


def shares(place, made):
    """Of pixels near interfaces from the right rim: where textures touch, and where they touch the paper."""
    found = five.interfaces(place.wanted)
    told = {pair: five.from_rim(place, made, pair[0], near) for pair, near in found.items()}
    return [s for (_, other), s in told.items() if other], [s for (_, other), s in told.items() if not other]


def test_rims_where_textures_touch(place, theirs, ours):
    absent, there = shares(place, ours)
    assert len(absent) == 16
    assert min(absent + there) > 0.9
    absent, there = shares(place, theirs)
    assert np.mean(absent) < 0.4
    assert np.median(absent) < 0.2
    assert min(there) > 0.9  # the example shows these interfaces


def test_insides_are_no_rims(place, theirs, ours):
    for label in range(1, len(five.LABELS)):
        inside = five.depth(place.wanted, label) > 2 * five.BAND
        assert five.from_rim(place, ours, label, inside) < 0.1
        assert five.from_rim(place, theirs, label, inside) < 0.1


def test_rim_scores(place, theirs, ours):
    labels = range(1, len(five.LABELS))
    apart, near = ([five.rim_score(place, made, label, paper=False) for label in labels] for made in (theirs, ours))
    assert all(n < a for a, n in zip(apart, near, strict=True))
    assert sum(near) < 0.5 * sum(apart)
    labels = [label for label, other in five.interfaces(place.wanted) if not other]
    apart, near = ([five.rim_score(place, made, label, paper=True) for label in labels] for made in (theirs, ours))
    assert sum(near) < 1.3 * sum(apart)  # the example shows these, and both do well


def test_labels_are_followed():
    """Of a square on a ground; moved as far as a pixel of the coarsest level, it is found again."""
    labels = np.zeros((28, 40, 3), np.float32)
    labels[6:22, 8:28] = 1.0
    texture = 0.7 * labels + 0.2 * np.random.default_rng(0).random(labels.shape, np.float32)
    texture[labels == 0] = 0.1
    for wanted in (labels, np.roll(labels, 4, axis=1)):
        found = by_numbers.sources(labels, texture, wanted)
        assert np.array_equal(labels[found[..., 0], found[..., 1]], wanted)
