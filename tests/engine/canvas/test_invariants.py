"""The invariants of the pyramid that a dense reference does not show: depth, locality, ghosts, range, width."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strokes import ArrayEdit, Grain, fill, random_stroke, spread_planes

from engine.brush.edits import edit as edit_of
from engine.brush.ink import resolve
from engine.brush.mask import StrokeMask
from engine.brush.settings import Brush
from engine.canvas import painted as painting
from engine.canvas.attenuate import fold
from engine.canvas.commit import commit
from engine.canvas.dither import NO_DITHER
from engine.canvas.evaluate import evaluate, shown
from engine.canvas.kernels import attenuate
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey
from engine.numeric.grid import FINE_STEP
from engine.numeric.pyramid import reduce
from engine.texture.sparse_planes import SparsePlanes

INKS = (Grain(0, 1), Grain(1, 2))
COUNT = 65536.0


def painted(seed, count=25, finest=4, half=12, inks=INKS):
    rng = np.random.default_rng(seed)
    pyramid = Pyramid()
    for _ in range(count):
        m, x, y, keep, add = random_stroke(rng, finest, half, inks)
        pyramid = commit(pyramid, ArrayEdit(m, x, y, keep, add, inks))
    return pyramid


def around(pyramid, level, half=12, cache=None):
    h = half << max(level, 0)
    return spread_planes(evaluate(pyramid, level, Rect(-h, -h, h, h), cache), INKS)


@pytest.mark.parametrize(("megabytes", "looking"), [(8, False), (2, True)])
def test_a_thousand_visits_with_evictions_change_nothing_and_store_nothing(megabytes, looking):
    pyramid = painted(1)
    wanted = {k: around(pyramid, k) for k in range(-3, 6)}
    rng, cache = np.random.default_rng(2), TileCache(megabytes << 20)
    before = [record for _, record in pyramid.all_records()]
    for n in range(1000):
        k = int(rng.integers(-4, 6))
        if looking:
            cache.look_at(k)
        assert cache.held <= cache.budget
        reach = 14 << max(k, 0)
        evaluate(pyramid, k, Rect.at(*(int(v) for v in rng.integers(-reach, reach, 2)), 9, 7), cache)
        if n % 100 == 0:
            cache.clear()
    assert all((around(pyramid, k, cache=cache) == v).all() for k, v in wanted.items())
    assert [record for _, record in pyramid.all_records()] == before


def test_planes_of_many_inks_are_kept_apart_and_give_the_same_records(monkeypatch):
    inks = tuple(Grain(0, n) for n in range(1, 6))

    def made(many):
        for module in ("compact", "residuals"):
            monkeypatch.setattr(f"engine.canvas.{module}.MANY", many)
        rng, pyramid = np.random.default_rng(4), Pyramid()
        for n in range(18):
            few = tuple(sorted({inks[n % 5], inks[n * 3 % 5]}, key=lambda ink: ink.key))
            m, x, y, keep, add = random_stroke(rng, 2, 14, few)
            pyramid = commit(pyramid, ArrayEdit(m, x, y, keep, add, few))
            pyramid = fold(pyramid) if n % 7 == 6 else pyramid
        return pyramid

    dense, sparse = made(99), made(1)
    apart = [record for _, record in sparse.all_records() if isinstance(record.held, SparsePlanes)]
    assert len(apart) > 10
    pairs = zip(dense.all_records(), sparse.all_records(), strict=True)
    for (key, one), (other_key, other) in pairs:
        assert (key, one.rect, one.inks, one.depth) == (other_key, other.rect, other.inks, other.depth)
        assert one.data.dtype == other.data.dtype
        assert np.array_equal(one.data, other.data)
    for level in (-6, -1, 0, 2):
        rect = Rect(-21, -13, 25, 30).zoomed(level)
        one, other = evaluate(dense, level, rect), evaluate(sparse, level, rect)
        assert one.inks == other.inks
        assert np.array_equal(one.data, other.data)
        assert np.array_equal(shown(sparse, level, rect), other.rgba)


def test_levels_left_behind_are_evicted_first():
    pyramid, cache = painted(1), TileCache(256 << 20)

    def known():
        return [sum(cache.get(pyramid, TileKey(k, x, y))[0] for x in (-1, 0) for y in (-1, 0)) for k in range(6)]

    for level in range(6):
        cache.look_at(level)
        evaluate(pyramid, level, Rect(-128, -128, 128, 128), cache)
    assert known() == [4] * 6
    cache.budget = 12 << 20  # half of it for levels beside the one that is seen
    cache.look_at(4)
    *behind, third, fourth, fifth = known()
    assert (third, fourth, fifth) == (4, 4, 4)
    assert sum(behind) < 12
    assert behind == sorted(behind)
    cache.shrink(cache.held * 2 // 3)
    assert known()[4] == 4
    assert sum(known()[:4]) < 4
    cache.shrink(0)
    assert cache.held == 0


@pytest.mark.parametrize("level", [0, 2, 4])
def test_an_opaque_fill_leaves_no_ghost_at_any_level(level):
    pyramid = painted(5 + level)
    half = 10 << level
    after = commit(pyramid, fill(level, -half, -half, 2 * half, 2 * half))
    colour = (np.rint(np.array([0.6, 0.2, 0.4, 1.0]) * COUNT) / COUNT)[:, None, None]
    for k in range(-3, level + 3):
        h = half >> (level - k) if k <= level else (half - 2) << (k - level)
        if h:
            got = evaluate(after, k, Rect(-h, -h, h, h))
            assert (got.rgba == colour).all(), k
            assert not got.data[4:].any(), k


def test_a_stroke_without_alpha_is_no_stroke():
    pyramid = painted(3)
    nothing = ArrayEdit(3, 5, 5, np.ones((9, 9), np.float32), np.zeros((4, 9, 9), np.float32))
    assert commit(pyramid, nothing) is pyramid


@settings(deadline=None, max_examples=6)
@given(
    seed=st.integers(0, 99), level=st.integers(0, 4), x=st.integers(-40, 40), y=st.integers(-40, 40),
    width=st.integers(1, 30), height=st.integers(1, 30), alpha=st.sampled_from([0.02, 0.5, 0.9, 1.0]),
)  # fmt: skip
def test_only_the_stated_rectangles_change_and_undo_restores_them(seed, level, x, y, width, height, alpha):
    pyramid = painted(seed % 4)
    after = commit(pyramid, fill(level, x, y, width, height, alpha=alpha))
    for k in range(-2, 7):
        before, now = around(pyramid, k), around(after, k)
        ys, xs = (before != now).any(0).nonzero()
        h = 12 << max(k, 0)
        rect = Rect.at(x, y, width, height)
        allowed = rect.zoomed(k - level) if k <= level else rect.grown(2).zoomed(k - level)
        if ys.size:
            assert Rect(xs.min() - h, ys.min() - h, xs.max() + 1 - h, ys.max() + 1 - h).union(allowed) == allowed, k
        if k == level:
            outside = np.ones(before.shape[1:], bool)
            inside = rect.intersect(Rect(-h, -h, h, h))
            if not inside.empty:
                outside[inside.slices(Rect(-h, -h, h, h))] = False
            assert (before[:, outside] == now[:, outside]).all()


def test_neighbours_of_two_hundred_fine_strokes_do_not_drift():
    pyramid = commit(Pyramid(), fill(0, -32, -32, 64, 64))
    rng = np.random.default_rng(0)
    for _ in range(200):
        x, y, w, h = (int(rng.integers(*r)) for r in ((0, 40), (0, 40), (1, 6), (1, 6)))
        pyramid = commit(pyramid, fill(3, x, y, w, h, tuple(rng.random(3)), float(rng.choice([1.0, 0.3]))))
    got = evaluate(pyramid, 3, Rect(-100, -100, 200, 200)).data
    outside = np.ones((300, 300), bool)
    outside[100:146, 100:146] = False
    first = got[:, 0, 0][:, None]
    assert (got[:, outside] == first).all()


def test_a_faint_fine_dab_over_a_hard_coarse_edge_does_not_make_it_pop():
    pyramid = commit(commit(Pyramid(), fill(0, 0, 0, 64, 64, (1, 1, 1))), fill(0, 0, 0, 31, 64, (0, 0, 0)))
    before = evaluate(pyramid, 0, Rect(0, 0, 64, 64)).data
    after = commit(pyramid, fill(2, 96, 96, 64, 64, (0.5, 0.5, 0.5), 0.01))
    change = np.abs(evaluate(after, 0, Rect(0, 0, 64, 64)).data - before).max()
    assert 0 < change < 0.0052


def test_popping_is_bounded_by_the_change_below_and_the_part_that_stays():
    pyramid = painted(11, inks=())
    m, h = 3, 12 << 3
    rng = np.random.default_rng(1)
    for _ in range(8):
        x, y, w, t = (int(v) for v in (*rng.integers(-60, 20, 2), *rng.integers(5, 40, 2)))
        alpha = float(rng.choice([0.05, 0.4, 1.0]))
        after = commit(pyramid, fill(m, x, y, w, t, tuple(rng.random(3)), alpha))
        views = {k: Rect(-h, -h, h, h).zoomed(k - m) for k in range(m + 1)}
        values = {k: [evaluate(p, k, view).data for p in (pyramid, after)] for k, view in views.items()}
        keep = np.ones((1, 2 * h, 2 * h), np.float32)
        keep[0, y + h : y + h + t, x + h : x + h + w] = 1 - np.rint(alpha * COUNT) / COUNT
        for k in range(m - 1, -1, -1):
            keep = reduce(keep)
            (fine_before, fine_after), (before, now) = values[k + 1], values[k]
            # A_j weighs what the coarse level knows and the fine one does not: that part alone may be lost.
            bound = reduce(np.abs(fine_after - fine_before)) + (1 - keep) * np.abs(before - reduce(fine_before))
            assert (np.abs(now - before) - bound).max() <= 4 / COUNT
        pyramid = after


def test_many_strokes_each_below_the_grid_add_up():
    pyramid = Pyramid()
    for i in range(32):
        for j in range(32):
            pyramid = commit(pyramid, fill(12, 64 * i, 64 * j, 1, 1, (1.0, 1.0, 1.0)))
    assert evaluate(pyramid, 1, Rect(0, 0, 1, 1)).data[0, 0, 0] * COUNT == 16


def test_alpha_stays_within_0_and_1():
    for seed in range(4):
        pyramid = painted(20 + seed)
        for k in range(-3, 7):
            alpha = around(pyramid, k)[3]
            assert alpha.min() >= 0
            assert alpha.max() <= 1


@pytest.mark.parametrize("level", [60, 200])
def test_painting_at_great_depth_works_as_at_level_0(level):
    pyramid = painted(2)
    x, y = (1 << (level - 1)) * 5 // 3, (1 << (level - 1)) * 7 // 5
    view = Rect.at(x, y, 32, 32)
    before = evaluate(pyramid, level, view).data
    at_0 = around(pyramid, 0)
    after = commit(pyramid, fill(level, x + 5, y + 5, 20, 20))
    levels = [k for k, records in after.levels.items() if records is not pyramid.levels.get(k)]
    assert len(levels) <= 15
    now = spread_planes(evaluate(after, level, view), INKS)
    inside = np.zeros((32, 32), bool)
    inside[5:25, 5:25] = True
    assert (now[:3, inside] == (np.rint(np.array([0.6, 0.2, 0.4]) * COUNT) / COUNT)[:, None]).all()
    wide = spread_planes(evaluate(pyramid, level, view), INKS)
    assert (now[:, ~inside] == wide[:, ~inside]).all()
    assert (around(after, 0) == at_0).all()
    deeper = evaluate(after, level + 60, Rect.at((x + 15) << 60, (y + 15) << 60, 40, 40)).rgba
    assert (deeper == deeper[:, :1, :1]).all()
    assert (evaluate(pyramid, level, view).data == before).all()


def test_a_canvas_two_to_the_forty_pixels_wide():
    pyramid = Pyramid()
    for place in (0, 1 << 40, -(1 << 40)):
        pyramid = commit(pyramid, fill(0, place - 5, place - 7, 10, 14))
    for place in (0, 1 << 40, -(1 << 40)):
        got = evaluate(pyramid, 0, Rect.at(place - 6, place - 8, 12, 16)).data
        assert got[3, 1:-1, 1:-1].min() == 1
        assert got[3].sum() == 140
    assert pyramid.nbytes < 1 << 20


def test_translation_by_the_coarsest_pixel_translates_the_result():
    shift = 1 << 20
    rng = np.random.default_rng(4)
    plain, moved = Pyramid(), Pyramid()
    for _ in range(10):
        m, x, y, keep, add = random_stroke(rng, 3, 12, ())
        plain = commit(plain, ArrayEdit(m, x, y, keep, add))
        moved = commit(moved, ArrayEdit(m, x + (shift << m), y - (shift << m), keep, add))
    for k in range(-8, 5):
        h = 12 << max(k, 0)
        by = shift << k if k >= 0 else shift >> -k
        a = evaluate(plain, k, Rect(-h, -h, h, h)).data
        b = evaluate(moved, k, Rect(by - h, -by - h, by + h, -by + h)).data
        assert (a == b).all()


def test_materialised_and_folded_records_change_nothing():
    pyramid = painted(7)
    wanted = {k: around(pyramid, k) for k in range(-3, 6)}
    folded = fold(pyramid)
    assert all((around(folded, k) == v).all() for k, v in wanted.items())


@pytest.mark.parametrize(
    ("limit", "inks", "spares"), [(1 << 26, 0, False), (1 << 18, 0, True), (1 << 24, 3, True), (1 << 20, 5, False)]
)
def test_an_edit_of_many_megapixels_equals_the_same_edit_in_parts(limit, inks, spares, monkeypatch):
    """Large edits are worked on in squares, very large ones in squares of squares, smaller ones where much ink lies;
    the pixels are those of one edit done at once."""
    rng = np.random.default_rng(8)
    height, width = 2300, 2700
    alpha = np.zeros((height, width), np.float32)
    for _ in range(60):
        x, y, w, h = (int(rng.integers(*r)) for r in ((0, 2500), (0, 2100), (4, 300), (4, 300)))
        alpha[y : y + h, x : x + w] = np.rint(rng.random() * COUNT) / COUNT
    add = np.rint(alpha * np.array([0.3, 0.9, 0.5, 1.0], np.float32)[:, None, None] * COUNT).astype(np.float32) / COUNT
    base = painted(9, inks=tuple(Grain(0, seed) for seed in range(inks)))
    edit = ArrayEdit(2, -1111, -903, 1 - alpha, add, spares_alpha=spares)
    monkeypatch.setattr("engine.canvas.commit._AT_ONCE", limit)
    monkeypatch.setattr(
        painting, "_MUCH", 1 << 19
    )  # of three inks' tiles what lies around a square is worked out alone
    by_slabs = commit(base, edit)
    monkeypatch.setattr("engine.canvas.commit._AT_ONCE", 1 << 40)
    at_once = commit(base, edit)
    assert [(k, r.rect) for k, r in by_slabs.all_records()] == [(k, r.rect) for k, r in at_once.all_records()]
    pairs = zip(by_slabs.all_records(), at_once.all_records(), strict=True)
    assert all((a.data == b.data).all() for (_, a), (_, b) in pairs)


@pytest.mark.parametrize(("budget", "most"), [(1 << 20, 48 << 20), (240 << 20, 60 << 20)])
def test_the_less_room_there_is_the_smaller_are_the_rectangles_of_an_edit(budget, most, monkeypatch):
    import engine.canvas.commit as module

    areas = []

    class Seen(Exception):
        pass

    def climbs(pyramid, level, rect, cache, known=None):
        areas.append(rect.area)
        raise Seen

    monkeypatch.setattr(module, "climbs", climbs)
    least = int((most / 16) ** 0.5) // 128 * 128
    for side in (least, least + 128):
        edit = ArrayEdit(0, 0, 0, np.ones((side, side), np.float32), np.ones((4, side, side), np.float32))
        with pytest.raises(Seen):
            commit(Pyramid(), edit, TileCache(budget))
    assert areas[0] == least**2
    assert 16 * areas[1] <= most


@pytest.mark.parametrize("with_cache", [False, True])
def test_tiles_worked_out_a_few_at_a_time_are_those_worked_out_together(with_cache, monkeypatch):
    """However many of them are: where much ink lies they are few, as all together take hundreds of megabytes."""
    base, sizes, results = painted(9), [], []
    edit = ArrayEdit(1, -311, -203, np.full((700, 900), 0.5, np.float32), np.full((4, 700, 900), 0.25, np.float32))
    plain = painting.evaluate_sparse

    def evaluate_sparse(*place, **how):
        found = plain(*place, **how)
        sizes.append(0 if found is None else found.data.nbytes)
        return found

    monkeypatch.setattr(painting, "evaluate_sparse", evaluate_sparse)
    for first, piece in ((1, 1 << 18), (1 << 20, 1 << 40)):
        monkeypatch.setattr(painting, "_FIRST", first)
        monkeypatch.setattr(painting, "_PIECE", piece)
        sizes.clear()
        results.append((commit(base, edit, TileCache(64 << 20) if with_cache else None), max(sizes), len(sizes)))
    (few, most_of_few, pieces), (together, most_of_all, whole) = results
    assert whole == 1
    assert pieces > 20
    assert most_of_few < most_of_all / 20
    pairs = zip(few.all_records(), together.all_records(), strict=True)
    for (key, one), (place, other) in pairs:
        assert (key, one.rect, one.inks) == (place, other.rect, other.inks)
        assert (one.data == other.data).all()
    monkeypatch.setattr(painting, "_PIECE", 1 << 18)
    sizes.clear()
    commit(together, edit)  # now it is stored how much lies there
    assert max(sizes) <= most_of_few


def test_a_thin_stroke_across_a_wide_canvas_takes_memory_for_the_stroke_alone(monkeypatch):
    """Where few tiles lie far apart, no level is held whole."""
    import engine.canvas.commit as module

    areas = []

    def climbs(pyramid, level, rect, cache, known=None):
        areas.append(rect.area)
        return plain(pyramid, level, rect, cache, known)

    plain = module.climbs
    monkeypatch.setattr(module, "climbs", climbs)
    mask = StrokeMask(0, (0, 0))
    steps = np.linspace(0.0, 24_000.0, 2500)
    mask.paint(np.stack([steps, steps, *(np.full(2500, v) for v in (16.0, 1.0, 1.0, 0.8))], axis=1))
    brush = Brush(radius=16.0)
    pyramid = commit(Pyramid(), edit_of(brush, mask, resolve(brush, {}, 0, 0)))
    assert 4 * 4 * max(areas) <= module._AT_ONCE
    assert (evaluate(pyramid, 0, Rect(12_000, 12_000, 12_001, 12_001)).data[3] == 1.0).all()


def test_attenuation_waits_for_a_bounded_number_of_strokes():
    pyramid = commit(Pyramid(), fill(6, 0, 0, 200, 200))
    reference = pyramid
    for n in range(80):
        pyramid = commit(pyramid, fill(2, n % 9, n % 7, 8, 8, alpha=0.02))
        reference = fold(commit(reference, fill(2, n % 9, n % 7, 8, 8, alpha=0.02)))
        assert sum(1 for _ in pyramid.waiting()) <= 33
    view = Rect(-10, -10, 220, 220)
    assert (evaluate(pyramid, 6, view).data == evaluate(reference, 6, view).data).all()


def test_attenuation_rounds_to_the_grid():
    data = np.array([[[3, -3, 1000, -70000]]], np.int32)
    out = np.empty_like(data)
    attenuate(data, np.full((1, 4), 0.5, np.float32), False, out, FINE_STEP, NO_DITHER)
    assert out.tolist() == [[[2, -2, 500, -35000]]]


def test_amplified_detail_stays_within_bounds_and_alpha_may_be_spared():
    data = np.full((5, 1, 3), [[400000, -400000, 100]], np.int32)
    out = np.empty_like(data)
    attenuate(data, np.full((1, 3), 2.0, np.float32), True, out, FINE_STEP, NO_DITHER)
    assert out[3].tolist() == [[400000, -400000, 100]]
    for plane in (0, 1, 2, 4):
        assert out[plane].tolist() == [[8 * 65536, -8 * 65536, 200]]


@pytest.mark.parametrize("level", range(-3, 7))
def test_what_is_shown_is_the_colour_of_the_value(level):
    pyramid = painted(5, half=30)
    rect = (Rect(-41, -7, 33, 50) if level < 5 else Rect(-11, -7, 13, 9)).zoomed(level)  # all of it takes seconds there
    found = shown(pyramid, level, rect)
    expected = evaluate(pyramid, level, rect).rgba
    assert np.array_equal(np.zeros_like(expected) if found is None else found, expected)
    assert shown(Pyramid(), level, rect) is None
