"""Rain on heights: gullies, what comes down, no pits; and the command that bakes it into a layer."""

import numpy as np
import pytest
from immutables import Map

from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting, Refusal
from engine.session.session import Session
from engine.terrain.eroding import Weather, eroded, eroding
from engine.terrain.plane import land

SIDE = 64
RECT = Rect.at(8, 8, 48, 40)


def hill(rough=0.6):
    """A cone on a plain, with grains."""
    y, x = np.mgrid[:SIDE, :SIDE] - SIDE / 2
    grains = np.random.default_rng(3).normal(size=(SIDE, SIDE))
    return np.maximum(18 - 0.9 * np.hypot(x, y), 0) + rough * grains


def pits(h):
    """How many samples are below all eight around them."""
    about = [np.roll(h, (y, x), (0, 1)) for y in (-1, 0, 1) for x in (-1, 0, 1) if (y, x) != (0, 0)]
    return (h < np.min(about, axis=0))[2:-2, 2:-2].sum()


def test_rain_carries_ground_downhill_and_leaves_no_pits():
    before = hill()
    after = eroded(before, Weather(1.0, 0.7, None))
    y, x = np.mgrid[:SIDE, :SIDE] - SIDE / 2
    r = np.hypot(x, y)
    change = after - before
    assert change[r < 8].mean() < -0.2  # taken from the top
    assert change[(r > 20) & (r < 26)].mean() > 0.1  # and laid down at the foot
    assert pits(before) > 100 > 10 > pits(after)
    assert pits(-after) < 10  # nor needles
    assert np.array_equal(after, eroded(before, Weather(1.0, 0.7, None)))
    assert not np.array_equal(after, eroded(before, Weather(1.0, 0.7, None, seed=1)))


def test_what_is_too_steep_slides_and_nothing_is_lost():
    y, x = np.mgrid[:SIDE, :SIDE]
    before = np.where(x < SIDE // 2, 9.0, 0.0) + 0.001 * y
    after = eroded(before, Weather(0.0, 0.0, 0.5))
    assert np.abs(np.diff(after, axis=1)).max() < 0.5 * np.abs(np.diff(before, axis=1)).max()
    assert after.mean() == pytest.approx(before.mean(), rel=1e-3)


def test_gentle_land_in_no_rain_stays():
    before = hill(0.0)[:40, :40].copy()
    before[:] = 0.25 * np.mgrid[:40, :40][1]
    assert np.array_equal(before, eroded(before, Weather(0.0, 0.5, 1.0)))


def test_it_is_worked_out_piece_by_piece():
    told = list(eroding(hill(), Weather(4.0)))
    assert told == sorted(told)
    assert len(told) > 3
    assert told[-1] == 1.0


def mountain(**members):
    session = Session(Painting(Rect.at(0, 0, SIDE, SIDE), 1))
    session.do(c.AddLayer("Land"))
    session.do(c.SetLayer("Land", role="height", scale=60.0))
    points = np.array([[32.0, 32, 1, 0, 0, 0]])
    brush = Brush(radius=40, hardness=0.0, colour="#ffffff", dynamics=Map())
    session.do(c.Stroke(0, (0, 0), points, brush))
    return session


def heights(session, level=0, rect=None):
    return land(session.painting, "Land").height(level, rect or Rect.at(0, 0, SIDE, SIDE))


@pytest.mark.parametrize("level", [0, 2, 16])
def test_the_command_changes_heights_of_its_rectangle_alone_and_is_undone(level):
    session = mountain()
    rect = RECT if level == 0 else Rect.at((20 << level) + 5, (26 << level) - 3, 48, 40)
    before = heights(session, level, rect.grown(8))
    session.do(c.Erode(rect, level, "Land", rain=2.0, strength=1.0, talus=0.2))
    after = heights(session, level, rect.grown(8))
    change = (after - before) * 2.0**level
    inside = change[8:-8, 8:-8].copy()
    assert np.abs(inside).max() > 0.05
    change[8:-8, 8:-8] = 0
    assert np.abs(change).max() < 5e-4
    assert np.abs(inside[0]).max() < 0.02 * np.abs(inside).max()
    wanted = eroded(before[8:-8, 8:-8] * 2.0**level, Weather(2.0, 1.0, 0.2)) - before[8:-8, 8:-8] * 2.0**level
    middle = np.s_[12:-12, 12:-12]
    assert np.abs(inside - wanted)[middle].max() < 1e-3 * np.abs(wanted).max() + 2e-4
    session.do(c.Undo())
    assert np.array_equal(heights(session, level, rect.grown(8)), before)


WRONG = {
    "no heights": (
        c.Erode(RECT),
        "expected a layer of the role height",
        lambda s: s.do(c.SetLayer("Land", role="")),
    ),
    "locked": (c.Erode(RECT), "locked", lambda s: s.do(c.SetLayer("Land", locked=True))),
    "too deep": (c.Erode(RECT, 2000), "found level 2000", lambda s: None),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_worn_down_is_told_in_a_line(name):
    command, message, first = WRONG[name]
    session = mountain()
    first(session)
    with pytest.raises(Refusal, match=message):
        session.do(command)


@pytest.mark.parametrize("rect", [[0, 0, 0, 8, 40], [0, 0, 0, 4096, 4096], [0, 0, 0, 40]])
def test_a_rectangle_that_is_none_is_refused(rect):
    with pytest.raises(ValueError, match="rect"):
        c.parse({"do": "erode", "rect": rect})
