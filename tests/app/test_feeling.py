"""How a pen is felt: its curve, a constant pressure, and fingers that do nothing."""

import pytest

from app.desk.preferring.feeling import felt
from app.input import xinput2
from app.input.events import PenEvent
from engine.keeping.preferences import Preferences


@pytest.mark.parametrize(
    ("preferences", "pressure"),
    [
        (Preferences(), 0.25),
        (Preferences(curve=((0.0, 0.5), (0.5, 1.0))), 0.75),
        (Preferences(curve=((0.5, 0.0), (1.0, 1.0))), 0.0),
        (Preferences(constant=0.8, curve=((0.0, 1.0), (1.0, 0.0))), 0.8),
    ],
)
def test_a_pens_pressure_becomes_what_is_preferred_and_a_mouses_stays(preferences, pressure):
    event = PenEvent("move", 3.0, 4.0, pressure=0.25, pen=True)
    assert felt(event, preferences).pressure == pytest.approx(pressure)
    mouse = PenEvent("move", 3.0, 4.0)
    assert felt(mouse, preferences) is mouse


def test_fingers_do_nothing_where_that_is_preferred():
    finger = PenEvent("down", 3.0, 4.0, touch=True)
    assert felt(finger, Preferences()) is finger
    assert felt(finger, Preferences(ignore_touch=True)) is None


def test_fingers_are_known_by_what_they_touch():
    assert xinput2.Device("ELAN Touchscreen", direct=True).touch
    assert xinput2.Device("Wacom Intuos Pro M Finger").touch
    assert not xinput2.Device("SynPS/2 Synaptics TouchPad").touch
    assert not xinput2.Device("Wacom Intuos Pro M Pen").touch
