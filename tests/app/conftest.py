"""A display of their own for tests that open the real window, and the program under a test's hand."""

import ctypes

import moderngl
import pytest
from driven import Program
from forked import Server
from xserver import lacking, need, started_screen


@pytest.fixture(scope="session")
def display():
    need("Xvfb", "xdotool")
    process, name = started_screen()
    yield name
    process.terminate()
    process.wait(90)


@pytest.fixture(scope="session")
def fork_server():
    begun = Server()
    yield begun
    begun.close()


@pytest.fixture
def program(display, tmp_path, fork_server):
    """Starts programs; `fresh`: one that loads everything for itself, as an artist's does."""
    opened = []

    def start(*words: str, on: str = display, fresh: bool = False, **told: str) -> Program:
        opened.append(Program(on, tmp_path, *words, server=None if fresh else fork_server, **told))
        return opened[-1]

    yield start
    for one in opened:
        one.close()


@pytest.fixture
def with_stroke(program):
    """The window with a stroke, one pixel of level 0 on one of the screen."""
    app = program()
    app.settled()
    app.keys("1")
    empty = app.canvas()
    app.stroke(*((440 + 8 * i, 320 + 5 * i) for i in range(16)))
    app.canvas_unlike(empty)
    app.box("Layer 1")  # the stroke is done
    return app


@pytest.fixture(scope="module")
def context():
    """OpenGL without a display."""
    try:
        made = moderngl.create_context(standalone=True, backend="egl")
    except Exception as error:  # whatever the driver says: no GL here
        lacking(f"EGL: {error}")
    yield made
    made.release()
    ctypes.CDLL("libEGL.so.1").eglReleaseThread()  # X refuses windows of a thread that has a context of EGL's
