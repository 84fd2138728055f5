"""Evaluated tiles that are kept: the same values as without them, whoever asked before, and only what they hold."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strokes import ArrayEdit, random_stroke

from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate, evaluate_sparse
from engine.canvas.layers import Layer
from engine.canvas.reading import layer_planes
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import Square, TileCache, occupied, parted, without_empty_inks
from engine.numeric.address import TILE, Rect, TileKey
from engine.texture.planes import Planes, merged
from engine.texture.table import instance

INKS = merged(
    (instance("rock", {"period": 8}, 0, 3), instance("squares", {"period": 3}, 1, 3)),
)


def edit(rng, finest=0):
    level, x, y, keep, add = random_stroke(rng, finest, 100, INKS)
    return ArrayEdit(level, x, y, keep, add, INKS)


def painted(count):
    """A pyramid of some strokes of two inks near the place (0, 0)."""
    rng, pyramid = np.random.default_rng(5), Pyramid()
    for _ in range(count):
        pyramid = commit(pyramid, edit(rng))
    return pyramid


def test_what_is_lent_is_what_is_evaluated_also_after_more_was_painted():
    cache, rng, pyramid = TileCache(64 << 20), np.random.default_rng(6), painted(8)
    whole = Rect(-256, 0, 0, 256)
    for level in (3, 0, 2, 1):
        seen = evaluate_sparse(pyramid, level, whole, cache, lent=True)
        again = evaluate_sparse(pyramid, level, whole, cache, lent=True)
        plain = evaluate(pyramid, level, whole)
        for found in (seen, again):
            assert found is not None
            assert np.array_equal(found.rgba, plain.rgba)
    before = evaluate(pyramid, 0, whole, cache).rgba.copy()
    after = commit(pyramid, edit(rng), cache)
    assert np.array_equal(evaluate(pyramid, 0, whole, cache).rgba, before)
    for level in (-4, 0, 3):
        assert np.array_equal(evaluate(after, level, whole, cache).rgba, evaluate(after, level, whole).rgba)


def test_of_many_inks_that_meet_far_above_no_commit_keeps_all_their_planes(monkeypatch):
    """Each would have them copied; records and pixels are those without a cache."""
    inks, kept = [instance("rock", {"period": 8 + n}, 0, 3) for n in range(80)], []
    get = TileCache.get

    def noted(self, pyramid, key):
        known, value = get(self, pyramid, key)
        kept.append(0 if value is None else value.data.nbytes)
        return known, value

    monkeypatch.setattr(TileCache, "get", noted)
    places = np.random.default_rng(7).integers(0, 3000, (len(inks) // 2, 2)).tolist()
    cache, plain, beside = TileCache(64 << 20), Pyramid(), Pyramid()
    for n, place in enumerate(places):
        pair, amount = merged(inks[2 * n : 2 * n + 2]), np.float32(0.25)
        made = ArrayEdit(0, *place, np.full((12, 20), amount), np.full((10, 12, 20), amount), pair)
        plain, beside = commit(plain, made), commit(beside, made, cache)
    assert max(kept) <= 4 << 20
    for (key, one), (place, other) in zip(plain.all_records(), beside.all_records(), strict=True):
        assert (key, one.rect, one.inks) == (place, other.rect, other.inks)
        assert np.array_equal(one.data, other.data)
    layer = Layer(1, "many", pyramid=beside)
    monkeypatch.setattr("engine.canvas.reading._CROWDED_BYTES", 1)  # so that only colours are worked out
    for level, side in ((-5, 900), (-1, 300), (1, 40)):
        rect = Rect.at(*places[0], side, side).zoomed(level)
        assert np.array_equal(layer_planes(layer, level, rect, cache), evaluate(plain, level, rect).rgba)


def test_tiles_are_contiguous_wherever_they_come_from():
    cache, pyramid = TileCache(64 << 20), painted(8)
    evaluate_sparse(pyramid, 1, Rect(-256, 0, 0, 256), cache, lent=True)
    known, value = cache.get(pyramid, TileKey(1, -1, 0))
    assert known
    assert value is not None
    assert value.data.flags.c_contiguous
    assert np.array_equal(value.rgba, evaluate(pyramid, 1, Rect.at(-TILE, 0, TILE, TILE)).rgba)


@pytest.mark.parametrize("corner", [(0, 0), (-3, 40), (1 << 40, -5)])
def test_a_square_around_holds_what_lies_above_any_tile_of_the_screen(corner):
    for n in range(8):
        rect = Rect.at((corner[0] + n) * 256, corner[1] * 256, 256, 256)
        for _ in range(3):
            rect = rect.parents().evened()
        around = Square.of(-3, rect)
        assert around is not None
        assert around.rect.union(rect) == around.rect
    assert Square.of(0, Rect.at(0, 0, 100, 10)) is None


def test_planes_that_hold_nothing_are_found_and_left_out():
    data = np.zeros((10, 8, 8), np.float32)
    assert without_empty_inks(Planes(data, INKS)) is None
    data[9, 6, 7] = 1
    assert occupied(data, 0, 0, 8, 8) == occupied.plain(data, 0, 0, 8, 8) == 4
    assert occupied(data, 0, 0, 8, 7) == occupied.plain(data, 0, 0, 8, 7) == 0
    left, right = parted(Planes(data, INKS), [(slice(0, 8), slice(0, 4)), (slice(0, 8), slice(4, 8))])
    assert left is None
    assert right is not None
    assert right.inks == INKS[1:]
    assert np.array_equal(right.data[4:], data[7:, :, 4:])
    data[0], data[5] = 1, 2
    both = parted(Planes(data, INKS), [(slice(0, 8), slice(4, 8))])
    assert both[0] is not None
    assert both[0].data.base is data


@settings(deadline=None, max_examples=12)
@given(st.integers(0, 2**16), st.lists(st.tuples(st.integers(-6, 3), st.integers(-2, 1)), min_size=4, max_size=24))
def test_what_is_kept_while_one_paints_is_what_is_evaluated(seed, visits):
    rng, pyramid, cache, states = np.random.default_rng(seed), Pyramid(), TileCache(64 << 20), []
    for n, (level, corner) in enumerate(visits):
        states.append(pyramid)
        pyramid = commit(pyramid, edit(rng, 2), cache)
        # Now and then an older state: one goes back, and paints on from there.
        pyramid = states[n // 2] if n % 7 == 6 else pyramid
        rect = Rect.at(corner * TILE, 0, 2 * TILE, TILE) if n % 2 else Rect.at(corner * 50, -30, 90, 70)
        found, wanted = evaluate(pyramid, level, rect, cache), evaluate(pyramid, level, rect)
        assert np.array_equal(found.rgba, wanted.rgba)
        for ink in wanted.inks:
            assert np.array_equal(*(p.data[p.inks.index(ink) * 3 + 4 :][:3] for p in (found, wanted)))


def test_what_a_commit_makes_of_coarser_levels_is_not_evaluated_again(monkeypatch):
    cache, pyramid = TileCache(64 << 20), painted(8)
    tiles = [TileKey(level, x, y) for level in (-2, -1) for x in (-1, 0) for y in (-1, 0)]
    for key in tiles:
        evaluate(pyramid, key.level, key.rect, cache)
    rng = np.random.default_rng(9)
    after = pyramid
    for _ in range(5):
        after = commit(after, edit(rng), cache)
    wanted = [evaluate(after, key.level, key.rect).rgba for key in tiles]
    assert not np.array_equal(wanted[-1], evaluate(pyramid, -1, tiles[-1].rect).rgba)
    monkeypatch.setattr("engine.canvas.evaluate.step", None)
    for key, pixels in zip(tiles, wanted, strict=True):
        assert np.array_equal(evaluate(after, key.level, key.rect, cache).rgba, pixels)


def stored(pyramid):
    """All records, as values."""
    return [(key, record.rect, record.inks, record.data.tolist()) for key, record in pyramid.all_records()]


def test_what_a_commit_leaves_of_the_levels_above_serves_the_next_one():
    """Where that lies within its bounds, and only in the state that it led to."""
    rng, cache, pyramid = np.random.default_rng(7), TileCache(64 << 20), painted(3)
    first = ArrayEdit(0, -90, -70, *(np.full(size, 0.5, np.float32) for size in ((200, 260), (4, 200, 260))))
    pyramid = commit(pyramid, first, cache)
    other = commit(pyramid, edit(rng))
    taken = 0
    for _ in range(6):
        known, one = cache.front.taken(pyramid), edit(rng)
        cache.front.keep(pyramid, known)
        assert not cache.front.taken(other)
        taken += len(known) > 0
        wanted = commit(pyramid, one)
        pyramid = commit(pyramid, one, cache)
        assert stored(pyramid) == stored(wanted)
    assert taken == 6


def test_the_levels_around_a_commit_count_and_are_let_go():
    cache = TileCache(64 << 20)
    pyramid = commit(Pyramid(), edit(np.random.default_rng(8)), cache)
    held = cache.held
    assert cache.front.taken(pyramid)
    assert cache.held < held
    small = TileCache(1000)
    assert not small.front.taken(commit(Pyramid(), edit(np.random.default_rng(8)), small))
    commit(pyramid, edit(np.random.default_rng(9)), cache)
    cache.shrink(0)
    assert cache.held == 0


class Hurried:
    """A lock; as soon as it is free again, another thread's work is done, once."""

    def __init__(self, lock, work):
        self._lock, self._work = lock, [work]

    def __enter__(self):
        return self._lock.__enter__()

    def __exit__(self, *told):
        self._lock.__exit__(*told)
        if self._work:
            self._work.pop()()


@pytest.mark.parametrize("ask", [TileCache.get, TileCache.view])
def test_a_tile_is_that_of_the_state_that_asks_while_another_thread_asks_for_a_newer_one(ask, monkeypatch):
    cache, pyramid, key = TileCache(64 << 20), painted(8), TileKey(-2, -1, 0)
    before = evaluate(pyramid, key.level, key.rect, cache).rgba.copy()
    whole = ArrayEdit(0, -200, -20, *(np.full(size, 0.5, np.float32) for size in ((100, 180), (4, 100, 180))))
    after = commit(pyramid, whole, cache)
    assert not np.array_equal(evaluate(after, key.level, key.rect).rgba, before)
    monkeypatch.setattr(cache, "_lock", Hurried(cache._lock, lambda: cache.get(after, key)))
    known, value = ask(cache, pyramid, key)
    assert known
    assert np.array_equal(value.rgba, before)
