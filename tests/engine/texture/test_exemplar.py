"""Analyses of examples: nearly the same in both arithmetics, and in ours the same bits as ever."""

import hashlib

import numpy as np
import pytest
from exemplars import blob
from scipy.ndimage import gaussian_filter

from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.blur import blurred
from engine.strokes.example_files import kept, key
from engine.texture.example.exemplar import analysed
from engine.texture.example.parameters import Parameters

ASKED = Parameters(smooth=1.7, channels="luminance")


@pytest.mark.parametrize(("size", "sigma"), [((1, 1), 0.4), ((30, 41), 2.3), ((7, 90), 9.0), ((60, 3), 0.01)])
def test_blurs_are_those_of_scipy(size, sigma):
    mask = np.random.default_rng(0).random(size) < 0.4
    right = gaussian_filter(mask.astype(np.float64), sigma, mode="constant")
    assert blurred(mask, sigma) == pytest.approx(right, abs=1e-12)


def test_an_analysis_is_nearly_the_same_in_both_arithmetics():
    one, other = (analysed(blob()[0], None, ASKED, arithmetic) for arithmetic in (LIBRARY, EVERYWHERE))
    assert np.array_equal(one.mask, other.mask)
    assert other.average == pytest.approx(one.average, abs=1e-6)
    for mine, theirs in zip(one.levels, other.levels, strict=True):
        assert np.abs(mine.compared - theirs.compared).max() <= 1
        assert np.array_equal(mine.bits, theirs.bits)


def test_an_analysis_gives_the_same_bits_as_ever():
    """Found with AVX-512 and FMA, and without AVX and FMA."""
    y, x = np.mgrid[:50, :40]
    inside = (x - 20) ** 2 + (y - 25) ** 2 < 300
    pixels = np.dstack([x * 6, y * 5, (x * y) % 256, 255 * inside]).astype(np.uint8)
    found = analysed(pixels, None, ASKED, EVERYWHERE)
    digest = hashlib.sha256(found.mask.tobytes() + found.average.tobytes())
    for level in found.levels:
        digest.update(level.compared.tobytes() + level.order.tobytes())
    assert digest.hexdigest()[:24] == "081d46a5e90e501c4e49e089"


def test_analyses_that_are_kept_tell_the_arithmetics_apart(tmp_path):
    pixels = blob()[0]
    assert key(pixels, None, ASKED) == key(pixels, None, ASKED, LIBRARY) != key(pixels, None, ASKED, EVERYWHERE)
    for arithmetic in (LIBRARY, EVERYWHERE, LIBRARY, EVERYWHERE):
        assert kept(pixels, None, ASKED, tmp_path, arithmetic).arithmetic == arithmetic
    assert len(list(tmp_path.glob("*.npz"))) == 2
