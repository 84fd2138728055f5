"""Blend kernels against the formulas of the W3C specification, written out plainly on straight float64 colours."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.blend import BLENDS, blend, flat, opaque, place
from engine.numeric.grid import snapped

TOLERANCE = 1e-5


# --- W3C Compositing and Blending Level 1, section 10.1: B(Cb, Cs) per channel ---------------------------------------


def multiply(cb, cs):
    return cb * cs


def screen(cb, cs):
    return cb + cs - cb * cs


def hard_light(cb, cs):
    return np.where(cs <= 0.5, multiply(cb, 2 * cs), screen(cb, 2 * cs - 1))


def color_dodge(cb, cs):
    quotient = np.divide(cb, 1 - cs, out=np.ones_like(cb), where=cs < 1)
    return np.where(cb == 0, 0.0, np.where(cs == 1, 1.0, np.minimum(1, quotient)))


def color_burn(cb, cs):
    quotient = np.divide(1 - cb, cs, out=np.ones_like(cb), where=cs > 0)
    return np.where(cb == 1, 1.0, np.where(cs == 0, 0.0, 1 - np.minimum(1, quotient)))


def soft_light(cb, cs):
    d = np.where(cb <= 0.25, ((16 * cb - 12) * cb + 4) * cb, np.sqrt(cb))
    return np.where(cs <= 0.5, cb - (1 - 2 * cs) * cb * (1 - cb), cb + (2 * cs - 1) * (d - cb))


# --- section 10.2: non-separable, on (3, n) --------------------------------------------------------------------------


def lum(c):
    return 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2]


def clip_color(c):
    light, n, x = lum(c), c.min(0), c.max(0)
    with np.errstate(divide="ignore", invalid="ignore"):
        c = np.where(n < 0, light + (c - light) * light / (light - n), c)
        return np.where(x > 1, light + (c - light) * (1 - light) / (x - light), c)


def set_lum(c, light):
    return clip_color(c + (light - lum(c)))


def sat(c):
    return c.max(0) - c.min(0)


def set_sat(c, s):
    span = sat(c)
    return np.divide((c - c.min(0)) * s, span, out=np.zeros_like(c), where=span > 0)


SPECIFIED = {
    "multiply": multiply,
    "screen": screen,
    "overlay": lambda cb, cs: hard_light(cs, cb),
    "darken": np.minimum,
    "lighten": np.maximum,
    "color-dodge": color_dodge,
    "color-burn": color_burn,
    "hard-light": hard_light,
    "soft-light": soft_light,
    "difference": lambda cb, cs: np.abs(cb - cs),
    "color": lambda cb, cs: set_lum(cs, lum(cb)),
    "luminosity": lambda cb, cs: set_lum(cb, lum(cs)),
    "hue": lambda cb, cs: set_lum(set_sat(cs, sat(cb)), lum(cb)),
    "saturation": lambda cb, cs: set_lum(set_sat(cb, sat(cs)), lum(cb)),
}
PORTER_DUFF = {  # section 9.1: Fa, Fb
    "src-over": lambda sa, ba: (1, 1 - sa),
    "plus": lambda sa, ba: (1, 1),
    "dst-in": lambda sa, ba: (0, sa),
    "dst-out": lambda sa, ba: (0, 1 - sa),
    "src-atop": lambda sa, ba: (ba, 1 - sa),
    "dst-atop": lambda sa, ba: (1 - ba, sa),
}


def specified(op, backdrop, source, opacity):
    """The specification's result for premultiplied (4, n): un-premultiply, blend, composite, premultiply."""
    backdrop, source = backdrop.astype(np.float64), source.astype(np.float64)
    ba, sa = backdrop[3], np.clip(source[3], 0, 1)
    cb = np.divide(backdrop[:3], ba, out=np.zeros_like(backdrop[:3]), where=ba > 0)
    cs = np.divide(np.clip(source[:3], 0, sa), sa, out=np.zeros_like(source[:3]), where=sa > 0)
    sa = sa * float(np.float32(opacity))
    if op in PORTER_DUFF:
        fa, fb = PORTER_DUFF[op](sa, ba)
    else:
        cs = (1 - ba) * cs + ba * SPECIFIED[op](cb, cs)
        fa, fb = PORTER_DUFF["src-over"](sa, ba)
    return np.minimum(1, np.vstack([sa * fa * cs + ba * fb * cb, (sa * fa + ba * fb)[None]]))


def result(op, backdrop, source, opacity=1.0):
    out = backdrop[:, None, :].copy()
    blend(op, out, source[:, None, :], opacity)
    return out[:, 0]


def premultiplied(straight):
    """Straight (4, n) to premultiplied on the grid, colour <= alpha."""
    planes = snapped(straight * np.vstack([straight[3:]] * 3 + [np.ones_like(straight[3:])]))
    planes[:3] = np.minimum(planes[:3], planes[3])
    return planes


def extremes():
    """Every pair of colours from {0, 1/4, 1/2, 1} per channel (thinned) at alpha 0, one step, between and 1."""
    values = np.array(list(itertools.product((0, 0.25, 0.5, 1), repeat=3))).T
    coloured = [np.vstack([values, np.full((1, values.shape[1]), a)]) for a in (0, 2.0**-16, 0.4, 1)]
    pixels = premultiplied(np.hstack(coloured))
    n = pixels.shape[1]
    first, second = np.divmod(np.arange(n * n), n)
    return np.ascontiguousarray(pixels[:, first]), np.ascontiguousarray(pixels[:, second])


channel = st.one_of(st.sampled_from([0.0, 2.0**-16, 0.5, 1 - 2.0**-16, 1.0]), st.floats(0, 1, width=32))
colour = st.tuples(channel, channel, channel, channel)


def test_the_table_holds_the_operators_of_openraster():
    assert len(BLENDS) == 20
    assert set(BLENDS) == set(SPECIFIED) | set(PORTER_DUFF)
    assert BLENDS["color-dodge"].op == "svg:color-dodge"
    assert len({row.label for row in BLENDS.values()}) == 20
    assert all(row.tooltip for row in BLENDS.values())


@pytest.mark.parametrize("op", BLENDS)
@pytest.mark.parametrize("opacity", [1.0, 0.37])
def test_extreme_colours_agree_with_the_specification(op, opacity):
    backdrop, source = extremes()
    assert np.abs(result(op, backdrop, source, opacity) - specified(op, backdrop, source, opacity)).max() <= TOLERANCE


@pytest.mark.parametrize("op", BLENDS)
@settings(deadline=None, max_examples=30)
@given(st.lists(st.tuples(colour, colour), min_size=1, max_size=20), st.sampled_from([0.0, 0.1, 0.75, 1.0]))
def test_any_colours_agree_with_the_specification(op, pairs, opacity):
    backdrop = premultiplied(np.array([b for b, _ in pairs]).T)
    source = premultiplied(np.array([s for _, s in pairs]).T)
    assert np.abs(result(op, backdrop, source, opacity) - specified(op, backdrop, source, opacity)).max() <= TOLERANCE


@pytest.mark.parametrize("op", BLENDS)
def test_random_colours_agree_and_stay_displayable(op):
    rng = np.random.default_rng(5)
    backdrop, source = (premultiplied(rng.random((4, 40000))) for _ in range(2))
    out = result(op, backdrop, source, 0.9)
    assert np.abs(out - specified(op, backdrop, source, 0.9)).max() <= TOLERANCE
    assert out.min() >= 0
    assert (out[:3] <= out[3]).all()
    assert out[3].max() <= 1


@pytest.mark.parametrize("op", BLENDS)
def test_source_is_clamped_as_for_display(op):
    wild = np.array([[2, -1, 0.5, np.nan, 3], [0.2, 0.9, -16, 0, 0], [16, 0.1, 0, 1, 0], [1.5, 0.5, -2, 0.5, np.nan]])
    wild = wild.astype(np.float32)
    tame = np.array([[1, 0, 0, 0, 0], [0.2, 0.5, 0, 0, 0], [1, 0.1, 0, 0.5, 0], [1, 0.5, 0, 0.5, 0]], np.float32)
    backdrop = premultiplied(np.full((4, 5), 0.6))
    assert np.array_equal(result(op, backdrop, wild), result(op, backdrop, tame))


@pytest.mark.parametrize("op", BLENDS)
def test_columns_outside_and_alone_say_what_the_kernel_does(op):
    row = BLENDS[op]
    rng = np.random.default_rng(1)
    some, none = premultiplied(rng.random((4, 500))), np.zeros((4, 500), np.float32)
    kept = result(op, some, none)
    assert np.array_equal(kept, none if row.outside else some)
    placed = np.empty_like(some)
    place(placed, flat(some), np.float32(0.3))
    assert np.array_equal(result(op, none, some, 0.3), placed if row.alone else none)


@pytest.mark.parametrize("op", ["src-over", "multiply", "color-dodge", "luminosity"])
def test_a_pixel_does_not_depend_on_its_neighbours(op):
    """Vectorised body and scalar remainder of the loop give the same bits."""
    rng = np.random.default_rng(2)
    backdrop, source = (premultiplied(rng.random((4, 101))) for _ in range(2))
    whole = result(op, backdrop, source, 0.7)
    single = [result(op, backdrop[:, i : i + 1].copy(), source[:, i : i + 1].copy(), 0.7) for i in range(101)]
    assert np.array_equal(whole, np.hstack(single))


def test_white_and_black_survive_translucent_layers_exactly():
    """Burn and dodge jump at white and black, so layers below may not leave them off by a rounding error."""
    rng = np.random.default_rng(3)
    alphas = snapped(rng.random((6, 1000)))
    white, black = np.zeros((4, 1, 1000), np.float32), np.zeros((4, 1, 1000), np.float32)
    for op, a in zip(["src-over", "screen", "src-over", "lighten", "hard-light", "src-over"], alphas, strict=True):
        blend(op, white, np.broadcast_to(a, (4, 1, 1000)), 0.77)
        blend(op, black, np.stack([0 * a, 0 * a, 0 * a, a])[:, None], 0.77)
    ink = np.zeros((4, 1, 1000), np.float32)
    ink[3] = 1
    before = white.copy()
    blend("color-burn", white, ink)
    assert np.allclose(white[:3], before[3], atol=1e-6)
    blend("color-dodge", black, np.ones((4, 1, 1000), np.float32))
    uncovered = np.prod(1 - 0.77 * alphas.astype(np.float64), axis=0)
    assert np.allclose(black[:3], uncovered, atol=1e-5)


def test_opaque_looks_at_every_pixel():
    planes = np.ones((4, 5000), np.float32)
    assert opaque(flat(planes[:, None]))
    for i in (0, 1023, 1024, 4999):
        planes[3, i] = 1 - 2.0**-16
        assert not opaque(flat(planes[:, None]))
        planes[3, i] = 1


def test_errors_say_what_was_found_and_expected():
    block = np.zeros((4, 2, 3), np.float32)
    with pytest.raises(ValueError, match=r"found 'svg:over', expected one of src-over, multiply"):
        blend("svg:over", block, block)
    with pytest.raises(ValueError, match=r"expected \(4, h, w\)"):
        blend("plus", block, block[:, :1])
    with pytest.raises(ValueError, match="expected C-contiguous float32"):
        blend("plus", block.transpose(0, 2, 1), np.zeros((4, 3, 2), np.float32))
