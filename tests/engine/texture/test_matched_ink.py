"""Matched textures as ink: the same bits for the same place, a spectrum that goes on where the tile's pixels end."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specimens import bark, granite, photograph, rock, sand, steep

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
from engine.texture.spectral import Tiled
from engine.texture.table import from_key, instance

ORIGINS = st.one_of(st.integers(-300, 300), st.integers(-(2**90), 2**90), st.just((1 << 40) - 20))


def source(picture, name="sample"):
    """A picture (1 or 3, h, w) of 0..1."""
    planes = np.clip(np.broadcast_to(picture, (3, *picture.shape[1:])), 0.0, 1.0)
    return ImageSource.of(name, snapped(np.concatenate([planes, np.ones_like(planes[:1])]).astype(np.float32)))


def translucent(size=(64, 64), seed=1):
    """Premultiplied RGBA: granite where rock is high, with soft rims."""
    height, width = size
    alpha = steep(rock(size, 12, 0.5, seed + 40), 0.5, 0.25)[None]
    colours = granite(size, seed)[:, :height, :width] * alpha
    return ImageSource.of("translucent", snapped(np.concatenate([colours, alpha]).astype(np.float32)))


def noise(b, size=(256, 256)):
    return 0.5 + 0.5 * texture_of(drawn("noise", size, {"b": b, "from": 0.0, "to": 1.5}), 3).reshape(1, *size)


GRANITE, GRAVEL = source(granite((64, 64))), source(photograph("gravel", (47, 64)))
BOTH = source(np.concatenate([granite((40, 48), k) for k in (1, 2, 3)], axis=1))
CLEAR = translucent()
STAGES = [BOTH.data[:, :40], *(translucent((40, 48), k).data for k in (2, 3))]
PARTLY = ImageSource.of("partly", np.concatenate(STAGES, axis=1))


@st.composite
def textures(draw):
    parameters = {
        "period": draw(st.sampled_from([5, 20, 48, 64, 300])),
        "roughness": draw(st.sampled_from([0.0, 0.05, 0.5, 0.85, 1.0])),
        "stages": 3,
        "weight": draw(st.sampled_from([0.0, 0.3, 0.5, 1.0])),
    }
    pictures = [("matched", GRANITE), ("matched", GRAVEL), ("series", BOTH), ("matched", CLEAR), ("series", PARTLY)]
    kind, picture = draw(st.sampled_from(pictures))
    made = instance(kind, parameters, -3, 9, picture)
    return made.cover if made.cover is not None and draw(st.booleans()) else made


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
            seen = 4 if made.cover is not None else 3 if made.coloured else 1
            assert len(small) == (seen if values == made.appearance else min(seen, 3))


@settings(deadline=None, max_examples=30)
@given(textures(), ORIGINS, ORIGINS, st.sampled_from([1, 2, 3, 5, 9, 30]))
def test_bandpass_is_what_expand_leaves_out(made, x, y, up):
    rect = Rect.at(x, y, 40, 36).evened()
    left = made.appearance(up - 3, rect)[:3]
    subtract_expanded(left, made.appearance(up - 4, parents(rect))[:3])
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


# ---- alpha ----


def test_a_translucent_texture_is_its_picture_and_its_cover_the_alpha():
    made = instance("matched", {}, 5, 0, CLEAR)
    rect = Rect.at(-10, 3, 90, 80)
    seen = made.appearance(5, rect)
    assert np.abs(made.appearance(5, Rect.at(0, 0, 64, 64)) - CLEAR.data).max() < 1e-6
    assert (made.cover.appearance(5, rect) == seen[3:]).all()
    small = instance("matched", {"period": 16}, 5, 0, CLEAR)
    for level in (5, 6):
        fine = small.appearance(level + 1, rect.zoomed(1))
        assert np.abs(small.appearance(level, rect) - reduce(fine)).max() < 5e-5
    assert made.cover.cover is None
    assert instance("matched", {}, 5, 0, GRANITE).cover is None


def test_detail_of_colours_and_alpha_goes_together():
    """Where the picture is opaque by its colours, detail of alpha follows that of the colours as in the picture."""
    made = instance("matched", {"roughness": octave_of(CLEAR).slope}, 0, 0, CLEAR)
    rect = Rect.at(0, 0, 256, 256)
    for level in (1, 2):
        colour, alpha = made.bandpass(level, rect), made.cover.bandpass(level, rect)
        together = np.corrcoef(colour.mean(0).ravel(), alpha.ravel())[0, 1]
        own = [np.diff(CLEAR.data[part], axis=-1).mean(0).ravel() for part in (slice(0, 3), slice(3, 4))]
        assert together == pytest.approx(np.corrcoef(*own)[0, 1], abs=0.12)
        assert together > 0.5
    deep = made.appearance(9, Rect.at(3**40, 5, 256, 256))
    assert deep[:3].std() > 0.02
    assert deep[3].std() > 0.02


@pytest.mark.parametrize("roughness", [0.3, 0.6, 0.85])
def test_beyond_its_pixels_it_is_a_picture_all_the_same(roughness):
    made = instance("matched", {"period": 40, "roughness": roughness}, 0, 0, CLEAR)
    for level in (1, 2, 3, 6, 40):
        seen = made.appearance(level, Rect.at(77, 5, 160, 128))
        assert -1e-6 < seen[:3].min() <= seen[:3].max() < 1.0 + 1e-6
        assert (seen[:3] <= seen[3] + 1e-6).all()
        assert (made.cover.appearance(level, Rect.at(77, 5, 160, 128)) == seen[3:]).all()
    native = made.appearance(made.native, Rect.at(0, 0, 80, 80))[3]
    finer, rect = made.native + 1, Rect.at(0, 0, 160, 160)
    for opaque in (0.0, 1.0):  # where there is no rim, most of the noise stays away
        there = np.repeat(np.repeat(native == opaque, 2, axis=0), 2, axis=1)
        seen, noisy = (
            np.abs(planes[-1][there] - opaque).mean()
            for planes in (made.appearance(finer, rect), Tiled.appearance(made.cover, finer, rect) / 2 + 0.5)
        )
        assert seen < 0.45 * noisy


def test_a_series_may_begin_opaque():
    made = [instance("series", {"stages": 3, "weight": w}, 0, 0, PARTLY) for w in weights(3)]
    rect = Rect.at(0, 0, 96, 80)
    assert np.abs(made[0].cover.appearance(3, rect) - 1).max() < 1e-6
    assert made[0].cover.bandpass(3, rect) is None or np.abs(made[0].cover.bandpass(3, rect)).max() < 1e-6
    assert made[2].cover.appearance(3, rect).std() > 0.1


def test_keys_come_back():
    pictures = (("matched", GRANITE), ("series", BOTH), ("matched", CLEAR), ("series", PARTLY))
    for kind, picture in pictures:
        made = instance(kind, {"period": 20, "roughness": 0.3, "stages": 3, "weight": 0.25}, 2, 0, picture)
        if made.cover is not None:
            cover = from_key(made.cover.key, {picture.sha: picture})
            assert cover == made.cover
            assert cover != made
            assert (cover.appearance(4, Rect.at(3, 4, 9, 9)) == made.appearance(4, Rect.at(3, 4, 9, 9))[3:]).all()
            assert not from_key(made.cover.key, {}).appearance(4, Rect.at(3, 4, 9, 9)).any()
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
