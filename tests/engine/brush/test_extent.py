"""Strokes with a sparse field end where its copies do."""

import numpy as np
import pytest

from engine.brush.extent import FULL, STEPS, WIDEST, resolve
from engine.brush.mask import StrokeMask
from engine.brush.relief import resolve as resolve_relief
from engine.brush.settings import from_json
from engine.numeric import sparse
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.numeric.spectra import radial_window
from engine.texture.image import ImageSource
from engine.texture.table import instance

RNG = np.random.default_rng(2)
GREY = snapped(RNG.uniform(0, 1, (1, 24, 32)))
SAMPLE = ImageSource.of("s", np.concatenate([GREY, GREY, GREY, np.ones((1, 24, 32), np.float32)]))
DISC = np.array([[100.0, 120, 60, 0.75, 1, 1]])


class Scattered:
    """A texture defined as a field of copies of SAMPLE."""

    def instance(self, parameters, level, seed):
        return instance("sparse", parameters, level, seed, SAMPLE)


def extent(period=32, level=0, **more):
    brush = {"extent": True, "opacity": 0.75, "ink": [{"texture": "s", "period": period}], **more}
    return resolve(from_json(brush), {"s": Scattered()}, level, 5)


def covered(dabs=DISC):
    mask = StrokeMask(0, (0, 0))
    mask.paint(dabs)
    return mask.coverage()


def joined(coverage, rect):
    out = np.zeros((rect.height, rect.width), np.float32)
    for key in rect.tiles(coverage.level):
        tile = coverage.tiles.get(key, 0.0)
        part = key.rect.intersect(rect)
        out[part.slices(rect)] = tile[part.slices(key.rect)] if isinstance(tile, np.ndarray) else tile
    return out


AROUND = Rect(-2 * TILE, -2 * TILE, 4 * TILE, 4 * TILE)


@pytest.mark.parametrize("period", [32, 16, 9, 100])
def test_the_coverage_is_the_sum_of_the_windows_of_the_points_under_the_stroke(period):
    made = extent(period)
    found = joined(made.over(covered()), AROUND)
    reach = sparse.reach(made.impulse, AROUND)
    m = joined(covered(), reach)
    area = radial_window(*made.impulse.size)
    plain = np.zeros(found.shape)
    for step in range(STEPS):
        within = (m > 0.75 * (step + 0.5) / STEPS).astype(np.uint8)
        total = sparse.field(made.impulse, made.noise, AROUND, within)[0].astype(float)
        plain += np.minimum(1, total / (FULL * made.noise.density * area.mean(dtype=np.float64))) * 0.75 / STEPS
    np.testing.assert_allclose(found, plain, atol=2e-4)
    assert found.max() <= 0.75 + 1e-6


def test_the_points_are_those_of_the_ink():
    texture = instance("sparse", {"period": 32}, 0, 5, SAMPLE)
    made = extent(32)
    assert made.noise.key == texture.noise.key
    assert made.impulse.size == texture.impulse(texture.native).size


def test_it_goes_beyond_the_stroke_by_a_window_at_most_and_not_beyond_what_it_says():
    made = extent()
    coverage = covered()
    wide = made.over(coverage)
    found = joined(wide, AROUND)
    rows, columns = np.nonzero(found)
    seen = Rect(*(int(v) for v in (columns.min() - 256, rows.min() - 256, columns.max() - 255, rows.max() - 255)))
    assert seen.union(wide.rect) == wide.rect
    assert coverage.rect.union(seen) != coverage.rect
    assert 16 <= made.reach <= 34
    inner = Rect(80, 100, 120, 140)
    assert (found[inner.slices(AROUND)] > 0.5).mean() > 0.9


def test_tiles_that_did_not_change_are_not_made_again():
    made = extent()
    mask = StrokeMask(0, (0, 0))
    mask.paint(np.array([[64.0, 64, 30, 1, 1, 1]]))
    key = TileKey(0, 0, 0)
    first = made.over(mask.coverage()).tiles[key]
    mask.paint(np.array([[300.0, 64, 30, 1, 1, 1]]))
    assert made.over(mask.coverage()).tiles[key] is first
    with pytest.raises(KeyError):
        made.over(mask.coverage()).tiles[TileKey(0, 50, 0)]


def test_brushes_without_a_field_have_plain_edges():
    assert extent(extent=False) is None
    assert extent(WIDEST + 1) is None
    assert extent(ink=[{"texture": "rock"}]) is None
    assert extent(ink=[], density={"texture": "s", "period": 20}) is not None
    relief = resolve_relief(from_json({"extent": True}), {}, 0, (1, 2))
    coverage = covered()
    assert relief.over(coverage) is coverage
    assert relief.reach == relief.spread == 0
