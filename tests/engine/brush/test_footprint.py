"""Which pixels a stroke takes: by the dabs alone, however they come, at whatever level."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush import tip
from engine.brush.checks import BrushError
from engine.brush.footprint import Footprint
from engine.brush.mask import StrokeMask
from engine.brush.settings import from_json
from engine.numeric.address import Rect

WHOLE = Rect(-600, -600, 1200, 1200)


def taken(brush, points, origin=(0, 0), finer=0, portions=1, whole=WHOLE, pattern=None, within=None):
    """All pixels of `whole` that a stroke takes: bool (h, w)."""
    out = np.zeros((whole.height, whole.width), bool)
    footprint = Footprint(from_json(brush), origin, finer, pattern, within)
    for part in np.array_split(rows(points), portions):
        for rect, mask in footprint.lay(part):
            assert mask.shape == (rect.height, rect.width)
            both = rect.intersect(whole)
            out[both.slices(whole)] |= mask[both.slices(rect)]
    return out


def rows(points):
    table = np.zeros((len(points), 6))
    table[:, 2] = 1.0
    for i, point in enumerate(points):
        table[i, : len(point)] = point
    return table


def plain(brush, points):
    """Each dab for itself, from the mask that paint has."""
    from engine.brush.dabs import Stroker

    out = np.zeros((WHOLE.height, WHOLE.width), bool)
    for dab in Stroker(from_json(brush)).walk(rows(points)):
        mask = StrokeMask(0, (0, 0))
        mask.paint(dab[None])
        coverage = mask.coverage()
        for key in coverage.keys:
            both = key.rect.intersect(WHOLE)
            out[both.slices(WHOLE)] |= coverage.on_grid(key)[both.slices(key.rect)] >= 0.5
    return out


PATHS = st.lists(st.tuples(st.integers(-150, 250), st.integers(-150, 250)), min_size=1, max_size=4)


@settings(deadline=None, max_examples=20)
@given(PATHS, st.floats(0.3, 40), st.floats(0, 1), st.floats(0.1, 3), st.integers(1, 4))
def test_a_pixel_is_taken_that_one_dab_covers_half(path, radius, hardness, spacing, portions):
    brush = {"radius": radius, "hardness": hardness, "spacing": spacing, "dynamics": {}}
    found = taken(brush, path, portions=portions)
    wanted = plain(brush, path)
    # The mask's profile is float32: at the very rim a pixel may be on the other side of a half.
    assert (found != wanted).sum() <= 0.002 * wanted.sum() + 4
    loud = brush | {"opacity": 0.1, "flow": 0.2, "dynamics": {"opacity": "pressure", "flow": "pressure"}}
    assert np.array_equal(taken(loud, [(x, y, 0.3) for x, y in path]), found)


def test_a_stroke_and_its_pieces_take_the_same_pixels():
    brush = {"radius": 8, "spacing": 0.5, "hardness": 0.2, "dynamics": {}}
    path = [(4 * i, 40) for i in range(30)]  # a dab on every point
    whole = taken(brush, [path[0], path[-1]])
    pieces = taken(brush, path[:11]) | taken(brush, path[10:21]) | taken(brush, path[20:])
    assert np.array_equal(whole, pieces)


def test_where_the_pen_is_lifted_nothing_is_taken():
    """However many dabs there are on the way, of no size."""
    brush = {"radius": 6, "dynamics": {"radius": "pressure"}}
    touches = [[(x, y, 0), (x, y, 1), (x + 8, y + 3, 0)] for x, y in ((10, 20), (400, 30), (60, 500))]
    lifted = taken(brush, [point for touch in touches for point in touch])
    alone = np.logical_or.reduce([taken(brush, touch) for touch in touches])
    assert (lifted != alone).sum() < 0.1 * alone.sum()  # other dabs of the same touches
    assert not lifted[:, 700:980].any()
    assert not list(Footprint(from_json(brush), (0, 0)).lay(rows([(10, 20, 0), (400, 30, 0)])))


@pytest.mark.parametrize("finer", [-8, -3, -1, 1, 3])
def test_a_stroke_takes_the_same_place_of_a_finer_or_coarser_level(finer):
    origin = ((1 << 90) + 77, -(1 << 70) - 3)
    brush = {"radius": 30, "dynamics": {}}
    points = [(5.5, 7.25), (60.0, 40.0)]
    scale = 2.0**finer
    x, y = ((value << finer) if finer > 0 else (value >> -finer) for value in origin)
    whole = Rect(x - 400, y - 400, x + 800, y + 800)
    found = taken(brush, points, origin, finer, whole=whole)
    left = [value - ((value >> -finer) << -finer) if finer < 0 else 0 for value in origin]
    moved = [((px + left[0]) * scale, (py + left[1]) * scale) for px, py in points]
    wanted = taken(brush | {"radius": 30 * scale}, moved, whole=Rect(-400, -400, 800, 800))
    assert found.any() == (30 * scale >= 0.36)
    assert (found != wanted).sum() <= 0.01 * wanted.sum() + 1  # spacing has a least step in pixels of the stroke


def test_a_tip_gives_the_dab_its_shape():
    brush = {"radius": 60, "dynamics": {}, "spacing": 16, "tip": {"texture": "stripes", "period": 40}}
    pattern = tip.resolve(from_json(brush), {}, 0, 1)
    found, full = taken(brush, [(100, 100)], pattern=pattern), taken(brush, [(100, 100)])
    assert 0.3 < (found & full).sum() / full.sum() < 0.7
    assert not (found & ~full).any()
    assert np.array_equal(found, taken(brush, [(100, 100), (110, 100)], portions=2, pattern=pattern))
    within = Rect(60, 90, 120, 300)
    part = taken(brush, [(100, 100)], pattern=pattern, within=within)
    assert np.array_equal(part[within.slices(WHOLE)], found[within.slices(WHOLE)])
    assert part.sum() == part[within.slices(WHOLE)].sum() < found.sum()


def test_strokes_that_are_too_large_are_refused():
    with pytest.raises(BrushError, match=r"brush\.radius: found 2400 px"):
        taken({"radius": 600, "dynamics": {}}, [(0, 0)], finer=2)
    with pytest.raises(BrushError, match=r"stroke: found one that meets 40.. squares"):
        taken({"radius": 1, "dynamics": {}}, [(0, 0), (1e6, 0)])
    assert not taken({"radius": 0.2, "dynamics": {}}, [(0.5, 0.5)]).any()


def test_a_wide_eraser_is_laid_piece_by_piece():
    """However many dabs there are: each piece is made when it is asked for, and pieces hardly overlap."""
    brush = {"radius": 1000, "spacing": 0.05, "hardness": 1, "dynamics": {}}
    footprint = Footprint(from_json(brush), (0, 0), within=Rect(-5000, -5000, 5000, 5000))
    pieces = footprint.lay(rows([(0, 0), (4000, 0)]))
    assert iter(pieces) is pieces
    areas = [rect.area for rect, _ in pieces]
    assert max(areas) <= 2 * 2002**2
    assert sum(areas) <= 3 * 6000 * 2002
