"""The pace of a flight: the same to the eye, eased at its ends and where it turns."""

from itertools import pairwise

import numpy as np
import pytest

from engine.film.aim import Aim, aim_at
from engine.film.course import flight, legs_through, length
from engine.film.leg import levels_between
from engine.numeric.address import Rect

SIZE = 1920, 1080
START = Aim(0, 0.0, 960 << 24, 540 << 24)


def zooms(path, fps=60):
    """Levels of zoom from each frame to the next."""
    count = round(path.seconds * fps)
    views = [path.at(path.seconds * i / (count - 1)) for i in range(count)]
    return np.array([levels_between(a, b) for a, b in pairwise(views)])


def test_twelve_levels_at_one_ratio_a_frame():
    legs = legs_through([START, START.at(12, 0.0)], SIZE[0])
    assert length(legs) == pytest.approx(12.0)
    steps = zooms(flight(legs, 12.0))
    assert steps.sum() == pytest.approx(12.0)
    steady = steps[62:-62]
    assert np.ptp(steady) < 1e-9
    # Eased in the first second and the last: from rest, ever faster, without a jump in pace.
    assert (np.diff(steps[:59]) > 0.0).all()
    assert np.allclose(steps, steps[::-1], atol=1e-9)
    assert steps[0] < 0.01 * steady[0]
    assert np.abs(np.diff(steps)).max() < 0.03 * steady[0]


def test_it_does_not_stop_where_it_goes_straight_on():
    steps = zooms(flight(legs_through([START, START.at(5, 0.0), START.at(12, 0.0)], SIZE[0]), 12.0))
    assert np.ptp(steps[62:-62]) < 1e-9


def test_it_slows_down_where_it_turns_round():
    legs = legs_through([START, START.at(6, 0.0), START], SIZE[0])
    path = flight(legs, 12.0)
    steps = zooms(path)
    assert path.loops
    assert abs(steps[len(steps) // 2]) < 0.01 * steps.max()
    assert np.abs(np.diff(steps)).max() < 0.03 * steps.max()
    assert steps.sum() == pytest.approx(0.0, abs=1e-9)


def test_a_loop_is_not_eased_at_its_seam():
    """It begins in the middle of a straight way, and comes back to it from behind."""
    places = [aim_at(3, Rect.at(x, 0, 1920, 1080), SIZE) for x in (20, 40, 0, 20)]
    path = flight(legs_through(places, SIZE[0]), 6.0)
    steps = np.diff([path.at(i / 60).at(3, 0.0).x for i in range(361)])
    assert path.loops
    assert steps[0] == pytest.approx(steps[-1], rel=1e-3)
    assert steps[0] > 0.999 * steps.max()


def test_nothing_moves():
    path = flight(legs_through([START], SIZE[0]), 5.0)
    assert {path.at(t) for t in (0.0, 1.0, 2.5, 5.0)} == {START}
    assert flight(legs_through([START, START], SIZE[0]), 5.0).seconds == 5.0


def test_short_films_are_eased_for_a_third():
    steps = zooms(flight(legs_through([START, START.at(2, 0.0)], SIZE[0]), 1.5))
    assert np.ptp(steps[31:-31]) < 1e-9
    assert steps.sum() == pytest.approx(2.0)
