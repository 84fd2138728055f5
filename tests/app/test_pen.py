"""A pen with pressure, from the X server's driver to paint on the screen."""

import ctypes as ct
import json
import time
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path

import inputtest
import numpy as np
import pytest
from xserver import lacking, need, started_server

from app.input.events import ENDS
from app.input.xinput2 import Libraries

pytestmark = pytest.mark.window
UNITS_X, UNITS_Y = 65536 / 1280, 65536 / 800  # of the driver's axes in a pixel
HEAVIEST = 1000.0
WHOLE_NUMBER = 19  # what Xlib calls XA_INTEGER


@pytest.fixture(scope="module")
def pen(tmp_path_factory):
    """(display, pen): an X server whose only pointer is a pen."""
    need("Xorg", "xdotool")
    if not list(Path("/usr/lib/xorg/modules").glob("**/dummy_drv.so")):
        lacking("xserver-xorg-video-dummy")
    folder = tmp_path_factory.mktemp("pen")
    (folder / "pen.conf").write_text(inputtest.CONFIG.format(socket=folder / "socket"))
    switches = ["-noreset", "-nolisten", "tcp", "-novtswitch", "-sharevts", "-logfile", str(folder / "log")]
    process, display = started_server(["Xorg", "-config", str(folder / "pen.conf"), *switches])
    held = inputtest.Pen(folder / "socket")
    yield display, held
    process.terminate()
    process.wait(90)
    held.close()


def moved(pen, x, y, pressure):
    pen.move(x * UNITS_X, y * UNITS_Y, pressure * HEAVIEST)
    pen.sync()
    time.sleep(0.004)


def test_pressure_arrives_as_paint(program, pen):
    display, held = pen
    app = program(on=display)
    held.near(True)
    empty = app.settled().astype(int)
    moved(held, 350, 400, 0.0)
    held.press(True)
    for i in range(101):
        moved(held, 350 + 5 * i, 400, 0.1 + 0.9 * i / 100)
    held.press(False)
    moved(held, 700, 790, 0.0)
    held.sync()
    app.until_rest((700, 790))
    painted = app.settled().astype(int)
    ink = np.abs(painted - empty).sum(axis=(0, 2))
    light, heavy = ink[400:500].sum(), ink[720:820].sum()
    assert heavy > 0
    assert heavy > 1.5 * light, "the same paint whatever the pressure"


LINES = (
    {"inkfall": 1, "frame": [0, 0, 320, 240], "seed": 1},
    {"do": "layer", "add": "Layer 1"},
    {"do": "guide", "name": "Ruler", "kind": "ruler", "points": [[20, 200], [300, 200]]},
)


class Hand:
    """A pen over the frame of a program, which lies in the middle of what its panels leave, a pixel on one of the
    screen."""

    def __init__(self, app, pen):
        self.app, self.pen = app, pen
        self.left, self.top = 621 - 160, 398 - 120

    def look(self):
        """What the frame shows when all is done, int (240, 320, 3), the pen being away."""
        moved(self.pen, 640, 790, 0.0)
        self.app.until_rest((640, 790))
        return self.app.settled()[self.top : self.top + 240, self.left : self.left + 320].astype(int)

    def along(self, *places, steps=8):
        """Presses, moves with a growing pressure, and lifts; what it changed in the frame, bool (240, 320)."""
        before, count = self.look(), steps * (len(places) - 1)
        path = np.concatenate([np.linspace(a, b, steps, endpoint=False) for a, b in pairwise(places)])
        moved(self.pen, self.left + places[0][0], self.top + places[0][1], 0.0)
        self.pen.press(True)
        for n, (x, y) in enumerate((*path, places[-1])):
            moved(self.pen, self.left + x, self.top + y, 0.4 + 0.6 * n / max(count, 1))
        self.pen.press(False)
        self.pen.sync()
        self.app.until_rest((self.left + places[-1][0], self.top + places[-1][1]))
        return np.abs(self.look() - before).max(axis=2) > 30


@pytest.mark.nightly
def test_with_the_pen_one_selects_masks_fills_draws_shapes_by_rulers_and_around_a_tile(program, pen, tmp_path):
    display, held = pen
    (tmp_path / "tile.jsonl").write_text("\n".join(map(json.dumps, LINES)) + "\n")
    app = program(str(tmp_path / "tile.jsonl"), on=display)
    held.near(True)
    app.settled()
    app.keys("1", "b", *["bracketright"] * 6)
    hand = Hand(app, held)
    ruled = hand.along((40, 195), (120, 206), (200, 193), (260, 203))
    rows, columns = np.nonzero(ruled)
    assert columns.max() - columns.min() > 180
    assert np.abs(rows - 200).max() < 8  # straight, however it was drawn
    app.keys("y")
    both = hand.along((30, 30), (90, 60))
    assert both[:, :150].sum() > 300
    assert abs(both[:, :160].sum() - both[:, 160:].sum()) < 0.2 * both.sum()
    app.keys("q")
    clear = hand.along((60, 100), (100, 120))  # of the tint
    assert abs(clear[:, :160].sum() - clear[:, 160:].sum()) < 0.2 * clear.sum() > 0
    app.keys("y", "q", "o")
    app.box("deselect")
    hand.along((120, 90), (200, 90), (200, 150), (120, 150), (120, 92))  # in place of that
    app.keys("b")
    within = hand.along((90, 120), (230, 120))
    rows, columns = np.nonzero(within[:, 100:220])
    assert 70 < columns.max() - columns.min() < 90
    app.keys("g")
    filled = hand.along((160, 140), (160, 140))
    assert filled[93:108, 124:196].all()
    assert not filled[:85].any()
    app.keys("ctrl+z", "shift+g")
    graded = hand.along((120, 100), (200, 140))
    assert graded[130:148, 124:150].all()
    app.keys("ctrl+z", "ctrl+shift+a")
    app.until_gone("deselect")
    app.keys("ctrl+alt+w", "b")
    around = hand.along((280, 40), (370, 50))
    assert around[30:60, 290:].sum() > 200
    assert around[30:60, :40].sum() > 200


@contextmanager
def heard(display):
    """The pens that a window on a display hears."""
    import glfw
    from imgui_bundle import imgui  # noqa: F401  # before glfw, so that both use one libglfw

    from app.input.xinput2 import XInput2Pointer

    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("DISPLAY", display)
        assert glfw.init()
        window = glfw.create_window(1280, 800, "pen", None, None)
    source = XInput2Pointer(glfw.get_x11_window(window), glfw.post_empty_event, display)
    try:
        yield source
    finally:
        source.close()
        glfw.destroy_window(window)
        glfw.terminate()


def test_every_report_arrives_in_order_with_its_fractions(pen):
    """A thousand reports, faster than frames are drawn: none is lost, none is rounded."""
    display, held = pen
    with heard(display) as source:
        assert source.tablets() == ["Test Pen"]
        for i in range(1000):
            held.move((100 + i * 0.37) * UNITS_X, 300 * UNITS_Y, i)
        held.sync()
        events, end = source.events(), time.monotonic() + 90
        while len(events) < 1000 and time.monotonic() < end:
            time.sleep(0.02)
            events += source.events()
    assert len(events) == 1000
    assert all(event.pen for event in events)
    assert np.allclose([e.pressure for e in events], np.arange(1000) / 1000)
    assert np.allclose([e.x for e in events], 100 + np.arange(1000) * 0.37, atol=0.03)


def plugged(display, pen, on):
    """The pen's tablet is plugged in, or out: the server then adds or takes away its device."""
    lib = Libraries()
    server = lib.x.XOpenDisplay(display.encode())
    lib.x.XInternAtom.restype, lib.x.XInternAtom.argtypes = ct.c_ulong, [ct.c_void_p, ct.c_char_p, ct.c_int]
    i, u = ct.c_int, ct.c_ulong
    lib.xi.XIChangeProperty.argtypes = [ct.c_void_p, i, u, u, i, i, ct.c_char_p, i]
    switch = lib.x.XInternAtom(server, b"Device Enabled", 0)
    lib.xi.XIChangeProperty(server, pen, switch, WHOLE_NUMBER, 8, 0, bytes([on]), 1)
    lib.x.XCloseDisplay(server)


def test_a_pen_that_is_unplugged_while_it_is_pressed_ends_its_stroke(pen):
    display, held = pen
    with heard(display) as source:
        number = next(ident for ident, device in source._devices.items() if device.pen)
        held.near(True)
        moved(held, 400, 300, 0.5)
        held.press(True)
        moved(held, 460, 320, 0.6)
        held.sync()
        plugged(display, number, False)
        end, events = time.monotonic() + 90, source.events()
        while not any(event.kind in ENDS for event in events):
            assert time.monotonic() < end, f"nothing tells that it is gone: {events}"
            time.sleep(0.02)
            events += source.events()
        while source.tablets():
            assert time.monotonic() < end, "it is still there"
            time.sleep(0.02)
        plugged(display, number, True)
        while not source.tablets():
            assert time.monotonic() < end, "it does not come back"
            time.sleep(0.02)
    assert [event.kind for event in events if event.kind != "move"] == ["down", events[-1].kind]
    assert (events[-1].x, events[-1].y) == pytest.approx((460, 320), abs=0.05)
