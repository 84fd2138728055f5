"""What an hour of random painting comes to."""

from threading import Event, Thread

import numpy as np

from bench.holders import _frames, _of_frames, holders
from bench.hour import BOUND, percentiles, verdict


def judged(resident, pings=(1.0,), budget=1024):
    told = verdict([{"resident": megabytes} for megabytes in resident], list(pings), budget)
    return told["small"], told["steady"], told["answers"]


def test_memory_may_grow_at_first_but_not_later_and_never_beyond_the_budget():
    assert judged([300, 900, 1200, 1200, 1200, 1190, 1210, 1200]) == (True, True, True)
    assert judged([300, 500, 700, 800, 900, 1000, 1100, 1200]) == (True, False, True)
    assert judged([300, 1275, 900, 900]) == (False, True, True)
    assert judged([300, 1275, 900, 900], budget=1025) == (True, True, True)


def test_one_ping_in_twenty_may_be_late():
    assert judged([300], [BOUND] * 96 + [10 * BOUND] * 4) == (True, True, True)
    assert judged([300], [BOUND] * 90 + [10 * BOUND] * 10) == (True, True, False)
    assert percentiles([float(n) for n in range(101)])["ping 95 %"] == 95.0


def test_who_holds_arrays_is_told_with_the_way_to_them():
    kept = {"a": [np.zeros(1 << 20, np.uint8)], "b": np.zeros(1 << 21, np.uint8)[1:], "c": bytes(1 << 20)}
    told = holders([[("first", kept["a"])], [("second", kept)]])
    assert told["total"] == 4
    assert sorted(told["top"]) == [
        ["first > ndarray", 1.0, 1],
        ["second > bytes", 1.0, 1],
        ["second > ndarray > ndarray", 2.0, 1],
    ]


HELD, ENDED = Event(), Event()


def outer():
    kept = np.zeros(1 << 20, np.uint8)
    inner()
    return kept


def inner():
    HELD.set()
    ENDED.wait()


def test_who_holds_arrays_is_told_of_functions_that_run_in_another_thread():
    """Of the one with the array alone: the thread's own lead to all that there is."""
    thread = Thread(target=outer, name="somebody")
    thread.start()
    HELD.wait()
    frames = [row for row in _frames() if row[0].startswith("somebody")]
    told = holders([_of_frames([row for row in frames if row[0].endswith((" outer", " inner"))])])
    ENDED.set()
    thread.join()
    assert len(frames) > 2
    assert told["top"] == [["somebody: outer kept", 1.0, 1]]
