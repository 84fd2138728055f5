"""Textures of other makers by their names within a text: what they are at any place, as wide as a sample is."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.texture.expression.defined import expression
from engine.texture.expression.naming.bound import bound_anew
from engine.texture.expression.naming.elsewhere import Elsewhere, unit_of
from engine.texture.image import Image, ImageSource
from engine.texture.record import pictures_of
from engine.texture.shaped import shaped
from engine.texture.table import from_key, instance

PIXELS = np.random.default_rng(3).random((4, 20, 32), np.float32)
PICTURE = ImageSource.of("a", np.ascontiguousarray(np.concatenate([PIXELS[:3] * PIXELS[3:], PIXELS[3:]])))


def textures():
    """Gives one of each kind of maker: endless, with edges, tiled, of a picture, bent, written."""
    made = {kind: instance(kind, {"seed": 4}, 0, 0, arithmetic=EVERYWHERE) for kind in ("rock", "squares")}
    made["image"] = Image(0, 32, PICTURE)
    made["bent"] = shaped(made["rock"], ((0.0, 0.0), (0.4, 1.0), (1.0, 0.2)))
    made["matched"] = instance("matched", {}, 0, 0, PICTURE, EVERYWHERE)
    bound = {name: bound_anew(one) for name, one in made.items()}
    return bound | {"text": expression({"text": 'noise(x*4, y*4) + 0.2*"rock"()', "named": {"rock": bound["rock"]}}, 0)}


NAMED = textures()
TEXTS = (
    '"rock"(x, y)', '"image"(x*3, y*3)', '"matched"(y, 0-x)', '"bent"(x + 0.2*noise(x*3, y*3), y)',
    'warp("squares"(x, y), 0.1*"rock"(), 0)',
    'rotate("image"(), 30)', 'scale("text"(), 2)', 'smoothstep(0.4, 0.6, "rock"())',
    'repeat("image"(x + random(1), y), 3, 5, 0.3)', '"rock"("rock"(x, y)*3, y/9)', '"rock"(1e300*x, 0/0)',
    '"image"(white(x*9, y*9)*1e9, 1/x)', '"squares"(0.25, 0.25)', 'relief("rock"(x, y))', '"image"(x*1e-30, y*1e30)',
)  # fmt: skip


def made_of(text, **told):
    return expression({"text": text, "named": NAMED, **told}, -40)


@pytest.mark.parametrize("name", ["rock", "squares", "image", "matched", "bent"])
def test_a_texture_as_it_is_has_the_pixels_of_its_own_maker(name):
    made, unit, rect = made_of(f'"{name}"(x, y)'), unit_of(NAMED[name]), Rect(-70, 33, 90, 64)
    for level in (0, 2):
        finer = level + {16: 2, 64: 0}[unit]  # of 64 pixels a period
        own = NAMED[name].appearance(finer, rect)
        assert np.abs(made.means(level, rect) - own).max() <= 2.0**-22


def test_a_third_value_tells_which_of_a_series_it_is():
    source = ImageSource.of("two", np.ascontiguousarray(PIXELS[:, :16]))
    named = {"both": bound_anew(instance("series", {"stages": 2, "period": 16}, 0, 0, source, EVERYWHERE))}
    rect, level = Rect(-9, 3, 40, 20), 2 if unit_of(named["both"]) == 16 else 0
    for told, weight in (("", 0.0), (", 0.25", 0.25), (", 0.2 + 0.8*clamp(pressure, 0, 1)", 1.0)):
        made = expression({"text": f'"both"(x, y{told})', "named": named}, -40)
        own = replace(named["both"], weight=weight).appearance(0, rect)
        assert np.abs(made.means(level, rect) - own).max() <= 2.0**-22
    for text, expected in (
        ('"rock"(x, y, 1)', "no series"), ('"moss"(x, y, 1)', "no series"), ('"both"(x, y, x)', "one that does not"),
        ('"both"(x, y, 2)', "a number from 0 to 1"), ('"both"(x, y, 0, 0)', "or an operator"),
    ):  # fmt: skip
        with pytest.raises(FieldError, match=expected):
            expression({"text": text, "named": NAMED | named}, -40)


@pytest.mark.parametrize("text", TEXTS)
def test_what_is_seen_hangs_on_the_place_alone(text):
    made = made_of(text, period=48.0)
    for level, left, top in ((-5, -30, 40), (11, 3 << 11, -5 << 11)):
        whole = Rect.at(left, top, 70, 9)
        seen = made.appearance(level, whole)
        assert np.isfinite(seen).all()
        for piece in (Rect.at(left + 37, top + 3, 5, 6), Rect.at(left + 1, top, 68, 1)):
            assert (made.appearance(level, piece) == seen[:, *piece.slices(whole)]).all()


@pytest.mark.parametrize("text", ['"image"(x*3, y*3)', 'rotate("squares"(), 30)', '"image"(x*7, y*0.6)'])
def test_a_level_is_the_mean_of_the_finer_one(text):
    made, rect = made_of(text), Rect(5, 7, 45, 47)
    for level in (-7, -4, -1, 1, 5):
        fine = made.means(level + 1, rect.zoomed(1))
        apart = fine.reshape(len(fine), 40, 2, 40, 2).mean(axis=(2, 4)) - made.means(level, rect)
        assert np.sqrt(np.square(apart).mean()) < 6.0 / 255.0


@given(st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 2, st.floats(1e-12, 1e3)), min_size=1, max_size=30), st.randoms())
@settings(max_examples=25)
def test_samples_do_not_hang_on_one_another(asked, order):
    one = Elsewhere(NAMED["image"], unit_of(NAMED["image"]))
    u, v, width = np.array(asked).T
    seen = one.seen(u, v, width)
    which = list(range(len(asked)))
    order.shuffle(which)
    assert (one.seen(u[which], v[which], width[which]) == seen[:, which]).all()
    assert ((seen >= -1e-6) & (seen <= 1.0 + 1e-6)).all()


def test_a_key_tells_all_of_it_and_its_pictures():
    made = made_of('"image"() + "text"()', values={})
    told = json.loads(json.dumps(made.key))
    assert pictures_of(made) == (PICTURE, PICTURE)
    again = from_key(told, {PICTURE.sha: PICTURE})
    assert again == made
    assert hash(again) == hash(made)
    lost = from_key(told, {}).appearance(0, Rect(0, 0, 3, 3))
    assert np.isfinite(lost).all()
