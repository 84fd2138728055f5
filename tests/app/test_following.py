"""Pictures that follow what they show: the first change at once, the last one always, none too often."""

from app.desk.examples.awaited import LATE, Awaited
from app.desk.examples.following import Following


def test_a_change_is_followed_at_once_and_only_once():
    following = Following(0.5)
    assert following.due("a", 10.0)
    assert not following.due("a", 10.1)
    assert not following.due("a", 20.0)
    assert following.due("b", 20.0)


def test_many_changes_are_followed_now_and_then_and_the_last_one_is_not_lost():
    following = Following(0.5)
    times = [n / 100 for n in range(1000, 1200)]
    asked = [now for now in times if following.due(min(now, 11.3), now)]
    assert asked == [10.0, 10.5, 11.0, 11.5]


def test_it_waits_until_it_is_free():
    following = Following(0.5)
    assert not following.due("a", 10.0, free=False)
    assert following.due("a", 10.1, free=True)


def test_a_picture_that_does_not_come_is_late_after_a_while_and_no_more_once_it_is_there(monkeypatch):
    now, awaited = [50.0], Awaited()
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    assert not awaited.late("brush")
    awaited.ask("brush")
    now[0] += 0.9 * LATE
    awaited.ask("brush")  # another one: the hand has moved on
    assert not awaited.late("brush")
    now[0] += 0.2 * LATE
    assert awaited.late("brush")
    assert not awaited.late("ink")
    awaited.come("brush")
    assert not awaited.late("brush")
