"""The coverage of a stroke: the compiled kernel against plain NumPy, its invariants, and its limits."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush import discs as kernels
from engine.brush.checks import BrushError
from engine.brush.dabs import Stroker
from engine.brush.mask import StrokeMask
from engine.brush.settings import from_json
from engine.numeric.address import TILE, Rect, TileKey

DABS = st.lists(
    st.tuples(
        st.floats(-150, 300),
        st.floats(-150, 300),
        st.one_of(st.floats(0, 3), st.floats(3, 200)),
        st.one_of(st.just(1.0), st.floats(0, 1)),
        st.one_of(st.just(1.0), st.floats(0, 1)),
        st.floats(0, 1),
    ),
    min_size=1,
    max_size=8,
).map(lambda rows: np.array(rows, float))


def plain(dabs, rect):
    """M over a rectangle, in float64, by the formulas of the documentation."""
    y, x = np.mgrid[rect.y0 : rect.y1, rect.x0 : rect.x1] + 0.5
    m = np.zeros(x.shape)
    for cx, cy, radius, opacity, flow, hardness in dabs:
        ceiling = np.floor(opacity * min(1, (radius / 0.5) ** 2) * 65536 + 0.5) / 65536
        r = max(radius, 0.5)
        inner, outer = max(0.0, min(hardness * r, r - 0.5)), r + 0.5
        u = np.clip(((x - cx) ** 2 + (y - cy) ** 2 - inner**2) / (outer**2 - inner**2), 0, 1)
        m += np.maximum(0, ceiling - m) * flow * (1 - u) ** 2 * (1 + 2 * u)
    return m


def laid(mask, rect):
    """M of a mask over a rectangle of its level."""
    coverage = mask.coverage()
    out = np.zeros((rect.height, rect.width), np.float32)
    for key in rect.tiles(mask.level):
        part = key.rect.intersect(rect)
        out[part.slices(rect)] = coverage.on_grid(key)[part.slices(key.rect)]
    return out


@settings(deadline=None, max_examples=25)
@given(DABS)
def test_the_kernel_does_what_plain_numpy_does(dabs):
    mask = StrokeMask(0, (0, 0))
    mask.paint(dabs)
    rect = Rect(-384, -384, 640, 640)
    np.testing.assert_allclose(laid(mask, rect), plain(dabs, rect), atol=2e-4)


@settings(deadline=None, max_examples=25)
@given(DABS, st.lists(st.integers(0, 8), max_size=4))
def test_any_portions_give_the_same_coverage_bit_for_bit(dabs, cuts):
    whole, parts = StrokeMask(0, (0, 0)), StrokeMask(0, (0, 0))
    keys = whole.paint(dabs)
    held = []
    for part in np.split(dabs, sorted(cuts)):
        parts.paint(part)
        held.append(parts.coverage())
    keys |= set(parts.coverage().tiles) | set(whole.coverage().tiles)
    for key in keys:
        assert whole.coverage().on_grid(key).tobytes() == parts.coverage().on_grid(key).tobytes()
    assert whole.rect == parts.rect


@settings(deadline=None, max_examples=20)
@given(DABS)
def test_opacity_is_a_ceiling_and_coverage_only_grows(dabs):
    mask = StrokeMask(0, (0, 0))
    before = {}
    for i in range(len(dabs)):
        mask.paint(dabs[i : i + 1])
        coverage = mask.coverage()
        highest = max(0.0, *(np.floor(o * 65536 + 0.5) / 65536 for o in dabs[: i + 1, 3]))
        for key in coverage.tiles:
            m = coverage.on_grid(key)
            assert m.max() <= highest
            assert m.min() >= 0
            assert (m >= before.get(key, 0)).all()
            assert (m * 65536 == np.rint(m * 65536)).all()
            before[key] = m


def test_many_dabs_come_up_to_the_opacity_and_no_further():
    mask = StrokeMask(0, (0, 0))
    mask.paint(np.tile([64.0, 64, 30, 0.5, 0.2, 0.5], (200, 1)))
    m = mask.coverage().on_grid(TileKey(0, 0, 0))
    assert m[64, 64] == 0.5
    assert m.max() == 0.5


@settings(deadline=None, max_examples=20)
@given(DABS)
def test_rect_and_keys_hold_all_that_is_covered(dabs):
    mask = StrokeMask(2, (1000, -77))
    touched = mask.paint(dabs)
    coverage = mask.coverage()
    assert touched <= set(coverage.tiles) == set(coverage.keys)
    assert list(coverage.keys) == sorted(coverage.keys, key=lambda k: (k.y, k.x))
    for key in coverage.keys:
        m = coverage.on_grid(key)
        inside = coverage.rect.intersect(key.rect)
        if not inside.empty:
            m[inside.slices(key.rect)] = 0
        assert not m.any()
        assert key in touched or not coverage.on_grid(key).any()


@pytest.mark.parametrize("hardness", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("radius", [0.05, 0.2, 0.5, 1.0, 3.0, 20.0])
def test_the_area_of_a_dab_is_that_of_its_profile(radius, hardness):
    """The profile's integral is pi (Rin^2 + Rout^2) / 2; below half a pixel it falls with the radius squared."""
    sums = []
    for at in np.random.default_rng(5).uniform(50, 60, (200, 2)):
        mask = StrokeMask(0, (0, 0))
        mask.paint(np.array([[*at, radius, 1, 1, hardness]]))
        sums.append(laid(mask, Rect(0, 0, 128, 128)).sum(dtype=float))
    r = max(radius, 0.5)
    inner, outer = max(0.0, min(hardness * r, r - 0.5)), r + 0.5
    area = math.pi * (inner**2 + outer**2) / 2 * min(1, (radius / 0.5) ** 2)
    assert np.mean(sums) == pytest.approx(area, rel=0.03)


@pytest.mark.parametrize("origin", [(2**70, -(2**70)), (2**70 + 37, 5 - 2**71), (-1, 127)])
def test_huge_origins_paint_as_near_ones(origin):
    near = origin[0] % TILE, origin[1] % TILE
    moved = origin[0] // TILE, origin[1] // TILE
    stroke = Stroker(from_json({"radius": 40})).add(np.array([[0.0, 0, 1], [300, 100, 0.5]]))
    a, b = StrokeMask(60, origin), StrokeMask(60, near)
    keys = a.paint(stroke)
    assert {TileKey(60, k.x + moved[0], k.y + moved[1]) for k in b.paint(stroke)} == keys
    for key in keys:
        there = TileKey(60, key.x - moved[0], key.y - moved[1])
        assert (a.coverage().on_grid(key) == b.coverage().on_grid(there)).all()
    assert a.rect == Rect(*(b.rect[i] + moved[i % 2] * TILE for i in range(4)))


def test_a_huge_dab_keeps_its_inside_as_single_values():
    mask = StrokeMask(0, (0, 0))
    mask.paint(np.array([[64.0, 64, 4000, 0.75, 0.5, 0.8]]))
    tiles = mask.coverage().tiles
    flat = [m for m in tiles.values() if not isinstance(m, np.ndarray)]
    assert len(flat) > 1800
    assert set(flat) == {0.375}
    mask.paint(np.array([[64.0, 64, 4000, 1, 1, 1]]))
    full = mask.coverage().tiles
    assert sum(m == 1.0 for m in full.values() if not isinstance(m, np.ndarray)) > 2800


def test_flat_tiles_hold_what_the_kernel_would_lay():
    rows = np.array([[64.0, 64, 700, 0.7, 0.3, 1], [64, 60, 700, 0.9, 0.25, 1], [40, 64, 30, 0.8, 1, 0.5]])
    mask = StrokeMask(0, (0, 0))
    mask.paint(rows[:2])
    assert isinstance(mask.coverage().tiles[TileKey(0, 0, 0)], float)
    mask.paint(rows[2:])
    np.testing.assert_allclose(laid(mask, Rect(0, 0, 128, 128)), plain(rows, Rect(0, 0, 128, 128)), atol=1e-5)


def test_a_tile_is_wiped_only_by_a_dab_that_reaches_the_ceiling():
    rect = Rect(0, 0, 128, 128)
    small, low, high = [40.0, 64, 30, 0.8, 1, 0.5], [64.0, 64, 700, 0.5, 1, 1], [64.0, 60, 700, 0.8, 1, 1]
    for rows, flat in (([small, low], False), ([small, low, high], True), ([high, small, low], True)):
        together, apart = StrokeMask(0, (0, 0)), StrokeMask(0, (0, 0))
        together.paint(np.array(rows))
        for row in rows:
            apart.paint(np.array([row]))
        for mask in (together, apart):
            assert isinstance(mask.coverage().tiles[TileKey(0, 0, 0)], float) == flat
            np.testing.assert_allclose(laid(mask, rect), plain(np.array(rows), rect), atol=1e-5)


def test_a_coverage_never_changes():
    mask = StrokeMask(0, (0, 0))
    dab = np.array([[64.0, 64, 20, 1, 0.1, 0.5]])
    mask.paint(dab)
    held = mask.coverage()
    before = held.on_grid(TileKey(0, 0, 0))
    mask.paint(dab)
    assert (held.on_grid(TileKey(0, 0, 0)) == before).all()
    assert (mask.coverage().on_grid(TileKey(0, 0, 0)) >= before).all()
    assert (mask.coverage().on_grid(TileKey(0, 0, 0)) > before).any()


def test_dabs_without_effect_touch_nothing():
    mask = StrokeMask(0, (0, 0))
    assert mask.paint(np.array([[0, 0, 10, 0, 1, 1], [0, 0, 10, 1, 0, 1], [0, 0, 0, 1, 1, 1.0]])) == set()
    assert mask.paint(np.empty((0, 6))) == set()
    assert mask.rect.empty
    assert not mask.coverage().tiles


def test_a_stroke_over_too_many_tiles_is_refused():
    mask = StrokeMask(0, (0, 0), tiles_cap=100)
    mask.paint(np.array([[0.0, 0, 100, 1, 1, 1]]))
    with pytest.raises(BrushError, match="at most 100"):
        mask.paint(np.array([[0.0, 0, 4000, 1, 1, 1]]))
    tiny = Stroker(from_json({"radius": 0.5})).add(np.array([[-(2.0**31), 0], [2.0**31, 0]]))
    with pytest.raises(BrushError, match="at most"):
        StrokeMask(0, (0, 0)).paint(tiny)


def test_more_pairs_than_are_sorted_at_once():
    dabs = np.tile([64.0, 64, 2500, 1, 0.1, 0.0], (12, 1))
    whole = StrokeMask(0, (0, 0))
    whole.paint(dabs)
    parts = StrokeMask(0, (0, 0))
    for i in range(12):
        parts.paint(dabs[i : i + 1])
    a, b = whole.coverage(), parts.coverage()
    assert a.keys == b.keys
    assert all(np.array_equal(a.tiles[key], b.tiles[key]) for key in a.keys)


@pytest.mark.parametrize("plainly", [False, True])
def test_scattered_dabs_give_the_same_coverage_whether_they_come_together_or_one_by_one(plainly, monkeypatch):
    """Together, those of tiles that are known are laid at once; a coverage that was taken in between stays as it is."""
    if plainly:
        monkeypatch.setattr(kernels, "lay_runs", kernels.lay_runs.plain)
    rng = np.random.default_rng(4)
    dabs = np.column_stack([700 * rng.random((90, 2)) - 200, 1 + 20 * rng.random(90), *rng.random((3, 90))])
    dabs[70, 2:5] = 400.0, 1.0, 1.0  # it wipes tiles out
    together, apart = StrokeMask(0, (0, 0)), StrokeMask(0, (0, 0))
    touched = together.paint(dabs[:30]) | together.paint(dabs[30:60])
    taken = together.coverage()
    before = {key: taken.on_grid(key) for key in taken.keys}
    touched |= together.paint(dabs[60:75]) | together.paint(dabs[75:])
    for dab in dabs:
        apart.paint(dab[None])
    a, b = together.coverage(), apart.coverage()
    assert a.keys == b.keys == tuple(sorted(touched, key=lambda key: (key.y, key.x)))
    assert all(np.array_equal(a.on_grid(key), b.on_grid(key)) for key in a.keys)
    assert all(np.array_equal(taken.on_grid(key), old) for key, old in before.items())
