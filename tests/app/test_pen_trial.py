"""What the pen tester measures, and which pens come and go."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.desk.preferring.pen_trial import PenTrail, PenTrial, motion_measured
from app.input.events import PenEvent


def tried(places, step=0.005, start=0.0):
    trial = PenTrial(on=True)
    for n, (x, y) in enumerate(places):
        event = PenEvent("move", x, y, 0.5, time=start + n * step, pen=True)
        trial.take(event, event)
    return trial


@given(st.floats(0.001, 0.05), st.floats(-9, 9), st.floats(-9, 9))
def test_an_even_straight_motion_has_its_rate_and_no_jitter(step, dx, dy):
    rate, uneven, jitter = motion_measured(tried([(n * dx, n * dy) for n in range(40)], step).reports)
    assert rate == pytest.approx(1 / step, rel=1e-6)
    assert uneven == pytest.approx(0, abs=1e-6)
    assert jitter == pytest.approx(0, abs=1e-6)


def test_jitter_is_the_deviation_of_a_place_and_an_earlier_motion_does_not_count():
    trial = tried([(n, 1.0 if n % 2 else -1.0) for n in range(100)])
    assert motion_measured(trial.reports).jitter == pytest.approx(2 / 3**0.5)  # its worst: each is off the other way
    for n in range(9):
        event = PenEvent("move", n, 0.0, 0.5, time=9.0 + n * 0.01, pen=True)
        trial.take(event, event)
    assert motion_measured(trial.reports).jitter == 0
    assert motion_measured(list(trial.reports)[:3]) is None


def test_buttons_are_told_of_a_mouse_too_and_nothing_while_it_is_closed():
    trial = PenTrial(on=True)
    for kind, button in (("down", 1), ("down", 3), ("up", 1)):
        event = PenEvent(kind, 0, 0, button=button)
        trial.take(event, event)
    assert (trial.buttons, len(trial.reports)) == ({3}, 0)
    trial.leave()
    trial.take(PenEvent("down", 0, 0, button=1), PenEvent("down", 0, 0))
    assert trial.buttons == set()


def test_a_pen_that_is_plugged_in_or_out_is_told_and_those_of_the_start_are_not():
    trial = PenTrial()
    assert trial.heard("XInput 2", ("One",)) == ""
    assert trial.heard("XInput 2", ("One", "Two")) == "Pen found: Two"
    assert trial.heard("XInput 2", ("One", "Two")) == ""
    assert trial.heard("XInput 2", ("Two",)) == "Pen gone: One"


def test_a_trail_has_every_report_of_the_last_stroke_however_few_frames_there_are():
    trial, trail, area = PenTrial(on=True), PenTrail(), (100.0, 50.0, 200.0, 80.0)
    told = [
        (110, 60, 0.0),
        (120, 60, 0.2),
        (130, 60, 0.4),
        (140, 60, 0.0),
        (150, 70, 0.5),
        (160, 70, 0.6),
        (500, 70, 0.7),
    ]
    for n, (x, y, pressure) in enumerate(told, 1):
        event = PenEvent("move", x, y, pressure, time=float(n), pen=True)
        trial.take(event, event)
        if n == 5:
            trail.follow(trial.reports, area)
            assert trail.dots == [(50, 20, 0.5)]
    trail.follow(trial.reports, area)
    trail.follow(trial.reports, area)
    assert trail.dots == [(50, 20, 0.5), (60, 20, 0.6)]
