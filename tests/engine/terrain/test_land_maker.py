"""Tiles of land for the window: a stroke makes those anew that it meets, and no painting is too bare to be land."""

import threading
import weakref
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.value import Painting
from engine.session.session import Session
from engine.studio.land import land_maker, still_picture
from engine.studio.land.land_maker import LandMaker
from engine.studio.land.land_records import AskGround, AskLand, AskStill, GroundFound
from engine.studio.land.still_picture import StillPictures
from engine.terrain.camera import windows_of
from engine.terrain.seen.eye import Eye
from engine.terrain.seen.land_tiles import TileKey

FRAME = Rect.at(0, 0, 512, 512)
NEAR, FAR = TileKey(0, 4, 4), TileKey(0, 28, 28)  # 64..80, 448..464


@pytest.fixture
def easel():
    sent = []
    return SimpleNamespace(session=Session(Painting(FRAME, 7)), live=None, send=sent.append, sent=sent)


def do(easel, **row):
    easel.session.do(parse(row))


def worked(easel, maker):
    """What is sent until nothing is left to do."""
    easel.sent.clear()
    while maker.pending:
        maker.step()
    return easel.sent


def test_a_stroke_makes_exactly_the_tiles_anew_that_it_meets(easel):
    do(easel, do="layer", add="Height")
    do(easel, do="layer", set="Height", role="height", scale=50, sea=0)
    maker = LandMaker(easel)
    maker.handlers[AskLand](AskLand(((NEAR, -1), (FAR, -1))))
    first = list(worked(easel, maker))
    assert [made.tile.key for made in first] == [NEAR, FAR]
    assert np.ptp(first[0].tile.surface) == 0
    maker.handlers[AskLand](AskLand(((NEAR, first[0].revision), (FAR, first[1].revision))))
    assert not worked(easel, maker)
    do(easel, do="stroke", points=[[72, 72]], brush={"radius": 6, "colour": "#ffffff"})
    again = worked(easel, maker)
    assert [made.tile.key for made in again] == [NEAR]
    assert again[0].tile.surface.max() > 5
    do(easel, do="undo")
    back = worked(easel, maker)
    assert [made.tile.key for made in back] == [NEAR]
    assert (back[0].tile.surface == first[0].tile.surface).all()


def test_evaluated_tiles_take_no_more_than_their_room_while_land_is_seen(easel, monkeypatch):
    """Once those of coarser levels and the canvas' own stayed for as long as one looked, 70 to 160 MB in a valley."""
    do(easel, do="layer", add="Height")
    do(easel, do="layer", set="Height", role="height", scale=50, sea=0)
    do(easel, do="stroke", points=[[0, 0], [512, 512]], brush={"radius": 60, "colour": "#ffffff"})
    cache = easel.session.cache
    cache.clear()
    tiles = tuple((TileKey(-1, 4 * x, 4 * y), -1) for x in range(4) for y in range(4))
    maker = LandMaker(easel)
    maker.handlers[AskLand](AskLand(tiles))
    first = [made.tile.colours.tobytes() for made in worked(easel, maker)]
    before = cache.held
    maker.handlers[AskLand](AskLand(()))
    monkeypatch.setattr(land_maker, "LAND_CACHE", before // 4)
    cache.look_at(0)
    easel.sent.clear()
    maker.handlers[AskLand](AskLand(tiles))
    while maker.pending:
        maker.step()
        assert 0 < cache.held <= before // 4
    assert [made.tile.colours.tobytes() for made in easel.sent] == first
    maker.handlers[AskLand](AskLand(()))
    assert cache.level == 0


def test_a_bare_painting_is_flat_land(easel):
    maker = LandMaker(easel)
    maker.handlers[AskGround](AskGround(Fraction(1, 3), Fraction(5) / 2**4000, 4000))
    assert [type(told) for told in easel.sent] == [GroundFound]
    assert np.isfinite(easel.sent[0].z)
    maker.handlers[AskLand](AskLand(((TileKey(-6, 0, 0), -1), (TileKey(29, 5 << 29, 7 << 29), -1))))
    made = list(worked(easel, maker))
    assert len(made) == 2
    for one in made:
        assert np.ptp(one.tile.surface) == 0
        assert one.tile.colours.min() > 20


def test_a_picture_at_rest_that_is_not_wanted_any_more_does_not_come(easel):
    come = threading.Event()
    easel.send = lambda told: (easel.sent.append(told), come.set() if told.last else None)
    stills = StillPictures(easel)
    ask = stills.handlers[AskStill]
    eye = Eye(Fraction(250), Fraction(600), 80.0)
    with stills._turn:  # none begins before both are asked for
        ask(AskStill(1, eye, 80.0, (64, 40)))
        ask(AskStill(2, eye, 80.0, (64, 40)))
    assert come.wait(200)
    assert [told.number for told in easel.sent if told.last] == [2]
    assert easel.sent[-1].pixels.shape == (40, 64, 3)


def test_windows_of_the_small_picture_are_gone_before_those_of_the_whole_one_are_made(easel, monkeypatch):
    """Once they stayed until these were there: 7 MB deep down, when the view takes the most memory."""
    made, held = [], []

    def watched(*asked):
        held.append(sum(one.nbytes for kept in made if (one := kept()) is not None))
        windows = windows_of(*asked)
        made.extend(weakref.ref(array) for array in (windows.heights, windows.tops, windows.colours))
        return windows

    monkeypatch.setattr(still_picture, "CELLS", 256)
    monkeypatch.setattr(still_picture, "windows_of", watched)
    asked = AskStill(1, Eye(Fraction(250), Fraction(600), 80.0), 80.0, (48, 30))
    still_picture._take(easel.session.painting, asked, lambda: False, easel.send)
    assert held == [0, 0]
    assert [told.by for told in easel.sent[:2]] == [4, 1]
