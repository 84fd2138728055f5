"""Packets of Wintab become events; the driver itself is on no machine of the tests."""

import ctypes as ct

import pytest

from app.input.events import LEFT, RIGHT
from app.input.wintab import PARTS_OF_PIXEL, Packet, Told, _Context, leaning, packet_events

TOLD = Told(2047, True, True)


def test_structures_have_the_sizes_of_the_headers():
    assert (ct.sizeof(Packet), ct.sizeof(_Context)) == (40, 80 if ct.sizeof(ct.c_wchar) == 2 else 160 + 132)


def test_a_packet_is_a_motion_in_the_window_with_fractions():
    packet = Packet(
        time=1500,
        x=PARTS_OF_PIXEL * 300 + 4,
        y=PARTS_OF_PIXEL * 200,
        pressure=1024,
        azimuth=900,
        altitude=450,
        twist=300,
    )
    (event,) = packet_events(packet, 0, TOLD, (100, 50))
    assert (event.kind, event.x, event.y, event.time, event.rotation) == ("move", 200.25, 150.0, 1.5, 30.0)
    assert event.pressure == pytest.approx(0.5, abs=1e-3)
    assert (event.tilt_x, event.tilt_y) == pytest.approx((45.0, 0.0))


def test_buttons_go_down_and_up_and_a_pen_that_leaves_lets_go():
    kinds = [(event.kind, event.button) for event in packet_events(Packet(buttons=3), 0, TOLD, (0, 0))]
    assert kinds == [("down", LEFT), ("down", RIGHT)]
    assert [event.kind for event in packet_events(Packet(buttons=2), 3, TOLD, (0, 0))] == ["up"]
    assert [event.kind for event in packet_events(Packet(status=1), 2, TOLD, (0, 0))] == ["lost"]
    assert packet_events(Packet(status=1), 0, TOLD, (0, 0)) == []
    assert packet_events(Packet(status=16), 0, Told(0, False, False), (0, 0))[0].eraser


@pytest.mark.parametrize(
    ("azimuth", "altitude", "tilt"),
    [(0, 900, (0, 0)), (1800, 450, (0, 45)), (0, 450, (0, -45)), (2700, 300, (-60, 0)), (900, -450, (45, 0))],
)
def test_a_pen_leans_to_where_its_upper_end_points(azimuth, altitude, tilt):
    assert leaning(azimuth, altitude) == pytest.approx(tilt, abs=1e-9)
