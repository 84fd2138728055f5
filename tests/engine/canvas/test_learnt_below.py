"""What a region painted with an example shows below the example's own pixels, where its detail is learnt."""

import hashlib
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from planted import around, blob, disc

from engine.canvas import growth as growths
from engine.canvas.flatten import flattened
from engine.canvas.layers import Layer
from engine.canvas.reading import layer_planes
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.texture.example.exemplar import analysed, premultiplied, shrunk
from engine.texture.learnt.least_squares import maps_fitted
from engine.texture.learnt.maps import as_picture
from engine.texture.learnt.refinement import Learning

KINDS = ("opaque", "alpha", "alpha+1")
WHOLE = Rect.at(-40, -40, 110, 80)


@cache
def example(kind, octaves=2, learnt=True):
    name, _, detail = kind.partition("+")
    pixels = blob(1)
    if name == "opaque":
        pixels = np.ascontiguousarray(pixels[14:50, 14:50])
        pixels[..., 3] = 255
    found = shrunk(analysed(pixels), int(detail or 0))
    planes = np.ascontiguousarray(premultiplied(pixels).transpose(2, 0, 1))
    maps = as_picture("m", maps_fitted([planes[:3] if name == "opaque" else planes]))
    return replace(found, learning=Learning(maps, 1.0, octaves)) if learnt else found


def grown(kind, growth=(), at=(0, 0, 30), **how):
    x, y, radius = at
    laid = growths.laid(growth, 0.0, 0, kind, kind, example(kind, **how), 1, around(x, y, radius), disc(radius))
    return growths.settled(laid)


@pytest.fixture(scope="module")
def plots():
    return {kind: grown(kind) for kind in KINDS}


@settings(deadline=None, max_examples=12)
@given(
    kind=st.sampled_from(KINDS),
    level=st.integers(1, 4),
    x=st.integers(0, 200),
    y=st.integers(0, 200),
    w=st.integers(1, 70),
    h=st.integers(1, 70),
)
def test_any_rectangle_shows_the_same_bits(plots, kind, level, x, y, w, h):
    whole = Rect.at((-35 << level) + x, (-35 << level) + y, 90, 80)
    part = Rect.at(whole.x0 + x % 20, whole.y0 + y % 20, min(w, 70), min(h, 60))
    big, small = (growths.planes(plots[kind], level, rect) for rect in (whole, part))
    nothing = np.zeros((4, whole.height, whole.width), np.float32)
    big = nothing if big is None else big
    small = nothing[:, *part.slices(whole)] if small is None else small
    assert np.array_equal(small, big[:, *part.slices(whole)])


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_sharper_below_its_own_pixels_and_the_same_above(plots, kind):
    plain = grown(kind, learnt=False)
    own = len(example(kind).finer)
    for level in (-1, 0, own):
        rect = WHOLE.zoomed(level)
        assert np.array_equal(growths.planes(plots[kind], level, rect), growths.planes(plain, level, rect))
    for octave in (1, 2):
        rect = Rect.at(-12, -12, 24, 24).zoomed(own + octave)
        found, soft = (growths.planes(growth, own + octave, rect) for growth in (plots[kind], plain))
        steps = [np.abs(np.diff(one[:3], axis=2)).mean() for one in (found, soft)]
        assert steps[0] > 1.1 * steps[1]
        assert (found[:3] <= found[3] + 1e-6).all()
        four = found.reshape(4, found.shape[1] // 2, 2, found.shape[2] // 2, 2).mean(axis=(2, 4))
        assert np.abs(four - growths.planes(plots[kind], own + octave - 1, rect.zoomed(-1))).max() < 3e-5
    below = growths.planes(plots[kind], own + 3, rect.zoomed(1))  # smooth from there on
    assert np.abs(np.diff(below[:3], axis=2)).mean() < 0.7 * steps[0]


def test_an_outline_is_as_opaque_as_it_was(plots):
    """That of an opaque example is what it is without; in one with alpha, four pixels are as much as the one above."""
    rect = Rect.at(-80, -80, 160, 160)
    found, plain = (growths.planes(one, 1, rect) for one in (plots["opaque"], grown("opaque", learnt=False)))
    assert np.array_equal(found[3], plain[3])
    faint = (found[3] < 0.9) & (found[3] > 0.2)
    assert abs(found[:3][:, faint].mean() / plain[:3][:, faint].mean() - 1.0) < 0.1
    four = growths.planes(plots["alpha"], 1, rect).reshape(4, 80, 2, 80, 2).mean(axis=(2, 4))
    assert np.abs(four - growths.planes(plots["alpha"], 0, rect.zoomed(-1))).max() < 3e-5


@pytest.mark.parametrize("kind", KINDS)
def test_what_changes_is_told(plots, kind):
    more = grown(kind, plots[kind], (34, 0, 9))
    for level in (0, 1, 2, 3):
        rect = WHOLE.zoomed(level)
        differs = (growths.planes(plots[kind], level, rect) != growths.planes(more, level, rect)).any(axis=0)
        for changed in growths.changed_rects(plots[kind], more, level):
            both = changed.intersect(rect)
            if not both.empty:
                differs[both.slices(rect)] = False
        assert not differs.any()


@pytest.mark.parametrize("kind", KINDS)
def test_flattened_it_looks_the_same_as_far_as_that_is_not_too_much(plots, kind, monkeypatch):
    layer = Layer(1, "A", pyramid=Pyramid(), growth=plots[kind])
    own, inner = len(example(kind).finer), Rect.at(-12, -12, 24, 24)
    for most, finest in ((1 << 25, own + 2), (0, own)):
        monkeypatch.setattr(growths, "_MOST_LEARNT", most)
        flat = flattened(layer)
        assert flat.pyramid.finest == finest
        for level in range(own, finest + 1):
            there = (inner if kind == "opaque" and level > own else Rect.at(-35, -35, 70, 70)).zoomed(level)
            seen, paint = (layer_planes(one, level, there)[:4] for one in (layer, flat))
            assert np.abs(seen - paint).max() < (1e-9 if level == finest else 6e-5)


PIXELS = {"opaque": "b392df7b181e34e1", "alpha": "7cd1993cbf6827ee", "alpha+1": "bccce631073e1b43"}


@pytest.mark.parametrize("kind", KINDS)
def test_pixels_stay(plots, kind):
    digest = hashlib.sha256()
    for octave in (1, 2):
        level = len(example(kind).finer) + octave
        digest.update(growths.planes(plots[kind], level, Rect.at(-20, -34, 60, 70).zoomed(level)).tobytes())
    assert digest.hexdigest()[:16] == PIXELS[kind]
