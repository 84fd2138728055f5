"""What ends a stroke, or the program, from outside: another window in front, the death of the display."""

import ctypes
import time

import pytest
from xserver import need, started_screen

from engine.journal.entries import listed

pytestmark = pytest.mark.window
POINTER_ROOT = 1


@pytest.fixture
def server():
    """(process, display): an X server that a test may kill."""
    need("Xvfb", "xdotool")
    process, name = started_screen()
    yield process, name
    process.kill()
    process.wait(90)


def take_focus(display):
    """Takes the focus from every window of a display."""
    x = ctypes.CDLL("libX11.so.6")
    x.XOpenDisplay.restype, x.XOpenDisplay.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    x.XSetInputFocus.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_ulong]
    x.XCloseDisplay.argtypes = [ctypes.c_void_p]
    opened = x.XOpenDisplay(display.encode())
    x.XSetInputFocus(opened, POINTER_ROOT, 0, 0)
    x.XCloseDisplay(opened)


def draw(app, *points):
    """The left button drawn through screen points, and held at the last."""
    app.do("mousemove", *points[0], "mousedown", 1)
    for point in points[1:]:
        app.do("mousemove", *point)
        time.sleep(0.03)


def test_a_stroke_stays_when_the_focus_goes_and_the_program_ends_well_when_the_display_does(program, server):
    process, display = server
    app = program(on=display)
    empty = app.canvas()
    draw(app, (400, 300), (500, 350), (600, 300))
    take_focus(display)
    app.wait_for("a stroke is posted")
    app.do("mousemove", 700, 600, "mouseup", 1)
    painted = app.canvas_unlike(empty)
    assert (painted[440:] == empty[440:]).all(), "the stroke went on after the focus was lost"
    app.do("search", "--onlyvisible", "--name", "Inkfall", "windowfocus", "--sync")
    app.do("mousemove", 400, 500)
    app.until_rest((400, 500))  # X tells that the focus is lost and there: it goes another way than a press, too
    draw(app, (400, 500), (600, 600))
    app.until_rest((600, 600))  # the key goes another way than the pointer, and may be there before it
    app.keys("Escape")
    app.do("mouseup", 1)
    assert app.comes_to(painted)
    app.keys("ctrl+z")
    assert app.comes_to(empty)
    draw(app, (400, 300), (500, 350))
    app.canvas_unlike(empty)  # the display lives until the stroke has come to the program
    process.kill()
    assert app.process.wait(90) == 0, app.log.read_text()
    words = app.log.read_text()
    assert "Fatal" not in words, words
    (kept,) = listed(app.folder / "state" / "inkfall" / "paintings")
    assert (kept.strokes, kept.alive, kept.in_bin, kept.faults) == (2, False, False, ())
