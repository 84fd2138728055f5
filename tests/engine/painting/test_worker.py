"""The worker's thread: order, cancellation, and errors that leave it alive."""

import threading
import time
from queue import Queue

import pytest

from engine.numeric.address import Rect
from engine.painting.value import Refusal
from engine.studio import requests as q
from engine.studio import results
from engine.studio.worker import Worker


class Bench:
    """A stand-in that writes down what it is asked to do; `gate` holds it up."""

    due = endless = None
    waits = unseen = False

    def __init__(self, send):
        self.send, self.did, self.open, self.gate = send, [], [], threading.Event()
        self.gate.set()
        send(results.Ready())

    def do(self, request):
        self.gate.wait(90)
        self.did.append(request)
        if isinstance(request, q.Export):
            raise Refusal("it did not work\nand more that nobody wants to read")
        if isinstance(request, q.Save):
            raise KeyError("missing key")

    def look(self, request):
        self.open = list(request.tiles)

    def step(self):
        self.gate.wait(90)
        self.did.append(self.open.pop(0))
        return True

    @property
    def pending(self):
        return len(self.open)

    def play(self):
        self.did.append("play")
        self.due = None if self.endless is None else 0.0

    def close(self):
        self.did.append("closed")


@pytest.fixture
def worker():
    made = Queue()

    def make(send, post):
        bench = Bench(send)
        bench.post = post
        made.put(bench)
        return bench

    one = Worker(lambda: None, make)
    one.bench = made.get(timeout=90)
    yield one
    one.bench.gate.set()
    one.close(90)


def until(condition):
    end = time.monotonic() + 90
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.002)


def test_it_is_behind_until_all_is_carried_out_and_its_results_are_taken(worker):
    one, bench = worker, worker.bench
    one.results()
    assert not one.behind
    bench.gate.clear()
    one.post(q.Finish())
    assert one.behind
    bench.gate.set()
    end = time.monotonic() + 90
    while one.behind:
        one.results()
        assert time.monotonic() < end
        time.sleep(0.01)
    assert bench.did == [q.Finish()]


def test_it_is_settled_when_nothing_is_left_to_be_seen_either(worker):
    one, bench = worker, worker.bench
    until(lambda: not one.results() and one.settled)
    bench.unseen = True  # pictures wait for what is made elsewhere
    one.post(q.Finish())
    until(lambda: bench.did)
    one.results()
    time.sleep(0.05)
    assert not one.settled
    bench.unseen = False
    one.post(q.Finish())
    until(lambda: not one.results() and one.settled)


def test_what_is_posted_while_it_closes_is_carried_out(worker):
    """The threads that write files post that they have, and closing waits for them."""
    bench = worker.bench
    bench.close = lambda: worker.post(q.Written(1))
    worker.close(90)
    assert bench.did == [q.Written(1)]


def test_requests_are_carried_out_in_order(worker):
    posts = [q.New(Rect(0, 0, n, n)) for n in range(1, 20)]
    for post in posts:
        worker.post(post)
    until(lambda: len(worker.bench.did) == len(posts))
    assert worker.bench.did == posts


def test_posting_never_waits(worker):
    """The engine does nothing before all is posted: this would never end."""
    worker.bench.gate.clear()
    for n in range(200):
        worker.post(q.New(Rect(0, 0, n, n)))
    assert len(worker.bench.did) < 100
    worker.bench.gate.set()
    until(lambda: len(worker.bench.did) == 200)


def test_a_newer_look_replaces_the_tiles_of_the_older(worker):
    worker.bench.gate.clear()
    worker.post(q.Look(tuple((0, n, 0, -1) for n in range(50))))
    until(lambda: worker.bench.open)
    worker.post(q.Look(((9, 1, 1, -1),)))
    worker.bench.gate.set()
    until(lambda: not worker.bench.open and (9, 1, 1, -1) in worker.bench.did)
    assert len(worker.bench.did) <= 3


def test_commands_go_before_tiles(worker):
    worker.bench.gate.clear()
    worker.post(q.Look(tuple((0, n, 0, -1) for n in range(50))))
    until(lambda: worker.bench.open)
    worker.post(q.Finish())
    worker.bench.gate.set()
    until(lambda: q.Finish() in worker.bench.did)
    assert worker.bench.did.index(q.Finish()) <= 1


def test_an_error_becomes_one_line_and_the_thread_goes_on(worker):
    worker.post(q.Export("somewhere.png"))
    worker.post(q.Finish())
    until(lambda: q.Finish() in worker.bench.did)
    notes = [r for r in worker.results() if isinstance(r, results.Note)]
    assert notes == [results.Note("it did not work", bad=True)]


def test_a_fault_is_no_refusal_and_leaves_its_trace(worker, faults):
    worker.post(q.Save("somewhere.ora"))
    worker.post(q.Finish())
    until(lambda: q.Finish() in worker.bench.did)
    notes = [r for r in worker.results() if isinstance(r, results.Note)]
    assert notes == [results.Note("A fault in Inkfall", True, True, True, ("copy_details",), "fault")]
    fault = faults.pop()
    assert fault.threadName == "inkfall engine"
    assert fault.exc_info[0] is KeyError
    assert not faults


def test_only_the_newest_swatch_of_a_name_is_painted(worker):
    worker.bench.gate.clear()
    worker.post(q.Finish())
    for n in range(5):
        worker.post(q.Swatch("ink", None, (n, n)))
    worker.post(q.Swatch("other", None, (7, 7)))
    worker.bench.gate.set()
    until(lambda: len(worker.bench.did) == 3)
    assert worker.bench.did[1:] == [q.Swatch("ink", None, (4, 4)), q.Swatch("other", None, (7, 7))]


def test_swatches_that_are_wanted_soon_go_first(worker):
    worker.bench.gate.clear()
    worker.post(q.Finish())
    for name in ("a", "b"):
        worker.post(q.Swatch(name, None, (1, 1)))
    worker.post(q.Swatch("brush", None, (1, 1), soon=True))
    worker.bench.gate.set()
    until(lambda: len(worker.bench.did) == 4)
    assert [swatch.ident for swatch in worker.bench.did[1:]] == ["brush", "a", "b"]


def test_tiles_let_a_swatch_pass_now_and_then(worker, monkeypatch):
    monkeypatch.setattr("engine.studio.worker.PASSING", 600.0)  # until no tiles are left
    worker.bench.gate.clear()
    worker.post(q.Look(tuple((0, n, 0, -1) for n in range(2000))))
    until(lambda: worker.bench.open)
    for n in range(2):
        worker.post(q.Swatch(f"{n}", None, (1, 1)))
    worker.bench.gate.set()
    until(lambda: len(worker.bench.did) == 2002)
    places = [i for i, did in enumerate(worker.bench.did) if isinstance(did, q.Swatch)]
    assert places[0] <= 1  # none had passed for long
    assert places[1] > 20  # the next waits


def test_tiles_let_the_next_swatch_pass_the_later_the_longer_the_last_one_took(worker, monkeypatch):
    times = []

    def slowly(bench, request):
        times.append(time.monotonic())
        time.sleep(0.1)
        times.append(time.monotonic())

    monkeypatch.setattr(Bench, "do", slowly)
    worker.bench.step = lambda: time.sleep(0.001)  # as if tiles never came to an end
    worker.bench.open = [1]
    for n in range(2):
        worker.post(q.Swatch(f"{n}", None, (1, 1)))
    until(lambda: len(times) == 4)
    worker.bench.open.clear()
    assert times[2] - times[1] >= 4 * (times[1] - times[0])


def test_closing_does_what_was_posted_before(worker):
    worker.bench.gate.clear()
    posts = [q.New(Rect(0, 0, n, n)) for n in range(5)]
    for post in posts:
        worker.post(post)
    threading.Timer(0.05, worker.bench.gate.set).start()
    worker.close(90)
    assert worker.bench.did == [*posts, "closed"]


def test_something_that_plays_goes_on_by_itself(worker):
    worker.bench.due = 0.0
    worker.post(q.Finish())
    until(lambda: "play" in worker.bench.did)


def test_an_engine_that_does_not_load_is_told(faults):
    woken = threading.Event()

    def broken(send, post):
        raise ImportError("no numba here")

    worker = Worker(woken.set, broken)
    woken.wait(90)
    assert worker.results() == [
        results.Note("The paint engine did not load", True, True, True, ("copy_details",), "engine")
    ]
    assert "no numba here" in str(faults.pop().exc_info[1])
    worker.close()


UNTURNED = 0.05  # seconds that open work waits for its turn, at most


def few(began):
    """Pieces of work that are done without a turn since then, at most."""
    return 2 + (time.monotonic() - began) / UNTURNED


def held(worker, count=1000):
    """A worker whose turn is over, with open work; since when."""
    worker.bench.gate.clear()
    worker.post(q.Look(tuple((0, n, 0, -1) for n in range(count))))
    until(lambda: len(worker.bench.open) == count)
    worker.turn(time.monotonic() - 1.0)
    began = time.monotonic()
    worker.bench.gate.set()
    return began


def test_open_work_waits_for_its_turn(worker):
    began = held(worker)
    time.sleep(0.1)
    assert len(worker.bench.did) <= few(began)
    worker.turn(None)
    until(lambda: len(worker.bench.did) == 1000)


def test_a_turn_ends_by_itself(worker):
    held(worker, 1_000_000)
    until(lambda: worker.turn(time.monotonic() + 0.1) or len(worker.bench.did) > 100)
    time.sleep(0.2)
    did, began = len(worker.bench.did), time.monotonic()
    assert did < 1_000_000
    time.sleep(0.1)
    assert len(worker.bench.did) <= did + few(began)


def test_work_goes_on_slowly_where_no_turn_ever_comes(worker):
    held(worker, 3)
    until(lambda: len(worker.bench.did) == 3)


def test_commands_need_no_turn(worker):
    began = held(worker)
    worker.post(q.Finish())
    until(lambda: q.Finish() in worker.bench.did)
    assert len(worker.bench.did) <= few(began) + 1


def test_a_swatch_waits_until_turns_are_over(worker, monkeypatch):
    monkeypatch.setattr("engine.studio.worker.LONGER", 600.0)
    worker.turn(time.monotonic() + 600.0)
    worker.post(q.Swatch("ink", None, (1, 1)))
    time.sleep(0.1)
    assert worker.bench.did == []
    worker.turn(None)
    until(lambda: len(worker.bench.did) == 1)


def test_a_swatch_does_not_wait_for_ever(worker, monkeypatch):
    monkeypatch.setattr("engine.studio.worker.LONGER", 0.05)
    worker.turn(time.monotonic() + 600.0)
    worker.post(q.Swatch("ink", None, (1, 1)))
    until(lambda: len(worker.bench.did) == 1)


def test_swatches_that_waited_come_one_by_one(worker, monkeypatch):
    monkeypatch.setattr("engine.studio.worker.LONGER", 0.1)
    worker.turn(time.monotonic() - 1.0)
    began = time.monotonic()
    for n in range(20):
        worker.post(q.Swatch(f"{n}", None, (1, 1)))
    until(lambda: worker.bench.did)
    time.sleep(0.25)
    assert len(worker.bench.did) <= few(began)


def test_what_plays_has_its_turns_too(worker):
    worker.bench.endless, worker.bench.due = True, 0.0
    worker.turn(time.monotonic() - 1.0)
    worker.post(q.Finish())
    until(lambda: "play" in worker.bench.did)
    did, began = len(worker.bench.did), time.monotonic()
    time.sleep(0.1)
    assert len(worker.bench.did) <= did + few(began)
    worker.turn(None)
    until(lambda: len(worker.bench.did) > did + 100)


def test_closing_waits_as_long_as_it_takes(worker):
    worker.bench.gate.clear()
    worker.post(q.Finish())
    worker.close(0.05)
    assert "closed" not in worker.bench.did
    worker.bench.gate.set()
    worker.close(None)
    assert worker.bench.did[-1] == "closed"


def test_what_is_seen_is_taken_alone_only_where_nothing_came_before_it(worker):
    one, bench = worker, worker.bench
    one.results()
    same, note = results.Same(((0, 0, 0),), 1), results.Note("a note")
    for result in (same, note, same):
        bench.send(result)
    assert one.results(seen=True) == [same]
    assert one.results(seen=True) == []
    assert one.results()[:2] == [note, same]
