"""Matched textures as ink: the same bits for the same place, a spectrum that goes on where the tile's pixels end."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specimens import bark, granite, photograph, sand

from engine.numeric import histograms
from engine.numeric.address import Rect
from engine.numeric.detail import cut, parents, subtract_expanded
from engine.numeric.grid import snapped
from engine.numeric.pyramid import reduce
from engine.numeric.shapes import drawn
from engine.numeric.spectra import power, radial_mean, radial_window, texture_of
from engine.texture.continuation import octave_of
from engine.texture.image import ImageSource
from engine.texture.matched import stage, weights
from engine.texture.matching import Shape, analysed
from engine.texture.table import from_key, instance

ORIGINS = st.one_of(st.integers(-300, 300), st.integers(-(2**90), 2**90), st.just((1 << 40) - 20))


def source(picture, name="sample"):
    """A picture (1 or 3, h, w) of 0..1."""
    planes = np.clip(np.broadcast_to(picture, (3, *picture.shape[1:])), 0.0, 1.0)
    return ImageSource.of(name, snapped(np.concatenate([planes, np.ones_like(planes[:1])]).astype(np.float32)))


def noise(b, size=(256, 256)):
    return 0.5 + 0.5 * texture_of(drawn("noise", size, {"b": b, "from": 0.0, "to": 1.5}), 3).reshape(1, *size)


GRANITE, GRAVEL = source(granite((64, 64))), source(photograph("gravel", (47, 64)))
BOTH = source(np.concatenate([granite((40, 48), k) for k in (1, 2, 3)], axis=1))


@st.composite
def textures(draw):
    parameters = {
        "period": draw(st.sampled_from([5, 20, 48, 64, 300])),
        "roughness": draw(st.sampled_from([0.0, 0.05, 0.5, 0.85, 1.0])),
        "stages": 3,
        "weight": draw(st.sampled_from([0.0, 0.3, 0.5, 1.0])),
    }
    kind, picture = draw(st.sampled_from([("matched", GRANITE), ("matched", GRAVEL), ("series", BOTH)]))
    return instance(kind, parameters, -3, 9, picture)


@settings(deadline=None, max_examples=40)
@given(textures(), ORIGINS, ORIGINS, st.sampled_from([0, 1, 3, 5, 9, 60, 4000]), st.data())
def test_any_rectangle_holds_the_same_bits(made, x, y, up, data):
    whole = Rect.at(x, y, 61, 50)
    a, b = sorted(data.draw(st.lists(st.integers(0, 61), min_size=2, max_size=2, unique=True)))
    c, d = sorted(data.draw(st.lists(st.integers(0, 50), min_size=2, max_size=2, unique=True)))
    part = Rect(x + a, y + c, x + b, y + d)
    for values in (made.appearance, made.bandpass):
        big, small = values(up - 3, whole), values(up - 3, part)
        if big is None or small is None:
            assert big is small or not (big if small is None else small).any()
        else:
            assert (small == big[:, *part.slices(whole)]).all()
            assert small.shape[0] == (3 if made.coloured else 1)


@settings(deadline=None, max_examples=30)
@given(textures(), ORIGINS, ORIGINS, st.sampled_from([1, 2, 3, 5, 9, 30]))
def test_bandpass_is_what_expand_leaves_out(made, x, y, up):
    rect = Rect.at(x, y, 40, 36).evened()
    left = made.appearance(up - 3, rect)
    subtract_expanded(left, made.appearance(up - 4, parents(rect)))
    added = made.bandpass(up - 3, rect)
    assert np.abs(cut(left, rect, rect) - (0 if added is None else added)).max() < 2e-5


def test_down_to_its_own_pixels_each_level_is_the_mean_of_the_next():
    made = instance("matched", {"period": 12}, 0, 1, GRANITE)
    rect = Rect.at(-30, 17, 50, 40)
    for level in range(made.native):
        assert np.abs(made.appearance(level, rect) - reduce(made.appearance(level + 1, rect.zoomed(1)))).max() < 5e-5
    own = instance("matched", {}, 5, 0, GRANITE).appearance(5, Rect.at(0, 0, 64, 64))
    assert np.abs(own - (2 * GRANITE.data[:3] - 1)).max() < 1e-6


EXAMPLES = {
    "granite": lambda: granite((256, 256)),
    "sand": lambda: sand((256, 256)),
    "bark": lambda: bark((256, 256)),
    "gravel": lambda: photograph("gravel", (256, 256)),
    "grass": lambda: photograph("grass", (256, 256)),
    "1/f^1.5": lambda: noise(1.5),
}


@pytest.mark.parametrize("period", [256, 180])
@pytest.mark.parametrize("name", EXAMPLES)
def test_the_spectrum_goes_on_where_the_pixels_end(name, period):
    """Over four octaves about the join, a third of an octave at a time, power stays within 2.2 dB of a line, and does
    not rise; without octaves it falls by 30 dB."""
    picture = source(EXAMPLES[name]())
    made = instance("matched", {"period": period, "roughness": octave_of(picture).slope}, 0, 0, picture)
    where, found = _thirds(made)
    line = np.polyval(np.polyfit(where, found, 1), where)
    assert np.abs(found - line).max() < 2.2
    assert np.diff(found).max() < 0.3
    _, smooth = _thirds(instance("matched", {"period": period, "roughness": 0.0}, 0, 0, picture))
    assert smooth[-1] < found[-1] - 20


def _thirds(made):
    """log2 of the frequency in cycles per pixel of the native level, and power in dB, by thirds of an octave."""
    window = radial_window(512)
    views = [made.appearance(made.native + 3, Rect.at(k * 5000, 7, 512, 512)).mean(0) * window for k in range(6)]
    frequency, mean = radial_mean(np.mean([power(view) for view in views], axis=0))
    edges = 2.0 ** np.arange(-2.67, 1.4, 1 / 3)
    inside = [(8 * frequency >= a) & (8 * frequency < b) for a, b in pairwise(edges)]
    return np.log2(edges[:-1]), np.array([10 * np.log10(mean[part].mean()) for part in inside])


def test_the_slope_is_that_of_the_subbands():
    for b, slope in ((1.5, 2**-0.5), (2.0, 0.5)):
        assert abs(octave_of(source(noise(b))).slope - slope) < 0.03


def test_detail_is_distributed_as_the_finest_subbands():
    """Not as Gaussian noise: most of gravel is flat, edges are strong."""
    picture = photograph("gravel", (256, 256))
    octave = octave_of(source(picture))
    shape = Shape("steerable", 1, 4)
    wanted, found = analysed(2.0 * picture, shape), analysed(octave.tile, shape)
    for place, ordered in wanted.bands[0].items():
        if place.level == 0:
            a, b = (values / values.std() for values in (ordered, found.bands[0][place]))
            gauss = np.sort(np.random.default_rng(0).standard_normal(a.size)).astype(np.float32)
            assert histograms.distance(b, a) < 0.5 * histograms.distance(gauss, a)


def test_detail_never_ends_nor_grows():
    made = instance("matched", {"roughness": octave_of(GRAVEL).slope}, 0, 3, GRAVEL)
    for level in (1, 2, 4, 7, 16, 60, 300):
        view = made.appearance(level, Rect.at((3**200 >> 100) << level >> 60, 5, 256, 256))
        assert 0.05 < view.std() < 1.0
        assert np.abs(made.bandpass(level, Rect.at(7, 5, 64, 64))).max() > 1e-3
    assert instance("matched", {"roughness": 0.0}, 0, 3, GRAVEL).bandpass(1, Rect.at(0, 0, 64, 64)) is None


def test_a_series_holds_its_stages_and_what_lies_between():
    rect = Rect.at(0, 0, 48, 40)
    stages = [instance("series", {"stages": 3, "weight": w}, 0, 0, BOTH).appearance(0, rect) for w in weights(3)]
    for k, seen in enumerate(stages):
        assert np.abs(seen - (2 * BOTH.data[:3, 40 * k : 40 * (k + 1)] - 1)).max() < 1e-6
    between = instance("series", {"stages": 3, "weight": 0.75}, 0, 0, BOTH).appearance(0, rect)
    assert np.abs(between - (stages[1] + stages[2]) / 2).max() < 3e-5
    assert stage(BOTH, 3, 0.5) is stage(BOTH, 3, 0.5)


def test_keys_come_back():
    for kind, picture in (("matched", GRANITE), ("series", BOTH)):
        made = instance(kind, {"period": 20, "roughness": 0.3, "stages": 3, "weight": 0.25}, 2, 0, picture)
        again = from_key(made.key, {picture.sha: picture})
        assert again == made
        assert again.key == made.key
        assert (again.appearance(4, Rect.at(3, 4, 9, 9)) == made.appearance(4, Rect.at(3, 4, 9, 9))).all()
        lost = from_key(made.key, {})
        assert not lost.appearance(5, Rect.at(0, 0, 8, 8)).any()
        assert lost.key == made.key


@pytest.mark.parametrize("size", [(1, 1), (2, 3), (8, 8), (9, 31)])
def test_tiny_and_flat_pictures(size):
    for picture in (granite((32, 32))[:, : size[0], : size[1]], np.full((1, *size), 0.25)):
        made = instance("matched", {"period": 16}, 0, 0, source(picture))
        seen = made.appearance(9, Rect.at(0, 0, 64, 64))
        assert np.isfinite(seen).all()
        assert np.abs(seen).max() < 4
