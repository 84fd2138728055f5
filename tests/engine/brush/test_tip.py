"""Small brushes: dabs in the shape of a texture's sample, or of windows into its field."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.checks import BrushError
from engine.brush.mask import StrokeMask
from engine.brush.settings import from_json
from engine.brush.tip import resolve
from engine.numeric.address import TILE, Rect
from engine.numeric.grid import snapped
from engine.numeric.shaping import shape, table
from engine.texture.grey import grey
from engine.texture.image import ImageSource
from engine.texture.table import instance

RNG = np.random.default_rng(4)
PHOTO = ImageSource.of("p", snapped(np.concatenate([RNG.uniform(0, 1, (3, 20, 40)), np.ones((1, 20, 40))])))
DABS = st.lists(
    st.tuples(
        st.floats(-150, 300),
        st.floats(-150, 300),
        st.one_of(st.floats(0, 3), st.floats(3, 150)),
        st.floats(0, 1),
        st.one_of(st.just(1.0), st.floats(0, 1)),
        st.floats(0, 1),
    ),
    min_size=1,
    max_size=8,
).map(lambda rows: np.array(rows, float))
TIPS = [
    {"texture": "rock"},
    {"texture": "photo"},
    {"texture": "rock", "from": "window", "shaping": "stretch", "period": 9},
]


def pattern(tip, radius=20.0, seed=3):
    return resolve(from_json({"radius": radius, "tip": tip}), {"photo": PHOTO}, 0, seed)


AROUND = Rect(-TILE, -TILE, 3 * TILE, 3 * TILE)


def laid(dabs, tip, rect=AROUND):
    mask = StrokeMask(0, (0, 0), tip=tip)
    mask.paint(dabs)
    out = np.zeros((rect.height, rect.width), np.float32)
    for key in rect.tiles(0):
        part = key.rect.intersect(rect)
        out[part.slices(rect)] = mask.coverage().on_grid(key)[part.slices(key.rect)]
    return out


@pytest.mark.parametrize("tip", TIPS)
@settings(deadline=None, max_examples=20)
@given(DABS, st.lists(st.integers(0, 8), max_size=4))
def test_any_portions_give_the_same_coverage_bit_for_bit(tip, dabs, cuts):
    made = pattern(tip)
    whole, parts = StrokeMask(0, (0, 0), tip=made), StrokeMask(0, (0, 0), tip=made)
    whole.paint(dabs)
    for part in np.split(dabs, sorted(cuts)):
        parts.paint(part)
        parts.coverage()
    assert whole.rect == parts.rect
    for key in set(whole.coverage().tiles) | set(parts.coverage().tiles):
        assert whole.coverage().on_grid(key).tobytes() == parts.coverage().on_grid(key).tobytes()


@pytest.mark.parametrize("tip", TIPS)
def test_a_dab_is_within_the_plain_one(tip):
    dabs = np.array([[30.0, 40, 25, 0.9, 0.8, 0.5], [140, 60, 60, 1, 1, 1]])
    filled, plain = laid(dabs, pattern(tip)), laid(dabs, None)
    assert (filled <= plain + 2**-16).all()
    assert 0.1 < filled.sum() / plain.sum() < 0.9
    assert filled[plain > 0.5].std() > 0.05


def test_a_sample_is_laid_out_over_the_dab_at_any_size():
    made = pattern({"texture": "photo"}, 32)
    large = laid(np.array([[64.0, 64, 32, 1, 1, 1]]), made)
    large = large[TILE + 32 : TILE + 96, TILE + 32 : TILE + 96]
    y, x = np.mgrid[:64, :64] + 0.5
    inside = np.hypot(x - 32, y - 32) < 30
    square = made.planes[: 64 * 64].reshape(64, 64)
    np.testing.assert_allclose(large[inside], square[inside], atol=1e-3)
    assert not large[:15].any()  # the picture is twice as wide as high
    small = laid(np.array([[64.0, 64, 8, 1, 1, 1]]), made)[TILE + 56 : TILE + 72, TILE + 56 : TILE + 72]
    mean = square.reshape(16, 4, 16, 4).mean((1, 3))
    y, x = np.mgrid[:16, :16] + 0.5
    inside = np.hypot(x - 8, y - 8) < 7
    np.testing.assert_allclose(small[inside], mean[inside], atol=0.02)


def test_a_period_given_is_in_pixels_and_otherwise_the_sample_fills_the_dab():
    own = pattern({"texture": "stripes", "period": 8})
    np.testing.assert_allclose(
        own.planes[: 64 * 64].reshape(64, 64),
        np.clip(grey(instance("stripes", {"period": 8}, 0, 3), 0, Rect(0, 0, 64, 64)), 0, 1),
        atol=1e-5,
    )
    filling = pattern({"texture": "stripes"}).planes[: 64 * 64].reshape(64, 64)
    assert (filling[:, :32] == 1).all()
    assert (filling[:, 32:] == 0).all()


def test_every_window_is_a_piece_of_the_field_and_another_one():
    made = pattern({"texture": "rock", "from": "window", "period": 9, "shaping": "stretch"})
    field = grey(instance("rock", {"period": 9}, 0, 3), 0, Rect(0, 0, 512, 512))
    field = shape(field, table("stretch"))
    centres = [(20.0, 20.0), (80.0, 20.0), (140.0, 20.0)]
    seen = laid(np.array([[x, y, 16, 1, 1, 1] for x, y in centres]), made, Rect(0, 0, 180, 40))
    windows = [seen[12:28, int(x) - 8 : int(x) + 8] for x, _ in centres]
    places = []
    for window in windows:
        off = np.lib.stride_tricks.sliding_window_view(field, window.shape)
        near = np.abs(off[..., 5, 3] - window[5, 3]) + np.abs(off[..., 9, 12] - window[9, 12]) < 2e-4
        found = [p for p in np.argwhere(near) if np.abs(off[tuple(p)] - window).max() < 2e-4]
        assert found
        places.append(tuple(found[0]))
    assert len(set(places)) == 3


def test_windows_follow_the_seed_and_the_dabs_number():
    dabs = np.array([[64.0, 64, 20, 1, 1, 1], [64, 64, 20, 1, 1, 1]])
    tip = {"texture": "squares", "from": "window", "period": 9}
    one, again, other = (laid(dabs, pattern(tip, seed=s)) for s in (3, 3, 4))
    assert one.tobytes() == again.tobytes()
    assert one.tobytes() != other.tobytes()
    assert laid(dabs[:1], pattern(tip)).sum() < one.sum()


@pytest.mark.parametrize("radius", [0.0, 0.4, 3.0, 500.0, 4000.0])
@pytest.mark.parametrize("tip", TIPS)
def test_dabs_of_any_size(tip, radius):
    m = laid(np.array([[64.0, 64, radius, 1, 1, 0.5]]), pattern(tip, radius), Rect(0, 0, TILE, TILE))
    assert np.isfinite(m).all()
    assert m.min() >= 0
    assert m.max() <= 1
    assert (m.max() > 0) == (radius > 0)


def test_plain_brushes_have_no_pattern_and_bad_tips_are_named():
    assert resolve(from_json({}), {}, 0, 0) is None
    with pytest.raises(BrushError, match=r"brush\.tip\.texture"):
        pattern({"texture": "wool"})
