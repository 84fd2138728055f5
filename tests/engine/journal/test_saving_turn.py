"""One painting is written at a time: a checkpoint gives way to a save, and is written after it."""

import threading
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_answers import draw, idle
from test_checkpoints import end_of_checkpoint, often  # noqa: F401  a fixture
from test_recovering import left, painter

from engine.archive.opening import open_painting
from engine.archive.saving_turn import SAVING, SavingTurn
from engine.files.fault import Cancelled
from engine.journal import checkpoints
from engine.keeping import memory
from engine.studio import requests as q


def until(told):
    """Waits for something."""
    end = time.monotonic() + 90
    while not told():
        assert time.monotonic() < end
        time.sleep(0.005)


@given(st.lists(st.booleans(), min_size=1, max_size=6))
def test_never_two_have_it_and_all_who_wait_do(wait):
    turn, inside, had, refused = SavingTurn(), [], [], []

    def write(number, waits):
        try:
            with turn.taken() if waits else turn.taken_if_free(), turn.taken():  # who has it may take it again
                inside.append(number)
                had.append(list(inside))
                inside.remove(number)
        except Cancelled:
            refused.append(number)

    threads = [threading.Thread(target=write, args=each) for each in enumerate(wait)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(len(there) == 1 for there in had)
    assert len(had) + len(refused) == len(wait)
    assert not any(wait[number] for number in refused)
    assert turn.free


def test_who_waits_is_known_and_may_give_up():
    turn, given_up, ended = SavingTurn(), threading.Event(), []

    def wait():
        with pytest.raises(Cancelled), turn.taken(given_up.is_set):
            pass
        ended.append(True)

    with turn.taken():
        assert not turn.free
        thread = threading.Thread(target=wait)
        thread.start()
        until(lambda: turn.wanted)
        given_up.set()
        thread.join()
    assert ended
    assert turn.free


def test_what_is_written_on_its_own_account_is_not_begun_while_somebody_waits():
    turn, done = SavingTurn(), []
    with turn.taken():
        thread = threading.Thread(target=lambda: [done.append(1) for _ in [0] if turn.taken().__enter__() is None])
        thread.start()
        until(lambda: turn.wanted)
        with pytest.raises(Cancelled), turn.taken_if_free():
            pass
    thread.join()
    assert done


@pytest.fixture(autouse=True)
def soon(monkeypatch):
    """What gave way is tried again at once."""
    monkeypatch.setattr("engine.studio.journalled.beside.LULL", 0.01)


@pytest.mark.usefixtures("often")
def test_a_checkpoint_gives_way_once_while_memory_is_short(tmp_path, monkeypatch):
    begun, save, outcomes = [], checkpoints.save, []

    def told(path, snapshot, cancelled):
        begun.append(path)
        outcomes.append(cancelled())
        if outcomes[-1]:
            raise Cancelled
        save(path, snapshot, cancelled=cancelled)

    monkeypatch.setattr(checkpoints, "save", told)
    monkeypatch.setattr(memory, "crowded", lambda: True)
    worker = painter(tmp_path / "journal")
    draw(worker, 30, 0)
    idle(worker)
    end_of_checkpoint(worker)
    assert outcomes == [True, False]
    left(worker)


@pytest.mark.usefixtures("often")
def test_a_checkpoint_gives_way_to_a_save_and_is_written_after_it(tmp_path, monkeypatch):
    begun, save = [], checkpoints.save

    def slow(path, snapshot, cancelled):
        begun.append(path)
        until(lambda: len(begun) > 1 or cancelled())
        if len(begun) == 1:
            raise Cancelled
        save(path, snapshot, cancelled=cancelled)

    monkeypatch.setattr(checkpoints, "save", slow)
    worker = painter(tmp_path / "journal")
    draw(worker, 30, 0)
    until(lambda: begun)
    worker.post(q.Save(tmp_path / "a.ora"))
    until((tmp_path / "a.ora").exists)
    end_of_checkpoint(worker)
    assert len(begun) == 2
    left(worker)
    assert open_painting(tmp_path / "a.ora").native
    assert SAVING.free


@pytest.mark.usefixtures("often")
def test_a_checkpoint_that_gave_way_gives_way_no_more(tmp_path, monkeypatch):
    begun, save, waits = [], checkpoints.save, []

    def slow(path, snapshot, cancelled):
        begun.append(path)
        until(lambda: SAVING.wanted)
        waits.append(cancelled())
        if cancelled():
            raise Cancelled
        save(path, snapshot, cancelled=cancelled)

    monkeypatch.setattr(checkpoints, "save", slow)
    worker = painter(tmp_path / "journal")
    draw(worker, 30, 0)
    for number in range(2):
        until(lambda number=number: len(begun) > number)
        worker.post(q.Save(tmp_path / f"{number}.ora"))
        until((tmp_path / f"{number}.ora").exists)
    end_of_checkpoint(worker)
    assert waits == [True, False]
    left(worker)
