"""The eye over the land: it turns about what is held, flies to what is pointed at, and keeps above the ground."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from app.desk.land import land_state
from app.desk.land.land_ring import ring_on_land
from app.desk.land.land_state import LandState
from app.land.land_screen import SPARE_CARDS
from engine.numeric.address import Rect
from engine.studio.land.land_maker import LAND_CACHE
from engine.studio.land.still_picture import STILL_CACHE
from engine.terrain.camera import CELLS
from engine.terrain.caster import mipmap_of, room_of
from engine.terrain.seen.choosing import choose_tiles
from engine.terrain.seen.eye import Eye
from engine.terrain.seen.land_tiles import QUADS, TEXEL_RIM, TEXELS, LandTile, TileKey
from engine.terrain.seen_parts import PART_WINDOWS

SIZE = 400, 300
_DRAWN = 160  # tiles of a picture, at most as a rule: twice 40,000 triangles


def flat(key):
    """A tile of even ground at height 0."""
    side = TEXELS + 2 * TEXEL_RIM
    heights, surface = np.zeros((QUADS + 1, QUADS + 1, 2), np.float32), np.zeros((TEXELS + 1, TEXELS + 1), np.float32)
    return LandTile(key, 0, heights, 0.0, 0.0, surface, np.zeros((side, side, 3), np.uint8))


@pytest.fixture
def state():
    made = LandState(on=True, frame=Rect.at(0, 0, 64, 64), room=(10, 20, *SIZE), drawn=[TileKey(-6, 0, 0)])
    made.take(flat(TileKey(-6, 0, 0)), 1, 0.0)
    made.look(Eye(Fraction(500), Fraction(700), 60.0, 15.0, -25.0), 0.0)
    return made


def seen_at(state, hit):
    """Where a place shows in the window."""
    right, up, forward = state.eye.axes()
    off = np.array([float(hit.x - state.eye.x), float(hit.y - state.eye.y), hit.z - state.eye.z])
    pixel = state.eye.pixel(SIZE[0]) * (off @ forward)
    return 10 + SIZE[0] / 2 + off @ right / pixel, 20 + SIZE[1] / 2 - off @ up / pixel


def test_what_is_hit_shows_where_it_was_pointed_at(state):
    hit = state.hit(120.0, 260.0)
    assert hit.z == pytest.approx(0.0, abs=1e-9)
    assert seen_at(state, hit) == pytest.approx((120.0, 260.0), abs=1e-6)
    assert state.hit(120.0, 22.0) is None


def test_turning_keeps_what_is_held_under_the_pointer_and_as_far_away(state):
    hit = state.hit(150.0, 220.0)
    state.orbit(hit, 40.0, -12.0, 1.0)
    assert seen_at(state, hit) == pytest.approx((150.0, 220.0), abs=1e-6)
    off = float(hit.x - state.eye.x), float(hit.y - state.eye.y), hit.z - state.eye.z
    assert np.linalg.norm(off) == pytest.approx(hit.away)
    state.orbit(hit, 0.0, 400.0, 1.0)
    assert state.eye.z > 0.0


def test_a_gesture_of_the_wheel_leads_from_the_range_to_a_pebble(state):
    hit = state.hit(210.0, 200.0)
    for _ in range(120):
        state.fly(210.0, 200.0, 1.0)
    while state.step(0.05, 2.0):
        pass
    assert 0.0 < state.eye.z < 1e-4
    assert abs(float(hit.x - state.eye.x)) < 1e-3
    assert state.hit(210.0, 200.0).away < 1e-3
    for _ in range(200):
        state.fly(210.0, 200.0, -1.0)
        state.step(0.1, 3.0)
    assert 100.0 < state.eye.z < 1e5


def test_the_eye_stays_above_the_ground(state):
    state.look(replace(state.eye, z=-5.0), 1.0)
    assert state.eye.z > 0.0
    assert state.clear == pytest.approx(state.eye.z)


def test_tiles_take_no_more_than_their_room(state, monkeypatch):
    one = flat(TileKey(0, 0, 0)).held
    monkeypatch.setattr(land_state, "MOST_HELD", 10 * one)
    for x in range(40):
        state.take(flat(TileKey(0, x, 0)), 1, 0.0)
        state.use({TileKey(-6, 0, 0), TileKey(0, 3, 0)} if x >= 3 else {TileKey(-6, 0, 0)})
        assert state.held <= 10 * one
    assert TileKey(0, 3, 0) in state.kept
    assert state.held == one * len(state.kept)
    state.forget()
    assert state.held == 0


def test_all_that_is_held_for_the_land_takes_at_most_300_mb():
    """However deep one looks: no more windows than 19 are had (see `test_a_sharp_picture_has_more_land...`)."""
    side = CELLS + 1
    window = side * side * (4 + 3) + 4 * room_of(mipmap_of(CELLS))
    evaluated = LAND_CACHE + STILL_CACHE
    cards = (_DRAWN + SPARE_CARDS) * (TEXELS + 2 * TEXEL_RIM) ** 2 * 4 * 4 // 3
    assert (19 + PART_WINDOWS) * window + land_state.MOST_HELD + cards + evaluated < 300e6


def test_the_brush_lies_on_the_land_as_a_stroke_of_its_radius_would(state):
    found = state.hit(150.0, 220.0)
    ring = ring_on_land(state, 150.0, 220.0, 12.0)
    wide = 12.0 * 2.0 ** -state.level_at(found.away)
    assert 6.0 < max(x for x, _ in ring) - 150.0 < 24.0
    for x, y in ring:
        met = state.hit(x, y)
        assert np.hypot(float(met.x - found.x), float(met.y - found.y)) == pytest.approx(wide, rel=1e-6)
    down, across = (max(at[i] for at in ring) - min(at[i] for at in ring) for i in (1, 0))
    assert down < 0.8 * across  # it is seen from the side
    assert ring_on_land(state, 120.0, 22.0, 12.0) == []


class _Everywhere(dict):
    """Holds flat ground wherever it is asked for."""

    def __contains__(self, key):
        return True

    def get(self, key, default=None):
        return flat(key)


def test_slow_pictures_have_fewer_triangles_and_quick_ones_more(state):
    state.look(Eye(Fraction(32), Fraction(60), 12.0, 0.0, -25.0), 0.0)
    counts = []
    for seconds in (0.1, 0.001):
        for _ in range(200):
            state.adapt(seconds)
        counts.append(len(choose_tiles(state.sight(), _Everywhere()).drawn))
    slow, quick = counts
    assert slow >= 4
    assert quick >= 2 * slow
    state.adapt(0.027)  # what is neither stays
    assert len(choose_tiles(state.sight(), _Everywhere()).drawn) == quick
