"""Land as the card draws it: in the colours of the picture at rest, with fewer pixels while the eye moves."""

from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from app.desk.land.land_state import LandState
from app.land import land_screen
from app.land.land_screen import LandScreen
from app.land.still_fade import SECONDS, StillFade
from engine.numeric.address import Rect
from engine.studio.land.land_records import StillCome
from engine.terrain.land_picture import developed
from engine.terrain.seen.choosing import choose_tiles
from engine.terrain.seen.eye import Eye
from engine.terrain.seen.land_tiles import BRIGHTEST, QUADS, TEXEL_RIM, TEXELS, LandTile

SIZE = 96, 64


def even(key, shade):
    """A tile of even ground, of one colour."""
    side = TEXELS + 2 * TEXEL_RIM
    heights, surface = np.zeros((QUADS + 1, QUADS + 1, 2), np.float32), np.zeros((TEXELS + 1, TEXELS + 1), np.float32)
    return LandTile(key, 0, heights, 0.0, 0.0, surface, np.full((side, side, 3), shade, np.uint8))


@pytest.fixture
def state():
    """The eye looks down on ground of which all is held; the frame is so wide that no haze is seen."""
    made = LandState(on=True, frame=Rect.at(-(2**20), -(2**20), 2**21, 2**21), room=(0, 0, *SIZE))
    made.look(Eye(Fraction(8), Fraction(8), 60.0, 15.0, -88.0), 0.0)
    return made


def hold(state, shade):
    """All tiles that are seen, in one colour."""
    while lacking := choose_tiles(state.sight(), {key: kept.tile for key, kept in state.kept.items()}).lacking:
        for key in lacking:
            state.take(even(key, shade), 1, 0.0)
    state.drawn = choose_tiles(state.sight(), {key: kept.tile for key, kept in state.kept.items()}).drawn


@pytest.mark.parametrize("shade", [3, 60, 128, 250])
def test_the_ground_has_the_colours_of_the_picture_at_rest(context, state, shade):
    hold(state, shade)
    screen = LandScreen(context)
    assert screen.draw(SimpleNamespace(land=state), 9.0)
    pixels = np.frombuffer(screen.picture(), np.uint8).reshape(SIZE[1], SIZE[0], 3)
    light = np.full((1, 1, 3), BRIGHTEST * (shade / 255) ** 2, np.float32)
    assert np.abs(pixels.astype(int) - developed(light, 1).astype(int)).max() <= 1


def test_what_is_begun_is_drawn_beside_other_things_and_once(context, state, monkeypatch):
    hold(state, 60)
    flushed, times = [], []
    monkeypatch.setattr(LandState, "adapt", lambda state, seconds: times.append(seconds))
    screen, desk = LandScreen(context, lambda: flushed.append(1)), SimpleNamespace(land=state)
    screen.begin(desk, 9.0)
    assert flushed
    assert not state.changed
    begun = screen.picture()
    assert screen.draw(desk, 9.0)
    assert screen.picture() == begun
    assert len(times) == 1
    screen.begin(desk, 9.1)
    assert not screen.draw(desk, 9.1)
    assert len(times) == 1


def test_where_the_processor_fills_pixels_they_are_fewer_as_long_as_the_eye_moves(context, state, monkeypatch):
    hold(state, 128)
    screen, desk = LandScreen(context), SimpleNamespace(land=state)
    monkeypatch.setattr(screen, "_slow", True)
    state.look(state.eye, 9.0)
    assert screen.draw(desk, 9.01)
    assert len(screen.picture()) == 72 * 48 * 3
    assert screen.moving
    assert screen.draw(desk, 9.3)
    assert len(screen.picture()) == 96 * 64 * 3
    assert not screen.moving
    assert not screen.draw(desk, 9.4)
    state.look(state.eye, 9.5)
    monkeypatch.setattr(screen, "_slow", False)
    assert screen.draw(desk, 9.51)
    assert len(screen.picture()) == 96 * 64 * 3
    screen.forget()


def test_tiles_that_are_not_drawn_any_more_leave_the_card(context, state, monkeypatch):
    monkeypatch.setattr(land_screen, "SPARE_CARDS", 2)
    screen, desk = LandScreen(context), SimpleNamespace(land=state)
    for place in (8, 900, 8):
        state.look(Eye(Fraction(place), Fraction(8), 60.0, 15.0, -88.0), 0.0)
        hold(state, 60)
        assert screen.draw(desk, 9.0)
        assert set(state.drawn) <= set(screen._tiles)
        assert len(screen._tiles) <= len(state.drawn) + 2 < len(state.kept)
    screen.forget()


def test_the_last_picture_at_rest_comes_over_the_one_before(context):
    fade, frame = StillFade(context), context.framebuffer([context.texture((8, 8), 3)])
    moving = context.texture((8, 8), 3, b"\x40" * 192)
    half = np.zeros((8, 8, 3), np.uint8)
    half[:4] = 200
    state = SimpleNamespace(still=StillCome(1, half, 1, False), size=(8, 8))

    def seen(now):
        fade.follow(state, now)
        frame.use()
        fade.draw(moving)
        rows = np.frombuffer(frame.read(), np.uint8).reshape(8, 8, 3)[::-1, 4, 0].tolist()
        return rows[1], rows[6], fade.moving

    assert seen(0.0) == (64, 64, True)
    assert seen(1.0) == (200, 0, False)
    state.still = StillCome(1, np.full((8, 8, 3), 100, np.uint8), 1, True)
    assert seen(2.0) == (200, 0, True)
    assert seen(2.0 + SECONDS / 2) == (150, 50, True)
    assert seen(3.0) == (100, 100, False)
    state.still = None
    assert seen(3.1) == (64, 64, False)
