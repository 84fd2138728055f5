"""When the window tells tests that it is at rest: not before all of a frame, and of the next, is done and seen."""

import re

import pytest

from app import resting, trace
from app.resting import QUIET, Resting


@pytest.fixture
def one(monkeypatch):
    monkeypatch.setattr(resting, "_hint_comes", lambda: False)
    return Resting()


def frames(one, count=QUIET, at=(3.0, 4.0), stirs=False, done=True, kept=True):
    one.stirs = stirs
    for _ in range(count):
        one.look(at, done, kept)
    return one.rests


def test_it_rests_after_frames_of_which_nothing_came(one):
    assert not frames(one)  # the pointer came in the first
    assert one.soon
    assert frames(one, 1)
    assert not one.soon


@pytest.mark.parametrize("how", [{"stirs": True}, {"done": False}, {"at": (5.0, 4.0)}])
def test_it_is_at_work_where_something_came_or_is_still_made(one, how):
    assert frames(one, QUIET + 1)
    assert not frames(one, 1, **how)
    assert not frames(one, QUIET - 1, at=how.get("at", (3.0, 4.0)))
    assert frames(one, 1, at=how.get("at", (3.0, 4.0)))


def test_what_it_takes_what_moves_and_a_hint_that_comes_are_work(one, monkeypatch):
    assert frames(one, QUIET + 1)
    one.keys = 1
    assert not frames(one, 1)
    assert frames(one, QUIET)
    monkeypatch.setattr(trace, "moved", True)
    assert not frames(one)
    monkeypatch.setattr(trace, "moved", False)
    assert frames(one)
    monkeypatch.setattr(resting, "_hint_comes", lambda: True)
    assert not frames(one)


def test_it_is_told_once_with_the_pointer_and_what_was_taken(one, monkeypatch, capsys):
    monkeypatch.setattr(trace, "TRACED", True)
    one.keys, one.presses = 2, 1
    frames(one, QUIET + 3, kept=False)
    frames(one, 2)
    told = re.findall(r"^at .*$", capsys.readouterr().err, re.M)
    assert told == ["at work held 3,4 2 1", "at rest held 3,4 2 1", "at rest kept 3,4 2 1"]
