"""Textures sent through curves: still one texture at every level, sharp where the texture is."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.ink import resolve
from engine.brush.settings import from_json
from engine.numeric.address import Rect, TileKey
from engine.numeric.detail import parents, subtract_expanded
from engine.numeric.grid import snapped
from engine.numeric.shaping import shape, table
from engine.texture.image import ImageSource
from engine.texture.rock import Rock
from engine.texture.shaped import FADED, Shaped, shaped, unshaped
from engine.texture.table import SHAPED_CAP, TextureError, from_key, instance

RNG = np.random.default_rng(5)
ALPHA = np.clip(RNG.uniform(-0.5, 1.5, (9, 13)), 0, 1)
SOURCE = ImageSource.of("p", snapped(np.concatenate([RNG.uniform(0, 1, (3, 9, 13)) * ALPHA, ALPHA[None]])))
KINDS = ["rock", "stripes", "sawtooth", "squares", "image", "white"]
CURVES = st.sampled_from(["negate", "clip", "threshold", "steps", ((0.0, 0.2), (0.4, 1.0), (0.5, 0.0))])
FAR = 1 << 70


def made(kind, curve, base=0):
    return Shaped(instance(kind, {"period": 12}, base, 3, SOURCE), curve)


@settings(deadline=None, max_examples=60)
@given(
    st.sampled_from(KINDS), CURVES, st.integers(0, 9), st.integers(-60, 60), st.integers(-60, 60), st.integers(1, 40)
)
def test_each_level_adds_what_the_coarser_one_leaves_out(kind, curve, above, x, y, size):
    texture = made(kind, curve, -2)
    rect = Rect.at(x * FAR, y, size, 17)
    level = above - 2
    found = texture.bandpass(level, rect)
    even = rect.evened()
    plain = texture.appearance(level, even)[:3]
    if above:
        subtract_expanded(plain, texture.appearance(level - 1, parents(even))[:3])
    else:
        plain[:] = 0
    plain = plain[:, rect.y0 - even.y0 :, rect.x0 - even.x0 :][:, : rect.height, : rect.width]
    if found is None:
        assert not plain.any()
    else:
        assert found.tobytes() == np.ascontiguousarray(plain).tobytes()
    larger = texture.bandpass(level, rect.grown(5))
    if larger is not None and found is not None:
        assert larger[:, 5:-5, 5:-5].tobytes() == found.tobytes()


def test_the_appearance_is_the_curve_of_the_textures_own():
    rect = Rect.at(-5, 3, 40, 30)
    rock = instance("rock", {}, 2, 3)
    s = (rock.appearance(4, rect).astype(float) + 1) / 2
    expected = 2 * np.interp(np.clip(s, 0, 1), np.linspace(0, 1, 1025), table("threshold")) - 1
    np.testing.assert_allclose(Shaped(rock, "threshold").appearance(4, rect), expected, atol=1e-3)


def test_a_pictures_colours_are_bent_and_its_alpha_is_not():
    rect = Rect.at(0, 0, 26, 18)
    plain = instance("image", {}, 0, 0, SOURCE)
    seen, bent = plain.appearance(0, rect), Shaped(plain, "negate").appearance(0, rect)
    assert (bent[3] == seen[3]).all()
    np.testing.assert_allclose(bent[:3], seen[3] - seen[:3], atol=1e-6)
    assert Shaped(plain, "negate").source is SOURCE


def test_stripes_stay_sharp_far_down():
    curve = ((0.0, 0.25), (1.0, 1.0))
    texture = Shaped(instance("stripes", {"period": 8}, 0, 0), curve)
    level = 90
    rect = Rect.at((4 << level) - 8, 5, 16, 2)
    seen = texture.appearance(level, rect)[0, 0]
    np.testing.assert_allclose(seen, [1] * 8 + [-0.5] * 8)
    rebuilt = texture.bandpass(level, rect)
    assert np.abs(rebuilt).max() > 0.1
    assert texture.bandpass(level, rect.grown(-6)._replace(x0=rect.x0 - 100, x1=rect.x0 - 90)) is None


def test_a_picture_enlarged_far_has_nothing_to_add():
    texture = made("image", "threshold")
    levels = texture.inner.refinements + FADED
    rect = Rect.at(5 << levels, 5 << levels, 16, 16)
    last = texture.bandpass(levels, rect)
    assert last is None or np.abs(last).max() < 2.0**-16
    assert texture.bandpass(50_000, Rect.at(1 << 50_000, 3, 8, 8)) is None


@settings(deadline=None, max_examples=30)
@given(st.sampled_from(KINDS), st.lists(CURVES, min_size=1, max_size=SHAPED_CAP), st.integers(-50, 50))
def test_a_shaped_texture_comes_back_from_its_key(kind, curves, base):
    texture = shaped(instance(kind, {"period": 12}, base, 3, SOURCE), *curves)
    back = from_key(json.loads(json.dumps(texture.key)), {SOURCE.sha: SOURCE})
    assert back == texture
    assert hash(back) == hash(texture)
    assert back.key == texture.key
    assert back.base == base
    assert unshaped(back).key[0] == kind


WHITE = ["white", 0]


@pytest.mark.parametrize(
    ("key", "place"),
    [
        (["shaped", 0, "negate"], "key"),
        (["shaped", 0, "bend", WHITE], "curve"),
        (["shaped", 0, [], WHITE], "curve"),
        (["shaped", 0, [[0, 0], [0, 1]], WHITE], "curve"),
        (["shaped", 0, [[0, 2]], WHITE], "curve"),
        (["shaped", 0, [[0, True]], WHITE], "curve"),
        (["shaped", 0, [[float("nan"), 0]], WHITE], "curve"),
        (["shaped", 1, "negate", WHITE], "level"),
        (["shaped", None, "negate", WHITE], "level"),
        (["shaped", 0, "negate", "white"], "key"),
        (["shaped", 0, "negate", ["wool", 0]], "texture"),
    ],
)
def test_bad_keys_are_named(key, place):
    with pytest.raises(TextureError) as caught:
        from_key(key, {})
    assert caught.value.place == place
    assert "\n" not in str(caught.value)


def test_keys_nested_without_end_are_refused():
    key = WHITE
    for _ in range(100_000):
        key = ["shaped", 0, "negate", key]
    with pytest.raises(TextureError, match="nested"):
        from_key(key, {})


# ---- in a brush's ink -----------------------------------------------------------------------------------------------


def test_the_components_curve_comes_first_then_the_brushes():
    brush = from_json(
        {
            "colour": "#000000",
            "ink": [{"texture": "rock", "shaping": "power"}, {"texture": "stripes"}, {"texture": "white"}],
            "shaping": "compress",
        }
    )
    ink = resolve(brush, {}, 0, 1)
    rock, stripes = ink.inks
    assert rock == Shaped(Shaped(instance("rock", {}, 0, 1), "power"), "compress")
    assert stripes == Shaped(instance("stripes", {}, 0, 1), "compress")
    key = TileKey(0, 1, 2)
    s = (instance("rock", {}, 0, 1).appearance(0, key.rect) + 1) / 2
    t = (instance("stripes", {}, 0, 1).appearance(0, key.rect) + 1) / 2
    expected = shape(shape(s, table("power")), table("compress")) + shape(t, table("compress")) + 0.75
    np.testing.assert_allclose(ink.field(key)[0], expected[0], atol=1e-5)


def test_curves_that_change_nothing_leave_no_trace():
    plain = resolve(from_json({"ink": [{"texture": "rock"}]}), {}, 0, 1)
    given_ = from_json({"ink": [{"texture": "rock", "shaping": [[0, 0], [1, 1]]}], "shaping": "identity"})
    assert resolve(given_, {}, 0, 1).inks == plain.inks


def test_a_translucent_picture_hides_what_it_hid_before():
    brush = from_json({"colour": "#ff0000", "ink": [{"texture": "p", "shaping": "negate"}]})
    ink = resolve(brush, {"p": SOURCE}, 0, 0)
    key = TileKey(0, 0, 0)
    seen = instance("image", {}, 0, 0, SOURCE).appearance(0, key.rect)
    expected = np.array([1.0, 0, 0])[:, None, None] * (1 - seen[3]) + (seen[3] - seen[:3])
    np.testing.assert_allclose(ink.field(key), expected, atol=1e-5)


@pytest.mark.parametrize("curve", ["rectify", ((0.0, 0.1), (0.5, 1.0), (1.0, 0.1))])
def test_what_lasts_goes_on_where_differences_of_float32_end(curve):
    """Through a curve as through a straight line; nearby, that is what two appearances differ by."""
    made = Shaped(Rock(0, 40.0, 0.8, 5, renew=False), curve)
    level = 11
    rect = Rect.at(700 << level, 300 << level, 32, 32)
    fine = made.appearance(level, rect)
    subtract_expanded(fine, made.appearance(level - 1, parents(rect)))
    found = made.bandpass(level, rect)
    assert np.abs(found - fine).max() < 0.05 * np.abs(fine).max() + 2e-6
    part = Rect(rect.x0 + 5, rect.y0 + 3, rect.x1 - 4, rect.y1 - 7)
    assert np.array_equal(made.bandpass(level, part), found[:, *part.slices(rect)])
    sizes = [made.bandpass(k, Rect.at(700 << k, 300 << k, 32, 32)).std() for k in (20, 30)]
    assert np.log2(sizes[0] / sizes[1]) / 10 == pytest.approx(0.8, abs=0.1)
