"""What is painted with examples is a function of masks, examples and seeds, at every level."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from planted import around, bitten, blob, dense, disc, example, masked, means, planted, same, stacked

from engine.canvas import growth as growths
from engine.canvas.grown import shown
from engine.canvas.grown.carry import carried
from engine.numeric.address import Rect
from engine.numeric.grid import Q, snapped
from engine.texture.example import region as regions
from engine.texture.example import show, tiles
from engine.texture.example.correction import OUTSIDE
from engine.texture.example.exemplar import PAD, analysed, shrunk
from engine.texture.example.parameters import Parameters

WHOLE = Rect.at(-128, -128, 256, 256)
places = st.tuples(st.integers(-50, 50), st.integers(-50, 50), st.integers(2, 20))
dabs = st.lists(st.tuples(places, st.sampled_from("ab"), st.sampled_from((0.0, 1.0)), st.booleans()), max_size=5)


def told(growth, dab):
    (x, y, radius), key, depth, erase = dab
    return bitten(growth, x, y, radius, depth) if erase else planted(growth, x, y, radius, key, depth)


@settings(deadline=None, max_examples=10)
@given(dabs=dabs, looks=st.integers(0, 1000))
def test_how_it_came_about_does_not_matter(dabs, looks):
    watched = plain = ()
    for n, dab in enumerate(dabs):
        plain, watched = told(plain, dab), told(watched, dab)
        if looks >> n & 1:
            watched = growths.previewed(watched)
        if looks >> 5 & 1:
            watched = [watched, *islice(growths.settling(watched), looks % 23)][-1]
    plain, watched = growths.settled(plain), growths.settled(watched)
    assert same(plain, watched)
    assert growths.is_settled(watched)
    assert growths.previewed(watched) is watched


EMPTY = tiles.sealed(np.zeros((4, tiles.TILE_SIDE, tiles.TILE_SIDE), np.float32))


def follows(plot):
    """Whether all tiles show their region as it is now, and coarser ones are their means."""
    drawn, level = plot.drawn, plot.shown[0] if plot.shown else tiles.NONE
    for key in set(level) | set(drawn.masks[0]):
        found = level.get(key, EMPTY)
        assert np.array_equal(found.data, show.preview(drawn, tiles.rect_of(key)))
    for above in plot.shown[1:]:
        for y, x in {(row >> 1, column >> 1) for row, column in level}:
            four = tiles.gathered(level, Rect.at(x * 128, y * 128, 128, 128), np.zeros((4, 128, 128), np.float32))
            assert np.array_equal(above.get((y, x), EMPTY).data, means(four))
        level = above
    return len(level) <= shown.FEW


@settings(deadline=None, max_examples=10)
@given(dabs=st.lists(places, min_size=2, max_size=6), bite=places, steps=st.lists(st.integers(0, 12), min_size=6))
def test_tiles_follow_the_region_wherever_it_stands(dabs, bite, steps):
    growth = ()
    for (x, y, radius), count in zip(dabs, steps, strict=False):
        growth = growths.previewed(planted(growth, 4 * x, 4 * y, 2 * radius))
        growth = [growth, *islice(growths.settling(growth), count)][-1]
        assert all(follows(plot) for plot in growth)
    growth = growths.previewed(bitten(growth, *bite))
    assert all(follows(plot) for plot in growth)


@settings(deadline=None, max_examples=8)
@given(places=st.lists(places, min_size=2, max_size=5), order=st.randoms())
def test_one_stroke_or_many_in_any_order(places, order):
    mask = np.zeros((256, 256), bool)
    many = ()
    for place in places:
        mask[around(*place).slices(WHOLE)] |= disc(place[2])
    one = growths.laid((), 0.0, 0, "a", "a", example("a"), 1, WHOLE, mask)
    order.shuffle(places)
    for place in places:
        many = growths.settled(planted(many, *place))
    assert same(growths.settled(one), many)
    gone = growths.settled(bitten(bitten(many, 0, 0, 30), 3, 8, 12))
    again = growths.settled(planted(gone, 0, 0, 30))
    more = growths.settled(planted(many, 0, 0, 30))
    assert same(again, more)


@pytest.fixture(scope="module")
def stack():
    """Three plots: of two levels, one with finer detail, at two depths."""
    growth = planted((), -20, -10, 40, "a")
    growth = planted(growth, 30, 20, 30, "b+1", depth=1.0)
    growth = planted(growth, 10, -30, 60, "c", depth=-1.5, level=1)
    return growths.settled(growth)


@pytest.mark.parametrize("level", range(-4, 4))
def test_against_the_plain_form(stack, level):
    room = {0: WHOLE, 1: Rect.at(-128, -128, 256, 256)}
    wanted = WHOLE.zoomed(level)
    pictures = []
    for plot in stack:
        held = room[plot.level]
        found = dense(plot, held, level)
        out = np.zeros((4, wanted.height, wanted.width))
        at = held.zoomed(level - plot.level)
        both = at.intersect(wanted)
        out[(slice(None), *both.slices(wanted))] = found[(slice(None), *both.slices(at))]
        pictures.append(out)
    below = np.zeros((4, wanted.height, wanted.width))
    assert np.array_equal(growths.planes(stack, level, wanted), stacked(pictures, below))


@settings(deadline=None, max_examples=25)
@given(
    level=st.integers(-5, 4), x=st.integers(0, 200), y=st.integers(0, 200), w=st.integers(1, 90), h=st.integers(1, 90)
)
def test_a_pixel_does_not_depend_on_the_rectangle(stack, level, x, y, w, h):
    whole = WHOLE.zoomed(level)
    part = Rect.at(whole.x0 + x, whole.y0 + y, w, h)
    everything = growths.planes(stack, level, whole.union(part))
    found = growths.planes(stack, level, part)
    found = np.zeros((4, h, w)) if found is None else found
    assert np.array_equal(found, everything[(slice(None), *part.slices(whole.union(part)))])


def test_far_out_and_far_in(stack):
    assert (
        growths.planes(stack, -60, Rect.at(-2, -2, 4, 4)) is None
        or not growths.planes(stack, -60, Rect.at(-2, -2, 4, 4)).any()
    )
    assert growths.planes(stack, -8, Rect.at(-2, -2, 4, 4)).any()
    for level in (20, 60, 4000):  # where all is smooth, to a step of the grid
        near = Rect.at(-20 << level, -10 << level, 40, 30)
        found = growths.planes(stack, level, near)
        assert np.abs(found - found[:, :1, :1]).max() <= 2 * Q
        step = growths.planes(stack, level + 1, near.zoomed(1))
        assert np.abs(found[:, 0, 0] - step[:, 0, 0]).max() <= 2 * Q


def test_far_away_is_as_near():
    """Tiles are the same where their places, and so the hashes of their places, agree to 2^64."""
    far = 1 << 70
    near, away = (growths.settled(planted((), x, x, 20, level=3)) for x in (0, far))
    assert growths.bounds(away, 3) == Rect.at(far - 20, far - 20, 41, 41)
    assert growths.planes(near, 3, around(0, 0, 20)).any()
    found = growths.planes(away, 3, around(far, far, 20))
    assert (found[3] > 0).sum() > 1000
    assert growths.planes(away, 63, around(far << 60, far << 60, 2))[3].min() > 0


def test_a_far_dab_leaves_other_tiles_alone():
    before = growths.settled(planted(planted((), 0, 0, 30), 1000, 0, 30))
    after = growths.settled(planted(before, 1040, 0, 30))
    for n, (old, new) in enumerate(zip(before[0].shown, after[0].shown, strict=False)):
        left = [key for key in old if key[1] << n < 8]
        assert left
        assert n > 3 or all(new[key] is old[key] for key in left)
    sources = before[0].region.levels[0].sources, after[0].region.levels[0].sources
    assert all(sources[0][key] is sources[1][key] for key in sources[0] if key[1] < 8)


def test_depths_and_examples_decide_what_joins():
    growth = planted(planted((), 0, 0, 20), 10, 0, 20)
    assert len(growth) == 1
    assert growth[0].region.seed == 1
    same_seed = planted(growth, 20, 0, 20, seed=9)
    assert [plot.region.seed for plot in same_seed] == [1]
    replaced = planted(growth, 10, 0, 20, "b")
    assert [plot.key for plot in replaced] == ["a", "b"]
    assert not (masked(replaced[0], WHOLE) & masked(replaced[1], WHOLE)).any()
    over = planted(growth, 10, 0, 20, "b", depth=-1.0)
    assert [plot.key for plot in over] == ["b", "a"]
    assert over[1] is growth[0]
    assert planted(growth, 0, 0, 40, "b", depth=0.0)[0].key == "b"
    assert len(planted(growth, 0, 0, 60, "b")) == 1  # nothing was left of the other
    assert bitten(growth, 0, 0, 90) == ()
    assert bitten(growth, 500, 0, 5) is growth
    assert bitten(over, 0, 0, 90, depth=-1.0) == (growth[0],)
    assert planted(growth, 0, 0, 3) is growth


@settings(deadline=None, max_examples=20)
@given(level=st.integers(-3, 3), parts=st.lists(places, min_size=1, max_size=4))
def test_masks_at_other_levels(level, parts):
    """A pixel leaves where the mask lies over its centre, whether in one stroke or in several."""
    start = planted((), 0, 0, 60)
    rect = Rect.at(-80, -80, 160, 160)
    mask = np.zeros((160, 160), bool)
    several = start
    for x, y, radius in parts:
        x, y, radius = x // 2, y // 2, radius // 2 + 1
        mask[around(x, y, radius).slices(rect)] |= disc(radius)
        several = bitten(several, x, y, radius, level=level)
    at_once = growths.cut(start, level, rect, mask)
    rows, columns = np.mgrid[-64:64, -64:64]
    y, x = ((n << max(level, 0)) + (1 << level >> 1 if level > 0 else 0) >> max(-level, 0) for n in (rows, columns))
    inside = (abs(y + 0.5) < 80) & (abs(x + 0.5) < 80)
    gone = np.zeros(rows.shape, bool)
    gone[inside] = mask[y[inside] + 80, x[inside] + 80]
    for growth in (at_once, several):
        left = masked(growth[0], Rect.at(-64, -64, 128, 128)) if growth else np.zeros(gone.shape, bool)
        assert np.array_equal(left, masked(start[0], Rect.at(-64, -64, 128, 128)) & ~gone)


def test_masks_of_any_size():
    """A wide mask on a few tiles far apart is dealt with tile by tile."""
    growth = planted(planted((), 0, 0, 20), 1 << 40, 0, 20)
    whole = np.ones((3, 3), bool)
    parts = list(carried(Rect.at(-1, -1, 3, 3), whole, 41, growth[0].region.masks[0]))
    assert len(parts) > 2
    assert growths.cut(growth, -41, Rect.at(-1, -1, 3, 3), whole) == ()
    assert growths.cut(growth, -400, Rect.at(-1, -1, 1, 1), whole[:1, :1])


def test_settling_goes_on_from_anywhere_and_begins_near():
    left, right = planted((), 0, 0, 25, "a"), planted((), 600, 0, 25, "b")
    growth = growths.previewed((*left, *right))
    places, part = growths.progress(growth)
    assert {rect for _, rect in places} == {around(0, 0, 25), around(600, 0, 25)}
    assert 0 < part < 1

    def first(near):
        for step in growths.settling(growth, near):
            for plot in step:
                if plot.settled:
                    return plot.key
        return None

    assert first((1, Rect.at(1180, -10, 40, 20))) == "b"
    assert first((0, Rect.at(-10, -10, 20, 20))) == "a"
    newest = growths.previewed(planted(right, 0, 0, 25, "a"))
    assert next(p.key for step in growths.settling(newest) for p in step if p.settled) == "a"
    *_, last = growths.settling(growth)
    with ThreadPoolExecutor(2) as pool:
        assert same(last, growths.settled(growth, pool))
    assert growths.progress(last) == ([], 1.0)
    assert not list(growths.settling(last))


def test_threads_do_not_matter(monkeypatch):
    """Nor does it that a large region is refined in squares, and looked at in rows of tiles."""
    start = planted(planted((), 0, 0, 100), 120, 60, 40)
    bites = start, bitten(planted(growths.settled(start), -70, 80, 50), 20, 10, 30)
    plain = [growths.settled(growth) for growth in bites]
    for module, name, value in ((regions, "_AT_ONCE", 100), (regions, "_SQUARE", 64), (shown, "_SHARED", 2)):
        monkeypatch.setattr(module, name, value)
    for growth, wanted in zip(bites, plain, strict=True):
        *_, stepped = growths.settling(growth)
        with ThreadPoolExecutor(2) as pool:
            *_, shared = growths.settling(growth, None, pool)
            assert same(wanted, growths.settled(growth, pool))
        assert same(wanted, stepped)
        assert same(wanted, shared)
        assert all(follows(plot) for plot in shared)


def test_a_preview_shows_something_everywhere():
    growth = growths.settled(planted((), 0, 0, 30))
    growth = growths.previewed(planted(growth, 40, 0, 30))
    found = growths.planes(growth, 0, WHOLE)
    assert np.array_equal(found.any(axis=0), masked(growth[0], WHOLE))
    assert not growth[0].settled
    cut = growths.previewed(bitten(growth, 0, 0, 12))
    assert not growths.planes(cut, 0, WHOLE)[:, ~masked(cut[0], WHOLE)].any()


def test_another_example_takes_a_region_over():
    growth = growths.settled(planted(planted((), 0, 0, 30), 70, 0, 20, "b"))
    plot = growths.at(growth, 0, -5, 0)
    assert plot is growth[0]
    changed = growths.settled(growths.swapped(growth, plot, "c", "c", example("c")))
    assert [p.key for p in changed] == ["b", "c"]
    assert same(changed, growths.settled(planted(planted((), 70, 0, 20, "b"), 0, 0, 30, "c")))
    joined = growths.swapped(growth, plot, "b", "b", example("b"))
    assert len(joined) == 1
    assert np.array_equal(masked(joined[0], WHOLE), masked(growth[0], WHOLE) | masked(growth[1], WHOLE))
    assert growths.swapped(growth, plot, "a", "a", example("a")) is growth


def test_what_is_at_a_pixel():
    growth = planted(planted((), 0, 0, 30), 10, 0, 20, "b", depth=1.0)
    assert growths.at(growth, 0, 10, 0).key == "b"
    assert growths.at(growth, 0, 10, 0, depth=0.0).key == "a"
    assert growths.at(growth, 2, -80, 0).key == "a"
    assert growths.at(growth, -3, -1, 0).key == "b"  # whose disc holds the pixel's centre, -4, 4
    assert growths.at(growth, -3, -2, 0).key == "a"
    assert growths.at(growth, 0, 100, 0) is None


@pytest.mark.parametrize("level", [-3, -1, 0, 1, 3])
def test_rectangles_hold_all_that_changes(stack, level):
    states = [stack]
    states.append(growths.previewed(planted(stack, 0, 0, 12, "b+1", depth=1.0)))
    states.append(growths.settled(states[-1]))
    states.append(growths.previewed(bitten(states[-1], -30, -10, 9)))
    states.append(growths.settled(states[-1]))
    states.append(growths.settled(growths.swapped(stack, stack[1], "b", "b", example("b"))))
    whole = Rect.at(-160, -160, 320, 320).zoomed(level)
    pictures = [growths.planes(state, level, whole) for state in states]
    for n, new in enumerate(states):
        for m in (0, n - 1):
            areas = growths.changed_rects(states[m], new, level)
            left = (pictures[m] != pictures[n]).any(axis=0)
            for rect in areas:
                left[rect.intersect(whole).slices(whole)] = False
            assert not left.any()
            assert len(areas) <= 100
    bounds = growths.bounds(stack, level)
    shown = pictures[0].any(axis=0)
    shown[bounds.slices(whole)] = False
    assert not shown.any()
    far = growths.settled(planted(stack, 500, 500, 10))
    assert all(
        rect.x0 >= 400 << level if level > 0 else rect.x0 >= 400 >> -level
        for rect in growths.changed_rects(stack, far, level)
    )


def test_what_was_never_seen_is_seen_as_soon_as_its_coarsest_level_is_grown():
    """As in a file that is opened: its regions are grown again."""
    exemplar = analysed(blob(1, 200), None, Parameters(levels=5))
    growth = growths.laid((), 0.0, 0, "a", "a", exemplar, 0, around(0, 0, 60), disc(60))
    states = [state for state in growths.settling(growth) if growths.planes(state, 0, WHOLE) is not None]
    assert states[0][0].region.finest == 4
    assert follows(states[0][0])
    assert same(states[-1], growths.settled(growth))


def test_bytes_are_counted_once():
    one = growths.settled(planted((), 0, 0, 20))
    two = growths.settled(planted(one, 300, 0, 20))
    held, more = growths.tiles_of(one), growths.tiles_of(two)
    assert len(held & more) > 0.5 * len(held)
    assert held == {tile for part in _maps(one[0]) for tile in part.values()}
    assert sum(tile.nbytes for tile in held) > sum(tile.data.nbytes for tile in held)


def _maps(plot):
    region = plot.region
    return (*region.masks, *plot.shown, *(m for n in region.levels for m in (n.mask, n.above, n.sources)))


def test_tiles_cannot_be_written_to(stack):
    for plot in stack:
        for level in plot.shown:
            assert all(
                not tile.data.flags.writeable and tile.data.shape == (4, tiles.TILE_SIDE, tiles.TILE_SIDE)
                for tile in level.values()
            )


def test_an_example_is_seen_with_its_own_rim_at_its_own_level():
    """A region as the example's own, all of it copied: zooming in shows the example itself, rim and all."""
    exemplar = example("b+1")
    at = Rect.at(0, 0, *exemplar.mask.shape[::-1])
    growth = growths.laid((), 0.0, 0, "b", "b+1", exemplar, 0, at, exemplar.mask)
    names = (np.arange(at.height)[:, None] + PAD << 16) + np.arange(at.width) + PAD
    names = np.where(exemplar.mask, names, OUTSIDE).astype(np.int32)[None]
    region = growth[0].region
    copied = replace(region.levels[0], mask=region.masks[0], sources=tiles.laid(tiles.NONE, at, names, OUTSIDE, at))
    region = replace(region, levels=(copied, *region.levels[1:]))
    growth = (replace(growth[0], region=region, shown=shown.followed((), None, region), drawn=region),)
    found = growths.planes(growth, 1, at.zoomed(1))
    assert np.array_equal(found, snapped(exemplar.finer[0].transpose(2, 0, 1)))


def test_what_is_not_refined_yet_is_seen_from_near_too():
    """While the pen moves there are no sources to look closer at, but for those of the coarsest level."""
    exemplar = shrunk(analysed(blob(1, 200)), 1)
    growth = growths.laid((), 0.0, 0, "a", "a", exemplar, 0, around(0, 0, 30), disc(30))
    growth = growths.previewed(growth)
    assert not growths.is_settled(growth)
    near = Rect.at(-16, -16, 32, 32)
    shown = growths.planes(growth, 0, near)
    for level in (1, 2):
        found = growths.planes(growth, level, near.zoomed(level))
        assert found[3].min() > 0.5
        found = found.reshape(4, 32, 1 << level, 32, 1 << level).mean(axis=(2, 4))
        assert np.abs(found - shown).mean() < 0.03
    growth = growths.laid(growths.settled(growth), 0.0, 0, "a", "a", exemplar, 0, around(50, 0, 30), disc(30))
    assert growths.planes(growths.previewed(growth), 1, Rect.at(80, -10, 60, 20))[3].min() > 0.5
