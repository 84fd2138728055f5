"""What lies far from a stroke, in place or in level, is left alone, and found again without looking through it all."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strokes import ArrayEdit, Grain, fill, random_stroke

from engine.canvas import attenuate as folding
from engine.canvas import tile_cache as caching
from engine.canvas.attenuate import fold
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate
from engine.canvas.store import Pyramid, changed_rects
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey
from engine.numeric.pyramid import expand

INKS = (Grain(0, 1),)


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 10**6))
def test_what_records_have_become_is_kept_for_the_state_that_asked(seed):
    rng = np.random.default_rng(seed)
    states = [Pyramid()]
    for level in (4, 3, 2, 0):
        _, x, y, keep, add = random_stroke(rng, 1, 12, INKS)
        states.append(commit(states[-1], ArrayEdit(level, x, y, keep, add, INKS)))
    for pyramid in (states[2], states[4], states[3], states[4], fold(states[4], 3), states[4], states[2]):
        found = evaluate(pyramid, 4, Rect(-40, -40, 90, 90))
        folding.RENEWED.clear()
        again = evaluate(pyramid, 4, Rect(-40, -40, 90, 90))
        assert np.array_equal(found.data, again.data)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_no_value_changes_above_the_coarsest_level_that_a_commit_tells(seed):
    rng = np.random.default_rng(seed)
    pyramid = Pyramid()
    for _ in range(4):
        m, x, y, keep, add = random_stroke(rng, 4, 12, INKS)
        after = commit(pyramid, ArrayEdit(m, x, y, keep, add, INKS))
        if after is pyramid:
            continue
        coarsest = after.last.coarsest
        for level in range(coarsest - 3, coarsest):
            rect = Rect(-4, -4, 4, 4)
            before, now = evaluate(pyramid, level, rect), evaluate(after, level, rect)
            assert np.array_equal(before.rgba, now.rgba)
            assert after.last.reach(level).empty
            assert changed_rects(pyramid, after, level) == []
        assert not after.last.reach(coarsest).empty
        pyramid = after


def test_a_tile_far_above_stays_in_the_cache_while_small_strokes_follow_below():
    cache, key = TileCache(1 << 24), TileKey(0, 0, 0)
    pyramid = commit(Pyramid(), fill(0, 10, 10, 90, 90), cache)
    pyramid = commit(pyramid, fill(30, 20 << 30, 20 << 30, 40, 40, (0.1, 0.9, 0.2)), cache)
    known, value = cache.get(pyramid, key)
    assert known
    assert np.array_equal(value.data, evaluate(pyramid, 0, key.rect).data)


def test_a_cached_tile_is_made_again_sooner_than_compared_with_thousands_of_commits(monkeypatch):
    asked = []
    plain = caching.changes_between
    monkeypatch.setattr("engine.canvas.rising.raised.MOST", 8)
    monkeypatch.setattr(caching, "changes_between", lambda a, b: (asked.append(c) or c for c in plain(a, b)))
    cache, key = TileCache(1 << 24), TileKey(0, 0, 0)
    pyramid = commit(Pyramid(), fill(0, 10, 10, 90, 90), cache)
    evaluate(pyramid, 0, key.rect, cache)
    for n in range(8):
        pyramid = commit(pyramid, fill(0, 10_000 + 500 * n, 0, 4, 4))
    assert cache.get(pyramid, key)[0]
    for n in range(20):
        pyramid = commit(pyramid, fill(0, 20_000 + 500 * n, 0, 4, 4))
    asked.clear()
    assert cache.get(pyramid, key) == (False, None)
    assert len(asked) == 9
    assert np.array_equal(evaluate(pyramid, 0, key.rect, cache).data, evaluate(pyramid, 0, key.rect).data)


@pytest.fixture
def spread():
    """Forty fine strokes far apart, and a faint coarse one over two of them."""
    pyramid = Pyramid()
    for n in range(40):
        pyramid = commit(pyramid, fill(3, 4000 * n, 0, 20, 20))
    return commit(pyramid, fill(0, 0, 0, 520, 10, alpha=0.25))


def test_folding_looks_only_at_records_that_an_attenuation_meets(spread, monkeypatch):
    looked = []
    plain = folding._weakened

    def weakened(step, pending, key, record):
        looked.append(key)
        return plain(step, pending, key, record)

    monkeypatch.setattr(folding, "_weakened", weakened)
    folded = fold(spread)
    assert looked
    assert all(key.rect.meets(spread.last.reach(key.level)) for key in looked)
    assert {key.x for key in looked if key.level == 3} == {-1, 0, 31}
    for level in (2, 3):
        for x in (0, 4000 >> 3 - level, 8000 >> 3 - level):
            view = Rect(x - 4, -4, x + 30, 30)
            assert np.array_equal(evaluate(folded, level, view).data, evaluate(spread, level, view).data)
    assert all(folded.levels[level] is spread.levels[level] for level in spread.levels if level <= 0)


def carried_plainly(waits, level, rect):
    """A of a stroke over a rectangle of a finer level, by one expand after the other from all that it follows from."""
    rects = [rect.evened()]
    for _ in range(level - waits.change.level):
        rects.append(rects[-1].parents().evened())
    at = rects.pop()
    keep = folding._base(waits, at)
    while rects:
        inner = rects.pop()
        top, left = (inner.y0 >> 1) - 1 - at.y0, (inner.x0 >> 1) - 1 - at.x0
        keep = expand(keep[None, top : top + inner.height // 2 + 2, left : left + inner.width // 2 + 2])[0]
        at = inner
    return keep[rect.slices(at)]


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 60), st.integers(-12, 40), st.integers(-6, 6), st.integers(0, 1 << 60), st.floats(0.05, 1.0))
def test_what_a_stroke_leaves_of_detail_is_the_same_by_whatever_stops(up, x, y, below, alpha):
    """However deep the detail lies, and whatever was noted of the stroke before."""
    alpha = round(alpha * 65536) / 65536
    base = commit(Pyramid(), fill(up, 0, 0, 4, 4))
    pyramid = commit(base, fill(0, 0, 0, 24, 9, alpha=alpha))
    (waits,) = pyramid.waiting() if pyramid.waits is not None else (None,)
    if waits is None:
        return
    offset = below & ((1 << up) - 1)
    for wide, level in ((7, up), (90, up), (7, max(up - 1, 1))):
        rect = Rect.at((x << level) + offset, (y << level) + offset, wide, 5)
        expected = carried_plainly(waits, level, rect)
        found = folding.attenuation(waits, level, rect)
        assert np.array_equal(np.ones_like(expected) if found is None else found, expected)


def test_folding_the_oldest_strokes_changes_no_value_and_leaves_the_others_waiting():
    pyramid = commit(Pyramid(), fill(6, 0, 0, 300, 200))
    for n in range(12):
        pyramid = commit(pyramid, fill(1 + n % 3, n % 5, n % 4, 6, 5, alpha=0.125 * (1 + n % 7)))
        if n % 4 == 3:
            pyramid = commit(pyramid, fill(7, 40 * n, 10, 30, 30, alpha=0.5))  # a record since some of them
    waiting = [waits.change.serial for waits in pyramid.waiting()]
    for left in (9, 5, 5, 1, 0):
        depth = list(pyramid.waiting())[left].change.depth if left < len(list(pyramid.waiting())) else pyramid.settled
        folded = fold(pyramid, depth)
        assert [waits.change.serial for waits in folded.waiting()] == waiting[:left]
        assert folded.settled == depth
        for level in (5, 6, 7, 8):
            view = Rect(-20, -20, 340 << max(level - 6, 0), 240 << max(level - 6, 0))
            assert np.array_equal(evaluate(folded, level, view).data, evaluate(pyramid, level, view).data)
        pyramid = folded
    assert all(
        (a.data == b.data).all()
        for (_, a), (_, b) in zip(pyramid.all_records(), fold(pyramid).all_records(), strict=True)
    )


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(-3000, 3000), min_size=4, max_size=4))
def test_records_are_found_by_few_tiles_and_by_few_records_alike(corners):
    pyramid = Pyramid()
    for n in range(12):
        pyramid = commit(pyramid, fill(0, 211 * n - 1200, 97 * n - 500, 60, 40))
    x0, x1 = sorted(corners[:2])
    y0, y1 = sorted(corners[2:])
    rect = Rect(x0, y0, x1, y1)
    expected = (
        [] if rect.empty else [key for key, _ in pyramid.all_records() if key.level == 0 and key.rect.meets(rect)]
    )
    assert {key for key, _ in pyramid.records(0, rect)} == set(expected)
    assert pyramid.has_records(0, rect) is bool(expected)
