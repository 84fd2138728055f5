"""Commits before the oldest step are forgotten; what is seen follows from the painting all the same."""

import itertools

import numpy as np
from stepped import stroke

from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.store import Change, changed_rects, changes_between
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.value import Painting
from engine.session import old_commits
from engine.session.differing import changed_records
from engine.session.history import History
from engine.session.session import Session

SEEN = Rect(0, 0, 128, 128)


def pyramid_of(painting):
    (layer,) = layers.layers(painting.root)
    return layer.pyramid


def linked(change):
    """All commits that one leads to."""
    while change is not None:
        yield change
        change = change.before


def painted(count):
    """Strokes of which a history that holds few is kept, and what the cache told after each."""
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(1 << 22), history=History(1 << 12))
    states, told = [], []
    for n in range(count):
        session.do(stroke(n))
        if n % 7 == 3:
            session.do(c.Undo(1))
        states.append(session.painting)
        told.append(evaluate(pyramid_of(session.painting), 0, SEEN, session.cache))
    return session, states, told


def test_what_led_to_forgotten_steps_is_forgotten_and_nothing_seen_changes(monkeypatch):
    monkeypatch.setattr(old_commits, "EACH", 3)
    session, states, told = painted(24)
    last = pyramid_of(session.painting).last
    assert session.history.forgotten > 0
    assert last.depth > 16
    assert len(list(linked(last))) < 12
    for state, planes in zip(states, told, strict=True):
        assert np.array_equal(evaluate(pyramid_of(state), 0, SEEN).data, planes.data)
    first, newest = pyramid_of(states[1]), pyramid_of(states[-1])
    assert all(rect.intersect(SEEN) == SEEN for rect in changed_rects(first, newest, 0)[-1:])
    assert [rect.intersect(SEEN) for rect in areas(states[1], states[-1])(5)][-1] == SEEN
    apart = {key for key, _, _ in changed_records(states[1].root, states[-1].root)}
    assert apart == {key for key, record in first.all_records() if not newest.holds(key, record)}


def test_steps_that_are_held_are_told_apart_by_their_own_commits(monkeypatch):
    monkeypatch.setattr(old_commits, "EACH", 3)
    session, _, _ = painted(24)
    for step in session.history.steps.done:
        (change,) = changes_between(pyramid_of(step.before).last, pyramid_of(step.after).last)
        assert change is pyramid_of(step.after).last


def test_a_history_that_keeps_no_step_forgets_what_led_to_the_present(monkeypatch):
    monkeypatch.setattr(old_commits, "EACH", 2)
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(1 << 22), history=History(0, keep=0))
    for n in range(9):
        session.do(stroke(n))
    assert session.history.steps.done == ()
    assert 1 <= len(list(linked(pyramid_of(session.painting).last))) <= 5


def test_commits_beyond_those_forgotten_may_have_changed_anything():
    chain = [None]
    for depth in range(1, 7):
        chain.append(Change(0, SEEN, chain[-1], depth=depth))
    chain[3].forget_before()
    assert list(changes_between(chain[3], chain[5])) == [chain[5], chain[4]]
    for older, newer in itertools.product(chain[:3], chain[4:]):
        *known, anything = changes_between(older, newer)
        assert known[: newer.depth - 2] == [newer, *itertools.islice(linked(newer.before), newer.depth - 3)]
        far = 1 << 8000
        assert all(anything.reach(level).meets(Rect.at(x, -x, 1, 1)) for level in (-4096, 0, 4096) for x in (far, -far))
