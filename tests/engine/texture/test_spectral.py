"""Spectral textures: functions of place at every level, with their sample's spectrum, that never run out of detail."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from skimage import data as photographs

from engine.brush.ink import resolve
from engine.brush.parts import Component
from engine.brush.settings import Brush
from engine.numeric.address import Rect, TileKey
from engine.numeric.detail import add_expanded, parents
from engine.numeric.grid import snapped
from engine.numeric.pyramid import reduce
from engine.numeric.shapes import drawn
from engine.numeric.spectra import SPREAD, power, radial_mean, radial_window, texture_of
from engine.texture.image import ImageSource
from engine.texture.octaves import Continuation, octave_changes, octave_weights
from engine.texture.table import TextureError, from_key, instance

ORIGINS = st.one_of(st.integers(-300, 300), st.integers(-(2**90), 2**90), st.just((1 << 40) - 20))


def source(texture, name="sample"):
    """A texture of nominal range -1..1, (h, w) or (3, h, w), as a picture."""
    s = np.clip(np.broadcast_to(texture, (3, *texture.shape[-2:])) * 0.5 + 0.5, 0.0, 1.0)
    return ImageSource.of(name, snapped(np.concatenate([s, np.ones_like(s[:1])]).astype(np.float32)))


RING = source(texture_of(drawn("ring", (40, 48), {"frequency": 0.25}), 1))
NOISE = source(texture_of(drawn("noise", (64, 64), {"b": 1.5}), 2))
COLOURS = source(texture_of(np.random.default_rng(1).random((3, 21, 33)), 4))
SOURCES = {"ring": RING, "noise": NOISE, "colours": COLOURS}


@st.composite
def textures(draw):
    kind = draw(st.sampled_from(["spectrum", "sparse"]))
    parameters = {
        "period": draw(st.sampled_from([4, 7, 20, 48, 64, 500])),
        "roughness": draw(st.sampled_from([0.0, 0.05, 0.3, 0.7, 1.0])),
        "density": draw(st.floats(0.5, 20.0)),
        "mean": draw(st.floats(-1.0, 1.0)),
        "quantise": draw(st.sampled_from([0, 3])),
    }
    return instance(kind, parameters, -3, 9, SOURCES[draw(st.sampled_from(sorted(SOURCES)))])


def expand(p):
    """E of (c, h + 2, w + 2) in float64, by its definition."""
    out = np.empty((p.shape[0], 2 * p.shape[1] - 4, 2 * p.shape[2] - 4))
    c = p[:, 1:-1, 1:-1]
    for r, v in enumerate((p[:, :-2], p[:, 2:])):
        for s, h in enumerate((slice(0, -2), slice(2, None))):
            out[:, r::2, s::2] = (9 * c + 3 * v[:, :, 1:-1] + 3 * p[:, 1:-1, h] + v[:, :, h]) / 16
    return out


@settings(deadline=None, max_examples=60)
@given(textures(), ORIGINS, ORIGINS, st.sampled_from([0, 1, 2, 3, 5, 9, 14, 60]), st.data())
def test_any_rectangle_holds_the_same_bits(made, x, y, up, data):
    whole = Rect.at(x, y, 61, 50)
    a, b = sorted(data.draw(st.lists(st.integers(0, 61), min_size=2, max_size=2, unique=True)))
    c, d = sorted(data.draw(st.lists(st.integers(0, 50), min_size=2, max_size=2, unique=True)))
    part = Rect(x + a, y + c, x + b, y + d)
    rows, columns = part.slices(whole)
    for values in (made.appearance, made.bandpass):
        big, small = values(up - 3, whole), values(up - 3, part)
        if big is None:
            assert small is None
        elif small is None:
            assert not big[:, rows, columns].any()
        else:
            assert (small == big[:, rows, columns]).all()
            assert small.dtype == np.float32
            assert small.flags.c_contiguous
            assert small.shape[0] == (3 if made.coloured else 1)


@settings(deadline=None, max_examples=60)
@given(textures(), ORIGINS, ORIGINS, st.sampled_from([1, 2, 3, 4, 7, 12, 30, 60]))
def test_bandpass_is_what_expand_leaves_out(made, x, y, up):
    rect = Rect.at(x, y, 40, 36).evened()
    coarse = made.appearance(up - 4, parents(rect)).astype(np.float64)
    added = made.bandpass(up - 3, rect)
    fine = made.appearance(up - 3, rect)
    assert np.abs(expand(coarse) + (0 if added is None else added) - fine).max() < 2e-5 * max(1, np.abs(fine).max())


@pytest.mark.parametrize("kind", ["spectrum", "sparse"])
@pytest.mark.parametrize("name", sorted(SOURCES))
def test_down_to_the_samples_own_pixels_each_level_is_the_mean_of_the_next(kind, name):
    made = instance(kind, {"period": 12}, 0, 1, SOURCES[name])
    assert 1 <= made.native <= 3
    rect = Rect.at(-30, 17, 50, 40)
    for level in range(made.native):
        fine = made.appearance(level + 1, rect.zoomed(1))
        assert np.abs(made.appearance(level, rect) - reduce(fine)).max() < 5e-5


def test_the_tile_is_the_sample_and_repeats():
    made = instance("spectrum", {}, 5, 0, NOISE)
    assert np.abs(made.appearance(5, Rect.at(0, 0, 64, 64)) - (2 * NOISE.data[:1] - 1)).max() < 1e-6
    a, b = (made.appearance(5, Rect.at(x, y, 30, 20)) for x, y in ((7, 9), (7 + 64 * 3, 9 - 64)))
    assert (a == b).all()
    own = instance("spectrum", {}, 5, 0, COLOURS).appearance(5, Rect.at(0, 0, 33, 21))
    assert np.abs(own - (2 * COLOURS.data[:3] - 1)).max() < 1e-6


@pytest.mark.parametrize("quantise", [0, 2])
@pytest.mark.parametrize("name", sorted(SOURCES))
def test_mean_and_spread_are_those_asked_for(name, quantise):
    made = instance("sparse", {"mean": 0.25, "spread": 0.5, "quantise": quantise}, 0, 5, SOURCES[name])
    found = made.appearance(0, Rect.at(50, -900, 1024, 1024))
    own = (2 * SOURCES[name].data[:3] - 1).mean((1, 2)) if made.coloured else 0.0
    assert np.abs(found.mean((1, 2)) - own - 0.25).max() < 0.02
    assert abs(np.sqrt(found.var((1, 2)).mean()) / (0.5 * SPREAD) - 1) < 0.05


def samples():
    size = (256, 256)
    gravel = photographs.gravel()[:256, :256].astype(np.float32) / 127.5 - 1.0
    return {
        "ring": texture_of(np.maximum(drawn("ring", size, {"frequency": 0.2, "width": 0.15}), 0.01), 1),
        "wedge": texture_of(np.maximum(drawn("wedge", size, {"spread": 30.0}), 0.02), 2),
        "1/f": texture_of(drawn("noise", size, {"b": 1.0, "from": 0.0, "to": 1.5}), 3),
        "1/f^2": texture_of(drawn("noise", size, {"b": 2.0, "from": 0.0, "to": 1.5}), 4),
        "gravel": gravel,
    }


@pytest.mark.parametrize("name", ["ring", "wedge", "1/f", "1/f^2", "gravel"])
def test_the_field_has_the_spectrum_of_its_sample(name):
    """Over two decades of frequency (Lewis 1984, section 5.2)."""
    sample = samples()[name]
    made = instance("sparse", {}, 0, 3, source(sample))
    window = radial_window(512)
    views = [made.appearance(0, Rect.at(x << 20, 5, 512, 512))[0] * window for x in range(12)]
    where, field = radial_mean(np.mean([power(view) for view in views], axis=0))
    window = radial_window(256)
    laid = np.zeros((512, 512))
    laid[:256, :256] = (sample - (sample * window).sum() / window.sum()) * window
    _, own = radial_mean(power(laid))
    rings = where >= 0.0039
    assert where[rings][-1] / where[rings][0] >= 100
    assert np.corrcoef(np.log(field[rings]), np.log(own[rings]))[0, 1] > 0.97
    # Spectra that fall at another rate correlate as well: no ring may be far off either.
    ratio = np.log(field[rings] / own[rings])
    assert np.abs(ratio - ratio.mean()).max() < 0.8


@pytest.mark.parametrize("kind", ["spectrum", "sparse"])
@pytest.mark.parametrize("name", sorted(SOURCES))
def test_detail_never_ends(kind, name):
    """Each level adds detail, and views at all depths keep their contrast; smooth textures end where they said."""
    made = instance(kind, {"roughness": 0.5}, 0, 3, SOURCES[name])
    for level in (1, 2, 4, 7, 11, 16, 25, 60, 300):
        x = (3**200 >> 100) << level >> 60
        view = [made.appearance(level, Rect.at(x + (k << 40), 5, 256, 256)) for k in range(3)]
        assert np.sqrt(np.var([v - v.mean((1, 2), keepdims=True) for v in view])) > 0.07
        assert np.sqrt(np.square(view).mean()) < 1.5
        assert np.abs(made.bandpass(level, Rect.at(x, 5, 64, 64))).max() > 1e-3
    smooth = instance(kind, {"roughness": 0.0}, 0, 3, SOURCES[name])
    assert smooth.bandpass(1, Rect.at(0, 0, 64, 64)) is None


@settings(deadline=None, max_examples=60)
@given(st.floats(0, 1), st.floats(0.001, 1), st.floats(1, 9), st.floats(1, 9), st.integers(1, 200))
def test_weights_of_octaves(roughness, strength, scale, octave, depth):
    form = Continuation(strength, scale, octave)
    weights = octave_weights(depth, roughness, form).astype(np.float64)
    if depth <= form.settled:
        assert np.allclose(weights[::-1], roughness ** np.arange(depth + 1), atol=2**-11)
    before, changes = octave_weights(depth - 1, roughness, form), octave_changes(depth, roughness, form)
    assert changes.size <= 40
    for m in range(max(weights.size, before.size + 1)):
        now, then = (w[k] if 0 <= k < w.size else 0.0 for w, k in ((weights, m), (before, m - 1)))
        assert abs((changes[m] if m < changes.size else 0.0) - (now - then)) < 1e-6 * max(1.0, abs(now), abs(then))
    whole = weights[depth] if weights.size > depth else 0.0
    if roughness >= 0.125:
        spread = np.sqrt(whole**2 + strength**2 * (weights[:depth] ** 2).sum())
        first = np.sqrt(1 + strength**2 * sum(roughness ** (2 * j) for j in range(1, form.settled + 1)))
        assert spread < first * 1.01


@pytest.mark.parametrize("kind", ["spectrum", "sparse", "matched"])
def test_textures_that_last_keep_their_octaves_at_any_depth(kind):
    """Each level adds an octave r times as strong as the one before, and changes nothing that was there."""
    made, usual = (instance(kind, {"roughness": 0.4, "renew": renew}, 0, 3, NOISE) for renew in (False, True))
    assert made.key != usual.key
    assert from_key(json.loads(json.dumps(made.key)), {NOISE.sha: NOISE}) == made
    deep = made.native + 12
    levels = range(made.native + 1, deep + 14, 3)
    sizes = [made.bandpass(level, Rect.at(700 << level, 300 << level, 64, 64)).std() for level in levels]
    assert np.allclose(np.diff(np.log2(sizes)) / 3, np.log2(0.4), atol=0.1)
    rect = Rect.at(700 << deep, 300 << deep, 32, 32)
    carried = np.zeros_like(made.appearance(deep, rect))
    add_expanded(carried, made.appearance(deep - 1, parents(rect)) - made.centre)
    assert np.allclose(made.appearance(deep, rect), carried + made.centre + made.bandpass(deep, rect), atol=1e-5)


def test_renewing_is_a_matter_of_yes_and_no():
    with pytest.raises(TextureError, match='renew: found "no", expected true or false'):
        instance("rock", {"renew": "no"}, 0, 3)
    with pytest.raises(TextureError, match="lasting stripes"):
        from_key(["lasting stripes", 0, 32.0, 0.0, 0.0], {})


def test_seeds_differ_and_the_sample_lost_is_flat():
    rect = Rect.at(0, 0, 200, 200)
    a, b = (instance("sparse", {"seed": k}, 0, 0, NOISE).appearance(0, rect) for k in (1, 2))
    assert abs(np.corrcoef(a.ravel(), b.ravel())[0, 1]) < 0.3
    for kind in ("spectrum", "sparse"):
        lost = instance(kind, {"period": 64}, 0, 0, ImageSource("gone", "00"))
        assert not lost.appearance(3, rect).any()
        assert lost.bandpass(3, rect) is None
        flat = instance(kind, {}, 0, 0, source(np.full((20, 30), 0.25)))
        assert np.ptp(flat.appearance(4, rect)) < 1e-5


def test_mixed_with_rock_in_one_brush():
    """Each instance has its amplitude; a coloured one takes the place of the brush's colour."""
    parts = (
        Component("pebbles", 0.5, "#ffffff", {"period": 64}),
        Component("rock", 0.4, "#000000"),
        Component("leaves", 0.25, "#ff8000"),
    )
    brush = Brush(colour="#804020", ink=parts)
    defined = {"pebbles": _Defined("sparse", NOISE), "leaves": _Defined("spectrum", COLOURS)}
    ink = resolve(brush, defined, 2, 7)
    assert [made.key[0] for made in ink.inks] == ["rock", "sparse", "spectrum"]
    key = TileKey(2, -5, 3)
    under = np.array(brush.rgb)[:, None, None]
    expected = under.copy() + 0.0
    for made, amount, to in (
        (ink.inks[1], 0.5, 1.0),
        (ink.inks[0], 0.4, 0.0),
        (ink.inks[2], 0.25, np.array([1.0, 128 / 255, 0.0])[:, None, None]),
    ):
        s = (made.appearance(2, key.rect) + 1.0) / 2.0
        expected = expected + (amount * (s * to - under) if made.key[0] == "spectrum" else amount * s * (to - under))
    assert np.abs(ink.field(key) - expected).max() < 1e-5


class _Defined:
    def __init__(self, kind, picture):
        self.kind, self.picture = kind, picture

    def instance(self, parameters, level, seed):
        return instance(self.kind, parameters, level, seed, self.picture)
