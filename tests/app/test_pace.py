"""Frames and the engine by turns, where the processor fills the pixels, too."""

import time

import pytest

from app import pace
from app.pace import PACE, SPARING, STILL, Pace

CARD, SOFTWARE = "Mesa Intel(R) UHD Graphics 620", "llvmpipe (LLVM 15.0.6, 256 bits)"


class Worker:
    ready = False

    def __init__(self):
        self.turns = []

    def turn(self, end):
        self.turns.append(end)


class Events:
    """Takes the place of the window system: nothing ever happens; `waited`: for how long, each time."""

    def __init__(self):
        self.waited, self.woken = [], 0

    def wait_events_timeout(self, seconds):
        self.waited.append(seconds)

    def poll_events(self):
        pass

    def post_empty_event(self):
        self.woken += 1


class Clock:
    """Takes the place of the clock: time passes only where somebody sleeps, and where a test says so."""

    def __init__(self):
        self.now = 100.0

    def monotonic(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds


@pytest.fixture
def clock(monkeypatch):
    stand_in = Clock()
    monkeypatch.setattr(pace, "time", stand_in)
    return stand_in


@pytest.fixture
def events(monkeypatch):
    stand_in = Events()
    monkeypatch.setattr(pace, "glfw", stand_in)
    return stand_in


def paced(renderer):
    one = Pace(renderer)
    one.worker = Worker()
    return one


def frame(one, growing, moving=False):
    one.begin(time.monotonic())
    one.end(True, moving, growing)


def test_the_engine_has_the_rest_between_two_frames(events, clock):
    one = paced(SOFTWARE)
    one.event()
    start = clock.now
    one.begin(start)
    clock.now += 0.004
    one.end(True, False, True)
    one.wait(False)
    (end,) = one.worker.turns
    assert start + 0.004 < end < start + STILL
    assert clock.now == pytest.approx(start + STILL)
    assert events.waited == []  # events do not cut it short


def test_an_event_ends_the_engines_turn(events):
    one = paced(SOFTWARE)
    frame(one, growing=True)
    one.event()
    (end,) = one.worker.turns
    assert end <= time.monotonic()


@pytest.mark.parametrize(("renderer", "growing"), [(CARD, True), (SOFTWARE, False)])
def test_there_are_no_turns_with_a_card_or_while_nothing_grows(events, monkeypatch, renderer, growing):
    monkeypatch.setattr(pace, "PACE", 10.0)  # however slow the machine is
    monkeypatch.setattr(pace, "STILL", 10.0)
    one = paced(renderer)
    one.event()
    frame(one, growing)
    one.event()
    one.wait(False)
    assert set(one.worker.turns) == {None}
    assert len(events.waited) == 1


def test_there_are_no_turns_while_the_hand_rests(events, monkeypatch):
    monkeypatch.setattr(pace, "AT_HAND", 0.0)
    one = paced(SOFTWARE)
    one.event()
    frame(one, growing=True)
    one.worker.turns.clear()
    one.wait(False)
    assert one.worker.turns == [None]


@pytest.mark.parametrize(("renderer", "lacks", "rest"), [(SOFTWARE, 3, SPARING), (SOFTWARE, 0, PACE), (CARD, 3, PACE)])
def test_frames_are_few_while_the_engine_makes_what_the_screen_lacks(events, clock, renderer, lacks, rest):
    one = paced(renderer)
    one.begin(clock.now)
    one.end(True, True, False, lacks)
    one.wait(True)
    assert events.waited == [pytest.approx(rest)]


def test_the_last_of_what_the_screen_lacks_wakes_a_frame(events, clock):
    one = paced(SOFTWARE)
    one.told()  # taken in by the frame that begins now
    one.begin(clock.now)
    one.told()
    one.end(True, True, False, 3)
    woken = []
    events.wait_events_timeout = lambda seconds: [(one.told(), woken.append(events.woken)) for _ in range(3)]
    one.wait(True)
    assert woken == [0, 1, 1]


def test_what_moves_by_itself_has_turns_too(events, monkeypatch):
    monkeypatch.setattr(pace, "AT_HAND", 0.0)
    one = paced(SOFTWARE)
    frame(one, growing=True, moving=True)
    one.wait(True)
    assert None not in one.worker.turns


@pytest.mark.parametrize("took", [0.012, 0.014, 0.0155, 0.0166, 0.018, 0.08])
def test_the_engine_gets_its_turn_however_long_a_frame_takes(events, clock, took):
    one = paced(SOFTWARE)
    one.event()
    one.begin(clock.now - took)
    one.end(True, False, True)
    start = clock.now
    one.wait(False)
    assert one.worker.turns[-1] >= start + pace.LEAST
    if took > STILL:
        assert clock.now - start >= pace.SHARE * took - 1e-9


def lingering(monkeypatch, drawn=False, moving=False):
    """A window at which an event came a while ago, after a frame; `drawn`: whether anything came of that."""
    monkeypatch.setattr(pace, "LINGER", 1000.0)  # however slow the machine is
    monkeypatch.setattr(pace, "CALM", 100.0)
    monkeypatch.setattr(pace, "STILL", 10.0)
    monkeypatch.setattr(pace, "SOON", 0.0)
    one = paced(CARD)
    one.event()
    one.begin(time.monotonic())
    one.end(drawn, moving, growing=False)
    return one


def test_frames_of_which_nothing_comes_grow_rare(events, monkeypatch):
    lingering(monkeypatch).wait(False)
    lingering(monkeypatch, drawn=True).wait(False)
    lingering(monkeypatch).wait(False, painting=True)
    rare, *usual = events.waited
    assert 50 < rare <= 100
    assert max(usual) <= 10
    assert len(usual) == 2


def test_news_are_not_kept_waiting_by_them(events, monkeypatch):
    one = lingering(monkeypatch)
    monkeypatch.setattr(events, "wait_events_timeout", lambda seconds: one.told())
    one.wait(False)
    assert events.woken == 1
    one.news(time.monotonic() + 60)
    monkeypatch.setattr(events, "wait_events_timeout", events.waited.append)
    one.wait(False)
    assert events.waited[0] <= 10  # more may follow


def test_nothing_waits_where_nothing_happens(events):
    one = paced(CARD)
    frame(one, growing=False)
    one.wait(False)
    one.wait(False, idle=pace.BLINK)
    assert events.waited == [pace.IDLE, pace.BLINK]
    one.told()
    assert events.woken == 0  # frames go on


def test_news_wakes_a_window_that_rests(events, monkeypatch):
    one = paced(CARD)
    frame(one, growing=False)
    monkeypatch.setattr(events, "wait_events_timeout", lambda seconds: one.told())
    one.wait(False)
    assert events.woken == 1


def test_while_the_pen_paints_more_of_the_paint_wakes_a_frame(events, clock):
    one = paced(SOFTWARE)
    woken = []
    events.wait_events_timeout = lambda seconds: (one.told(), woken.append(events.woken))
    for painting in (False, True):
        one.event()
        one.begin(clock.now)
        one.end(True, False, False)
        one.wait(False, painting)
    assert woken == [0, 1]
