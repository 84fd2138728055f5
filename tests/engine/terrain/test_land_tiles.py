"""Tiles of land as the card draws them: without cracks, of the plane's heights, and met where a ray meets them."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.value import Painting
from engine.session.apply import Around, apply
from engine.terrain.drape import Cover
from engine.terrain.plane import land
from engine.terrain.seen.choosing import LandSight, anchor, choose_tiles
from engine.terrain.seen.eye import Eye, from_whole
from engine.terrain.seen.land_tiles import FINER, QUADS, TEXELS, UNIT, TileKey, morphed
from engine.terrain.seen.meeting import ground_under, height_in, met
from engine.terrain.seen.tile_making import TileMaker

FRAME = Rect.at(0, 0, 192, 128)
ROCK = {"texture": "rock", "amount": 1, "period": 96, "roughness": 0.9, "colour": "#808080", "renew": False}
STROKE = {
    "do": "stroke",
    "points": [[60, 60], [90, 66]],
    "brush": {"radius": 44, "colour": "#404040", "hardness": 0.2, "ink": [ROCK]},
}


@pytest.fixture(scope="module")
def made():
    """Tiles by their keys, each made once."""
    painting = apply(
        apply(Painting(FRAME, 7), parse({"do": "layer", "add": "Hills"}), Around()), parse(STROKE), Around()
    )
    cache = TileCache(32 << 20)
    maker, tiles = TileMaker(land(painting, scale=60.0, cache=cache), Cover(None, 0.0, 40.0), False), {}

    def of(key):
        if key not in tiles:
            tiles[key] = maker.make(key)
        return tiles[key]

    of.land = maker.land
    return of


def corners(land, level, rect):
    """Heights at the corners of pixels: of the four that meet there the mean."""
    h = land.height(level, Rect(rect.x0 - 1, rect.y0 - 1, rect.x1 + 1, rect.y1 + 1))
    return (h[1:, 1:] + h[1:, :-1] + h[:-1, 1:] + h[:-1, :-1]) / 4


@pytest.mark.parametrize("level", [-1, 2, 9])
def test_the_corners_of_a_tile_are_the_plane(made, level):
    x, y = (int(v * 2.0**level / QUADS) for v in (74.2, 63.3))
    tile = made(TileKey(level, x, y))
    own = corners(made.land, level, Rect.at(x * QUADS, y * QUADS, QUADS, QUADS))
    told = (tile.heights[:, :, 0].astype(np.float64) + tile.base) * 2.0 ** -(level + UNIT)
    assert np.abs(told - own).max() <= 0.51 * 2.0 ** -(level + UNIT)
    fine = corners(made.land, level + FINER, Rect.at(x * TEXELS, y * TEXELS, TEXELS, TEXELS))
    assert np.abs((tile.surface.astype(np.float64) + tile.base * 2.0**-UNIT) * 2.0**-level - fine).max() < 2.0 ** (
        -level - 12
    )


def seen_from(x, y, up, texel=4.0):
    eye = Eye(Fraction(x), Fraction(y), 30.0 + up, 30.0, -35.0)
    return LandSight(eye, (640, 400), up, texel, FRAME)


def whole(sight, made):
    """What is drawn once nothing is lacking."""
    held = {}
    while True:
        found = choose_tiles(sight, held)
        if not found.lacking:
            return found, held
        held |= {key: made(key) for key in found.lacking}


def edge(of, key, at, sight, side):
    """What a tile draws of one of its rims."""
    tile = of[key]
    where = morphed(tile, at.place(key, tile.base, sight), at.eye, at.clear)
    return {"left": where[:, 0], "right": where[:, -1], "top": where[0], "bottom": where[-1]}[side]


@settings(max_examples=3, deadline=None)
@given(st.floats(20, 150), st.floats(20, 110), st.sampled_from([3.0, 11.0]))
def test_where_tiles_meet_they_are_the_same_bit_for_bit(made, x, y, up):
    sight = seen_from(x, y, up)
    found, held = whole(sight, made)
    drawn, at = set(found.drawn), anchor(sight, found.finest)
    same = coarser = 0
    for key in drawn:
        for dx, dy, mine, theirs in ((1, 0, "right", "left"), (0, 1, "bottom", "top"), (-1, 0, "left", "right")):
            other = TileKey(key.level, key.x + dx, key.y + dy)
            if other in drawn:
                same += 1
                assert edge(held, key, at, sight, mine).tobytes() == edge(held, other, at, sight, theirs).tobytes()
            elif other.parent in drawn and other.parent != key.parent:
                coarser += 1
                fine = {tuple(p) for p in edge(held, key, at, sight, mine).tolist()}
                coarse = {tuple(p) for p in edge(held, other.parent, at, sight, theirs).tolist()}
                assert len(fine) == QUADS // 2 + 1
                assert fine <= coarse
    assert same > 20
    assert coarser > 3


def test_no_tile_is_drawn_twice_and_none_but_those_that_are_lacking_is_left_out(made):
    sight = seen_from(70, 60, 5.0)
    found, held = whole(sight, made)
    above = {key for key in found.drawn for other in found.drawn if other != key and covers(other, key)}
    assert not above
    few = {key: tile for key, tile in held.items() if key.level <= found.finest - 2}
    again = choose_tiles(sight, few)
    assert again.lacking
    assert again.drawn
    assert not any(covers(other, key) for key in again.drawn for other in again.drawn if other != key)


def covers(one, other):
    up = other.level - one.level
    return up > 0 and (other.x >> up, other.y >> up) == (one.x, one.y)


def test_what_is_nearer_than_a_level_reaches_is_drawn_finer(made):
    sight = seen_from(70, 60, 2.0)
    found, _ = whole(sight, made)
    for key in found.drawn:
        side = QUADS / 2.0**key.level
        x, y = (float(v) for v in (sight.eye.x, sight.eye.y))
        far = max(key.x * side - x, x - (key.x + 1) * side, key.y * side - y, y - (key.y + 1) * side, sight.clear)
        texel = 2.0 ** (-key.level - FINER) / (far * sight.eye.pixel(640))
        assert texel <= sight.texel * (1 + 1e-9) or far >= 1.5 * side


def test_a_ray_meets_the_tiles_where_small_steps_do(made):
    sight = seen_from(70, 100, 20.0)
    found, held = whole(sight, made)
    tiles = [held[key] for key in found.drawn]
    hits = 0
    for x, y in ((320, 200), (100, 320), (540, 380), (20, 150), (330, 120)):
        way = sight.eye.direction(x, y, sight.size)
        hit = met(tiles, sight.eye, way)
        if hit is None:
            continue
        hits += 1
        finest = next(t for t in sorted(tiles, key=lambda t: -t.key.level) if inside(t, hit.x, hit.y))
        pixel = 2.0 ** -(finest.key.level + FINER)
        assert abs(height_in(finest, hit.x, hit.y) - hit.z) < 1e-4 * pixel
        for t in np.linspace(0.0, hit.away * 0.999, 300):  # nothing lies before it
            at = sight.eye.moved(way * t)
            ground = ground_under(tiles, at.x, at.y)
            assert ground is None or at.z > ground - 1e-3
    assert hits >= 3


def inside(tile, x, y):
    side = Fraction(QUADS) / Fraction(2) ** tile.key.level
    return tile.key.x * side <= x <= (tile.key.x + 1) * side and tile.key.y * side <= y <= (tile.key.y + 1) * side


def test_what_is_looked_at_from_above_is_not_mirrored():
    eye = Eye(Fraction(0), Fraction(0), 10.0, 0.0, -89.0)
    right, lower = eye.direction(400, 100, (400, 200)), eye.direction(200, 200, (400, 200))
    assert right[0] > 0.3
    assert lower[1] > 0.2
    assert math.isclose(float(np.linalg.norm(right)), 1.0)


def test_shade_lies_behind_what_stands_in_the_sun(made):
    from engine.terrain.seen.tile_light import Square, sunlit, towards_sun

    heights = np.zeros((60, 60), np.float32)
    heights[28:32, 28:32] = 6.0
    seen = sunlit([Square(heights, 1.0, (20, 20), 19.0)], 20)
    x, y, _ = towards_sun()
    behind = round(10 - 4 * x), round(10 - 4 * y)
    assert seen[behind[1], behind[0]] < 0.05
    assert seen[round(10 + 5 * y), round(10 + 5 * x)] > 0.95


@given(st.integers(-(2**110), 2**110), st.integers(-12, 40), st.integers(-(2**60), 2**60))
def test_where_a_place_lies_from_a_whole_number_is_rounded_once(place, up, less):
    told = Fraction(place, 1 << 96)
    assert from_whole(told, up, less) == float(told * Fraction(2) ** up - less)
