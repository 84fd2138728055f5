"""What thins a stroke's coverage: density, and the grain that lies still at every level."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.checks import BrushError
from engine.brush.edits import edit
from engine.brush.mask import Coverage, StrokeMask
from engine.brush.relief import SOFTNESS, Heights, resolve
from engine.brush.settings import from_json
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.numeric.pyramid import reduce
from engine.numeric.shaping import table
from engine.texture.grey import grey
from engine.texture.image import ImageSource
from engine.texture.planes import Planes
from engine.texture.table import instance

KEY = TileKey(0, 0, 0)
RNG = np.random.default_rng(8)
PHOTO = ImageSource.of("p", snapped(np.concatenate([RNG.uniform(0, 1, (3, 24, 40)), np.ones((1, 24, 40))])))
DABS = np.array([[40.0, 50, 45, 0.8, 0.7, 0.3], [90, 70, 30, 1, 1, 0.9]])


def covered(values, level=0, key=KEY):
    return Coverage(level, {key: values}, key.rect)


def relief(level=0, seeds=(1, 7), **brush):
    return resolve(from_json(brush), {"photo": PHOTO}, level, seeds)


def heights(part, key):
    """The grain's values over a tile."""
    return relief(key.level, grain=part).grain.plane(key)


def plain(m, g, a):
    touch = np.clip((m * (1 + SOFTNESS) / a - (1 - g)) / SOFTNESS, 0, 1)
    return touch * (m + a * m * (1 - m))


@settings(deadline=None, max_examples=30)
@given(st.floats(0.05, 1), st.integers(0, 2**32))
def test_the_grain_does_what_its_formula_says(amount, seed):
    m = np.random.default_rng(seed).uniform(0, 1, (TILE, TILE)).astype(np.float32)
    made = relief(grain={"texture": "rock", "amount": amount})
    out = made.over(covered(m)).tiles[KEY]
    g = made.grain.plane(KEY).astype(float)
    np.testing.assert_allclose(out, plain(m.astype(float), g, amount), atol=2e-4 / amount)
    assert out.min() >= 0
    assert out.max() <= 1


def test_a_light_touch_meets_only_the_peaks_and_a_full_one_fills():
    made = relief(grain="rock")
    g = made.grain.plane(KEY)
    light = made.over(covered(0.35)).tiles[KEY]
    assert light[g > 0.8].min() > 0.3
    assert not light[g < 0.5].any()
    assert (made.over(covered(1.0)).tiles[KEY] == 1).all()
    assert made.over(covered(0.0)).tiles[KEY] == 0
    more = made.over(covered(0.5)).tiles[KEY]
    assert (more >= light).all()


def test_without_any_amount_there_is_no_relief():
    coverage = covered(0.5)
    assert relief().over(coverage) is coverage
    assert relief(grain={"texture": "rock", "amount": 0}, density={"texture": "x", "amount": 0}).over(coverage) is (
        coverage
    )


def test_density_multiplies():
    made = relief(2, density={"texture": "stripes", "amount": 0.75, "shaping": "negate", "period": 9})
    key = TileKey(2, -3, 5)
    s = (instance("stripes", {"period": 9}, 2, 1).appearance(2, key.rect)[0] + 1) / 2
    out = made.over(covered(0.5, 2, key)).tiles[key]
    np.testing.assert_allclose(out, 0.5 * (0.25 + 0.75 * (1 - s)), atol=1e-5)


GRAINS = [
    {"texture": "rock", "period": 40},
    {"texture": "rock", "period": 23.5, "seed": 4},
    {"texture": "stripes", "period": 18.0, "angle": 30},
    {"texture": "photo"},
    {"texture": "photo", "period": 64, "shaping": "stretch"},
]


@pytest.mark.parametrize("part", GRAINS)
@pytest.mark.parametrize(("coarse", "fine"), [(-3, -1), (-2, 0), (0, 2), (2, 5)])
def test_the_same_hills_at_the_same_places_at_every_level(part, coarse, fine):
    steps = fine - coarse
    size = TILE << steps
    key = TileKey(coarse, 3, -2)
    part = {k: v for k, v in part.items() if k != "shaping"}
    over = relief(coarse, grain=part).grain.plane(key)
    under = relief(fine, grain=part).grain
    above = np.empty((1, size, size), np.float32)
    for tile in key.rect.zoomed(steps).tiles(fine):
        above[0][tile.rect.slices(key.rect.zoomed(steps))] = under.plane(tile)
    for _ in range(steps):
        above = reduce(above)
    if over.std() < 0.03:  # a level at which the period has no pixels left
        assert above[0].std() < 0.12
        return
    assert np.corrcoef(over.ravel(), above[0].ravel())[0, 1] > 0.9
    assert abs(float(over.mean()) - float(above.mean())) < 0.06  # rock re-bases itself on the way


def test_at_its_own_level_a_picture_is_felt_pixel_for_pixel():
    g = heights({"texture": "photo", "level": 3, "period": 40}, TileKey(3, 0, 0))
    expected = np.einsum("chw,c->hw", PHOTO.data[:3], np.array([0.2126, 0.7152, 0.0722]))
    np.testing.assert_allclose(g[:24, :40], expected, atol=1e-4)
    np.testing.assert_array_equal(g[:24, :40], g[24:48, 40:80])


def test_the_grain_belongs_to_the_painting_the_density_to_the_stroke():
    one, other = (relief(grain="rock", density="rock", seeds=(seed, 7)) for seed in (1, 2))
    assert one.grain.plane(KEY).tobytes() == other.grain.plane(KEY).tobytes()
    assert one.density.plane(KEY).tobytes() != other.density.plane(KEY).tobytes()
    assert relief(grain="rock", seeds=(1, 8)).grain.plane(KEY).tobytes() != one.grain.plane(KEY).tobytes()


def test_far_levels_have_a_grain_too():
    deep = heights({"texture": "rock", "period": 40}, TileKey(3000, 1 << 3000, -5))
    assert deep.std() > 0.05
    high = heights({"texture": "rock", "period": 40}, TileKey(-4096, 0, 0))
    assert np.ptp(high) == 0
    assert 0.3 < high[0, 0] < 0.7


def test_grey_of_colours_and_pictures():
    rect = Rect(0, 0, 7, 5)

    class Coloured:
        def appearance(self, level, rect):
            return np.stack([np.full((5, 7), v, np.float32) for v in (-1, 0, 0.4)])

    np.testing.assert_allclose(grey(Coloured(), 0, rect), 0.4)
    assert Heights(instance("white", {}, 0, 0), table("negate")).plane(KEY).max() == 0


@pytest.mark.parametrize("mode", ["paint", "erase", "smooth"])
@pytest.mark.parametrize("locked", [False, True])
def test_every_mode_takes_the_thinned_coverage(mode, locked):
    brush = from_json({"mode": mode, "grain": "rock", "density": "stripes", "colour": "#ff8040"})
    mask = StrokeMask(0, (0, 0))
    mask.paint(DABS)
    made = relief(grain="rock", density="stripes")
    from engine.brush.ink import resolve as resolve_ink

    old = Planes(np.full((4, TILE, TILE), 0.5, np.float32))
    around = lambda rect: Planes(np.full((4, rect.height, rect.width), 0.5, np.float32))  # noqa: E731
    stamp = edit(brush, mask, resolve_ink(brush, {}, 0, 1), locked, around, made).stamp(KEY, old)
    if mode == "erase" and locked:
        assert stamp is None
        return
    m = snapped(made.over(mask.coverage()).tiles[KEY])
    assert (stamp.keep == 1 - m).all()
    assert 0.01 < m.mean() < mask.coverage().on_grid(KEY).mean()


def test_tiles_that_did_not_change_are_not_made_again():
    made = relief(grain="rock")
    mask = StrokeMask(0, (0, 0))
    mask.paint(np.array([[64.0, 64, 30, 0.8, 1, 0.5]]))
    first = made.over(mask.coverage()).tiles[KEY]
    mask.paint(np.array([[300.0, 64, 30, 0.8, 1, 0.5]]))
    assert made.over(mask.coverage()).tiles[KEY] is first
    mask.paint(np.array([[70.0, 64, 30, 1, 1, 0.5]]))
    assert made.over(mask.coverage()).tiles[KEY] is not first


@pytest.mark.parametrize(
    ("brush", "place"),
    [
        ({"grain": "wool"}, "brush.grain.texture"),
        ({"density": {"texture": "rock", "period": -1}}, "brush.density.period"),
        ({"grain": {"texture": "image"}}, "brush.grain.source"),
    ],
)
def test_what_cannot_be_used_is_named(brush, place):
    with pytest.raises(BrushError) as caught:
        relief(**brush)
    assert caught.value.place == place
