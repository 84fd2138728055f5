"""Many inks in one place: a stroke with one too many is refused in a line, and nothing of it is painted."""

import numpy as np
import pytest
from immutables import Map

from engine.brush.settings import Brush, Component
from engine.painting import commands as c
from engine.painting import crowding
from engine.painting.value import Refusal
from engine.session.session import Session

POINTS = np.array([[0.0, 0.0, 1.0, 0.0, 0.0, 0.0], [5.0, 3.0, 1.0, 0.0, 0.0, 0.1]])


def stone(number, x=0, mode="paint"):
    ink = (Component("rock", 0.6, "#d0c0a0", parameters=Map({"period": 8.0 + number})),)
    return c.Stroke(0, (x, 0), POINTS, Brush(radius=6.0, mode=mode, colour="#807060", ink=ink))


def test_one_ink_too_many_in_a_place_is_refused_and_others_are_not(monkeypatch):
    monkeypatch.setattr(crowding, "MOST_MEETING", 9)
    session = Session()
    for number in range(9):
        session.do(stone(number, 20 * number))
    before = session.painting
    with pytest.raises(Refusal, match="stroke: found 9 inks here that differ, expected fewer than 9: "):
        session.do(stone(9))
    assert session.painting is before
    session.do(stone(4))  # one that is there
    session.do(stone(9, 10**9))  # far away
    session.do(c.Stroke(0, (0, 0), POINTS, Brush(radius=6.0)))  # none
    session.do(stone(9, mode="erase"))
    session.do(c.AddLayer("Above"))
    session.do(stone(9))
