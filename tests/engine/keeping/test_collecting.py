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
from engine.studio.studio import Studio

POINTS = np.zeros((0, 6))
YOUNG = 40_000  # objects, more than are looked at before they are passed over


class _Held:
    """What a cycle holds."""


@pytest.fixture(autouse=True)
def _all_looked_at():
    """Looks for garbage as often as where the program runs: tests look seldom, and pass over all that they began with,
    a million objects."""
    seldom = gc.get_threshold()
    gc.set_threshold(700, 10, 10)
    gc.freeze()
    yield
    gc.freeze()
    gc.set_threshold(*seldom)


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
    before, held = gc.get_freeze_count(), _grow_old()
    collecting.pass_over()
    assert gc.get_freeze_count() > before + len(held)
    assert len(gc.get_objects()) < 1000


def test_a_cycle_among_what_is_new_is_found_before_that():
    there = _cycle()
    _grow_old()
    collecting.pass_over()
    assert there() is None


def test_little_that_is_new_is_not_worth_a_look():
    assert not collecting.due()


def test_it_is_never_due_where_nothing_is_to_be_looked_for():
    held = _grow_old()
    assert collecting.due()
    gc.disable()
    try:
        assert not collecting.due(), len(held)
    finally:
        gc.enable()


def test_the_engine_does_so_at_rest_and_never_within_a_stroke():
    studio = Studio(lambda result: None, lambda request: None)
    while studio.step():
        pass
    before = gc.get_freeze_count()
    studio.easel.begin(c.Stroke(0, (0, 0), POINTS, Brush(radius=4)))
    held = _grow_old()
    while studio.step():
        pass
    assert gc.get_freeze_count() == before
    studio.easel.abandon()
    while studio.step():
        pass
    assert gc.get_freeze_count() > before + len(held)
    assert not studio.pending


def test_another_painting_has_all_looked_at_anew():
    easel = Easel(lambda result: None)
    _grow_old()
    collecting.pass_over()
    there = weakref.ref(easel.session)
    easel.session.itself = easel.session
    easel.show(Session(first_painting(Header())), None)
    gc.collect()
    assert there() is None
