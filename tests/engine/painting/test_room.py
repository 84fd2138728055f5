"""What a session holds is kept within the budget, whatever comes and goes."""

import numpy as np
import pytest

from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.keeping import memory
from engine.numeric.address import TileKey
from engine.painting.value import Painting
from engine.session import room as rooms
from engine.session.history import History
from engine.session.room import Room
from engine.texture.planes import Planes

MEGABYTE = memory.MEGABYTE


class Process:
    """A process whose memory a test decides: what is given back is free at once."""

    def __init__(self, monkeypatch):
        self.used = self.free = self.now = self.given = self.passed = self.worked = 0
        monkeypatch.setattr(memory, "budget", lambda: 100 * MEGABYTE)
        monkeypatch.setattr(memory, "PROGRAM", rooms._APART + 100 * MEGABYTE // rooms._PASSING_PART)
        monkeypatch.setattr(memory, "resident", lambda: (self.used + self.free) * MEGABYTE)
        monkeypatch.setattr(memory, "peak", lambda: (self.used + self.free + self.passed) * MEGABYTE)
        monkeypatch.setattr(memory, "give_back", self.give_back)
        monkeypatch.setattr(rooms.time, "monotonic", lambda: self.now)
        monkeypatch.setattr(rooms.time, "thread_time", self.thread_time)

    def thread_time(self):
        self.worked += 1e-4
        return self.worked

    def give_back(self):
        self.given += self.free > 0
        self.free = 0


@pytest.fixture
def process(monkeypatch):
    return Process(monkeypatch)


def test_what_a_spike_left_is_given_back_soon(process):
    room = Room(TileCache(MEGABYTE), History())
    process.used = 500  # a save is on its way
    room.keep_within(Painting().root)
    process.used, process.free = 90, 400
    room.keep_within(Painting().root)
    assert process.free == 400  # it was looked after just now
    process.now += rooms._AGAIN
    room.keep_within(Painting().root)
    assert process.free == 0


def test_a_process_within_its_budget_is_left_alone(process):
    room = Room(TileCache(MEGABYTE), History())
    process.used, process.free = 60, 40
    for _ in range(3):
        room.keep_within(Painting().root)
        process.now += 10 * rooms._AGAIN
    assert process.free == 40


def test_what_is_always_too_much_is_seldom_looked_after(process):
    room = Room(TileCache(MEGABYTE), History())
    process.used = 200
    for _ in range(100):
        process.free = 1
        room.keep_within(Painting().root)
        process.now += rooms._AGAIN / 10
    assert 5 <= process.given <= 15


def test_what_strokes_bring_and_leave_takes_a_small_part_of_their_time(process):
    """Unless little room is left."""
    room = Room(TileCache(MEGABYTE), History())
    room._took = 1.0
    for _ in range(100):
        process.used, process.free = 60, 45
        room.keep_within(Painting().root)
        room._took = 1.0  # the look took a second
        process.now += 1
    assert 5 <= process.given <= 8
    for _ in range(100):
        process.free = 60
        room.keep_within(Painting().root)
        room._took = 1.0
        process.now += 1
    assert process.given >= 105


def test_old_steps_are_all_coded_and_put_away_where_the_process_takes_too_much(process):
    history = History()
    room = Room(TileCache(MEGABYTE), history)
    process.used = 500
    room.keep_within(Painting().root)
    assert history.tight
    process.used = 90
    room.keep_within(Painting().root)
    assert not history.tight


def gives_back_at_rest(room, process, used, free):
    process.used, process.free = used, free
    room.keep_within(Painting().root)
    return bool(room.pending)


def test_what_came_and_went_is_given_back_at_rest_however_little_is_taken(process):
    room = Room(TileCache(MEGABYTE), History())
    assert not gives_back_at_rest(room, process, 10, 0)
    assert gives_back_at_rest(room, process, 30, 60)
    room.step()
    assert not room.pending
    assert (process.used, process.free) == (30, 0)
    assert not gives_back_at_rest(room, process, 20, 20)
    assert gives_back_at_rest(room, process, 20, 80)


def test_the_more_is_taken_the_more_may_be_free_before_it_is_given_back(process):
    room = Room(TileCache(MEGABYTE), History())
    room._settled = 1600 * MEGABYTE
    assert not gives_back_at_rest(room, process, 1600, 90)
    assert gives_back_at_rest(room, process, 1600, 110)


def test_what_is_free_is_left_for_what_is_seen_next_while_somebody_looks(process):
    cache = TileCache(128 * MEGABYTE)
    room = Room(cache, History())
    assert not gives_back_at_rest(room, process, 10, 0)
    for n in range(20):  # 80 MB of evaluated tiles
        cache.lend(Pyramid(), TileKey(0, n, 0), Planes(np.zeros((4, 512, 512), np.float32)))
    room.looked()
    assert not gives_back_at_rest(room, process, 95, 3)
    assert room.due == rooms._CALM
    process.now = rooms._CALM
    assert room.due is None
    assert room.pending
    room.looked()
    assert not room.pending
    assert gives_back_at_rest(room, process, 95, 30)  # beside the tiles the process grew too much
    room.step()
    assert process.free == 0
    assert room.due is None


def test_a_small_cache_gives_way_too(process):
    cache = TileCache(64 * MEGABYTE)
    for n in range(60):
        cache.adopt(Pyramid(), TileKey(0, n, 0), Planes(np.ones((4, 256, 256), np.float32)))
    process.used, room = 500, Room(cache, History())
    room.keep_within(Painting().root)
    assert cache.held <= rooms.SMALLEST_CACHE == cache.budget  # nor does it grow again at once
    process.used = 80
    room.keep_within(Painting().root)
    assert cache.budget == cache.held + 20 * MEGABYTE
    process.used = 10
    room.keep_within(Painting().root)
    assert cache.budget == 64 * MEGABYTE


def test_where_much_comes_and_goes_room_is_left_for_it_for_a_while(process):
    room = Room(TileCache(MEGABYTE), History())
    process.used, process.free, process.passed = 60, 35, 45
    for worked, given in ((0.05, 0), (0.2, 1)):  # a short piece of work tells nothing
        process.worked += worked
        room.keep_within(Painting().root)
        assert process.given == given
    process.passed = 10
    for n in range(80):
        process.free, process.now, process.worked = 35, process.now + 10 * rooms._AGAIN, process.worked + 0.2
        room.keep_within(Painting().root)
        assert process.given == n + 2 or n > 20
    assert process.given < 70
    assert process.free
