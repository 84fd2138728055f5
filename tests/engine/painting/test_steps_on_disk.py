"""Steps beyond what memory and disk hold: undo comes to the first all the same, and redo to the last."""

import gc
from functools import partial

import numpy as np
import pytest
import stepped
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from stepped import ROCK, contents

from engine.canvas import layers
from engine.canvas.tile_cache import TileCache
from engine.keeping.spill import Spill, Spilled
from engine.numeric.address import Rect
from engine.numeric.recent import Recent
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.coding import coded_records, made_again
from engine.session.coding.coded_records import CodedData
from engine.session.history import History
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio.studio import Studio

stroke = partial(stepped.stroke, radius=2.0)

LIMIT = 230_000  # bytes of steps in memory: each holds some thousand beside what is coded


class Narrow(Spill):
    """A disk with room for so many bytes."""

    def __init__(self, folder, room):
        super().__init__(folder)
        self.room = room

    def put(self, piece, spare=False):
        with self._lock:
            self._collect()  # what nobody holds any more has no part in what is full
        return super().put(piece, spare) if self.held + len(piece) <= self.room else None


@pytest.fixture
def disk(tmp_path, monkeypatch):
    spill = Narrow(tmp_path, 20_000)
    monkeypatch.setattr(coded_records, "spill", lambda: spill)
    yield spill
    spill.close()


def begun():
    studio = Studio(lambda result: None, lambda request: None)
    studio.do(q.New(Rect.at(0, 0, 96, 96)))
    session = studio.easel.session
    session._history = session.room.history = History(LIMIT, keep=2)
    return studio


def do(studio, command):
    studio.do(q.Do(command))
    while studio.step():
        pass


def ways(history):
    """Counts of the records of steps: in memory as they are, coded, on disk."""
    held = [
        record.held
        for step in (*history.steps.done, *history.steps.undone)
        for sheet in layers.layers(step.before.root)
        for _, record in sheet.pyramid.all_records()
    ]
    coded = [h for h in held if isinstance(h, CodedData)]
    away = sum(isinstance(h.packed, Spilled) for h in coded)
    return sum(isinstance(h, np.ndarray) for h in held), len(coded) - away, away


STROKES = st.builds(stroke, st.integers(0, 9), st.integers(-1, 1), ink=st.sampled_from([(), ROCK]))


def there_and_back(strokes):
    """Paints, goes back to the first step and on to the last."""
    studio = begun()
    session = studio.easel.session
    states = [contents(session.painting, depth=False)]
    for command in strokes:
        do(studio, command)
        states.append(contents(session.painting, depth=False))
    assert session.history.forgotten > 0
    assert all(ways(session.history)), ways(session.history)
    for wanted in states[-2::-1]:
        assert session.can_undo
        do(studio, c.Undo())
        assert contents(session.painting, depth=False) == wanted
    assert not session.can_undo
    for wanted in states[1:]:
        assert session.can_redo
        do(studio, c.Redo())
        assert contents(session.painting, depth=False) == wanted
    assert not session.can_redo
    studio.close()


@pytest.mark.usefixtures("disk")
def test_undo_comes_to_the_first_step_and_redo_to_the_last_whichever_way_they_are_kept():
    there_and_back(map(stroke, range(18)))


@pytest.mark.nightly
@settings(deadline=None, max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(STROKES, min_size=8, max_size=16))
@pytest.mark.usefixtures("disk")
def test_so_it_does_whatever_was_painted(strokes):
    there_and_back((*map(stroke, range(18)), *strokes))


def test_what_steps_had_on_disk_is_free_when_they_are_gone(disk, monkeypatch):
    disk.room = 1 << 30
    studio = begun()
    for n in range(14):
        do(studio, stroke(n))
    assert studio.easel.session.history.forgotten == 0
    assert disk.held > 0
    studio.do(q.New(Rect.at(0, 0, 96, 96)))
    studio.close()
    del studio
    gc.collect()
    coded_records.RECORDS_MADE._made.clear()  # of what was asked for of late, nothing
    monkeypatch.setattr(coded_records, "RECORDS_MADE", Recent(lambda: 0))
    disk.put(b"")
    assert disk.held == 0


@pytest.mark.parametrize("limit", [None, 40_000])
def test_what_was_undone_goes_to_disk_too_where_there_is_no_room_and_is_done_again_as_it_was(disk, limit):
    disk.room = 1 << 30
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    for n in range(14):
        session.do(stroke(n, radius=9.0))
    history = session.history
    states = [contents(end.after, depth=False) for end in history.steps.done]
    session.do(c.Undo(13))
    assert disk.held == 0
    plain = history.held
    if limit is None:
        history.tight = True
    else:
        history._limit = limit
    undone = history._undone
    while history.pending:
        history.step()
    assert undone.plain == undone.in_memory == 0
    assert disk.held > 0
    assert 0 < history.held < plain / 2
    made_again.forget_made(1 << 40)
    for wanted in states[1:]:
        session.do(c.Redo(1))
        assert contents(session.painting, depth=False) == wanted


def test_no_interrupt_gets_lost_while_pieces_are_let_go(tmp_path):
    spill = Spill(tmp_path)
    for n in range(50):
        pieces = [spill.put(bytes([n]) * 600) for _ in range(20)]
        assert all(piece.read() == bytes([n]) * 600 for piece in pieces)
        del pieces[:]  # runs no code of ours, in which it would be passed over
    assert spill.put(b"x").read() == b"x"
    assert spill.length <= 21 * 1024
    assert "__del__" not in vars(Spilled)
    spill.close()
