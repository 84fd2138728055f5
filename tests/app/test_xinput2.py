"""Decoding XInput 2: structures filled by hand, as the X server fills them."""

import ctypes as ct

import pytest
from imgui_bundle import imgui  # noqa: F401  # before glfw, so that both use one libglfw

from app.input import xinput2 as x
from app.keys import pointer_chord


def report(kind, *, detail=0, values=None, at=(10.25, 20.75), time=5000):
    """An XIDeviceEvent with valuators {number: raw}; what it points to must be kept alive."""
    values = values or {}
    mask = (ct.c_ubyte * 2)()
    for number in values:
        mask[number >> 3] |= 1 << (number & 7)
    numbers = (ct.c_double * max(1, len(values)))(*(values[n] for n in sorted(values)))
    state = x.ValuatorState(2, ct.cast(mask, ct.POINTER(ct.c_ubyte)), ct.cast(numbers, ct.POINTER(ct.c_double)))
    event = x.DeviceEvent(evtype=kind, detail=detail, time=time, event_x=at[0], event_y=at[1], valuators=state)
    return event, (mask, numbers)


def pen(name="Stylus"):
    return x.Device(name, {2: x.Axis("pressure", 0, 8191), 3: x.Axis("tilt_x", -64, 63), 4: x.Axis("tilt_y", -64, 63)})


def test_places_keep_their_fractions_and_times_become_seconds():
    event, _keep = report(x.MOTION)
    found = x.pen_event(event, None)
    assert (found.kind, found.x, found.y, found.time) == ("move", 10.25, 20.75, 5.0)
    assert found.pressure == 1.0
    assert not found.pen


def test_pressure_is_normalised_by_the_range_of_its_axis():
    event, _keep = report(x.MOTION, values={0: 500.0, 1: 600.0, 2: 8191.0, 3: -32.0})
    found = x.pen_event(event, pen())
    assert found.pen
    assert found.pressure == 1.0
    assert found.tilt_x == -32.0


def test_an_axis_that_did_not_change_keeps_its_value():
    device = pen()
    first, _a = report(x.BUTTON_PRESS, detail=1, values={2: 4095.5})
    assert x.pen_event(first, device).pressure == pytest.approx(0.5)
    second, _b = report(x.MOTION, values={0: 1.0, 4: 30.0})
    found = x.pen_event(second, device)
    assert found.pressure == pytest.approx(0.5)
    assert found.tilt_y == 30.0


def test_the_mouse_moving_in_between_does_not_take_the_pens_pressure():
    device = pen()
    first, _a = report(x.MOTION, values={2: 8191.0})
    x.pen_event(first, device)
    mouse, _b = report(x.MOTION, values={0: 3.0, 1: 4.0})
    assert x.pen_event(mouse, x.Device("Mouse")).pressure == 1.0
    assert device.last["pressure"] == 1.0


@pytest.mark.parametrize(("raw", "expected"), [(-5.0, 0.0), (9999.0, 1.0)])
def test_pressure_out_of_its_range_is_clamped(raw, expected):
    assert x.Axis("pressure", 0, 8191).value(raw) == expected


def test_an_axis_without_a_range_gives_nothing_wild():
    assert x.Axis("pressure", 0, 0).value(3) == 0.0


def test_tilt_in_other_units_becomes_degrees():
    assert x.Axis("tilt_x", -9000, 9000).value(4500) == 45.0
    assert x.Axis("tilt_x", -64, 63).value(-64) == -64.0


def test_a_barrel_that_is_told_becomes_degrees_and_none_is_told_as_none():
    assert x.Axis("rotation", -900, 899).value(450) == 90.0
    assert x.Axis("rotation", 0, 0).value(7) == 0.0
    told, _keep = report(x.MOTION, values={2: 4000.0, 5: -450.0})
    device = pen()
    assert x.pen_event(told, device).rotation is None
    device.axes[5] = x.Axis("rotation", -900, 899)
    assert x.pen_event(told, device).rotation == -90.0


@pytest.mark.parametrize(("detail", "dx", "dy"), [(4, 0, 1), (5, 0, -1), (6, 1, 0), (7, -1, 0)])
def test_buttons_four_to_seven_are_the_wheel(detail, dx, dy):
    event, _keep = report(x.BUTTON_PRESS, detail=detail)
    found = x.pen_event(event, None)
    assert (found.kind, found.dx, found.dy) == ("wheel", dx, dy)
    event, _keep = report(x.BUTTON_RELEASE, detail=detail)
    assert x.pen_event(event, None) is None


@pytest.mark.parametrize(("detail", "button"), [(1, 1), (2, 2), (3, 3), (8, 4), (9, 5)])
def test_presses_and_releases(detail, button):
    for kind, word in ((x.BUTTON_PRESS, "down"), (x.BUTTON_RELEASE, "up")):
        event, _keep = report(kind, detail=detail)
        found = x.pen_event(event, None)
        assert (found.kind, found.button) == (word, button)


def test_other_buttons_are_told_by_their_number_and_those_beside_a_tablet_apart():
    event, _keep = report(x.BUTTON_PRESS, detail=10)
    assert x.pen_event(event, None).button == 6
    pad = x.Device("Wacom Intuos Pro M Pad pad")
    event, _keep = report(x.BUTTON_PRESS, detail=1)
    assert pointer_chord(x.pen_event(event, pad), 0) == "Pad button 1"
    event, _keep = report(x.BUTTON_PRESS, detail=4)
    assert pointer_chord(x.pen_event(event, pad), 0) == "Ring up"
    assert pointer_chord(x.pen_event(event, x.Device("Touchpad")), 0) == "Wheel up"


def test_the_eraser_is_known_by_its_name():
    event, _keep = report(x.MOTION, values={2: 1.0})
    assert x.pen_event(event, pen("Wacom Intuos Pen eraser")).eraser
    assert not x.pen_event(event, pen("Wacom Intuos Pen stylus")).eraser


def test_masks_have_the_bits_that_the_protocol_counts():
    mask = x.mask_of(x.MOTION, x.BUTTON_PRESS, x.HIERARCHY_CHANGED)
    assert list(mask) == [0b01010000, 0b00001000, 0, 0]


def test_structures_have_the_sizes_of_the_headers():
    if ct.sizeof(ct.c_long) == 8:
        assert ct.sizeof(x.Event) == 192
        assert x.DeviceEvent.event_x.offset == 104
        assert x.DeviceEvent.valuators.offset == 144
        assert x.ValuatorClass.min.offset == 24
