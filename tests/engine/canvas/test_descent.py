"""Going down through many levels at once gives what going through them one by one does."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from strokes import ArrayEdit, Grain, fill, random_stroke, spread_planes

from engine.canvas import evaluate as evaluating
from engine.canvas.attenuate import attenuation
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate, shown, step
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.column import Column
from engine.numeric.pyramid import expand

INKS = (Grain(0, 1),)


def one_by_one(pyramid, level, rect):
    """The values of a rectangle, through every level from the coarsest on."""
    rects = [rect.evened()]
    for _ in range(level - pyramid.coarsest + 1):
        rects.append(rects[-1].parents().evened())
    value = None
    for n in range(level - pyramid.coarsest, -1, -1):
        value = step(pyramid, value, rects[n + 1], level - n, rects[n])
    inner = rect.slices(rects[0])
    return np.zeros((7, rect.height, rect.width)) if value is None else spread_planes(value, INKS)[:, *inner]


def at_depths(seed, inks, corner):
    """A pyramid of strokes around one place at levels far from one another, and the levels."""
    rng = np.random.default_rng(seed)
    pyramid, levels = Pyramid(), []
    for _ in range(5):
        level = int(rng.integers(0, 90))
        _, x, y, keep, add = random_stroke(rng, 0, 20, inks)
        place = (corner << level) // 3
        pyramid = commit(pyramid, ArrayEdit(level, place + x - 5, place + y - 5, keep, add, inks))
        levels.append(level)
    return pyramid, levels


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from([0, 3, 1000]), st.booleans())
def test_far_below_as_one_by_one(seed, corner, inked):
    pyramid, levels = at_depths(seed, INKS if inked else (), corner)
    cache = TileCache(1 << 24)
    for level in (*levels, 95):
        place = (corner << level) // 3
        rect = Rect.at(place - 9, place - 7, 17, 15)
        plain = one_by_one(pyramid, level, rect)
        assert np.array_equal(spread_planes(evaluate(pyramid, level, rect), INKS), plain)
        assert np.array_equal(spread_planes(evaluate(pyramid, level, rect, cache), INKS), plain)
        seen = shown(pyramid, level, rect)
        assert np.array_equal(np.zeros_like(plain[:4]) if seen is None else seen, plain[:4])


def test_levels_that_change_nothing_are_not_gone_through(monkeypatch):
    pyramid = commit(Pyramid(), fill(0, -20, -20, 40, 40))
    pyramid = commit(pyramid, fill(4000, -30, -30, 40, 40, (0.1, 0.9, 0.2), 0.5))
    made = []
    monkeypatch.setattr(evaluating, "step", lambda *given, **told: (made.append(given[3]), step(*given, **told))[1])
    value = evaluate(pyramid, 8000, Rect(-6, -6, 6, 6))
    assert len(made) < 120
    assert (value.data[3] == 1.0).all()
    cache, first = TileCache(1 << 24), len(made)
    assert np.array_equal(evaluate(pyramid, 8000, Rect(-6, -6, 6, 6), cache).data, value.data)
    made.clear()
    assert np.array_equal(evaluate(pyramid, 8000, Rect(-4, -4, 4, 4), cache).data, value.data[:, 2:-2, 2:-2])
    assert len(made) < first // 2


@settings(max_examples=60, deadline=None)
@given(st.integers(-(10**9), 10**9), st.integers(1, 300), st.integers(-(10**9), 10**9), st.integers(1, 300))
def test_a_column_holds_the_parents_of_each_level(x, width, y, height):
    column = Column(Rect.at(x, y, width, height).evened())
    for up in range(70):
        inner = column.at(up).parents()
        assert column.at(up + 1).intersect(inner) == inner
        assert column.at(up + 1) == column.at(up + 1).evened()
    assert max(column.at(60).width, column.at(60).height) <= 8


@settings(max_examples=60, deadline=None)
@given(st.integers(-40, 40), st.integers(2, 60), st.integers(1, 30))
def test_levels_that_lie_alike_have_one_offset(x, first, count):
    column = Column(Rect(2 * x, -4, 2 * x + 12, 8))
    last = max(1, first - count)
    offsets = {
        (column.at(up - 1).parents().x0 - column.at(up).x0, column.at(up).width, column.at(up - 1).width)
        for up in range(first, last, -1)
    }
    assert column.lies_alike(first, last) <= (len(offsets) <= 1)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from([0, 3]))
def test_what_a_stroke_leaves_of_fine_detail_far_below(seed, corner):
    rng = np.random.default_rng(seed)
    place = (corner << 70) // 3
    pyramid = commit(Pyramid(), fill(70, place - 20, place - 20, 40, 40))
    _, x, y, keep, add = random_stroke(rng, 0, 30, ())
    pyramid = commit(pyramid, ArrayEdit(2, (corner << 2) // 3 + x, (corner << 2) // 3 + y, keep, add))
    waits, rect = pyramid.waits, Rect.at(place - 9, place - 7, 18, 16)
    if waits is None:
        return
    found = attenuation(waits, 70, rect)
    rects = [rect.evened()]
    for _ in range(68):
        rects.append(rects[-1].parents().evened())
    plain = np.ones((rects[-1].height, rects[-1].width), np.float32)
    for key in rects[-1].tiles(2):
        kept = waits.keep.get((key.x, key.y))
        if kept is not None and kept.rect.meets(rects[-1]):
            part = kept.rect.intersect(rects[-1])
            plain[part.slices(rects[-1])] = kept.data[part.slices(kept.rect)]
    for outer, inner in zip(reversed(rects), reversed(rects[:-1]), strict=False):
        plain = expand(plain[None, *inner.parents().slices(outer)])[0]
    plain = plain[rect.slices(rects[0])]
    assert np.array_equal(np.ones_like(plain) if found is None else found, plain)
