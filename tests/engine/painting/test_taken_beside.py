"""Steps of a thread of their own: all come, in order, faults too, and they end when nobody wants them."""

import threading

import pytest

from engine.studio.textures.taken_beside import taken_beside


def test_all_steps_come_in_order_and_nothing_between_them():
    """A step may be None itself, as of who has nothing to tell."""
    found = list(taken_beside(iter([1, None, 2, 3])))
    assert [step for step in found if step is not None] == [1, 2, 3]


def test_who_asks_is_not_kept_waiting_by_a_long_step():
    go_on = threading.Event()

    def steps():
        go_on.wait()
        yield "done"

    taken = taken_beside(steps())
    assert [next(taken) for _ in range(3)] == [None] * 3
    go_on.set()
    assert [step for step in taken if step is not None] == ["done"]


def test_a_fault_is_raised_where_it_is_waited_for():
    def steps():
        yield 1
        raise ValueError("no more")

    taken = taken_beside(steps())
    with pytest.raises(ValueError, match="no more"):
        for _ in taken:
            pass


def test_steps_that_nobody_wants_end():
    taken, ended, go_on = [], threading.Event(), threading.Event()

    def steps():
        try:
            for n in range(1000):
                taken.append(n)
                yield n
                go_on.wait()
        finally:
            ended.set()

    wanted = taken_beside(steps())
    while next(wanted) is None:
        pass
    wanted.close()
    go_on.set()
    assert ended.wait(90)
    assert len(taken) < 1000
