"""Looks for garbage take no longer in a large painting, and what held a painting that is gone is found nevertheless."""

import gc
import weakref

import numpy as np
import pytest

from engine.brush.settings import Brush
from engine.keeping import collecting
from engine.painting import commands as c
from engine.painting.recording import Header
from engine.painting.value import first_painting
from engine.session.session import Session
from engine.studio.easel import Easel

POINTS = np.array([[0.0, 0, 1, 0, 0, 0], [30, 9, 1, 0, 0, 0.1]])
YOUNG = 40_000  # objects, more than are looked at before they are passed over


class _Held:
    """What a cycle holds."""


@pytest.fixture(autouse=True)
def _all_looked_at():
    gc.collect()
    yield
    gc.unfreeze()


def _grow_old():
    """Makes so many objects that the next stroke has what there is passed over."""
    held = [[] for _ in range(YOUNG)]
    assert gc.get_count()[2] >= 4
    return held


def _cycle():
    held = _Held()
    held.itself = held
    return weakref.ref(held)


def test_what_outlived_a_look_is_passed_over_by_the_next():
    held = _grow_old()
    collecting.pass_over()
    assert gc.get_freeze_count() > len(held)
    assert len(gc.get_objects()) < 1000


def test_a_cycle_among_what_is_new_is_found_before_that():
    there = _cycle()
    _grow_old()
    collecting.pass_over()
    assert there() is None


def test_little_that_is_new_is_not_looked_through():
    collecting.pass_over()
    assert gc.get_freeze_count() == 0


def test_where_nothing_is_to_be_looked_for_nothing_is():
    held = _grow_old()
    gc.disable()
    try:
        collecting.pass_over()
        assert gc.get_freeze_count() == 0, len(held)
    finally:
        gc.enable()


@pytest.mark.parametrize(
    "next_thing",
    [
        lambda easel: easel.begin(c.Stroke(0, (0, 0), POINTS[:0], Brush(radius=4))),
        lambda easel: easel.carry_out(c.AddLayer("Another")),
    ],
)
def test_a_stroke_and_a_command_begin_with_it(next_thing):
    easel = Easel(lambda result: None)
    held = _grow_old()
    next_thing(easel)
    assert gc.get_freeze_count() > len(held)


def test_another_painting_has_all_looked_at_anew():
    easel = Easel(lambda result: None)
    held = _grow_old()
    easel.carry_out(c.AddLayer("Another"))
    there = weakref.ref(easel.session)
    del held
    easel.session.itself = easel.session
    easel.show(Session(first_painting(Header())), None)
    gc.collect()
    assert there() is None
