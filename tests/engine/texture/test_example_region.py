"""What is painted with an example depends on the region, the example and the seed alone."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event

import numpy as np
import pytest
from exemplars import bounded, controlled, faint, told_at, unbounded
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from engine.numeric.address import Rect
from engine.numeric.neighbourhood import FULL
from engine.strokes.example_files import read_exemplar, read_parameters
from engine.texture.example import region as regions
from engine.texture.example import tiles
from engine.texture.example.exemplar import PAD, analysed
from engine.texture.example.region import empty, painted, refined, refining

EXEMPLARS = {
    "bounded": bounded(),
    "unbounded": unbounded(),
    "two passes": bounded(passes=2, neighbourhood=5),
    "told": controlled(),
    "seamless": bounded(method=2),
    "seamless, told": controlled(method=2),
    "seamless, faint": faint(method=2),
    "seamless, unbounded": unbounded(method=2),
}
EXAMPLES = Path(__file__).parents[3] / "palettes" / "examples"
places = st.tuples(st.integers(-40, 60), st.integers(-40, 60), st.integers(1, 24))


def bundled(name):
    at = EXAMPLES / name
    return read_exemplar(f"{at}.png", f"{at}.mask.png", read_parameters(f"{at}.toml"))


def disc(radius):
    y, x = np.mgrid[-radius : radius + 1, -radius : radius + 1]
    return x * x + y * y <= radius * radius


def dabbed(region, dab, erase=False, at=(0, 0)):
    x, y, radius = dab
    side = 2 * radius + 1
    rect = Rect.at(at[0] + x - radius, at[1] + y - radius, side, side)
    return painted(region, rect, disc(radius), erase, told_at(region.exemplar, rect))


def same(one, other):
    """All levels' sources and masks are alike, tile by tile."""
    for a, b in zip(one.levels, other.levels, strict=True):
        for left, right in ((a.sources, b.sources), (a.mask, b.mask)):
            assert set(left) == set(right)
            for key, tile in left.items():
                assert np.array_equal(tile.data, right[key].data), key


def sources(region, rect, level=0):
    out = np.full((1, rect.height, rect.width), -1, np.int32)
    return tiles.gathered_last(region.levels[level].sources, rect, out)[0]


@pytest.mark.parametrize("name", EXEMPLARS)
@settings(deadline=None, max_examples=12)
@given(dabs=st.lists(places, min_size=1, max_size=6), again=st.randoms(), seed=st.integers(0, 9))
def test_many_dabs_in_any_order_are_one_shot(name, dabs, again, seed):
    start = empty(EXEMPLARS[name], seed)
    grown = whole = shuffled = start
    for dab in dabs:
        grown = refined(dabbed(grown, dab))
        whole = dabbed(whole, dab)
    order = list(dabs)
    again.shuffle(order)
    for k, dab in enumerate(order):  # some levels wait for the next dab
        shuffled = refined(dabbed(shuffled, dab), upto=k % 3 if k + 1 < len(order) else 0)
    same(grown, refined(whole))
    same(grown, shuffled)


@pytest.mark.parametrize("name", EXEMPLARS)
@settings(deadline=None, max_examples=8)
@given(dabs=st.lists(places, min_size=1, max_size=4), gone=places)
def test_what_was_erased_leaves_no_trace(name, dabs, gone):
    first = dabbed(empty(EXEMPLARS[name], 3), gone)
    there = refined(first)
    for dab in dabs:
        there = refined(dabbed(there, dab))
    there = refined(dabbed(there, gone, erase=True))
    plain = empty(EXEMPLARS[name], 3)
    for dab in dabs:
        plain = dabbed(plain, dab)
    same(there, refined(dabbed(plain, gone, erase=True)))


@settings(deadline=None, max_examples=6)
@given(dabs=st.lists(places, min_size=2, max_size=5), stops=st.integers(1, 30))
def test_a_refinement_may_stop_anywhere(dabs, stops):
    start = whole = empty(EXEMPLARS["bounded"], 1)
    for dab in dabs:
        start, whole = dabbed(start, dab), dabbed(whole, dab)
        for n, step in enumerate(refining(start), 1):
            start = step.region
            if n == stops:
                break
    same(refined(start), refined(whole))


@pytest.mark.parametrize("name", EXEMPLARS)
def test_threads_and_squares_do_not_matter(name, monkeypatch):
    random = np.random.default_rng(2)
    mask = np.kron(random.integers(0, 2, (12, 15)), np.ones((16, 16))).astype(bool)
    start = painted(empty(EXEMPLARS[name], 5), Rect.at(-17, 33, 240, 192), mask)
    plain = refined(start)
    assert (sources(plain, Rect.at(-17, 33, 240, 192)) >= 0).sum() == mask.sum()
    with ThreadPoolExecutor(2) as pool:
        monkeypatch.setattr(regions, "_TOGETHER", 0)
        monkeypatch.setattr(regions, "_SLICE", 97)
        same(plain, refined(start, threads=pool))
        monkeypatch.setattr(regions, "_SHARED", 1000)
        same(plain, refined(start, threads=pool))
        same(plain, refined(start))
        monkeypatch.setattr(regions, "_AT_ONCE", 32)
        monkeypatch.setattr(regions, "_SQUARE", 64)
        same(plain, refined(start, threads=pool))
        more = np.ones((50, 60), bool)
        rect = Rect.at(100, 100, 60, 50)
        after = refined(painted(plain, rect, more), threads=pool)
    same(after, refined(painted(start, rect, more)))


def test_threads_stop_where_no_more_is_asked_for(monkeypatch):
    monkeypatch.setattr(regions, "_SHARED", 1000)
    monkeypatch.setattr(regions, "_TOGETHER", 0)
    start = painted(empty(EXEMPLARS["two passes"], 5), Rect.at(-17, 33, 300, 200), np.ones((200, 300), bool))
    whole = refined(start)
    readying, alone, gate, ended = regions._readying, regions._alone, Event(), []

    def gated(region, n, *where):
        assert n > 0 or gate.wait(200)
        return (yield from readying(region, n, *where))

    monkeypatch.setattr(regions, "_readying", gated)
    monkeypatch.setattr(regions, "_alone", lambda *given: ended.append(alone(*given)) or ended[-1])
    with ThreadPoolExecutor(2) as pool:
        steps = refining(start, threads=pool)
        step = next(step for step in steps if step.level == 0)
        steps.close()
        gate.set()
    assert step.done < 1.0
    assert len(ended) <= 2
    assert all(found is None for found in ended)
    same(whole, refined(step.region))


def test_places_may_be_anywhere():
    """Far away everything goes on alike: the same region there is another texture, and as good."""
    for far in (1 << 32, -(1 << 32), 3 << 70):
        grown = whole = empty(EXEMPLARS["bounded"], 1)
        for dab in ((-20, 3, 16), (8, 0, 20), (30, -6, 14)):
            grown = refined(dabbed(grown, dab, at=(far, far)))
            whole = dabbed(whole, dab, at=(far, far))
        same(grown, refined(whole))
        found = sources(grown, Rect.at(far - 40, far - 40, 100, 100))
        assert (found >= 0).sum() > 1500


def test_seeds_differ_and_only_what_can_be_reached_changes():
    exemplar = EXEMPLARS["bounded"]
    whole = Rect.at(0, 0, 300, 100)
    one, other = (refined(painted(empty(exemplar, s), whole, np.ones((100, 300), bool))) for s in (1, 2))
    assert (sources(one, whole) != sources(other, whole)).mean() > 0.5
    more = refined(dabbed(one, (300, 50, 20)))
    far = Rect.at(0, 0, 100, 100)
    assert np.array_equal(sources(one, far), sources(more, far))
    assert one.levels[0].sources[(0, 0)] is more.levels[0].sources[(0, 0)]
    assert one.fresh(0)
    assert not dabbed(one, (300, 50, 20)).fresh(0)
    assert dabbed(one, (300, 50, 20)).finest == len(one.levels)


def test_levels_come_one_after_another():
    start = dabbed(empty(EXEMPLARS["bounded"], 1), (10, 10, 20))
    ends = [step.level for step in refining(start) if step.done == 1.0]
    assert sorted(set(ends), reverse=True) == list(reversed(range(len(start.levels))))
    coarse = refined(start, upto=1)
    assert coarse.finest == 1
    same(refined(coarse), refined(start))
    assert not list(refining(refined(start)))
    assert painted(start, Rect(0, 0, 0, 0), np.zeros((0, 0), bool)) is start


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (2, 3), (5, 40)])
def test_tiny_examples(shape):
    pixels = np.random.default_rng(0).integers(1, 256, (*shape, 4)).astype(np.uint8)
    for mask in (None, np.indices(shape).sum(0) % 3 == 0):
        done = refined(dabbed(empty(analysed(pixels, mask), 1), (10, 10, 12)))
        assert (sources(done, Rect.at(-2, -2, 25, 25)) >= 0).sum() == disc(12).sum()


def depths(mask):
    """How far each pixel lies from the outline."""
    return ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1]


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize(("side", "values"), [(64, {}), (120, {}), (120, {"passes": 2}), (120, {"method": 2})])
def test_rims_come_from_rims_and_insides_from_insides(side, values, seed):
    exemplar = bounded(side, **values)
    y, x = np.mgrid[:160, :260]
    mask = abs(y - 80 - 30 * np.sin(x / 40.0)) < 34
    mask[:, :20] = mask[:, -20:] = False
    mask[70:90, 120:140] = False
    rect = Rect.at(-31, 17, 260, 160)
    names = sources(refined(painted(empty(exemplar, seed), rect, mask)), rect)
    here, there = depths(exemplar.mask), depths(mask)
    found = np.zeros(mask.shape)
    found[mask] = here[(names[mask] >> 16) - PAD, (names[mask] & 0xFFFF) - PAD]
    assert (found[mask & (there <= 3)] <= 3).mean() > 0.9
    assert (found[there > 6] <= 3).mean() < 0.1


@st.composite
def planes(draw):
    """Some planes of tiles, most of whose pixels are 0."""
    held = np.zeros(draw(st.tuples(st.integers(1, 2), st.integers(1, 9), st.integers(1, 9))), np.uint8)
    for place in draw(st.lists(st.tuples(*(st.integers(0, n - 1) for n in held.shape)), max_size=3)):
        held[place] = draw(st.integers(1, 255))
    return held


@settings(deadline=None, max_examples=60)
@given(held=planes())
def test_bounds_are_those_of_what_is_not_0(held):
    y0, y1, x0, x1 = tiles.bounds(held)
    rows, columns = (np.flatnonzero(held.any((0, axis))) for axis in (2, 1))
    if held.any():
        assert (y0, y1, x0, x1) == (rows[0], rows[-1] + 1, columns[0], columns[-1] + 1)
    else:
        assert y0 == y1 == x0 == x1


def test_shapes_of_rims_are_kept_side_by_side():
    for exemplar in EXEMPLARS.values():
        for level, shapes in zip(exemplar.levels, exemplar.shapes, strict=True):
            names = level.order[: shapes.size - 1]
            assert np.array_equal(shapes[:-1], level.bits[names >> 16, names & 0xFFFF])
            assert (
                level.bits[level.order[shapes.size - 1 :] >> 16, level.order[shapes.size - 1 :] & 0xFFFF] == FULL
            ).all()
            assert shapes[-1] == FULL
            assert exemplar.control is not None or (shapes[:-1] != FULL).all()


@pytest.mark.parametrize("width", [8, 16])
@pytest.mark.parametrize("name", ["embroidery", "orange-peel", "torn-newsprint", "torn-rag-paper"])
def test_narrow_strokes_come_from_rims(name, width):
    """Both of their sides are near, and what continues one must not go on to the other."""
    exemplar = bundled(name)
    y, x = np.mgrid[:160, :300]
    wave = 0.25 * np.arange(4 * 300)
    mask = np.zeros((160, 300), bool)
    for at, middle in zip(wave, 80.0 + 60.0 * np.sin(wave / 40.0), strict=True):
        mask |= (y - middle) ** 2 + (x - at) ** 2 < (0.5 * width) ** 2
    rect = Rect(0, 0, 300, 160)
    names = sources(refined(painted(empty(exemplar, 1), rect, mask)), rect)
    near = mask & (depths(mask) <= 3)
    found = depths(exemplar.mask)[(names[near] >> 16) - PAD, (names[near] & 0xFFFF) - PAD]
    assert (found <= 4).mean() > 0.9


@pytest.mark.parametrize("name", ["wash-indigo", "torn-rag-paper", "felt"])
def test_a_straight_band_does_not_repeat(name):
    """Along it all shapes are one: few pixels may come from where another one some way along the row comes from."""
    exemplar = bundled(name)
    grown = refined(painted(empty(exemplar, 1), Rect(0, 0, 660, 100), np.ones((100, 660), bool)))
    found = sources(grown, Rect(40, 0, 620, 100))
    assert max((found[:, lag:] == found[:, :-lag]).mean() for lag in range(6, 60)) < 0.25


def test_sources_are_as_control_channels_tell():
    """Within, where a channel changes slowly; one that is laid over what is there takes its place."""
    exemplar, rect = controlled(64, turns=16), Rect.at(-7, 5, 96, 96)
    y, x = np.mgrid[:96, :96]
    inside = np.hypot(y - 48, x - 48) < 46
    for way in (x * 2 & 255, 200 + y & 255):
        values = np.stack([way, np.full_like(way, 128)]).astype(np.uint8)
        names = sources(refined(painted(empty(exemplar, 4), rect, inside, values=values)), rect)
        found = exemplar.control.levels[0][:, names[inside] >> 16, names[inside] & 0xFFFF].astype(int)
        apart = np.abs((found[0] - way[inside] + 128 & 255) - 128)
        assert np.quantile(apart, 0.9) <= 16  # as far as copies are apart
        assert np.median(np.abs(found[1] - 128)) <= 40
    first = refined(painted(empty(exemplar, 4), rect, inside, values=np.zeros((2, 96, 96), np.uint8)))
    same(
        refined(painted(first, rect, inside, values=values)),
        refined(painted(empty(exemplar, 4), rect, inside, values=values)),
    )
