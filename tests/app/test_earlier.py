"""Dates of earlier versions, as one says them."""

import time

from app.desk.earlier import date_text


def at(day, hour=12):
    return time.mktime((2026, 3, day, hour, 5, 0, 0, 0, -1))


def test_today_and_yesterday_have_their_names():
    now = at(29, 13)
    assert date_text(at(29, 0), now) == "Today, 00:05"
    assert date_text(at(28, 23), now) == "Yesterday, 23:05"
    assert date_text(at(27), now) == "2026-03-27, 12:05"
    assert date_text(at(30), now) == "2026-03-30, 12:05"  # the clock was wrong
