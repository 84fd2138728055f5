"""The land shows the stroke in hand while the pen is down, of its tiles those where it grew, and none of it if it is
dropped."""

import numpy as np
import pytest

from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.painting.commands import Stroke, parse
from engine.painting.value import Painting
from engine.session.session import Session
from engine.studio.easel import Easel
from engine.studio.land.land_maker import LandMaker
from engine.studio.land.land_records import AskLand, LandMade
from engine.studio.land.stroke_seen import StrokeSeen
from engine.terrain.seen.land_tiles import TileKey

FIRST, LAST = TileKey(0, 4, 4), TileKey(0, 36, 4)  # 64..80 and 576..592 across
HEAP = Brush(radius=6, height=5.0)


@pytest.fixture
def easel():
    sent = []
    made = Easel(sent.append)
    made.sent = sent
    made.session = Session(Painting(Rect.at(0, 0, 1024, 512), 7))
    made.session.do(parse({"do": "layer", "add": "Height"}))
    made.session.do(parse({"do": "layer", "set": "Height", "role": "height", "scale": 50}))
    return made


def worked(easel, maker):
    easel.sent.clear()
    while maker.pending:
        maker.step()
    return {told.tile.key: told for told in easel.sent if isinstance(told, LandMade)}


def test_tiles_follow_the_pen_and_come_to_what_is_committed(easel):
    maker = LandMaker(easel, lambda: 0.0)
    maker.handlers[AskLand](AskLand(((FIRST, -1), (LAST, -1))))
    bare = worked(easel, maker)
    easel.begin(Stroke(0, (0, 0), np.empty((0, 6)), HEAP))
    assert not worked(easel, maker)
    easel.extend(np.array([[72.0, 72, 1, 0, 0, 0]]))
    first = worked(easel, maker)
    assert set(first) == {FIRST}
    assert first[FIRST].tile.surface.max() > 3
    easel.extend(np.array([[330.0, 72, 1, 0, 0, 0.1]]))
    assert FIRST in worked(easel, maker)
    easel.extend(np.array([[584.0, 72, 1, 0, 0, 0.2]]))
    assert set(worked(easel, maker)) == {LAST}
    easel.finish()
    shown = worked(easel, maker)
    assert set(shown) == {FIRST, LAST}
    easel.session.do(parse({"do": "undo"}))
    back = worked(easel, maker)
    assert all(np.array_equal(back[key].tile.surface, bare[key].tile.surface) for key in (FIRST, LAST))


def test_a_dropped_stroke_leaves_nothing(easel):
    maker = LandMaker(easel, lambda: 0.0)
    maker.handlers[AskLand](AskLand(((FIRST, -1),)))
    bare = worked(easel, maker)[FIRST]
    easel.begin(Stroke(0, (0, 0), np.empty((0, 6)), HEAP))
    easel.extend(np.array([[72.0, 72, 1, 0, 0, 0]]))
    assert worked(easel, maker)
    easel.abandon()
    assert np.array_equal(worked(easel, maker)[FIRST].tile.surface, bare.tile.surface)


def test_a_stroke_that_takes_long_is_laid_a_third_of_the_time_at_most(easel):
    ticks = iter(np.arange(100) * 0.2)
    seen = StrokeSeen(easel, lambda: float(next(ticks)))
    easel.begin(Stroke(0, (0, 0), np.empty((0, 6)), HEAP))
    given = []
    for i in range(9):
        easel.extend(np.array([[72.0 + i, 72, 1, 0, 0, i / 10]]))
        given.append(seen.painting())
    assert 3 <= len({id(one) for one in given}) <= 6
